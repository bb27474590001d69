"""How each item without a partner disappears, by how it lies; what appears does so backwards.

What lies in something that stays, or is loose, shrinks about its middle; what touches something
that stays shrinks into the contact; lines are retracted along their length. So everything is seen
whole or not at all, and nothing through anything else.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ends import End
from shapetween.geometry.bezier import flatten
from shapetween.scene.asked import Change
from shapetween.scene.faces import have_faces
from shapetween.scene.forms import RoundedBox
from shapetween.scene.relations import Scene
from shapetween.scene.unmatched.clusters import (
    Anchors,
    Cluster,
    clusters_of,
    contact,
    is_line,
    staying_parent,
)
from shapetween.scene.unmatched.contents import joined_on_hosts
from shapetween.scene.unmatched.encircling import encircling_going
from shapetween.scene.unmatched.gaps import timed_gaps
from shapetween.scene.unmatched.going import Going, Side, nearer_end, nearest_beside, within_reach
from shapetween.scene.unmatched.inside_holes import gone_with_hole
from shapetween.scene.unmatched.presence import Leaving
from shapetween.scene.unmatched.retracting import first_end, gap_going, retracted_lines

__all__ = ["goings_between"]

#: Share of a part's own size along which it must touch the border it lies at, from inside, to
#: shrink into that. Smaller, and what only nears the border goes sideways.
TOUCHES = 0.35

#: Sum of differences of colour from what an item lies on up to which it is shade or shine: it
#: melts into that, since shrinking shades are more seen than melting ones. Larger, and ghosts of
#: eyes and mouths are seen.
SHADE = 0.16

#: Share of shade that lies on what it is the shade of, and not in its holes.
LIES_ON = 0.8

#: Least size, as a share of what it lies on, of an area that melts into that because what lies on
#: it stays: an ape's muzzle would grow as a lump between its eyes. Smaller, and the whites of eyes
#: are ghosts; larger, and the muzzle is a lump.
GROUND = 0.4

#: Size at which what grows is first seen: a share of its own, and at most one of the drawing. With
#: none, what comes is a dot first; with much, it snaps into place.
LEAST, LEAST_SEEN = 0.3, 0.06

#: Gap to another part, as a share of the drawing, that a part keeps all along if that one covers a
#: share of it at some time. Wider gaps are no gaps, and a part that only grazes another is no lump.
GAP, COVERED = 0.06, 0.3

#: Ratio of the sizes of two such parts. Of less alike ones, one is a twig or a dot of the other.
LIKE = (0.8, 2.5)

#: When that is looked at, of what comes; of what goes, backwards.
AWAY_FROM_HOME = np.array([0.0, 0.25, 0.5])

#: Distance of what goes from what comes, as a share of the drawing, from which on both may be seen
#: at once. Smaller, and one grows into what is left of the other; larger, and what appears
#: waits for what is nowhere near it.
APART = 0.03

#: Ratio of sides from which on a loose box goes into its end, as a ray of a sun.
SLIM = 1.6


#: Power of size by which the lines of a sign thin. At 1 they are pale when small; at 0 what is
#: close clots.
LINES_THIN = 0.6

#: Time from which on a line comes in whose place something was. Earlier, and both are seen there at
#: once; later, and it snaps.
LATE = 0.55


def goings_between(
    scenes: tuple[Scene, Scene],
    anchors: tuple[Anchors, Anchors],
    unmatched: tuple[Sequence[int], Sequence[int]],
    change: Change | None = None,
) -> tuple[dict[int, Going], dict[int, Going]]:
    """How the items of two drawings that have no partners go, and come.

    Parameters
    ----------
    scenes : (Scene, Scene)
    anchors : (mapping of int to sequence of Track, ...)
        Of the items that have partners.
    unmatched : (sequence of int, sequence of int)
    change : str, optional
        How they go, if the user says so. What cannot be drawn along its length grows instead.
    """
    gaps = [
        tuple(s.items[k] for k in own if s.items[k].cut and not s.items[k].filled)
        for s, own in zip(scenes, unmatched, strict=True)
    ]
    apart = _apart(scenes, unmatched)
    seen = have_faces(*scenes)
    sides = (
        Side(scenes[0], anchors[0], End.SOURCE, gaps[1], not unmatched[1], apart, seen[0]),
        Side(scenes[1], anchors[1], End.TARGET, gaps[0], not unmatched[0], apart, seen[1]),
    )
    first, second = (_goings(s, own, change) for s, own in zip(sides, unmatched, strict=True))
    timed_gaps(sides[0], sides[1], first, second)
    timed_gaps(sides[1], sides[0], second, first)
    return first, second


def _apart(scenes: tuple[Scene, Scene], unmatched: tuple[Sequence[int], Sequence[int]]) -> bool:
    """Whether what goes is nowhere near what comes."""
    import shapely

    drawn = [
        shapely.union_all([s.items[k].enclosed for k in own if not s.sheets[k]])
        for s, own in zip(scenes, unmatched, strict=True)
    ]
    scale = (scenes[0].scale + scenes[1].scale) / 2
    return bool(shapely.distance(*drawn) > APART * scale)


def _goings(side: Side, unmatched: Sequence[int], change: Change | None = None) -> dict[int, Going]:
    found: dict[int, Going] = {}
    clustered = []
    for k in unmatched:
        alone = _by_itself(k, side)
        if alone is None:
            clustered.append(k)
        else:
            found[k] = alone
    clusters = clusters_of(clustered, side.scene, side.anchors)
    for cluster in joined_on_hosts(clusters, side):
        together = _together(cluster, side)
        # With something else coming or going, waiting would leave the middle empty.
        if side.only and any(_waits(k, side) for k in cluster.members):
            together = {k: _later(going, side.end) for k, going in together.items()}
        found |= together
    if change is not None:
        for k in unmatched:
            if not side.scene.sheets[k]:
                found[k] = _asked(change, found[k], k, side)
    return found


def _later(going: Going, end: End) -> Going:
    """The same, but not before what is in its place has left half of its way."""
    low, high = going.leaving.window
    window = (max(low, LATE), high) if end is End.TARGET else (low, min(high, 1 - LATE))
    return replace(going, leaving=replace(going.leaving, window=window))


def _waits(k: int, side: Side) -> bool:
    """Whether something that stays has to move away from a line's place before it may come."""
    import shapely

    scene, item = side.scene, side.scene.items[k]
    if item.filled or item.closed or item.cut:
        return False
    for j, tracks in side.anchors.items():
        other = scene.items[j]
        if other.filled or item.drawn.intersects(other.drawn):
            continue
        curves = tracks[0].curves(np.array([1.0 - side.end]))[0]
        points = np.append(flatten(curves, 4).reshape(-1, 2), curves[-1:, 3], axis=0)
        before = shapely.LineString(points)
        if before.distance(item.drawn) < other.width / 2:
            return True
    return False


def _by_itself(k: int, side: Side) -> Going | None:
    """How an item goes that no other one concerns; None for what is looked at with others."""
    scene, item = side.scene, side.scene.items[k]
    if scene.sheets[k]:
        return Going(Leaving((0.0, 1.0), fades=True))
    anchor = int(scene.outlined[k])
    if anchor in side.anchors and item.closed:
        thins = item.painted is None  # else it has no stroke
        leaving = Leaving(side.window, thins=float(thins), fades=not thins)
        along = side.anchors[anchor][0] if thins else None
        return Going(leaving, side.carry(anchor, item.centre, "in"), along=along)
    if item.cut and not item.filled:
        return gap_going(k, side)
    parent = staying_parent(k, scene, side.anchors)
    if parent is not None and item.filled and scene.items[parent].filled:
        away = np.abs(scene.colours[k] - scene.colours[parent]).sum()
        over = scene.sizes[k] > GROUND * scene.sizes[parent] and any(
            scene.parents[j] == k and scene.items[j].filled for j in side.anchors
        )
        # What comes in from an edge is no ground: it slides over what lies there.
        edge = contact([k], parent, scene, inside=True)[1]
        ground = over and edge <= TOUCHES * scene.sizes[k]
        if (away < SHADE or ground) and scene.common(k, parent) > LIES_ON * item.area:
            return Going(Leaving(side.window, fades=True), side.carry(parent, item.centre, "in"))
    return None


def _together(cluster: Cluster, side: Side) -> dict[int, Going]:
    """How items go that touch each other, or are one sign."""
    members = cluster.members
    inside = gone_with_hole(members, side)
    if inside is not None:
        return inside
    if cluster.sign:
        place, thins = _middle(members, side.scene), LINES_THIN if cluster.lines else 1.0
        leaving = Leaving(side.window, place, thins=thins, least=_least(members, side.scene))
        return dict.fromkeys(members, Going(leaving, side.carry(cluster.parent, place, "in")))
    lines = retracted_lines(cluster, side) if cluster.lines else None
    if lines is not None:
        return lines
    round_it = encircling_going(members, side)
    if round_it is not None:
        return {members[0]: round_it}
    place, anchor, how = _shrinks_to(cluster, side)
    leaving = Leaving(side.window, place, least=_least(members, side.scene))
    return {k: Going(leaving, side.carry(anchor, place, how)) for k in members}


def _shrinks_to(
    cluster: Cluster, side: Side
) -> tuple[Points, int | None, Literal["in", "at", "beside"]]:
    """The place that a cluster shrinks to, and what that is carried by, and how."""
    scene, members, parent = side.scene, cluster.members, cluster.parent
    if parent is not None:
        if scene.items[parent].closed:
            place, length = contact(members, parent, scene, inside=True)
            if length > TOUCHES * max(scene.sizes[k] for k in members):
                return place, parent, "in"
        return _middle(members, scene), parent, "in"
    touched = [
        j
        for j in side.anchors
        if not scene.sheets[j] and any(scene.touching[k, j] for k in members)
    ]
    if touched:
        found = {j: contact(members, j, scene, inside=False) for j in touched}
        anchor = max(touched, key=lambda j: (round(found[j][1] / scene.scale, 9), -j))
        if _behind(members, anchor, scene):
            return scene.items[anchor].centre, anchor, "in"
        return found[anchor][0], anchor, "at"
    pushed = _pushed_by(members, side)
    if pushed is not None:
        return *pushed, "at"
    beside = nearest_beside(members, side)
    if len(members) == 1 and beside is not None:
        end = _slim_end(members[0], beside, scene)
        if end is not None:
            return end, beside, "beside"
    return _middle(members, scene), beside, "beside"


def _pushed_by(members: Sequence[int], side: Side) -> tuple[Points, int] | None:
    """Where a part is nearest to another one that is wider on its way, and which that is.

    It keeps its gap to that from the start, or would grow out of it as a lump. One with a mate does
    as that one does.
    """
    import shapely

    scene = side.scene
    mated = any(axis.mates[k] not in (-1, k) for axis in scene.axes for k in members)
    if mated or not all(scene.items[k].filled for k in members):
        return None
    own = shapely.union_all([scene.items[k].drawn for k in members])
    found = []
    for j, tracks in side.anchors.items():
        larger = scene.sizes[j] / max(scene.sizes[k] for k in members)
        if scene.sheets[j] or not scene.items[j].filled or not LIKE[0] < larger < LIKE[1]:
            continue
        if not within_reach(scene.items[j], own, GAP * scene.scale):
            continue
        away = shapely.distance(own, scene.items[j].drawn) / scene.scale
        if not 0 < away < GAP:
            continue
        curves = tracks[0].curves(np.abs(float(side.end is End.SOURCE) - AWAY_FROM_HOME))
        rings = flatten(curves[:, : tracks[0].counts[0]], 4)
        over = [shapely.make_valid(shapely.Polygon(ring)).intersection(own).area for ring in rings]
        if max(over) > COVERED * own.area:
            found.append((round(away, 9), j))
    if not found:
        return None
    anchor = min(found)[1]
    line = shapely.shortest_line(own, scene.items[anchor].drawn)
    return np.array(line.coords[0]), anchor


def _least(members: Sequence[int], scene: Scene) -> float:
    """Share of its size at which a cluster is first seen."""
    boxes = np.array([scene.items[k].box for k in members])
    extent = float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
    return min(LEAST, LEAST_SEEN * scene.scale / max(extent, LEAST_SEEN * scene.scale))


def _middle(members: Sequence[int], scene: Scene) -> Points:
    """The middle of the one that is around the others, else of the box of all."""
    largest = max(members, key=lambda k: (round(float(scene.sizes[k]) / scene.scale, 9), -k))
    box = scene.items[largest].box
    boxes = np.array([scene.items[k].box for k in members])
    slack = 0.02 * scene.scale
    if (boxes[:, 0] >= box[0] - slack).all() and (boxes[:, 1] <= box[1] + slack).all():
        return scene.items[largest].centre
    return np.asarray((boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2)


def _behind(members: Sequence[int], anchor: int, scene: Scene) -> bool:
    """Whether something looks out from behind another all around, as the rays of a sun do."""
    import shapely

    if len(members) > 1 or members[0] > anchor or not scene.items[anchor].closed:
        return False
    item = scene.items[members[0]]
    box, inner = item.enclosed, scene.items[anchor].enclosed
    middle = shapely.Point(scene.items[anchor].centre)
    return bool(box.contains(middle) and box.area < 4 * inner.area and not item.holes)


def _slim_end(k: int, anchor: int, scene: Scene) -> Points | None:
    """The end of a slim box that points to what is beside it."""
    form = scene.forms[k]
    if not isinstance(form, RoundedBox) or form.sides.max() < SLIM * form.sides.min():
        return None
    long = int(form.sides.argmax())
    along = np.array([np.cos(form.angle), np.sin(form.angle)])
    if long:
        along = np.array([-along[1], along[0]])
    ends = form.centre + np.array([[-0.5], [0.5]]) * form.sides[long] * along
    near = nearer_end(ends, anchor, scene)
    return None if near is None else ends[near]


def _asked(change: Change, going: Going, k: int, side: Side) -> Going:
    """The same time, but in the way that the user asks for."""
    scene, item, anchors = side.scene, side.scene.items[k], side.anchors
    window = going.leaving.window
    carries = going.carries[:1]
    if change == "draw" and is_line(k, scene):
        kept = going.leaving.kept
        if kept is None:
            kept = first_end(item.outer.curves[[0, -1], [0, 3]])
        return replace(going, leaving=Leaving(window, kept=kept))
    if change == "slide" and anchors:
        away = np.linalg.norm(scene.centres[list(anchors)] - item.centre, axis=1)
        larger = np.array([scene.sizes[j] >= scene.sizes[k] for j in anchors])
        nearest = list(anchors)[int(np.where(larger, away, np.inf).argmin())]
        return Going(Leaving(window, scene.items[nearest].centre), carries)
    if change == "fade":
        return Going(Leaving(window, fades=True), carries)
    return Going(Leaving(window, item.centre), carries)
