"""How unlike two places of two outlines are.

The weights were set on hand-matched pairs of drawings; figures move little when any one of them is
halved or doubled.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.match.features import CONTEXT_STEP, Features, contexts, describe, unit
from shapetween.match.sampling import SAMPLES, Samples, sample
from shapetween.match.symmetry import Axes, mirror_axes
from shapetween.match.vertices import Vertices, salient_vertices
from shapetween.model.outline import Outline

__all__ = [
    "Cells",
    "Prepared",
    "SampleFeatures",
    "UprightFeatures",
    "all_cells",
    "intrinsic_cost",
    "likeness_of_vertices",
    "prepare",
    "sample_features",
    "upright_cost",
    "upright_features",
]

#: Least medial radius told from 0, in roots of the area.
MIN_RADIUS = 0.02

#: How far positions are stretched towards equal spread in x and y: this power of the ratio, the
#: ratio itself held within `MOST_SPREAD`. 0 leaves tall against wide, 1/2 loses what tall means.
SPREAD_POWER, MOST_SPREAD = 0.25, 2.0

#: Outlines whose features are kept, for who asks more than one thing of a pair. More cost memory.
KEPT = 8

#: Unlikeness above which two salient vertices are unrelated.
UNRELATED = 0.45

#: Unlikeness no two places exceed as drawn. Less, and a place is as unlike its wrong neighbour as
#: its opposite; more, and a few odd places decide for all.
MOST_UNLIKE = 1.5

#: Width over which one seen point passes from above to below, in roots of the area; with none, a
#: level side would have any rank from its one end's to its other's.
RANK_BLUR = 0.1

#: Greatest exponent of a rank's exponentials: the product of two stays a number.
FAR = float(np.floor(np.log(np.finfo(np.float64).max) / 2))


Cells: TypeAlias = tuple[Index, Index]
"""Pairs of samples of two outlines, of shapes that broadcast."""


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """An outline with its samples, features, salient vertices and axes of symmetry."""

    samples: Samples
    features: Features
    vertices: Vertices
    axes: Axes

    def places(self, at: Floats) -> Floats:
        """Fractions of the length, from the canonical start, of measures of any turn."""
        whole = np.floor(at)
        even = np.arange(SAMPLES + 1) / SAMPLES
        return np.asarray(whole + np.interp(at - whole, self.features.measure, even))

    def measures(self, places: Floats) -> Floats:
        """Inverse of `places`."""
        whole = np.floor(places)
        even = np.arange(SAMPLES + 1) / SAMPLES
        return np.asarray(whole + np.interp(places - whole, even, self.features.measure))


@dataclass(frozen=True, slots=True, eq=False)
class SampleFeatures:
    """Places of an outline that the matching is made of, with their features.

    Attributes
    ----------
    points, tangents, apexes : (n, 2) float64
    turns : (5, n) float64
    inside, outside : (n,) float64
    surroundings : (m, 2) float64
        Points of the whole outline.
    """

    points: Points
    tangents: Points
    apexes: Points
    turns: Floats
    inside: Floats
    outside: Floats
    surroundings: Points

    def turned(self, angle: float) -> "SampleFeatures":
        """The same samples of the outline turned by an angle."""
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, s], [-s, c]])
        return replace(
            self,
            points=self.points @ turn,
            tangents=self.tangents @ turn,
            apexes=self.apexes @ turn,
            surroundings=self.surroundings @ turn,
        )


@dataclass(frozen=True, slots=True, eq=False)
class UprightFeatures:
    """Features of samples in the frame as drawn.

    Attributes
    ----------
    turns, spread, ranks : (2, n) float64
    tangents : (n, 2) float64
    around : (n, k) float64
    """

    turns: Floats
    spread: Floats
    ranks: Floats
    tangents: Points
    around: Floats


@lru_cache(maxsize=KEPT)
def prepare(outline: Outline) -> Prepared:
    """Sample and describe an outline; the last few are kept."""
    samples = sample(outline)
    points = samples.points
    return Prepared(samples, describe(points), salient_vertices(points), mirror_axes(points))


def sample_features(prepared: Prepared, places: Floats) -> SampleFeatures:
    """Samples at fractions of the length from the canonical start, of any turn."""
    points, features = prepared.samples.points, prepared.features
    index = places * SAMPLES
    low = np.floor(index)
    share = index - low
    first = low.astype(np.intp) % SAMPLES
    second = (first + 1) % SAMPLES
    rows = np.concatenate(
        [
            points.T,
            features.tangents.T,
            features.apexes.T,
            features.inside[None],
            features.outside[None],
            features.turns,
        ]
    )
    read = rows.take(first, axis=1) * (1 - share) + rows.take(second, axis=1) * share
    return SampleFeatures(
        points=read[:2].T,
        tangents=unit(read[2:4].T),
        apexes=read[4:6].T,
        inside=read[6],
        outside=read[7],
        turns=read[8:],
        surroundings=points[::CONTEXT_STEP],
    )


def upright_features(samples: SampleFeatures) -> UprightFeatures:
    """Features of samples in the frame as drawn."""
    return UprightFeatures(
        turns=samples.turns[3:],
        spread=_even_spread(samples).T,
        ranks=_ranks(samples),
        tangents=samples.tangents,
        around=contexts(samples.points, samples.surroundings),
    )


def intrinsic_cost(a: SampleFeatures, b: SampleFeatures, cells: Cells) -> Floats:
    """Unlikeness of pairs of samples that no turning of either outline changes, from 0 to 1."""
    turns = _square_gaps(a.turns, b.turns, cells) / len(a.turns)
    around = (
        contexts(a.points, a.surroundings, a.tangents),
        contexts(b.points, b.surroundings, b.tangents),
    )
    inside = _square_gaps(_log_radius(a.inside), _log_radius(b.inside), cells)
    outside = _square_gaps(_log_radius(a.outside), _log_radius(b.outside), cells)
    thick = 0.2 * (0.5 * inside + 0.25 * outside)
    return _saturated(0.5 * turns + 2 * _unlikeness(*around, cells) + thick)


def upright_cost(a: UprightFeatures, b: UprightFeatures, cells: Cells) -> Floats:
    """Unlikeness of pairs of samples in the frame as drawn, from 0 to `MOST_UNLIKE`.

    Positions count twice: in roots of the area, and by rank. By rank feet stand on the ground in a
    tall shape as in a low one, so height counts more than side.
    """
    turns = _square_gaps(a.turns, b.turns, cells)
    away = _square_gaps(a.spread, b.spread, cells)
    ranks = _square_gaps(a.ranks, b.ranks, cells)
    askew = _unlikeness(a.tangents, b.tangents, cells)
    around = _unlikeness(a.around, b.around, cells)
    return _saturated(0.6 * turns + 0.25 * (away + ranks + askew) + around, MOST_UNLIKE)


def likeness_of_vertices(a: SampleFeatures, b: SampleFeatures) -> Floats:
    """Likeness of salient vertices in the frame as drawn, (n, m): from 0, unrelated, to 1."""
    cells = all_cells(len(a.points), len(b.points))
    away = _square_gaps(_even_spread(a).T, _even_spread(b).T, cells)
    around = contexts(a.points, a.surroundings), contexts(b.points, b.surroundings)
    askew = _unlikeness(a.apexes, b.apexes, cells)
    cost = _saturated(0.6 * away + 0.5 * askew + 0.8 * _unlikeness(*around, cells))
    return np.maximum(1 - cost / UNRELATED, 0.0)


def all_cells(rows: int, columns: int) -> Cells:
    """Every pair of samples, to be broadcast."""
    return np.arange(rows)[:, None], np.arange(columns)[None]


def _square_gaps(a: Floats, b: Floats, cells: Cells) -> Floats:
    """Sum over rows of the squared differences of pairs of columns: (k, n) and (k, m)."""
    # Taken, not indexed: then the pairs lie side by side in memory.
    gap = a.take(cells[0], axis=1) - b.take(cells[1], axis=1)
    gap *= gap
    return np.asarray(gap.sum(axis=0))


def _unlikeness(a: Floats, b: Floats, cells: Cells) -> Floats:
    """How far the products of pairs of unit vectors, (n, k) and (m, k), fall short of 1."""
    return np.asarray(1 - (a @ b.T)[cells])


def _log_radius(radius: Floats) -> Floats:
    return np.log(np.maximum(radius, MIN_RADIUS))[None]


def _saturated(cost: Floats, most: float = 1.0) -> Floats:
    """Between 0 and `most`: what is quite unlike can hardly be more so."""
    return np.asarray(cost / (1 + cost / most))


def _even_spread(samples: SampleFeatures) -> Points:
    """Points part of the way to equal spread in x and y."""
    wide, tall = samples.surroundings.std(axis=0)
    ratio = np.clip(wide / tall, 1 / MOST_SPREAD, MOST_SPREAD) ** SPREAD_POWER
    return np.asarray(samples.points * [1 / ratio, ratio])


def _ranks(samples: SampleFeatures) -> Floats:
    """Rank of the coordinates among all seen, from -1 to 1, height weighted double; (2, n).

    The mean of the hyperbolic tangents of the gaps over `RANK_BLUR`; tanh(x - y) is
    1 - 2 / (1 + exp(2 x) exp(-2 y)).
    """
    # So far out two points are told apart by where they are; the exponentials stay finite.
    points = np.concatenate([samples.points, samples.surroundings]).T.copy(order="C")
    here, seen = np.split(np.clip(points * (2 / RANK_BLUR), -FAR, FAR), [len(samples.points)], 1)
    table = np.exp(here)[:, :, None] * np.exp(-seen)[:, None]
    table += 1
    np.divide(2, table, out=table)
    x, y = 1 - table.mean(axis=2)
    return np.stack([x, np.sqrt(2) * y])
