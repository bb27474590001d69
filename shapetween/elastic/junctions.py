"""Where lines of a drawing end on other lines."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.attach.ties import Spot
from shapetween.base.arrays import Curves, Floats, Points
from shapetween.elastic.pairing import Pairing
from shapetween.geometry.bezier import evaluate
from shapetween.model.drawing import Shape

__all__ = ["DrawnLine", "Junctions", "junctions", "with_hanging"]

#: Distance of an end from another line, in mean widths of both, up to which it lies on it: their
#: ink is one. Larger ties what is only near.
TOUCH = 0.75

#: Chords of a curve among which the nearest place is looked for, and of a line of many curves.
CHORDS, MOST_CHORDS = 16, 4000

#: Curves of all lines past which no ends are looked at: maps.
MOST_CURVES = 4000

#: Ends times chords that are looked at at once; more cost memory and are no quicker.
CELLS_AT_ONCE = 1_000_000

Junctions: TypeAlias = dict[tuple[int, int], dict[int, tuple[float, Spot]]]
"""By number of an open line and its end, 0 or 1: the lines that it lies on, how far away and where.
"""


@dataclass(frozen=True, slots=True, eq=False)
class DrawnLine:
    """A stroked line of one drawing.

    Attributes
    ----------
    curves : (P, 4, 2) float64
    closed : bool
    width : float
    """

    curves: Curves
    closed: bool
    width: float


def junctions(lines: Sequence[DrawnLine | None]) -> Junctions:
    """Which ends of some lines lie on which others; None stands for one that is not drawn."""
    drawn = {k: line for k, line in enumerate(lines) if line is not None}
    if sum(len(line.curves) for line in drawn.values()) > MOST_CURVES:
        return {}
    guests = [k for k, line in drawn.items() if not line.closed]
    tips = np.array([drawn[k].curves[[0, -1], [0, 3]] for k in guests]).reshape(-1, 2)
    widths = np.repeat([drawn[k].width for k in guests], 2)
    found: Junctions = {}
    for host, line in drawn.items():
        reach = TOUCH * (widths + line.width) / 2
        low, high = line.curves.min(axis=(0, 1)), line.curves.max(axis=(0, 1))
        near = ((tips > low - reach[:, None]) & (tips < high + reach[:, None])).all(axis=1)
        index = np.flatnonzero(near)
        places, feet = _nearest(line.curves, tips[index])
        away = np.linalg.norm(tips[index] - feet, axis=1)
        for k, place, foot, far in zip(index.tolist(), places.tolist(), feet, away, strict=True):
            if guests[k // 2] != host and far <= reach[k]:
                spot = Spot(place, tips[k] - foot)
                found.setdefault((guests[k // 2], k % 2), {})[host] = float(far), spot
    return found


def _nearest(curves: Curves, points: Points) -> tuple[Floats, Points]:
    """Places, as curve number plus parameter, nearest to points (K, 2), and the points there."""
    chords = max(2, min(CHORDS, MOST_CHORDS // len(curves)))
    line = evaluate(curves, np.linspace(0, 1, chords + 1))
    start, step = line[:, :-1].reshape(-1, 2), np.diff(line, axis=1).reshape(-1, 2)
    size = (step**2).sum(axis=1)
    place = np.zeros(len(points))
    for some in np.array_split(
        np.arange(len(points)), 1 + len(points) * len(start) // CELLS_AT_ONCE
    ):
        offset = points[some, None] - start
        along = np.clip((offset * step).sum(axis=2) / np.where(size > 0, size, 1.0), 0.0, 1.0)
        best = np.linalg.norm(offset - along[..., None] * step, axis=2).argmin(axis=1)
        place[some] = (best + along[np.arange(len(some)), best]) / chords
    index = np.minimum(place.astype(np.intp), len(curves) - 1)
    return place, evaluate(curves[index], (place - index)[:, None])[:, 0]


def with_hanging(first: Sequence[Shape], second: Sequence[Shape], pairing: Pairing) -> Pairing:
    """A pairing, and pairs of lines left over that end on lines which become each other.

    The bar of an A becomes that of an H wherever it is: both hang between the same lines.
    """
    alone = pairing.first_only, pairing.second_only
    if not all(alone):
        return pairing
    partner = dict(pairing.pairs)
    same = {i: (i, j) for i, j in pairing.pairs}, {j: (i, j) for i, j in pairing.pairs}
    hung = []
    for side, lone, known in zip((first, second), alone, same, strict=True):
        near = junctions([_drawn(shape) for shape in side])
        ends = {}
        for k in lone:
            hosts = [
                [(away, known[h]) for h, (away, _) in near.get((k, end), {}).items() if h in known]
                for end in (0, 1)
            ]
            if all(hosts):
                ends[k] = sorted(min(side)[1] for side in hosts)
        hung.append(ends)
    for i, between in hung[0].items():
        j = next((k for k, other in hung[1].items() if other == between), None)
        if j is not None:
            partner[i] = j
            del hung[1][j]
    taken = set(partner.values())
    return Pairing(
        tuple(sorted(partner.items())),
        tuple(i for i in pairing.first_only if i not in partner),
        tuple(j for j in pairing.second_only if j not in taken),
    )


def _drawn(shape: Shape) -> DrawnLine | None:
    """A shape that is one stroked line."""
    stroke = shape.style.stroke
    if shape.style.fill is not None or stroke is None or len(shape.rings) > 1:
        return None
    return DrawnLine(shape.rings[0].curves, shape.rings[0].closed, stroke.width)
