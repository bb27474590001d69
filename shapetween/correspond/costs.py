"""How unlike two places of two outlines are.

The weights were set on hand-matched pairs of drawings; figures move little when any one of them is
halved or doubled.
"""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.arrays import Floats, Points
from shapetween.correspond.features import SEEN_STEP, Features, contexts, describe, unit
from shapetween.correspond.sampling import SAMPLES, Samples, sample
from shapetween.correspond.vertices import Vertices, salient_vertices
from shapetween.outline import Outline

__all__ = [
    "Prepared",
    "Stations",
    "intrinsic_cost",
    "likeness_of_vertices",
    "prepare",
    "stations",
    "upright_cost",
]

#: Least medial radius told from 0, in roots of the area.
MIN_RADIUS = 0.02

#: How far positions are stretched towards equal spread in x and y: this power of the ratio, the
#: ratio itself held within `MOST_SPREAD`. 0 leaves tall against wide, 1/2 loses what tall means.
SPREAD_POWER, MOST_SPREAD = 0.25, 2.0

#: Unlikeness above which two salient vertices are strangers.
STRANGERS = 0.45

#: Unlikeness no two places exceed as drawn. Less, and a place is as unlike its wrong neighbour as
#: its opposite; more, and a few odd places decide for all.
MOST_UNLIKE = 1.5

#: Width over which one seen point passes from above to below, in roots of the area; with none, a
#: level side would have any rank from its one end's to its other's.
RANK_BLUR = 0.1

UPRIGHT = np.array([1.0, 0.0])


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """An outline with its samples, features and salient vertices."""

    samples: Samples
    features: Features
    vertices: Vertices

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
class Stations:
    """Places of an outline that the matching is made of, with what is seen from them.

    Attributes
    ----------
    points, tangents, apexes : (n, 2) float64
    turns : (5, n) float64
    inside, outside : (n,) float64
    seen : (m, 2) float64
        Points of the whole outline.
    """

    points: Points
    tangents: Points
    apexes: Points
    turns: Floats
    inside: Floats
    outside: Floats
    seen: Points

    def turned(self, angle: float) -> "Stations":
        """The same stations of the outline turned by an angle."""
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, s], [-s, c]])
        return replace(
            self,
            points=self.points @ turn,
            tangents=self.tangents @ turn,
            apexes=self.apexes @ turn,
            seen=self.seen @ turn,
        )


def prepare(outline: Outline) -> Prepared:
    """Sample and describe an outline."""
    samples = sample(outline)
    return Prepared(samples, describe(samples.points), salient_vertices(samples.points))


def stations(prepared: Prepared, places: Floats) -> Stations:
    """Stations at fractions of the length from the canonical start, of any turn."""
    points, features = prepared.samples.points, prepared.features
    index = places * SAMPLES
    low = np.floor(index)
    share = index - low
    first = low.astype(np.intp) % SAMPLES
    second = (first + 1) % SAMPLES

    def read(values: Floats) -> Floats:
        return values[..., first] * (1 - share) + values[..., second] * share

    return Stations(
        points=read(points.T).T,
        tangents=unit(read(features.tangents.T).T),
        apexes=read(features.apexes.T).T,
        turns=read(features.turns),
        inside=read(features.inside),
        outside=read(features.outside),
        seen=points[::SEEN_STEP],
    )


def intrinsic_cost(a: Stations, b: Stations) -> Floats:
    """Unlikeness that no turning of either outline changes, (n, m), from 0 to 1."""
    turns = _square_gaps(a.turns, b.turns) / len(a.turns)
    around = 1 - contexts(a.points, a.seen, a.tangents) @ contexts(b.points, b.seen, b.tangents).T
    inside = _square_gaps(_log_radius(a.inside), _log_radius(b.inside))
    outside = _square_gaps(_log_radius(a.outside), _log_radius(b.outside))
    return _saturated(0.5 * turns + 2 * around + 0.2 * (0.5 * inside + 0.25 * outside))


def upright_cost(a: Stations, b: Stations) -> Floats:
    """Unlikeness in the frame as drawn, (n, m), from 0 to `MOST_UNLIKE`.

    Positions count twice: in roots of the area, and by rank. By rank feet stand on the ground in a
    tall shape as in a low one, so height counts more than side.
    """
    turns = _square_gaps(a.turns[3:], b.turns[3:])
    away = _square_gaps(_even_spread(a).T, _even_spread(b).T)
    ranks = _square_gaps(_ranks(a), _ranks(b))
    askew = 1 - a.tangents @ b.tangents.T
    around = _unlike_surroundings(a, b)
    return _saturated(0.6 * turns + 0.25 * (away + ranks + askew) + around, MOST_UNLIKE)


def likeness_of_vertices(a: Stations, b: Stations) -> Floats:
    """Likeness of salient vertices in the frame as drawn, (n, m): from 0, strangers, to 1."""
    away = _square_gaps(_even_spread(a).T, _even_spread(b).T)
    cost = _saturated(
        0.6 * away + 0.5 * (1 - a.apexes @ b.apexes.T) + 0.8 * _unlike_surroundings(a, b)
    )
    return np.maximum(1 - cost / STRANGERS, 0.0)


def _unlike_surroundings(a: Stations, b: Stations) -> Floats:
    return 1 - contexts(a.points, a.seen, UPRIGHT) @ contexts(b.points, b.seen, UPRIGHT).T


def _square_gaps(a: Floats, b: Floats) -> Floats:
    """Sum over rows of the squared differences of all pairs: (k, n) and (k, m) to (n, m)."""
    return np.asarray(((a[:, :, None] - b[:, None, :]) ** 2).sum(axis=0))


def _log_radius(radius: Floats) -> Floats:
    return np.log(np.maximum(radius, MIN_RADIUS))[None]


def _saturated(cost: Floats, most: float = 1.0) -> Floats:
    """Between 0 and `most`: what is quite unlike can hardly be more so."""
    return np.asarray(cost / (1 + cost / most))


def _even_spread(stations: Stations) -> Points:
    """Points part of the way to equal spread in x and y."""
    wide, tall = stations.seen.std(axis=0)
    ratio = np.clip(wide / tall, 1 / MOST_SPREAD, MOST_SPREAD) ** SPREAD_POWER
    return np.asarray(stations.points * [1 / ratio, ratio])


def _ranks(stations: Stations) -> Floats:
    """Rank of the coordinates among all seen, from -1 to 1, height weighted double; (2, n)."""
    gap = stations.points[:, None] - stations.seen
    x, y = np.tanh(gap / RANK_BLUR).mean(axis=1).T
    return np.stack([x, np.sqrt(2) * y])
