"""Outlines like those of maps: rough at every scale, with bays that widen inland."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline

__all__ = ["coast"]

#: How far, as a share of a side, its middle moves to either side. From 0.35 on, sides soon cross.
ROUGHNESS = 0.28


def coast(seed: int, curves: int) -> Outline:
    """A closed outline of about so many straight curves, clockwise as drawn, that never crosses."""
    random = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(12) / 12
    radius = 1 + 0.3 * random.uniform(-1, 1, 12)
    points = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    while len(points) < curves:
        points = _rougher(points, random)
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def _rougher(points: Points, random: np.random.Generator) -> Points:
    """Every side in two, its middle moved to either side, but for those that would cross."""
    import shapely

    following = np.roll(points, -1, axis=0)
    step = following - points
    shift = random.uniform(-ROUGHNESS, ROUGHNESS, len(points))
    across = np.stack([-step[:, 1], step[:, 0]], axis=1)
    slide = random.uniform(-ROUGHNESS, ROUGHNESS, len(points))
    while True:
        middle = (points + following) / 2 + shift[:, None] * across + slide[:, None] * step
        doubled = np.stack([points, middle], axis=1).reshape(-1, 2)
        sides = shapely.linestrings(np.stack([doubled, np.roll(doubled, -1, axis=0)], axis=1))
        one, other = shapely.STRtree(sides).query(sides, predicate="intersects")
        apart = (one - other) % len(sides)
        bad = one[(apart > 1) & (apart < len(sides) - 1)] // 2
        if not len(bad):
            return doubled
        shift[bad] /= 2
        slide[bad] /= 2
