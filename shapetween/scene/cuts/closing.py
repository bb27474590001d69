"""Lines that another one closes, where the other drawing has the ring that both are together."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline
from shapetween.model.paint import Stroke
from shapetween.scene.asked import Group
from shapetween.scene.cuts.division import Division, Found
from shapetween.scene.cuts.lines import opaque, shared_lines
from shapetween.scene.items import Item
from shapetween.scene.motion.knots import kinks_of
from shapetween.scene.places import SAME, Places, run_between
from shapetween.scene.relations import Scene

__all__ = ["closed_lines"]

#: Distance of a line's ends from what closes it, in its widths. Larger, and what closes it would be
#: seen to come out of it.
ON = 0.5

#: Least share of two boxes' common area of the area of both, for rings to be one. Smaller, and any
#: ring becomes any other.
COMMON = 0.5

#: Share of what closes a line from which on it is all of it, and drawn once.
ALL = 0.97

#: Share of a ring from which on lines that lie on it leave but gaps of it. Larger, and a slash is
#: taken for what closes the line it cuts.
GAPS = 0.75

#: Greatest length of what closes a line, as a share of it. Larger, and a hook on a circle is taken
#: for what it hangs on.
CLOSES = 0.8

#: Share of a line's extent up to which a gap to what closes it is none. Smaller, and rounding, so
#: the unit, leaves curves that are points; larger, and it would be seen.
GAP = 1e-7


def closed_lines(whole: Scene, parts: Scene, groups: Sequence[Group] = ()) -> Found:
    """Lines of a scene, closed by what both their ends lie on, that are rings of another one.

    What is drawn twice then lies on itself, so both drawings stay as they are.
    """
    kept = {k for one, _ in groups for k in one}
    lines = [k for k, item in enumerate(whole.items) if _line(item) and not item.closed]
    rings = [j for j, item in enumerate(parts.items) if _line(item) and item.closed]
    if not lines or not rings:
        return {}
    gaps = shared_lines(parts, whole)  # rings that these lines are pieces of
    rings = [j for j in rings if not (j in gaps and _nearly_all(gaps[j], parts.items[j]))]
    options = []
    for k in lines:
        if whole.items[k].shape in kept or not rings:
            continue
        for closing in _closings(k, whole):
            found = np.round([_common(closing.item.box, parts.items[j].box) for j in rings], 6)
            best = int(found.argmax())
            if found[best] >= COMMON:
                options.append((-float(found[best]), k, rings[best], closing))
    result: Found = {}
    taken: set[int] = set()
    for _, k, j, closing in sorted(options, key=lambda option: option[:3]):
        if j in taken or {k, closing.anchor} & result.keys():
            continue
        item = closing.item
        taken.add(j)
        result[k] = Division([item], [(item, j)])
        if closing.all:
            result[closing.anchor] = Division([], [])
    return result


@dataclass(frozen=True, slots=True, eq=False)
class _Closing:
    """What closes a line.

    Attributes
    ----------
    anchor : int
    item : Item
        Both together.
    all : bool
        Whether it is all of what closes it.
    """

    anchor: int
    item: Item
    all: bool


def _nearly_all(pieces: Division, item: Item) -> bool:
    """Whether an item's pieces that have partners leave little but gaps."""
    return sum(piece.length for piece, _ in pieces.pairs) > GAPS * item.length


def _line(item: Item) -> bool:
    return not (item.filled or item.cut) and opaque(item)


def _closings(k: int, scene: Scene) -> list[_Closing]:
    """What closes a line, if anything does."""
    item = scene.items[k]
    stroke = item.style.stroke
    assert stroke is not None
    if not _round(item.outer, stroke):
        return []
    style = replace(item.style, stroke=replace(stroke, join="round"))
    ends = item.outer.curves[[-1, 0], [3, 0]]
    found = []
    for j in np.flatnonzero(scene.touching[k]).tolist():
        other = scene.items[j]
        if j == k or not _line(other) or not _alike(item, other):
            continue
        places = Places(other.outer)
        shares = places.nearest(ends)
        there = places.point(shares)
        if np.linalg.norm(there - ends, axis=1).max() > ON * item.width:
            continue
        if np.ptp(shares) < SAME:  # both ends lie on one place of it, perhaps its end
            continue
        run = run_between(places, *shares.tolist())
        length = Places(run).length
        if 0 < length <= CLOSES * item.length and _round(run, other.style.stroke):
            every = not other.closed and length > ALL * places.length
            both = replace(item, rings=(_ring(item.outer, run),), style=style)
            found.append(_Closing(j, both, every))
    return found


def _alike(one: Item, other: Item) -> bool:
    """Whether two lines are drawn alike but for their ends and corners."""
    strokes = one.style.stroke, other.style.stroke
    if strokes[0] is None or strokes[1] is None:
        return False
    one_way, other_way = (replace(s, cap="butt", join="round") for s in (strokes[0], strokes[1]))
    return one_way == other_way and one.style.opacity == other.style.opacity


def _round(line: Outline, stroke: Stroke | None) -> bool:
    """Whether a line's corners are round, if it has any."""
    return (stroke is not None and stroke.join == "round") or not len(kinks_of(Places(line))[0])


def _ring(line: Outline, run: Outline) -> Outline:
    """A line and what leads from its end back to its start."""
    there = line_curves(line.curves[-1, 3], run.curves[0, 0])[None]
    back = line_curves(run.curves[-1, 3], line.curves[0, 0])[None]
    parts = [line.curves, there, run.curves, back]
    least = GAP * float(np.ptp(line.box, axis=0).max())
    long = [part for part in parts if np.ptp(part.reshape(-1, 2), axis=0).max() > least]
    curves = np.concatenate(long)
    curves[:, 0] = np.roll(curves[:, 3], 1, axis=0)
    return Outline(curves, True)


def _common(one: Points, other: Points) -> float:
    """Area that two boxes share, as a share of the area of both."""
    low, high = np.maximum(one[0], other[0]), np.minimum(one[1], other[1])
    shared = float(np.maximum(high - low, 0.0).prod())
    both = float((one[1] - one[0]).prod() + (other[1] - other[0]).prod()) - shared
    return shared / both if both > 0 else 0.0
