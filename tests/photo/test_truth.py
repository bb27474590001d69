"""Boards against the truth: a plane's picture under a known movement of the camera."""

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.photo.layers import Piece
from shapetween.photo.transition import Transition
from shapetween.raster.picture import Picture
from tests.photo.scenes import HALVES, QUAD, camera, corners, mesh, psnr, rendered, shown

#: Yaw, pitch, distance and place of the plane at both ends.
MOVES = {
    "turning": ((-0.7, 0.1, 3.0, -0.1, 0.0), (0.6, -0.1, 3.2, 0.1, 0.05)),
    "tilting": ((0.0, 0.0, 2.8, 0.0, 0.0), (0.2, 0.8, 3.0, 0.0, 0.1)),
    "going-away": ((0.4, 0.2, 2.4, 0.0, 0.0), (0.9, 0.0, 4.0, 0.5, -0.2)),
}
MOVING = pytest.mark.parametrize("move", MOVES)


def between(move: str, t: float) -> Floats:
    """The camera at a time; every part of its movement is even."""
    start, end = (np.array(part) for part in MOVES[move])
    return camera(*((1 - t) * start + t * end).tolist())


@MOVING
def test_both_ends_come_back(move: str) -> None:
    ends = [between(move, t) for t in (0.0, 1.0)]
    views = [rendered(matrix) for matrix in ends]
    pair = mesh(corners(ends[0]), corners(ends[1]), QUAD)
    transition = Transition.between(
        Picture.of(views[0][0]), Picture.of(views[1][0]), [Piece(pair)], np.array([0.0, 1.0])
    )
    for k, (view, core) in enumerate(views):
        assert psnr(transition.frame(k), view, core) > 60


@MOVING
def test_the_inside_of_a_board_is_seen_as_a_plane(move: str) -> None:
    """With the corners where the camera saw them, only the map between them is left to test.

    The homography has 56 dB in all three; two affine triangles have 19, 31 and 31.
    """
    start, middle = between(move, 0.0), between(move, 0.5)
    picture = Picture.of(rendered(start)[0])
    truth, core = rendered(middle)
    quad = psnr(shown(picture, corners(start), corners(middle), QUAD), truth, core)
    halves = psnr(shown(picture, corners(start), corners(middle), HALVES), truth, core)
    assert quad > 54
    assert halves < 32


@pytest.mark.parametrize(
    ("move", "projective", "affine"),
    [("turning", 17.0, 17.7), ("tilting", 24.3, 25.0), ("going-away", 25.9, 25.5)],
)
def test_mid_frames_against_the_camera(move: str, projective: float, affine: float) -> None:
    """What both methods reach half way, in decibels, corners' paths and all.

    Neither knows how far the camera was, so both put the corners some pixels off, and that
    outweighs the map between them: on whole frames the projective method is no better than fair
    affine triangles. What it does better is what is inside a board.
    """
    ends = [between(move, t) for t in (0.0, 1.0)]
    pictures = [Picture.of(rendered(matrix)[0]) for matrix in ends]
    truth, core = rendered(between(move, 0.5))
    for method, faces, expected in (
        ("projective", QUAD, projective),
        ("arap", HALVES, affine),
    ):
        pair = mesh(corners(ends[0]), corners(ends[1]), faces)
        transition = Transition.between(
            pictures[0],
            pictures[1],
            [Piece(pair)],
            np.array([0.5]),
            background=(1.0, 1.0, 1.0, 1.0),
            method=method,
        )
        assert psnr(transition.frame(0), truth, core) == pytest.approx(expected, abs=0.3)
