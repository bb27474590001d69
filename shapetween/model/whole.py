"""How a shape moves as one body, which what is painted inside it follows.

A gradient knows no mesh: it can be moved, turned and stretched, no more. So it follows the affine
map that best fits the motion of the shape's inside; where a shape bends so much that no affine map
says what happens to it, the similarity in it.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from shapetween.base.arrays import Affine, Floats, Points
from shapetween.geometry.rotation import rotations
from shapetween.timing.easing import even_times

__all__ = ["MOTION_TIMES", "WholeMotion"]

#: Times at which the motion is looked at. Between them a cubic is off by 2e-5 of the shape's size
#: if it makes half a turn, less than what is printed.
MOTION_TIMES = even_times(17)

#: Greatest residual of the affine fit, as a share of the shape's radius, up to which the affine map
#: is followed, and from which on only the similarity. Larger, and shapes that bend shear their
#: gradients; smaller, and a gradient does not stretch along with a shape that also bends a little.
AFFINE_RESIDUAL = (0.1, 0.3)

#: Least correlation of the inside with what it was, below which nothing can be said of its turn.
LEAST_CORRELATION = 0.1

#: Radius, as a share of the one at the start, below which a body has vanished; and spread across a
#: line, as a share of that along it, below which points say nothing of what happens across it.
VANISHED, FLAT = 1e-6, 1e-6


@dataclass(frozen=True, eq=False)
class WholeMotion:
    """Affine maps from a shape's first place to its later ones.

    Attributes
    ----------
    matrices : (K, 2, 3) float64
        At `MOTION_TIMES`; the first is the identity.
    turn : float
        Angle by which the shape has turned at the end, whole turns included, radians.
    """

    matrices: Floats
    turn: float

    @classmethod
    def of(cls, places: Points, weights: Floats) -> "WholeMotion | None":
        """Fit the motion of points.

        Parameters
        ----------
        places : (K, N, 2) float64
            At `MOTION_TIMES`.
        weights : (N,) float64
            What each counts, not negative.

        Returns
        -------
        WholeMotion or None
            None if there is nothing to fit: the points are all in one place at some time.
        """
        if not weights.any():
            return None
        shares = weights / weights.sum()
        centres = shares @ places
        offsets = places - centres[:, None]
        radii = np.sqrt((offsets**2).sum(axis=2) @ shares)
        if not (radii > VANISHED * radii.max()).all():
            return None
        moments = np.einsum("n,kni,nj->kij", shares, offsets, offsets[0])
        similar, angles = _similarities(moments, radii)
        linear = _bent(similar, moments, offsets, shares, radii)
        shifts = centres - (linear @ centres[0])
        return cls(np.concatenate([linear, shifts[:, :, None]], axis=2), float(angles[-1]))

    @cached_property
    def _spline(self) -> Any:
        from scipy.interpolate import CubicSpline  # slow to import

        return CubicSpline(MOTION_TIMES, self.matrices)

    def at(self, t: float) -> Affine:
        """The map to the place at one time, (2, 3)."""
        return np.asarray(self._spline(t), dtype=np.float64)

    @cached_property
    def back(self) -> Affine:
        """The map from the last place to the first, (2, 3)."""
        linear, shift = self.matrices[-1, :, :2], self.matrices[-1, :, 2]
        inverse = np.linalg.inv(linear)
        return np.column_stack([inverse, -inverse @ shift])


def _similarities(moments: Floats, radii: Floats) -> tuple[Floats, Floats]:
    """Turns and evenly scaled matrices that fit best, (K, 2, 2), and their angles (K,)."""
    along = moments[:, 0, 0] + moments[:, 1, 1]
    across = moments[:, 1, 0] - moments[:, 0, 1]
    known = np.hypot(along, across) >= LEAST_CORRELATION * radii * radii[0]
    angles = np.unwrap(np.arctan2(across, along)) if known.all() else np.zeros(len(radii))
    return rotations(angles) * (radii / radii[0])[:, None, None], angles


def _bent(
    similar: Floats, moments: Floats, offsets: Points, shares: Floats, radii: Floats
) -> Floats:
    """The affine fits, (K, 2, 2), or the similarities, or what lies between both."""
    spread = np.linalg.eigvalsh(moments[0])
    if spread[0] <= FLAT * spread[1]:
        return similar
    affine = moments @ np.linalg.inv(moments[0])
    misfits = offsets - offsets[0] @ np.swapaxes(affine, 1, 2)
    residual = float((np.sqrt((misfits**2).sum(axis=2) @ shares) / radii).max())
    low, high = AFFINE_RESIDUAL
    share = np.clip((residual - low) / (high - low), 0, 1)
    linear = affine + share * (similar - affine)
    valid = (np.linalg.det(affine) > 0) & (np.linalg.det(linear) > 0)
    return np.asarray(linear if valid.all() else similar)
