"""Which of several things becomes which: shapes of two drawings, pieces of shapes, holes."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.fill.naming import is_given
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.model.drawing import Shape
from shapetween.model.paint import Colour, Gradient, Paint

__all__ = ["LEFT", "Fixed", "Pairing", "Thing", "pair_shapes", "pair_things"]

#: What a move by the own size, a factor e in size, black to white in paint, bottom to top in order,
#: fill against line, and open against closed cost. Distance counts most: what stays near its place
#: is seen as the same thing.
DISTANCE, SIZE, PAINT, ORDER, KIND, OPEN = 1.0, 0.35, 0.8, 0.15, 0.6, 0.25

#: What two shapes cost that nowhere cover each other.
OVERLAP = 0.8

#: What a factor e in the ratio of width to height costs, and the least share of its size that a
#: thing is wide or high: a line's own width.
ASPECT, SLIM = 0.12, 0.1

#: Share of the drawing that a move is counted against beside the own size: how far a curve may go.
REACH = 0.15

#: What leaving a thing without a partner costs, and what a pair as large as the drawing saves
#: beside that. More, and unlike shapes far apart become each other; less, and everything comes and
#: goes.
LEFT, LARGE = 0.5, 0.6

#: What leaving alone costs among the pieces and holes of one shape, which are all of one kind.
PIECE_LEFT = 1.2

#: What a pair saves of which both have one name that an editor gave: files made from one another
#: share such names, and unlike shapes may do so by chance.
NAMED = 0.4

#: What a pair of areas in one paint saves where both drawings have as many of them, and how many at
#: least: one or two may be alike by chance, as palettes are small.
COMPLETE, SEVERAL = 0.8, 3


@dataclass(frozen=True, slots=True, eq=False)
class Thing:
    """What a shape, piece or hole is judged by.

    Attributes
    ----------
    centre : (2,) float64
    size : float
        A length: the root of its area, or of its box.
    aspect : float
        Logarithm of how much wider than high it is.
    """

    centre: Points
    size: float
    aspect: float = 0.0

    @classmethod
    def of(cls, points: Points) -> "Thing":
        """What a box about points (N, 2) is judged by."""
        low, high = points.min(axis=0), points.max(axis=0)
        width, height = (high - low).tolist()
        size = float(np.hypot(width, height))
        least = SLIM * size or 1.0
        return cls((low + high) / 2, size, math.log(max(width, least) / max(height, least)))


@dataclass(frozen=True, slots=True)
class Pairing:
    """Indices of what belongs together, and of what is left over on either side."""

    pairs: tuple[tuple[int, int], ...]
    first_only: tuple[int, ...]
    second_only: tuple[int, ...]


Fixed: TypeAlias = tuple[tuple[Shape, ...], tuple[Shape, ...], tuple[tuple[int, int], ...]]
"""Shapes of both drawings in paint order, and which of them become each other in any case."""


def pair_things(
    first: Sequence[Thing],
    second: Sequence[Thing],
    scale: float,
    extra: Floats | None = None,
    fixed: Sequence[tuple[int, int]] = (),
    left: float = PIECE_LEFT,
) -> Pairing:
    """Match what belongs together, at the least total cost of pairs and of what is left alone.

    At least one pair is made if both sides have anything.

    Parameters
    ----------
    first, second : sequence of Thing
    scale : float
        Length against which distances are measured.
    extra : (len(first), len(second)) float64, optional
        Further cost of each pair.
    fixed : sequence of (int, int)
        Pairs that are fixed.
    left : float
        Cost of leaving one thing alone.
    """
    rows = [i for i in range(len(first)) if i not in {a for a, _ in fixed}]
    columns = [j for j in range(len(second)) if j not in {b for _, b in fixed}]
    pairs = list(fixed)
    if rows and columns:
        cost = _costs(first, second, scale)
        pairs += _cheapest(cost if extra is None else cost + extra, rows, columns, left)
    pairs.sort()
    return Pairing(
        tuple(pairs),
        tuple(i for i in range(len(first)) if i not in {a for a, _ in pairs}),
        tuple(j for j in range(len(second)) if j not in {b for _, b in pairs}),
    )


def _costs(first: Sequence[Thing], second: Sequence[Thing], scale: float) -> Floats:
    """Cost of every pair by place and size, (len(first), len(second))."""
    sides = first, second
    centres = [np.array([t.centre for t in side]) for side in sides]
    sizes = [np.maximum([t.size for t in side], 1e-12 * scale) for side in sides]
    aspects = [np.array([t.aspect for t in side]) for side in sides]
    away = np.linalg.norm(centres[0][:, None] - centres[1], axis=-1)
    own = (sizes[0][:, None] + sizes[1]) / 2
    cost = DISTANCE * away / (own + REACH * scale)
    cost += ASPECT * np.abs(aspects[0][:, None] - aspects[1])
    cost += SIZE * np.abs(np.log(sizes[0][:, None] / sizes[1]))
    cost -= LARGE * np.minimum(np.minimum(sizes[0][:, None], sizes[1]) / scale, 1.0)
    return np.asarray(cost)


def _cheapest(
    every: Floats, rows: list[int], columns: list[int], left: float
) -> list[tuple[int, int]]:
    """Pairs of some rows and columns of the costs, as long as they cost less than to be alone."""
    if len(rows) == len(columns) == 1:
        return [(rows[0], columns[0])]
    cost = every[np.ix_(rows, columns)]
    # Every thing may also be left alone: a partner of its own for each, at that price.
    height, width = cost.shape
    table = np.full((height + width, height + width), np.inf)
    table[:height, :width] = cost
    table[np.arange(height), width + np.arange(height)] = left
    table[height + np.arange(width), np.arange(width)] = left
    table[height:, width:] = 0.0
    found = zip(*(k.tolist() for k in cheapest_pairs(table)), strict=True)
    chosen = [(i, j) for i, j in found if i < height and j < width]
    if not chosen and np.isfinite(cost).any():
        chosen = [divmod(int(cost.argmin()), width)]
    return [(rows[i], columns[j]) for i, j in chosen]


def pair_shapes(
    first: Sequence[Shape],
    second: Sequence[Shape],
    scale: float,
    fixed: Sequence[tuple[int, int]],
    *,
    mapped: Sequence[Thing] | None = None,
    shared: Floats | None = None,
    barred: Mask | None = None,
) -> Pairing:
    """Match shapes: by name where both drawings have it once, else by place, size, paint, order.

    Parameters
    ----------
    first, second : sequence of Shape
        In paint order. Names that editors give by themselves only help.
    scale : float
        Diagonal of the drawing.
    fixed : sequence of (int, int)
        Pairs that the user fixed.
    mapped : sequence of Thing, optional
        What becomes of the first drawing's shapes where both lie on each other; by default as
        they are drawn.
    shared : (len(first), len(second)) float64, optional
        Share of what either of two shapes covers that both then cover.
    barred : (len(first), len(second)) bool, optional
        Pairs that are not made unless they are fixed.
    """
    known = list(fixed)
    taken = {a for a, _ in known}, {b for _, b in known}
    alike = _named_alike(first, second)
    known += [
        (i, j)
        for i, j in alike
        if is_given(first[i].name) and i not in taken[0] and j not in taken[1]
    ]
    colours = [np.array([_seen(shape) for shape in side]) for side in (first, second)]
    kinds = [np.array([shape.style.fill is None for shape in side]) for side in (first, second)]
    orders = [np.arange(len(side)) / max(len(side) - 1, 1) for side in (first, second)]
    extra = PAINT * np.abs(colours[0][:, None] - colours[1]).mean(axis=-1)
    extra = extra + KIND * (kinds[0][:, None] != kinds[1])
    rings = [
        np.array([np.mean([r.closed for r in s.rings]) for s in side]) for side in (first, second)
    ]
    extra = extra + OPEN * np.abs(rings[0][:, None] - rings[1])
    extra = extra + ORDER * np.abs(orders[0][:, None] - orders[1])
    extra = extra - COMPLETE * _complete(first, second)
    for i, j in alike:
        extra[i, j] -= NAMED
    if shared is not None:
        extra = extra + OVERLAP * (1 - shared)
    if barred is not None:
        extra = np.where(barred, np.inf, extra)
    things = [_thing(shape) for shape in first] if mapped is None else mapped
    return pair_things(things, [_thing(shape) for shape in second], scale, extra, known, LEFT)


def _named_alike(first: Sequence[Shape], second: Sequence[Shape]) -> list[tuple[int, int]]:
    """Pairs of shapes by names that both drawings have once."""
    counts = [Counter(shape.name for shape in side) for side in (first, second)]
    once = {name for name in counts[0] if name and counts[0][name] == counts[1][name] == 1}
    there = {shape.name: j for j, shape in enumerate(second) if shape.name in once}
    return [(i, there[shape.name]) for i, shape in enumerate(first) if shape.name in once]


def _complete(first: Sequence[Shape], second: Sequence[Shape]) -> Mask:
    """Pairs of areas in one paint of which both drawings have as many, (N, M)."""
    kinds = [
        [(s.style.fill is None, s.style.fill, s.style.opacity) for s in x] for x in (first, second)
    ]
    counts = [Counter(side) for side in kinds]
    whole = {k for k in counts[0] if not k[0] and SEVERAL <= counts[0][k] == counts[1][k]}
    return np.array([[one == other and one in whole for other in kinds[1]] for one in kinds[0]])


def _thing(shape: Shape) -> Thing:
    return Thing.of(np.concatenate([ring.box for ring in shape.rings]))


def _seen(shape: Shape) -> tuple[float, float, float, float]:
    """Colour of a shape as four numbers, premultiplied."""
    style = shape.style
    paint: Paint = style.fill
    if paint is None and style.stroke is not None:
        paint = style.stroke.paint
    if isinstance(paint, Gradient):
        paint = paint.stops[len(paint.stops) // 2].colour if paint.stops else None
    colour = paint if isinstance(paint, Colour) else Colour(alpha=0.0)
    alpha = colour.alpha * style.opacity
    return colour.red * alpha, colour.green * alpha, colour.blue * alpha, alpha
