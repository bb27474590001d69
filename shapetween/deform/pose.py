"""The motion of two shapes as wholes: where each is, how large, and the affine map between them.

The outside of the shapes is held by a frame that follows this motion, so that an affine image is
reached through affine images and nothing pulls back.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OutlineError
from shapetween.deform.jacobians import polar_path
from shapetween.geometry.linearmaps import LinearMaps
from shapetween.geometry.rotation import rotations

__all__ = ["AffinePath", "Pose", "affine_path"]

#: Residual of the affine fit, as a share of the shape's size, up to which the frame follows the
#: whole affine map, and from which on it follows only the similarity in it. Larger, and unlike
#: shapes shear the frame; smaller, and rounding in a matching breaks affine pairs.
AFFINE_RESIDUAL = (0.002, 0.05)

#: Angle next to a half turn backwards that counts as one forwards, or rounding would choose.
HALF_TURN_TIE = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Centre and size of a shape.

    Attributes
    ----------
    centre : (2,) float64
    size : float
        Square root of the shape's area.
    """

    centre: Points
    size: float

    @classmethod
    def of(cls, nodes: Points, area: float) -> "Pose":
        """Pose of a shape from the nodes of its outlines, (N, 2), and its area.

        Raises
        ------
        OutlineError
            If the area is not positive.
        """
        if not area > 0:
            raise OutlineError("an outline needs an area above zero")
        return cls(nodes.mean(axis=0), float(np.sqrt(area)))

    def normalise(self, points: Points) -> Points:
        """Points with the centre at the origin and the size 1."""
        return np.asarray((points - self.centre) / self.size)

    def place(self, points: Points) -> Points:
        """Undo `normalise`."""
        return np.asarray(points * self.size + self.centre)


@dataclass(frozen=True, slots=True, eq=False)
class AffinePath:
    """A linear map of the plane that starts as the identity.

    Attributes
    ----------
    matrix : (2, 2) float64
        Where it ends; its determinant is positive.
    angle : float
        Angle of its rotation, radians.
    """

    matrix: Floats
    angle: float

    def at(self, t: Floats) -> LinearMaps:
        """Linear maps at the times (F,)."""
        return polar_path(LinearMaps.of(self.matrix), np.asarray(self.angle), t)

    def reversed(self) -> "AffinePath":
        """The same path backwards, as seen from its end."""
        return AffinePath(np.asarray(np.linalg.inv(self.matrix), dtype=np.float64), -self.angle)


def affine_path(source: Points, target: Points) -> AffinePath:
    """Best motion of matched nodes as one body.

    Parameters
    ----------
    source, target : (N, 2) float64
        Both normalised by their poses.

    Returns
    -------
    AffinePath
        The affine map between them if they are affine images, the similarity nearest to that map
        if they are far from it, a blend in between.
    """
    moment = target.T @ source
    turn = rotations(LinearMaps.of(moment).angles)
    similarity = turn * np.sqrt((target**2).sum() / (source**2).sum())
    affine = np.asarray(np.linalg.lstsq(source, target, rcond=None)[0].T, dtype=np.float64)
    residual = np.sqrt(((source @ affine.T - target) ** 2).sum(axis=1).mean())
    low, high = AFFINE_RESIDUAL
    share = np.clip((residual - low) / (high - low), 0, 1)
    matrix = affine + share * (similarity - affine)
    if np.linalg.det(affine) <= 0 or np.linalg.det(matrix) <= 0:
        matrix = similarity
    angle = float(LinearMaps.of(matrix).angles)
    return AffinePath(matrix, angle + 2 * np.pi * (angle < HALF_TURN_TIE - np.pi))
