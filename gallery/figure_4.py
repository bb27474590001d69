"""Figure 4: a shape that bends and swells, by quads and by triangles."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.gallery import Exhibit, Picture
from shapetween.gallery.strips import method_strips
from shapetween.mesh.pair import MeshPair

SEGMENTS = 3

ROWS = (
    ("Projective", "this package's form", "projective"),
    ("Projective, 2007", "the paper's form", "projective-2007"),
    ("ARAP", "fair triangles", "arap"),
    ("ARAP, 2000", "as published", "arap-2000"),
)


def bar(turn: float, ends: tuple[float, float]) -> Points:
    """A bar of unit pieces that turns by so much in all, its width growing from end to end."""
    angles = np.linspace(0, turn, SEGMENTS + 1)
    middles = (angles[1:] + angles[:-1]) / 2
    steps = np.stack([np.cos(middles), np.sin(middles)], axis=1)
    spine = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    across = np.stack([-np.sin(angles), np.cos(angles)], axis=1)
    half = np.linspace(*ends, SEGMENTS + 1)[:, None] / 2
    return np.concatenate([spine - half * across, spine + half * across])


def draw() -> list[Exhibit]:
    k = np.arange(SEGMENTS)
    quads = np.stack([k, k + 1, k + SEGMENTS + 2, k + SEGMENTS + 1], axis=1)
    pair = MeshPair(bar(0.0, (1.3, 1.3)), bar(-2.0, (0.6, 2.0)), quads)
    text = (
        "A straight bar becomes a bent horn. By quads the boards' lines stay straight within each "
        "quad; by triangles they break at every diagonal. Outlines differ far less: with as many "
        "quads as here, all four draw nearly the same shape, and the fair triangles are as good "
        "as the quads. What quads win is the inside."
    )
    svg = method_strips("A bar becomes a horn", pair, ROWS, 4)
    return [
        Exhibit(
            "Figure 4: a shape that is not rigid",
            text,
            (Picture("figure-4.svg", svg, "A bar becomes a horn, by four methods"),),
        )
    ]
