"""Planes in space under a moving camera, drawn by their own formulas."""

from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.geometry.homography import apply_homography
from shapetween.mesh.pair import MeshPair
from shapetween.photo.layers import Layer
from shapetween.photo.transition import Transition
from shapetween.raster.light import FULL, Bytes
from shapetween.raster.picture import Picture

__all__ = ["HALVES", "QUAD", "camera", "corners", "mesh", "pattern", "psnr", "rendered", "shown"]

Faces: TypeAlias = tuple[list[list[int]], list[list[int]]]
"""Quads and triangles."""

QUAD: Faces = ([[0, 1, 2, 3]], [])
HALVES: Faces = ([], [[0, 1, 2], [0, 2, 3]])

SIZE = (160, 120)

#: Corners of the plane in its own coordinates.
PLANE = np.array([[-1.0, -0.7], [1.0, -0.7], [1.0, 0.7], [-1.0, 0.7]])


def camera(yaw: float, pitch: float, away: float, x: float, y: float) -> Floats:
    """Homography from the plane to the picture, for a plane turned so and standing there."""
    cy, sy, cp, sp = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch)
    turn = np.array([[cy, sy * sp], [0.0, cp], [-sy, cy * sp]])
    pose = np.column_stack([turn, [x, y, away]])
    lens = np.array([[150.0, 0, SIZE[0] / 2], [0, 150.0, SIZE[1] / 2], [0, 0, 1]])
    return np.asarray(lens @ pose)


def pattern(points: Points) -> Floats:
    """Linear light of the plane's picture: smooth waves, so that sampling is not what is tested."""
    x, y = points[..., 0], points[..., 1]
    waves = [np.sin(5 * x + k) * np.cos(4 * y - 2 * k) for k in range(3)]
    return 0.5 + 0.4 * np.stack(waves, axis=-1)


def rendered(matrix: Floats) -> tuple[Bytes, Mask]:
    """What a camera sees, and a mask of pixels that lie inside the plane by two pixels."""
    width, height = SIZE
    places = np.asarray(np.moveaxis(np.indices((height, width)), 0, -1) + 0.5, np.float64)
    inverse = np.asarray(np.linalg.inv(matrix), np.float64)
    on_plane = apply_homography(inverse, places[..., ::-1].reshape(-1, 2)).reshape(height, width, 2)
    light = pattern(on_plane)
    values = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    inside = (np.abs(on_plane) <= PLANE[2]).all(axis=-1)
    shown = np.where(inside[..., None], values, 1.0)
    core = inside.copy()
    for axis in (0, 1):
        for step in (-2, -1, 1, 2):
            core &= np.roll(inside, step, axis=axis)
    return np.rint(shown * 255).astype(np.uint8), core


def corners(matrix: Floats) -> Points:
    """The plane's corners in the picture."""
    return apply_homography(matrix, PLANE)


def psnr(a: Bytes, b: Bytes, where: Mask) -> float:
    """Peak signal to noise ratio in decibels over some pixels."""
    difference = a[where].astype(np.float64) - b[where]
    error = max(float(np.mean(difference**2)), 1e-9)
    return float(10 * np.log10(255**2 / error))


def mesh(source: Points, target: Points, faces: Faces) -> MeshPair:
    quads, triangles = (np.array(part, np.intp) for part in faces)
    return MeshPair(source, target, quads.reshape(-1, 4), triangles.reshape(-1, 3))


def shown(
    picture: Picture, source: Points, places: Points, faces: Faces = QUAD, behind: int = FULL
) -> Bytes:
    """A part of a picture, warped so that its corners come to these places, on white or grey."""
    pair = mesh(source, source, faces)
    layer = Layer(pair, places[None], np.zeros(len(pair.quads), bool), (0.0, 0.0), ())
    ground = np.full((picture.height, picture.width, 4), behind, np.uint16)
    ground[..., 3] = FULL
    size = (picture.width, picture.height)
    still = Transition(
        (picture, picture), np.zeros(1), size, (layer,), (ground,) * 2, (ground,) * 2, True
    )
    return still.frame(0)
