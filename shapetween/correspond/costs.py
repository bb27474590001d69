"""How unlike two places of two outlines are."""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Points
from shapetween.correspond.features import SEEN_STEP, Features, contexts, describe
from shapetween.correspond.sampling import SAMPLES, Samples, sample
from shapetween.outline import Outline

__all__ = ["Prepared", "Stations", "intrinsic_cost", "prepare", "stations", "upright_cost"]

#: Least medial radius told from 0, in roots of the area.
MIN_RADIUS = 0.02

#: How far positions are stretched towards equal spread in x and y: this power of the ratio, the
#: ratio itself held within `MOST_SPREAD`. 0 leaves tall against wide, 1/2 loses what tall means.
SPREAD_POWER, MOST_SPREAD = 0.25, 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """An outline with its samples and features."""

    samples: Samples
    features: Features

    def places(self, at: Floats) -> Floats:
        """Fractions of the length, from the canonical start, of measures of any turn."""
        whole = np.floor(at)
        even = np.arange(SAMPLES + 1) / SAMPLES
        return np.asarray(whole + np.interp(at - whole, self.features.measure, even))


@dataclass(frozen=True, slots=True, eq=False)
class Stations:
    """Places of an outline that the matching is made of, with what is seen from them.

    Attributes
    ----------
    places : (n,) float64
        Fractions of the length from the canonical start.
    points, tangents : (n, 2) float64
    turns : (5, n) float64
    inside, outside : (n,) float64
    seen : (m, 2) float64
        Points of the whole outline.
    """

    places: Floats
    points: Points
    tangents: Points
    turns: Floats
    inside: Floats
    outside: Floats
    seen: Points

    def turned(self, angle: float) -> "Stations":
        """The same stations of the outline turned by an angle."""
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, s], [-s, c]])
        return Stations(
            self.places,
            self.points @ turn,
            self.tangents @ turn,
            self.turns,
            self.inside,
            self.outside,
            self.seen @ turn,
        )


def prepare(outline: Outline) -> Prepared:
    """Sample and describe an outline."""
    samples = sample(outline)
    return Prepared(samples, describe(samples.points))


def stations(prepared: Prepared, at: Floats) -> Stations:
    """Stations at places given by the measure, 0 to 1 over one turn; it may run past 1."""
    points, features = prepared.samples.points, prepared.features
    places = prepared.places(at)
    index = places * SAMPLES
    low = np.floor(index)
    share = index - low
    first = low.astype(np.intp) % SAMPLES
    second = (first + 1) % SAMPLES

    def read(values: Floats) -> Floats:
        return values[..., first] * (1 - share) + values[..., second] * share

    tangents = read(features.tangents.T).T
    size = np.linalg.norm(tangents, axis=1, keepdims=True)
    return Stations(
        places=places,
        points=read(points.T).T,
        tangents=tangents / np.where(size > 0, size, 1.0),
        turns=read(features.turns),
        inside=read(features.inside),
        outside=read(features.outside),
        seen=points[::SEEN_STEP],
    )


def intrinsic_cost(a: Stations, b: Stations) -> Floats:
    """Unlikeness that no turning of either outline changes, (n, m)."""
    turns = _square_gaps(a.turns, b.turns) / len(a.turns)
    around = 1 - contexts(a.points, a.seen, a.tangents) @ contexts(b.points, b.seen, b.tangents).T
    inside = _square_gaps(_log_radius(a.inside), _log_radius(b.inside))
    outside = _square_gaps(_log_radius(a.outside), _log_radius(b.outside))
    return _saturated(0.5 * turns + 2 * around + 0.2 * (0.5 * inside + 0.25 * outside))


def upright_cost(a: Stations, b: Stations) -> Floats:
    """Unlikeness in the frame as drawn, (n, m)."""
    turns = _square_gaps(a.turns[3:], b.turns[3:])
    away = _square_gaps(_even_spread(a).T, _even_spread(b).T)
    askew = 1 - a.tangents @ b.tangents.T
    upright = np.array([1.0, 0.0])
    around = 1 - contexts(a.points, a.seen, upright) @ contexts(b.points, b.seen, upright).T
    return _saturated(0.3 * turns + 0.5 * away + 0.5 * askew + around)


def _square_gaps(a: Floats, b: Floats) -> Floats:
    """Sum over rows of the squared differences of all pairs: (k, n) and (k, m) to (n, m)."""
    return np.asarray(((a[:, :, None] - b[:, None, :]) ** 2).sum(axis=0))


def _log_radius(radius: Floats) -> Floats:
    return np.log(np.maximum(radius, MIN_RADIUS))[None]


def _saturated(cost: Floats) -> Floats:
    """Between 0 and 1: what is quite unlike can hardly be more so."""
    return np.asarray(cost / (1 + cost))


def _even_spread(stations: Stations) -> Points:
    """Points part of the way to equal spread in x and y."""
    wide, tall = stations.seen.std(axis=0)
    ratio = np.clip(wide / tall, 1 / MOST_SPREAD, MOST_SPREAD) ** SPREAD_POWER
    return np.asarray(stations.points * [1 / ratio, ratio])
