"""Which holes of an area become which of another: those that plainly are each other.

A hole that becomes something else, or goes where another one is, is seen to melt; one that closes
where it is before another one opens is not.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.fill.regions import Region
from shapetween.fill.splitting import split_alike
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.mirrored import even_knots
from shapetween.scene.motion.turning import total_turning
from shapetween.scene.places import Places
from shapetween.scene.relations import in_common, pictures
from shapetween.scene.strokes.segmentation import OutlinedStroke, outlined_strokes

if TYPE_CHECKING:
    import shapely

__all__ = ["distances", "divided_hole", "paired_holes", "stroke_of", "way_between"]

#: What a factor e in size costs beside the distance of two holes. Without it, two holes that swap
#: sizes go to what is a little nearer; much more, and a hole that grows in place becomes another.
SIZE = 0.15

#: Least share that two holes have in common, each in its own square, to be of one form; and as much
#: of those that turn alike, as a bold letter and a light one do.
ALIKE, TURNED_ALIKE = 0.5, 0.35

#: Turning of an outline, in whole turns, up to which a hole is a plain opening, and any such one
#: becomes any other one, a triangle an oval or a crescent. A disc has 1, a plus 3; larger, and a
#: plus is let melt into a window.
PLAIN = 1.9

#: Least share that two plain openings have in common, unless both are their own mirror images.
#: Smaller, and a calendar's page is seen to melt into a clock's hands; larger, and the counters of
#: letters close and open again.
PLAIN_ALIKE = 0.32

#: Most by which the turning of two holes of one form differs: a square is no plus.
TURNS = 0.5

#: Size, as a logarithm, and form, as a share in common, within which holes are of one set.
SET_SIZE, SET_FORM = 0.2, 0.75

#: Difference of heights, as a share of their size, up to which two holes are at one height. Larger,
#: and steps are eyes; at 0 rounding makes eyes of two heights.
LEVEL = 0.25

#: Ratio of the distances of a hole's partner and of another hole that is like the partner, from
#: which on it is the one of the two. Larger, and one pip of a die becomes any of four.
PLAINLY = 0.75

#: Distance, as that of others, within which a hole stays where it is, whatever its set does.
STILL = 0.02

#: Least share of a hole that lies in another one that a bar divides, and that all such leave of it.
#: Smaller, and pips and windows near a hole are held to be its pieces.
WITHIN, LEFT = 0.6, 0.5

#: Share of the smaller of two areas that counts as their lying on each other.
MEETS = 1e-3

#: Times at which two moving holes are looked at together.
LOOKED = np.linspace(0.0, 1.0, 9)


def distances(first: Sequence[Item], second: Sequence[Item], size: Floats | float) -> Floats:
    """How far holes are from each other, as a share of a size or of one by axis, (N, M)."""
    one, other = (np.array([hole.centre for hole in side]) for side in (first, second))
    return np.asarray(np.linalg.norm((one[:, None] - other) / size, axis=-1))


def paired_holes(
    first: Sequence[Item], second: Sequence[Item], apart: Floats, allowed: Mask
) -> list[tuple[int, int]]:
    """Holes that become each other.

    Parameters
    ----------
    first, second : sequence of Item
        The first area's as they lie in the second one.
    apart : (N, M) float64
        How far they are from each other.
    allowed : (N, M) bool
        Which of them may become each other.

    Returns
    -------
    list of (int, int)
        All that are of one form, each of which plainly is the other one, and whose ways meet no
        other hole.
    """
    if not first or not second:
        return []
    sides = (first, second)
    sizes = [np.array([hole.size for hole in side]) for side in sides]
    growth = np.log(np.maximum(sizes[0][:, None], 1e-12) / np.maximum(sizes[1], 1e-12))
    fine = allowed & _of_one_form(first, second) & ~_one_of_two(first, second)
    worst = float(apart.max() + SIZE * np.abs(growth).max()) + 1.0
    cost: Floats = apart + SIZE * np.abs(growth)
    cost = np.where(fine, cost, worst * (len(first) + len(second)))
    rows, columns = cheapest_pairs(np.asarray(np.round(cost, 9), dtype=np.float64))
    pairs = [(i, j) for i, j in zip(rows.tolist(), columns.tolist(), strict=True) if fine[i, j]]
    mates = [_mates(side) for side in sides]
    still = apart < STILL
    while True:
        unsure = [pair for pair in pairs if not _plain(pair, pairs, apart, mates)]
        kept = [
            (i, j)
            for i, j in pairs
            if (still[i, j] or not any(_in_set((i, j), pair, mates) for pair in unsure))
            and not _meets((i, j), pairs, first, second)
        ]
        if len(kept) == len(pairs):
            return pairs
        pairs = kept


def divided_hole(
    whole: Sequence[Item], parts: Sequence[Item]
) -> tuple[int, list[int], tuple[Region, ...]] | None:
    """A hole that several of another area are what a bar leaves of, and its pieces for them.

    Parameters
    ----------
    whole, parts : sequence of Item
        Holes of both areas, as they lie in one of them.
    """
    for k, hole in enumerate(whole):
        inside = [
            j
            for j, part in enumerate(parts)
            if part.enclosed.intersection(hole.enclosed).area > WITHIN * part.enclosed.area
        ]
        left = sum(parts[j].enclosed.area for j in inside)
        if len(inside) < 2 or left < LEFT * hole.enclosed.area:
            continue
        cells = split_alike(Region(hole.outer), [Region(parts[j].outer) for j in inside])
        if cells is not None:
            return k, inside, cells
    return None


def stroke_of(hole: Item) -> OutlinedStroke | None:
    """The one open stroke that a hole is, if it is one."""
    strokes = outlined_strokes(Region(hole.outer))
    if strokes is None or len(strokes) != 1 or strokes[0].line.line.closed:
        return None
    return strokes[0]


def _of_one_form(first: Sequence[Item], second: Sequence[Item]) -> Mask:
    """Which holes are of one form, both plain openings, or both strokes, (N, M)."""
    turns = [np.array([_turning(hole) for hole in side]) for side in (first, second)]
    common = in_common(pictures(first), pictures(second))
    alike = (np.abs(turns[0][:, None] - turns[1]) < TURNS) & (common > TURNED_ALIKE)
    alike |= (common > ALIKE) & (np.abs(turns[0][:, None] - turns[1]) < 2 * TURNS)
    tests: tuple[Callable[[Item], bool], ...] = (_is_box, _is_plain, _is_stroke)
    for test in tests:
        own = [np.array([test(hole) for hole in side]) for side in (first, second)]
        together = own[0][:, None] & own[1]
        if test is _is_plain:
            for i, j in np.argwhere(together & (common < PLAIN_ALIKE)).tolist():
                together[i, j] = _are_even(first[i], second[j])
        alike |= together
    # A tick swells to no disc: what bends as a line becomes what does.
    bent = [np.array([_is_bent(hole) for hole in side]) for side in (first, second)]
    return np.asarray(alike & (bent[0][:, None] == bent[1]))


def _one_of_two(first: Sequence[Item], second: Sequence[Item]) -> Mask:
    """Which pairs are of a hole by itself and one of two of another form, (N, M).

    One of three dots above each other is no eye.
    """
    boxes = [np.array([_is_box(hole) for hole in side]) for side in (first, second)]
    twins = [_have_twins(side) for side in (first, second)]
    return np.asarray((boxes[0][:, None] != boxes[1]) & (twins[0][:, None] != twins[1]))


def _have_twins(holes: Sequence[Item]) -> Mask:
    """Which holes have a mirror image at their height, (N,)."""
    drawn = pictures(holes)
    sizes = np.maximum([hole.size for hole in holes], 1e-12)
    heights = np.array([hole.centre[1] for hole in holes])
    twins = in_common(np.flip(drawn, axis=2), drawn) > SET_FORM
    twins &= np.abs(np.log(sizes[:, None] / sizes)) < SET_SIZE
    twins &= np.abs(heights[:, None] - heights) < LEVEL * sizes
    np.fill_diagonal(twins, False)
    return np.asarray(twins.any(axis=1))


def _is_box(hole: Item) -> bool:
    return isinstance(form_of(hole), RoundedBox)


def _is_plain(hole: Item) -> bool:
    return _turning(hole) < PLAIN


def _are_even(one: Item, other: Item) -> bool:
    """Whether two holes are their own mirror images, and so move evenly whatever they are."""
    return even_knots(Places(one.outer.clockwise()), Places(other.outer.clockwise())) is not None


def _is_stroke(hole: Item) -> bool:
    return stroke_of(hole) is not None


def _is_bent(hole: Item) -> bool:
    """Whether a hole is a stroke that is no mere bar or disc."""
    return _is_stroke(hole) and not _is_box(hole)


def _turning(hole: Item) -> float:
    return round(total_turning(hole.outer.curves), 6)


def _mates(holes: Sequence[Item]) -> Mask:
    """Which other holes each is in one set with, (N, N)."""
    sizes = np.log(np.maximum([hole.size for hole in holes], 1e-12))
    drawn = pictures(holes)
    alike = (np.abs(sizes[:, None] - sizes) < SET_SIZE) & (in_common(drawn, drawn) > SET_FORM)
    np.fill_diagonal(alike, False)
    return np.asarray(alike)


def _plain(
    pair: tuple[int, int], pairs: Sequence[tuple[int, int]], apart: Floats, mates: Sequence[Mask]
) -> bool:
    """Whether none of those like a hole's partner that are left over is nearly as near."""
    i, j = pair
    left = [
        [k for k in np.flatnonzero(m[k0]) if all(p[s] != k for p in pairs)]
        for s, (m, k0) in enumerate(zip(mates, pair, strict=True))
    ]
    others = [float(apart[k, j]) for k in left[0]] + [float(apart[i, k]) for k in left[1]]
    return all(round(apart[i, j] - PLAINLY * other, 9) <= 0 for other in others)


def _in_set(pair: tuple[int, int], other: tuple[int, int], mates: Sequence[Mask]) -> bool:
    """Whether a pair is another one, or of one set with it at either end."""
    return pair == other or any(bool(m[k, n]) for m, k, n in zip(mates, pair, other, strict=True))


def _meets(
    pair: tuple[int, int],
    pairs: Sequence[tuple[int, int]],
    first: Sequence[Item],
    second: Sequence[Item],
) -> bool:
    """Whether a hole's way meets one that stays alone, or another one on its own way."""
    own = way_between(first[pair[0]], second[pair[1]])
    alone = [
        hole.enclosed
        for side, holes in enumerate((first, second))
        for k, hole in enumerate(holes)
        if all(p[side] != k for p in pairs)
    ]
    if any(_overlaps(own, other) for other in alone):
        return True
    for other in pairs:
        if other == pair or not own.intersects(way_between(first[other[0]], second[other[1]])):
            continue
        moving = [
            [_between(first[i].enclosed, second[j].enclosed, t) for t in LOOKED.tolist()]
            for i, j in (pair, other)
        ]
        if any(map(_overlaps, *moving)):
            return True
    return False


def way_between(one: Item, other: Item) -> "shapely.Geometry":
    """What a hole may pass over that becomes another: the hull of both."""
    import shapely

    return shapely.union(one.enclosed, other.enclosed).convex_hull


def _overlaps(one: "shapely.Geometry", other: "shapely.Geometry") -> bool:
    return bool(one.intersection(other).area > MEETS * min(one.area, other.area))


def _between(one: "shapely.Geometry", other: "shapely.Geometry", t: float) -> "shapely.Geometry":
    """The hole that is the nearer of two, moved and scaled to where it is in between."""
    import shapely

    nearer = one if t < 0.5 else other
    boxes = [np.array(area.bounds).reshape(2, 2) for area in (one, other)]
    home = np.array(nearer.bounds).reshape(2, 2)
    box = (1 - t) * boxes[0] + t * boxes[1]
    scale = (box[1] - box[0]) / np.maximum(home[1] - home[0], 1e-300)
    return shapely.transform(nearer, lambda points: box[0] + scale * (points - home[0]))
