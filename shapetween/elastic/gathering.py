"""Areas in one paint that are one area in the other drawing are one here too.

One drawing has a cross as two bars, another as one outline; one has four spots as four shapes,
another as one path. Only as one do they become each other.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.errors import OutlineError
from shapetween.elastic.flow import Flow
from shapetween.elastic.naming import common_names
from shapetween.elastic.overlaps import laid_on
from shapetween.elastic.pairing import Settled
from shapetween.elastic.regions import regions_of
from shapetween.elastic.silhouette import Areas, opaqueness
from shapetween.model.drawing import Shape
from shapetween.model.paint import Style

__all__ = ["gather_areas"]

#: Share of an area that lies on another drawing's for it to be part of that one.
WITHIN = 0.6

#: Share of what either covers that all parts together and the other drawing's area have in common,
#: at least; and by how much more that is than of any part alone.
ALIKE, BETTER = 0.4, 0.1

#: Most parts of one area, and most areas of a drawing where parts are looked for.
MOST_PARTS, MOST_AREAS = 12, 250


@dataclass(frozen=True, slots=True)
class _Group:
    """Areas of one drawing that are one of the other.

    Attributes
    ----------
    side : int
        Whose areas they are.
    parts : tuple of int
    whole : int
        Shape of the other drawing.
    gain : float
    """

    side: int
    parts: tuple[int, ...]
    whole: int
    gain: float


def gather_areas(
    first: Sequence[Shape],
    second: Sequence[Shape],
    areas: tuple[Areas, Areas],
    flow: Flow,
    settled: Sequence[tuple[int, int]],
) -> Settled:
    """Shapes of both drawings, some of them several of the drawn ones, and what is settled.

    Parameters
    ----------
    first, second : sequence of Shape
        In paint order and one frame.
    areas : ((N,), (M,)) of shapely.Geometry
        What each of them covers.
    flow : Flow
        Brings the first drawing's shapes onto the second's.
    settled : sequence of (int, int)
        Shapes that become each other anyway; they stay as they are, as do those of one name.
    """
    sides = first, second
    same = tuple(first), tuple(second), tuple(settled)
    kept = common_names(first, second)
    free = [
        [
            k
            for k, shape in enumerate(side)
            if shape.name not in kept and k not in {pair[end] for pair in settled} and _plain(shape)
        ]
        for end, side in enumerate(sides)
    ]
    if min(map(len, free)) < 1 or not 2 < sum(map(len, free)) <= MOST_AREAS:
        return same
    laid = laid_on(areas, flow)
    groups = [g for end in (0, 1) for g in _groups(end, sides[end], areas[end], laid, free)]
    groups.sort(key=lambda group: (-group.gain, group.side, group.parts))
    taken: set[tuple[int, int]] = set()
    made: list[dict[int, Shape]] = [{}, {}]
    gone: list[set[int]] = [set(), set()]
    pairs = list(settled)
    for group in groups:
        members = {(group.side, k) for k in group.parts} | {(1 - group.side, group.whole)}
        union = None if members & taken else _union([sides[group.side][k] for k in group.parts])
        if union is None:
            continue
        taken |= members
        lowest, *others = group.parts
        made[group.side][lowest] = union
        gone[group.side].update(others)
        pairs.append((group.whole, lowest) if group.side else (lowest, group.whole))
    if len(pairs) == len(settled):
        return same
    left = [[k for k in range(len(side)) if k not in gone[end]] for end, side in enumerate(sides)]
    place = [{k: n for n, k in enumerate(some)} for some in left]
    fresh = [tuple(made[end].get(k, side[k]) for k in left[end]) for end, side in enumerate(sides)]
    return fresh[0], fresh[1], tuple((place[0][i], place[1][j]) for i, j in pairs)


def _plain(shape: Shape) -> bool:
    """Whether a shape is an area of which no overlap is seen."""
    style = shape.style
    return style.fill is not None and style.stroke is None and opaqueness(style) == 1


def _groups(
    side: int, shapes: Sequence[Shape], areas: Areas, laid: Sequence[Areas], free: list[list[int]]
) -> list[_Group]:
    """Groups of one drawing's areas that are about what an area of the other is."""
    import shapely

    by_paint: dict[Style, list[int]] = {}
    for k in free[side]:
        by_paint.setdefault(replace(shapes[k].style, fill_rule="nonzero"), []).append(k)
    groups = []
    for members in by_paint.values():
        if len(members) < 2:
            continue
        parts = laid[side][members]
        sizes = shapely.area(parts)
        for whole in free[1 - side]:
            other = laid[1 - side][whole]
            common = shapely.area(shapely.intersection(parts, other))
            within = common >= WITHIN * np.maximum(sizes, np.finfo(float).tiny)
            if not 2 <= within.sum() <= MOST_PARTS:
                continue
            alone = float((common / (sizes + other.area - common))[within].max())
            union = shapely.union_all(parts[within])
            shared = float(union.intersection(other).area)
            alike = shared / float(union.area + other.area - shared)
            chosen = tuple(k for k, lies in zip(members, within.tolist(), strict=True) if lies)
            if alike >= ALIKE and alike >= alone + BETTER and _may_sink(chosen, areas):
                groups.append(_Group(side, chosen, whole, alike - alone))
    return groups


def _may_sink(parts: tuple[int, ...], areas: Areas) -> bool:
    """Whether all parts may be painted where the lowest is: nothing between lies below them."""
    import shapely

    between = [k for k in range(parts[0] + 1, parts[-1]) if k not in parts]
    return not any(
        shapely.relate_pattern(areas[k], areas[part], "T********")
        for part in parts[1:]
        for k in between
        if k < part
    )


def _union(shapes: Sequence[Shape]) -> Shape | None:
    """One shape that shows what several show; None if one of them cannot be told."""
    try:
        pieces = [region for shape in shapes for region in regions_of(shape, "")[0]]
        rings = [
            ring
            for piece in pieces
            for ring in (piece.outer, *(hole.reversed() for hole in piece.holes))
        ]
        style = replace(shapes[0].style, fill_rule="nonzero")
        whole = Shape(tuple(rings), style, shapes[0].name)
        found = regions_of(whole, "")[0]
    except OutlineError:
        return None
    resolved = [r for p in found for r in (p.outer, *(hole.reversed() for hole in p.holes))]
    return replace(whole, rings=tuple(resolved))
