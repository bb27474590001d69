"""Outlines for the tests of the plane mesh, as nodes in order, clockwise as drawn."""

import numpy as np
from hypothesis import strategies as st

from shapetween.base.arrays import Index, Points

__all__ = ["blob", "bowed_strip", "comb", "pairs", "ring_with_hole", "two_discs"]


@st.composite
def pairs(draw: st.DrawFn, least: int = 8, most: int = 24) -> tuple[Points, Points]:
    """Two star-shaped polygons with as many nodes, of any size and place."""
    count = draw(st.integers(least, most))
    return blob(draw(st.integers(0, 10**6)), count), blob(draw(st.integers(0, 10**6)), count)


def blob(seed: int, count: int) -> Points:
    """A random star-shaped polygon."""
    random = np.random.default_rng(seed)
    angles = 2 * np.pi * (np.arange(count) + random.uniform(0.1, 0.9, count)) / count
    radii = random.uniform(0.4, 1.0, count)
    points = radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    size = 10.0 ** random.uniform(-2, 3)
    return np.asarray(size * (points + random.uniform(-3, 3, 2)))


def bowed_strip(angle: float, count: int = 8) -> Points:
    """A strip of length 1 and width 0.1, its middle line bent into an arc of some angle."""
    s = np.linspace(0, 1, count)
    heading = angle * (s - 0.5)
    if angle:
        middle = np.stack([np.sin(heading), -np.cos(heading)], axis=1) / angle
    else:
        middle = np.stack([s - 0.5, 0 * s], axis=1)
    across = 0.05 * np.stack([-np.sin(heading), np.cos(heading)], axis=1)
    return np.concatenate([middle - across, (middle + across)[::-1]])


def comb(teeth: int, lean: float) -> Points:
    """A bar with teeth that lean sideways by a share of their length."""
    bar = [[0.0, 0.0], [2.0 * teeth, 0.0]]
    hang = [
        [2.0 * k + x + lean * y, y]
        for k in reversed(range(teeth))
        for x, y in ((1.8, 1.0), (1.8, 5.0), (1.0, 5.0), (1.0, 1.0))
    ]
    return np.array([*bar, *hang])


def ring_with_hole(shift: float) -> tuple[Points, list[Index]]:
    """A round shape with a round hole that lies to one side."""
    angles = 2 * np.pi * np.arange(16) / 16
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    nodes = np.concatenate([circle, 0.4 * circle[::-1] + [shift, 0.0]])
    return nodes, [np.arange(16), np.arange(16, 32)]


def two_discs(angle: float) -> tuple[Points, list[Index]]:
    """Two discs on opposite sides of the origin, in some direction."""
    angles = 2 * np.pi * np.arange(12) / 12
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    away = 1.4 * np.array([np.cos(angle), np.sin(angle)])
    return np.concatenate([circle + away, circle - away]), [np.arange(12), np.arange(12, 24)]
