"""Outlines bent, bowed, stretched and turned by known maps."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.geometry.polygon import polygon_area
from shapetween.match.correspondence import Correspondence
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from tests.match.labels import labelled
from tests.match.shapes import bowed, polygon, rotation, swirled, target_at

__all__ = ["FAILED", "Warped", "warped"]

#: Mean distance from where the places went, as a share of the length, from which on a matching
#: has failed.
FAILED = 0.03

#: Turns, radians: little, about a right angle, and on to the head.
TURNS = ((0.0, 1.2), (1.2, 2.2), (2.2, 3.14))

PLACES = 400


@dataclass(frozen=True, eq=False)
class Warped:
    """An outline, its image, and fractions of their lengths that belong together."""

    name: str
    source: Outline
    target: Outline
    turn: float
    u: Floats
    v: Floats

    def failed(self, found: Correspondence) -> bool:
        gap = target_at(found, self.u) - self.v
        return bool(np.abs(gap - np.round(gap)).mean() > FAILED)


def warped(count: int, every: int = 1) -> Iterator[Warped]:
    """Three images of each of the labelled outlines, about evenly turned.

    Outlines that are much the same turned by some angle are left out: nobody knows how far their
    images are turned.
    """
    import shapely

    for number, pair in enumerate(labelled("tune")[:count]):
        if number % every:
            continue
        around = ArcLength(pair.source).point(np.arange(PLACES) / PLACES)
        points = (around - around.mean(axis=0)) / np.sqrt(pair.source.area)
        if _turns_into_itself(points):
            continue
        rng = np.random.default_rng([5, number])
        for low, high in TURNS:
            image = points
            for _ in range(2):
                centre = points[rng.integers(PLACES)]
                image = swirled(image, centre, rng.uniform(-0.7, 0.7), rng.uniform(0.5, 1.2))
            image = bowed(image, rng.uniform(-0.12, 0.12))
            stretch, across = np.exp(rng.uniform(-0.25, 0.25)), rotation(rng.uniform(0, np.pi))
            image = image @ across[:, :2].T * [stretch, 1 / stretch] @ across[:, :2]
            turn = rng.uniform(low, high) * rng.choice([-1, 1])
            image = image @ rotation(turn)[:, :2].T
            if not shapely.is_simple(shapely.linearrings(image)) or polygon_area(image) < 0:
                continue
            start = int(rng.integers(PLACES))
            target = polygon(np.roll(image, -start, axis=0) * rng.uniform(0.1, 50.0))
            u, v = _places(points), _places(image)
            yield Warped(pair.name, polygon(points), target, turn, u, (v - v[start]) % 1)


def _places(points: Points) -> Floats:
    """Fractions of a polygon's length at its corners."""
    sides = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    return np.asarray((np.cumsum(sides) - sides) / sides.sum())


def _turns_into_itself(points: Points) -> bool:
    """Whether an outline shifted along itself is nearly itself turned."""
    z = points @ [1, 1j]
    likeness = np.abs(np.fft.ifft(np.abs(np.fft.fft(z)) ** 2)) / (np.abs(z) ** 2).sum()
    # Next to no shift anything is like itself.
    return bool(likeness[PLACES // 12 : -PLACES // 12].max() > 0.97)
