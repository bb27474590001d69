"""Projective interpolation of quads, each alone.

.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007, sections 3 and 4.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Floats, Points, Quads, frozen, times
from shapetween.base.errors import DegenerateQuadError, OptionError, ShapeError
from shapetween.geometry.homography import apply_homography, quad_homographies
from shapetween.geometry.polygon import corner_sines, rms_radius
from shapetween.geometry.rotation import linear_between, polar

__all__ = ["QuadMotion", "check_quads", "interpolate_quads"]

#: Least sine of a corner. Larger refuses thin but valid quads; smaller lets the rotation that is
#: read off the matrix be rounding error.
MIN_CORNER_SINE = 1e-9


def check_quads(source: Quads, target: Quads) -> None:
    """Refuse quads that no homography of one sign takes from source to target, both (Q, 4, 2).

    Raises
    ------
    DegenerateQuadError
        Where a quad is not strictly convex, or is inverted between source and target.
    """
    sines = np.stack([corner_sines(source), corner_sines(target)])  # (2, Q, 4)
    turning = np.sign(sines.sum(axis=-1))
    flat = (np.abs(sines) < MIN_CORNER_SINE) | (np.sign(sines) != turning[..., None])
    bad = flat.any(axis=(0, 2))
    if bad.any():
        raise DegenerateQuadError(
            np.flatnonzero(bad), "not strictly convex at both ends; split it into triangles"
        )
    if (mirrored := turning[0] != turning[1]).any():
        raise DegenerateQuadError(
            np.flatnonzero(mirrored), "inverted between source and target; reverse one end"
        )


@dataclass(frozen=True, slots=True, eq=False)
class QuadMotion:
    """Homographies from source quads to target quads, taken apart to be interpolated.

    Attributes
    ----------
    centres : (Q, 2) float64
        Source centroids, the origin of each quad's own frame.
    shifts : (Q, 2) float64
        From the centroid to its projective image.
    angles : (Q,) float64
        Rotation of the linear part.
    stretches : (Q, 2, 2) float64
        Symmetric stretch of the linear part.
    lines : (Q, 2) float64
        Vanishing line (h31, h32) / h33 in the quad's own frame, in units of 1 / length.
    radii : (Q,) float64
        Root mean square radius of the source quads.
    scale : float or None
        Source radius that the line turns at (slerp); None for the limit of an infinite one.
    """

    centres: Points
    shifts: Points
    angles: Floats
    stretches: Floats
    lines: Floats
    radii: Floats
    scale: float | None

    @classmethod
    def between(cls, source: Quads, target: Quads, scale: float | None = None) -> "QuadMotion":
        """Take the homographies between two stacks of quads apart.

        Parameters
        ----------
        source, target : (Q, 4, 2) float64
            Convex, with the same orientation.
        scale : float, optional
            See `interpolate_quads`.

        Raises
        ------
        DegenerateQuadError
            Where a quad is not strictly convex, or is inverted between source and target.
        """
        check_quads(source, target)
        centres, means = source.mean(axis=1), target.mean(axis=1)
        matrix = quad_homographies(source - centres[:, None], target - means[:, None])
        lines, image = matrix[:, 2, :2], matrix[:, :2, 2]
        angles, stretches = polar(matrix[:, :2, :2] - image[:, :, None] * lines[:, None, :])
        radii = rms_radius(source)
        return cls(centres, image + means - centres, angles, stretches, lines, radii, scale)

    def linear(self, t: Floats) -> Floats:
        """Linear part of the affine factor at the times (F,), shape (F, Q, 2, 2)."""
        return linear_between(self.angles, self.stretches * self._cosines[:, None, None], t)

    @property
    def _sizes(self) -> Floats:
        """Length of each line in the unit of the scale, tan gamma; 0 in the limit."""
        if self.scale is None:
            return np.zeros(len(self.radii))
        return np.asarray(np.linalg.norm(self.lines, axis=1) * self.radii / self.scale)

    @property
    def _cosines(self) -> Floats:
        return np.asarray(1 / np.hypot(1.0, self._sizes))

    def homographies(self, t: Floats) -> Floats:
        """In-between homographies, source frame to drawing, at the times (F,): (F, Q, 3, 3).

        Notes
        -----
        ``H_t = [R(t angle) ((1 - t) I + t S), t T; 0 1] P_t``. The last row of P_t is the unit
        vanishing line turned from (0, 0, 1) by t gamma, [WKD07]_ equation (7) with three faults
        of its printed form corrected: the line's sign, the missing eta and the division by
        sin gamma. With the radius at infinity it becomes (t h31, t h32, 1).
        """
        gamma = np.arctan(self._sizes)
        turned = t[:, None] * gamma
        # sin(t gamma) / tan gamma, whose limit at gamma = 0 is t.
        safe = np.where(gamma > 0, self._sizes, 1.0)
        share = np.where(gamma > 0, np.sin(turned) / safe, t[:, None])
        matrix = np.zeros((len(t), len(gamma), 3, 3))
        last = matrix[..., 2, :]
        last[..., :2] = share[..., None] * self.lines
        last[..., 2] = np.cos(turned)
        move = t[:, None, None] * self.shifts
        # The affine factor times P_t: its translation multiplies P_t's last row.
        matrix[..., :2, :2] = self.linear(t)
        matrix[..., :2, :] += (self.centres + move)[..., :, None] * last[..., None, :]
        return matrix

    def corners(self, source: Quads, t: Floats) -> Quads:
        """Corners of the source quads at the times (F,), (F, Q, 4, 2)."""
        local = source - self.centres[:, None]
        return apply_homography(
            self.homographies(t), np.broadcast_to(local, (len(t), *local.shape))
        )


def interpolate_quads(
    p: ArrayLike,
    q: ArrayLike,
    t: ArrayLike,
    line: Literal["limit", "slerp"] = "limit",
    scale: float | None = None,
) -> Quads:
    """Move each quad projectively on its own, by sections 3 and 4 of [WKD07]_.

    Parameters
    ----------
    p, q : (Q, 4, 2) array_like
        Corners at the start and at the end, convex and in the same order of corners.
    t : (F,) array_like
        Times in [0, 1].
    line : {"limit", "slerp"}
        How the vanishing line moves: "slerp" turns the unit line as the paper does, which depends
        on the source's size; "limit" is what that tends to for large sources.
    scale : float, optional
        With "slerp" the root mean square radius to which the source is scaled; 10 if left out.

    Returns
    -------
    (F, Q, 4, 2) float64
        Convex at every time.

    Raises
    ------
    DegenerateQuadError
        If a quad is not strictly convex at one end, or is inverted.

    Examples
    --------
    A square turned by a right angle keeps its size half way:

    >>> square = np.array([[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]])
    >>> half = interpolate_quads(square, np.roll(square, -1, axis=1), [0.5])
    >>> np.round(np.abs(half[0, 0]).max(), 3)
    np.float64(1.414)
    """
    source = frozen(p, np.float64, last=(4, 2))
    target = frozen(q, np.float64, last=(4, 2))
    if source.shape != target.shape:
        raise ShapeError(f"{len(source)} source quads and {len(target)} target quads")
    if line not in ("limit", "slerp"):
        raise OptionError(f"line: {line!r} is neither 'limit' nor 'slerp'")
    if scale is not None and (line == "limit" or not 0 < scale < np.inf):
        raise OptionError("scale: a positive number, and only with line='slerp'")
    radius = (10.0 if scale is None else scale) if line == "slerp" else None
    moments = times(t)
    result = QuadMotion.between(source, target, radius).corners(source, moments)
    result[moments == 0] = source
    result[moments == 1] = target
    return result
