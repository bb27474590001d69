"""From pixels of a frame back to a picture: the inverse map of each face, and its footprint."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Floats, Points, Quads
from shapetween.geometry.homography import homogeneous_weights, quad_homographies

__all__ = ["SHARPNESS", "Bilinear", "FaceMap", "Footprint", "Projection", "projections"]

#: Most samples along a pixel's longer side. More cost time where a board is seen edge-on; fewer
#: blur it there.
MOST_PROBES = 8

#: Share of a pixel's footprint that a picture's halved copy may be as coarse as. Straight lines
#: between its pixels blur by themselves: at 1 shrunken pictures were 5 to 9 dB farther from the
#: mean over each pixel than at 0.7; at 0.5 fine patterns begin to shimmer.
SHARPNESS = 2**-0.5

#: Share of the least weight at the corners that is the least weight anywhere. Middles of pixels
#: on the edge may lie beyond the face, and where the horizon is near, w would vanish there.
LEAST_WEIGHT_SHARE = 0.5


class FaceMap(Protocol):
    """Places in a picture for places in a frame."""

    def __call__(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Coordinates in the picture, (N,) each, of places in the frame, (N,) each."""


@dataclass(frozen=True, slots=True, eq=False)
class Footprint:
    """How large a frame's pixel is in the picture.

    Attributes
    ----------
    matrix : (3, 3) float64
        Homography from frame to picture.
    least : float
        Least weight it is taken to have.
    direction : (2,) float64
        In the frame, the way along which the picture shrinks most, at the face's centre.
    probes : int
        Samples to take along it in each pixel.
    shrinks : bool
        Whether any pixel of the face covers noticeably more than one of the picture's.
    """

    matrix: Floats
    least: float
    direction: Points
    probes: int
    shrinks: bool

    @classmethod
    def of(cls, matrix: Floats, corners: Points) -> "Footprint":
        """The footprint on a face with these corners in the frame, (K, 2)."""
        places = np.concatenate([corners, corners.mean(axis=0, keepdims=True)])
        weights = homogeneous_weights(matrix, places)
        mapped = (np.c_[places, np.ones(len(places))] @ matrix[:2].T) / weights[:, None]
        jacobians = matrix[None, :2, :2] - mapped[:, :, None] * matrix[None, 2:, :2]
        jacobians /= weights[:, None, None]
        _, stretches, axes = np.linalg.svd(jacobians)
        ratio = float((stretches[:, 0] / stretches[:, 1]).max())
        shrinks = bool(stretches[:, 0].max() * SHARPNESS > 1)
        probes = int(np.clip(np.ceil(min(ratio, stretches[:, 0].max()) - 0.25), 1, MOST_PROBES))
        least = LEAST_WEIGHT_SHARE * float(weights.min())
        return cls(matrix, least, axes[-1, 0], probes if shrinks else 1, shrinks)

    def level(self, x: Floats, y: Floats, u: Floats, v: Floats) -> NDArray[np.float32]:
        """Which halving of the picture suits each pixel, 0 for none, (N,).

        Notes
        -----
        J = (M - (u, v) m3) / w has the determinant det H / w^3. A probe's footprint is |J d| over
        the probes long and det J / |J d| wide; the larger of both must not skip pixels.
        """
        h, (dx, dy) = self.matrix, self.direction
        w = np.maximum(h[2, 0] * x + h[2, 1] * y + h[2, 2], self.least).astype(np.float32)
        fall = h[2, 0] * dx + h[2, 1] * dy
        across, down = h[:2, :2] @ self.direction
        run, rise = (across - u * fall).astype(np.float32), (down - v * fall).astype(np.float32)
        along = np.sqrt(run * run + rise * rise) / w
        area = np.float32(abs(np.linalg.det(h))) / w**3
        size = np.maximum(along / np.float32(self.probes), area / along)
        size *= np.float32(SHARPNESS)
        return np.asarray(np.log2(np.maximum(size, np.float32(1))))


@dataclass(frozen=True, slots=True, eq=False)
class Projection:
    """A face that is mapped by a homography, or, a triangle, by an affine map.

    Attributes
    ----------
    matrix : (3, 3) float64
        From frame to picture, its weight positive on the face.
    least : float
        Least weight it is taken to have.
    """

    matrix: Floats
    least: float

    def __call__(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Coordinates in the picture, (N,) each, of places in the frame, (N,) each."""
        h = self.matrix
        w = np.maximum(h[2, 0] * x + h[2, 1] * y + h[2, 2], self.least)
        return (h[0, 0] * x + h[0, 1] * y + h[0, 2]) / w, (h[1, 0] * x + h[1, 1] * y + h[1, 2]) / w


@dataclass(frozen=True, slots=True, eq=False)
class Bilinear:
    """A quad mapped bilinearly, so that neighbours agree along their edge.

    Attributes
    ----------
    frame, picture : (4, 2) float64
        Corners of the quad, convex in the frame.
    """

    frame: Points
    picture: Points

    def __call__(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Coordinates in the picture, (N,) each, of places in the frame, (N,) each.

        Notes
        -----
        A point is a + s b + r c + s r d, with s along the first side and r along the last. The
        cross product with b + r d leaves a quadratic in r, of whose roots the one for convex
        quads is (2 k0) / (-k1 +- sqrt(k1^2 - 4 k2 k0)), which is stable as k2 vanishes.
        """
        a = self.frame[0]
        b, c = self.frame[1] - a, self.frame[3] - a
        d = self.frame[2] - self.frame[1] - c
        px, py = x - a[0], y - a[1]
        k2 = d[0] * c[1] - d[1] * c[0]
        k1 = b[0] * c[1] - b[1] * c[0] + px * d[1] - py * d[0]
        k0 = px * b[1] - py * b[0]
        root = np.sqrt(np.maximum(k1 * k1 - 4 * k2 * k0, 0.0))
        turn = np.sign(b[0] * c[1] - b[1] * c[0])
        r = np.clip(-2 * k0 / (k1 + turn * root), -1.0, 2.0)
        # s from whichever coordinate b + r d is larger in.
        ex, ey = b[0] + r * d[0], b[1] + r * d[1]
        wide = np.abs(ex) >= np.abs(ey)
        s = np.where(wide, px - r * c[0], py - r * c[1]) / np.where(wide, ex, ey)
        s = np.clip(s, -1.0, 2.0)
        p, q = self.picture[0], self.picture[1] - self.picture[0]
        e = self.picture[3] - p
        f = self.picture[2] - self.picture[1] - e
        u = p[0] + s * q[0] + r * (e[0] + s * f[0])
        v = p[1] + s * q[1] + r * (e[1] + s * f[1])
        return u, v


def projections(frame: Quads, picture: Quads) -> Floats:
    """Maps from faces in the frame to the picture, (N, 3, 3), weight positive on each face.

    Parameters
    ----------
    frame, picture : (N, K, 2) float64
        Quads (K = 4), which get homographies, or triangles (K = 3), which get affine maps.
    """
    if frame.shape[1] == 4:
        return quad_homographies(frame, picture)
    ones = np.ones((*frame.shape[:2], 1))
    matrices = np.zeros((len(frame), 3, 3))
    # A frame's corner in homogeneous coordinates on the left: rows (x, y, 1) M^T = (u, v).
    solved = np.linalg.solve(np.concatenate([frame, ones], axis=2), picture)
    matrices[:, :2] = np.swapaxes(solved, 1, 2)
    matrices[:, 2, 2] = 1.0
    return matrices
