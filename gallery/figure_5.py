"""Figure 5: two views of a cube, by quads and by triangles, beside what really happens."""

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Floats, Points, times
from shapetween.gallery import Exhibit, Picture
from shapetween.gallery.strips import method_strips
from shapetween.mesh.pair import MeshPair

#: Three faces around a corner.
CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], dtype=np.float64
)
QUADS = np.array([[0, 1, 2, 3], [1, 0, 4, 5], [0, 3, 6, 4]])

#: How far away the cube is, in sides.
DISTANCE = 2.6

#: Pitch and yaw of both views.
ANGLES = np.array([[0.35, -1.1], [0.9, -0.35]])

ROWS = (
    ("Projective", "this package's form", "projective"),
    ("Projective, 2007", "the paper's form", "projective-2007"),
    ("ARAP", "fair triangles", "arap"),
    ("ARAP, 2000", "as published", "arap-2000"),
    ("Linear", "corners go straight", "linear"),
)


def turned(pitch: float, yaw: float) -> Floats:
    """First about the upright axis, then about the one across."""
    up = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    across = np.array(
        [[1, 0, 0], [0, np.cos(pitch), -np.sin(pitch)], [0, np.sin(pitch), np.cos(pitch)]]
    )
    return np.asarray(across @ up)


def view(pitch: float, yaw: float) -> Points:
    """The cube as a camera sees it, its near corner in the middle."""
    points = (CORNERS - 0.5) @ turned(pitch, yaw).T
    return np.asarray(points[:, :2] / (points[:, 2:] + DISTANCE))


class Truth:
    """The cube itself, turning evenly."""

    def vertices(self, t: ArrayLike) -> Points:
        """All corners at the times (F,), (F, V, 2)."""
        time = times(t)[:, None]
        return np.stack([view(*angles) for angles in ((1 - time) * ANGLES[0] + time * ANGLES[1])])


def draw() -> list[Exhibit]:
    pair = MeshPair(view(*ANGLES[0]), view(*ANGLES[1]), QUADS)
    text = (
        "Two views of one cube. By homographies the boards' lines stay straight and their far "
        "cells small, as on real faces. By triangles each face breaks along its diagonal. Look at "
        "the last row too: for so small a turn, corners that simply go straight are a strong "
        "rival. Nothing below the first row knows that it is a cube."
    )
    svg = method_strips(
        "A cube turns", pair, [("The cube itself", "a camera's view", Truth()), *ROWS], 6
    )
    return [
        Exhibit(
            "Figure 5: two views of a cube",
            text,
            (Picture("figure-5.svg", svg, "Two views of a cube, by five methods"),),
        )
    ]
