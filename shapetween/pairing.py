"""Which of several things becomes which: shapes of two drawings, pieces of shapes, holes."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Points
from shapetween.drawing import Shape
from shapetween.paint import Colour, Gradient, Paint

__all__ = ["Pairing", "Thing", "pair_shapes", "pair_things"]

#: What a whole diagonal of the drawing in distance, a factor e in size, black to white in paint,
#: bottom to top in order, and fill against line cost. Distance counts most: what stays near its
#: place is seen as the same thing.
DISTANCE, SIZE, PAINT, ORDER, KIND = 1.0, 0.15, 0.2, 0.15, 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Thing:
    """What a shape, piece or hole is judged by.

    Attributes
    ----------
    centre : (2,) float64
    size : float
        A length: the root of its area, or of its box.
    """

    centre: Points
    size: float


@dataclass(frozen=True, slots=True)
class Pairing:
    """Indices of what belongs together, and of what is left over on either side."""

    pairs: tuple[tuple[int, int], ...]
    first_only: tuple[int, ...]
    second_only: tuple[int, ...]


def pair_things(
    first: Sequence[Thing],
    second: Sequence[Thing],
    scale: float,
    extra: Floats | None = None,
    fixed: Sequence[tuple[int, int]] = (),
) -> Pairing:
    """Match as many as both sides have, at the least total cost.

    Parameters
    ----------
    first, second : sequence of Thing
    scale : float
        Length against which distances are measured.
    extra : (len(first), len(second)) float64, optional
        Further cost of each pair.
    fixed : sequence of (int, int)
        Pairs that are settled.
    """
    rows = [i for i in range(len(first)) if i not in {a for a, _ in fixed}]
    columns = [j for j in range(len(second)) if j not in {b for _, b in fixed}]
    pairs = list(fixed)
    if rows and columns:
        pairs += _cheapest(first, second, rows, columns, scale, extra)
    pairs.sort()
    return Pairing(
        tuple(pairs),
        tuple(i for i in range(len(first)) if i not in {a for a, _ in pairs}),
        tuple(j for j in range(len(second)) if j not in {b for _, b in pairs}),
    )


def _cheapest(
    first: Sequence[Thing],
    second: Sequence[Thing],
    rows: list[int],
    columns: list[int],
    scale: float,
    extra: Floats | None,
) -> list[tuple[int, int]]:
    if len(rows) == len(columns) == 1:
        return [(rows[0], columns[0])]
    from scipy.optimize import linear_sum_assignment  # slow to import, and most drawings are one

    a, b = [first[i] for i in rows], [second[j] for j in columns]
    away = np.linalg.norm(
        np.array([t.centre for t in a])[:, None] - np.array([t.centre for t in b]), axis=-1
    )
    sizes = [np.log(np.maximum([t.size for t in side], 1e-12 * scale)) for side in (a, b)]
    cost = DISTANCE * away / scale + SIZE * np.abs(sizes[0][:, None] - sizes[1])
    if extra is not None:
        cost = cost + extra[np.ix_(rows, columns)]
    chosen = linear_sum_assignment(cost)
    return [(rows[i], columns[j]) for i, j in zip(*(k.tolist() for k in chosen), strict=True)]


def pair_shapes(
    first: Sequence[Shape], second: Sequence[Shape], scale: float, fixed: Sequence[tuple[int, int]]
) -> Pairing:
    """Match shapes: by name where both drawings have it once, else by place, size, paint, order.

    Parameters
    ----------
    first, second : sequence of Shape
        In paint order.
    scale : float
        Diagonal of the drawing.
    fixed : sequence of (int, int)
        Pairs that the user settled.
    """
    settled = list(fixed)
    taken = {a for a, _ in settled}, {b for _, b in settled}
    names = [Counter(shape.name for shape in side) for side in (first, second)]
    for i, shape in enumerate(first):
        if shape.name and names[0][shape.name] == names[1][shape.name] == 1 and i not in taken[0]:
            j = next(k for k, other in enumerate(second) if other.name == shape.name)
            if j not in taken[1]:
                settled.append((i, j))
    colours = [np.array([_seen(shape) for shape in side]) for side in (first, second)]
    kinds = [np.array([shape.style.fill is None for shape in side]) for side in (first, second)]
    orders = [np.arange(len(side)) / max(len(side) - 1, 1) for side in (first, second)]
    extra = PAINT * np.abs(colours[0][:, None] - colours[1]).mean(axis=-1)
    extra = extra + KIND * (kinds[0][:, None] != kinds[1])
    extra = extra + ORDER * np.abs(orders[0][:, None] - orders[1])
    things = [[_thing(shape) for shape in side] for side in (first, second)]
    return pair_things(things[0], things[1], scale, extra, settled)


def _thing(shape: Shape) -> Thing:
    boxes = np.array([ring.box for ring in shape.rings])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    return Thing((low + high) / 2, float(np.linalg.norm(high - low)))


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
