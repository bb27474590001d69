"""How each item without a partner goes, by how it lies; what comes does the same backwards."""

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.model.outline import Outline
from shapetween.scene.asked import Change
from shapetween.scene.forms import Dot, OpenLine, Segment
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Frame, Track
from shapetween.scene.places import Places, cut_alike
from shapetween.scene.presence import LAST, Carry, Kept, Leaving, LonePart
from shapetween.scene.relations import Scene
from shapetween.scene.strokes import StrokedLonePart, stroked_lone_part

__all__ = ["leaving_part"]

#: When a child of a part that stays goes, when what is loose does, and when it does where nothing
#: stays at all.
CHILD, LOOSE, EMPTY = (0.05, 0.58), (0.0, 0.45), (0.0, 0.72)

#: Share of its own size along which a fill must touch another for it to go into that.
TOUCHES = 0.35

#: Size at last of what goes behind another.
HIDDEN = 0.55

#: How near a line's end is to what it lies on, in widths.
ON = 0.6

#: Share of leaving from which on a line that shrinks into its middle fades.
DOTTED = 0.5

#: Size that a fill which fades where it is has at last, and one that lies in another.
FADED, FADED_CHILD = 0.65, 0.6


def leaving_part(
    k: int,
    scene: Scene,
    hosts: dict[int, tuple[Track, ...]],
    arrives: bool,
    frame: Frame | None,
    change: Change | None = None,
) -> LonePart | StrokedLonePart:
    """The part of an item without a partner.

    Parameters
    ----------
    k : int
        Which item.
    scene : Scene
    hosts : dict of int to tuple of Track
        Of the items that have partners.
    arrives : bool
        Whether it comes.
    frame : Frame or None
        What the whole drawing moves in.
    change : str, optional
        How it goes, if the user says so. What cannot be drawn along its length grows instead.
    """
    item = scene.items[k]
    leaving, host = _leaving(k, scene, hosts, arrives)
    if change is not None and not scene.sheets[k]:
        leaving = _asked(change, leaving, k, scene, hosts)
    carry = None
    if host is not None:
        carry = Carry.near(hosts[host][0], item.centre, scene.scale, float(arrives))
    rings = [ring.curves for ring in item.rings]
    closed = tuple(ring.closed for ring in item.rings)
    if item.filled:
        rings[1:] = [curves[::-1, ::-1] for curves in rings[1:]]
    if leaving.drawn == "both":
        rings, closed = _halves(item.outer), (False, False)
    if item.painted is not None:
        style = item.painted.style
        line = LonePart(item.name, style, tuple(rings), closed, leaving, arrives, carry)
        stroked = stroked_lone_part(line, item, frame)
        if stroked is not None:
            return stroked
    return LonePart(item.name, item.style, tuple(rings), closed, leaving, arrives, carry, frame)


def _halves(line: Outline) -> list[Curves]:
    """A line cut in its middle."""
    cut = np.array([0.0, 0.5, 1.0])
    places = Places(line)
    pieces = cut_alike(places, places, cut, cut).source
    middle = places.point(np.array([0.5]))[0]
    k = int(np.linalg.norm(pieces[:, 0] - middle, axis=1).argmin())
    return [pieces[:k], pieces[k:]]


def _asked(
    change: Change, leaving: Leaving, k: int, scene: Scene, hosts: dict[int, tuple[Track, ...]]
) -> Leaving:
    """The same time, but in the way that the user asks for."""
    item, window = scene.items[k], leaving.window
    if change == "draw" and not item.filled:
        return Leaving(window, drawn="start", fades=False)
    if change == "slide" and hosts:
        away = np.linalg.norm(scene.centres[list(hosts)] - item.centre, axis=1)
        larger = np.array([scene.sizes[j] >= scene.sizes[k] for j in hosts])
        nearest = list(hosts)[int(np.where(larger, away, np.inf).argmin())]
        return Leaving(window, scene.items[nearest].centre, 0.0, fades=False)
    if change == "fade":
        return Leaving(window)
    return Leaving(window, item.centre, 0.0, fades=False)


def _leaving(
    k: int, scene: Scene, hosts: dict[int, tuple[Track, ...]], arrives: bool
) -> tuple[Leaving, int | None]:
    """How an item goes, and what carries it meanwhile."""
    item, form = scene.items[k], scene.forms[k]
    window = LOOSE if hosts else EMPTY
    if scene.sheets[k]:
        return Leaving((0.0, 1.0)), None
    if scene.outlined[k] >= 0 and int(scene.outlined[k]) in hosts:
        return Leaving(CHILD), int(scene.outlined[k])
    parent = _staying(int(scene.parents[k]), scene, hosts)
    if isinstance(form, Segment | OpenLine) and not isinstance(form, Dot):
        return _line(k, item, scene, hosts, window, parent, arrives)
    if parent is not None:
        return Leaving(CHILD, item.centre, FADED_CHILD), parent
    touched = [j for j in hosts if scene.touching[k, j] and not scene.sheets[j]]
    if touched and item.filled:
        host = max(touched, key=lambda j: (_contact(scene, k, j)[1], -j))
        place, length = _contact(scene, k, host)
        if _behind(scene, k, host):
            return Leaving(window, scene.items[host].centre, HIDDEN, fades=False), host
        if length > TOUCHES * item.size:
            return Leaving(window, place, 0.0, fades=False), host
    return Leaving(window, item.centre, FADED), None


def _behind(scene: Scene, k: int, host: int) -> bool:
    """Whether an item looks out from behind another all around, as the rays of a sun do."""
    import shapely

    if k > host or not scene.items[host].closed:
        return False
    middle = shapely.Point(scene.items[host].centre)
    box = scene.items[k].enclosed
    inner = scene.items[host].enclosed
    return bool(box.contains(middle) and box.area < 4 * inner.area and not scene.items[k].holes)


def _staying(parent: int, scene: Scene, hosts: dict[int, tuple[Track, ...]]) -> int | None:
    """The nearest item around one that has a partner."""
    while parent >= 0:
        if parent in hosts:
            return parent
        parent = int(scene.parents[parent])
    return None


def _contact(scene: Scene, k: int, other: int) -> tuple[Points, float]:
    """Where two items touch, and along what length."""
    import shapely

    one, two = scene.items[k].drawn, scene.items[other].drawn
    reach = 0.004 * scene.scale
    shared = shapely.intersection(shapely.boundary(one), two.buffer(reach))
    if shared.is_empty:
        return scene.items[k].centre, 0.0
    middle = shared.centroid
    length = float(np.hypot(*np.diff(np.reshape(shared.bounds, (2, 2)), axis=0)[0]))
    return np.array([middle.x, middle.y]), length


def _line(
    k: int,
    item: Item,
    scene: Scene,
    hosts: dict[int, tuple[Track, ...]],
    window: tuple[float, float],
    parent: int | None,
    arrives: bool,
) -> tuple[Leaving, int | None]:
    """A line is retracted to what it lies on, to its middle, or to its first end."""
    import shapely

    others = [j for j in range(len(scene.items)) if j != k and scene.touching[k, j]]
    ends = shapely.points(item.outer.curves[[0, -1], [0, 3]])
    reach = ON * item.width
    on = [False, False]
    host = None
    for j in others:
        if scene.sheets[j] or scene.items[j].filled:
            continue
        near = shapely.distance(scene.items[j].drawn, ends) <= reach - item.width / 2
        on = [a or bool(b) for a, b in zip(on, near, strict=True)]
        if near.any() and j in hosts:
            host = j
    if host is None:
        host = parent
    if on[0] and on[1] and not (item.style.stroke and item.style.stroke.dashes):
        return Leaving(window, drawn="both", fades=False), host
    if on[0] != on[1]:
        return Leaving(window, drawn="start" if on[0] else "end", fades=False), host
    # What goes shrinks into its middle; what comes is drawn, as one draws it.
    kept: Kept = "start" if arrives and parent is None else "middle"
    crossing = [j for j in others if not scene.items[j].filled and not scene.sheets[j]]
    if crossing:
        # What crosses others on the mirror axis shrinks into its middle, else it is undrawn.
        axial = any(axis.mates[k] == k for axis in scene.axes)
        return _to_middle(window, "middle" if axial else kept), host
    return _to_middle(CHILD if parent is not None else window, kept), parent


def _to_middle(window: tuple[float, float], kept: Kept) -> Leaving:
    """What is left of a line in its middle would be a dot, so it fades before."""
    last = DOTTED if kept == "middle" else LAST
    return Leaving(window, drawn=kept, fades=False, last=last)
