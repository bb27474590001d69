"""How well a face of a mesh would move: convexity, perspective and likeness in both shapes.

Corners come as ``(2, ..., K, 2)``: source and target first, then any stack of faces.

.. [Won07] K. W. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Mask, Points

__all__ = ["MAX_PERSPECTIVE", "MIN_CORNER_SINE", "USABLE_SINE", "FaceFigures", "face_figures"]

#: Least corner sine of a quad. Raise it and more of a shape is left to triangles; lower it and
#: quads stay whose homography is mostly rounding error and whose in-betweens are slivers.
MIN_CORNER_SINE = 0.05

#: Corner sine above which a quad moves well projectively. It is the limit the in-between methods
#: hold quads to; the search pays a price for quads beneath it.
USABLE_SINE = 0.12

#: Greatest ratio of the homography's w over a quad's corners that still moves well. Larger, and
#: most of the quad's inside is drawn from one corner.
MAX_PERSPECTIVE = 6.0


@dataclass(frozen=True, slots=True, eq=False)
class FaceFigures:
    """Figures of a stack of faces over both shapes.

    Attributes
    ----------
    sine : (...,) float64
        Least corner sine in the two shapes; positive if and only if strictly convex in both.
    perspective : (...,) float64
        Largest over smallest w of the homography from source to target at the corners; 1 for an
        affine map, infinite where the face is not convex in both.
    area : (...,) float64
        Mean area in the two shapes.
    misfit : (...,) float64
        Sum of squared distances left between the two after the best rotation and translation.
    """

    sine: Floats
    perspective: Floats
    area: Floats
    misfit: Floats

    @property
    def usable(self) -> Mask:
        """Which quads move well projectively, (...,)."""
        return np.asarray((self.sine > USABLE_SINE) & (self.perspective < MAX_PERSPECTIVE))


def face_figures(corners: Points) -> FaceFigures:
    """Measure faces of two shapes.

    Parameters
    ----------
    corners : (2, ..., K, 2) float64

    Notes
    -----
    The four corners of a quad have one affine dependency, whose coefficients are the areas of the
    triangles that leave out one corner each. A homography keeps it up to the factors w, so w at a
    corner is the ratio of these areas between the shapes; no homography need be solved for.
    """
    # Corners first and as complex numbers: twenty times fewer and longer inner loops.
    z = np.ascontiguousarray(corners).view(np.complex128)[..., 0]
    z = np.ascontiguousarray(z.transpose(-1, *range(z.ndim - 1)))
    z -= z.sum(axis=0) / len(z)
    following = np.concatenate([z[1:], z[:1]])
    leaving = following - z
    product = np.concatenate([leaving[-1:], leaving[:-1]]).conj() * leaving
    turns, size = product.imag, abs(product)
    sine = (turns / np.maximum(size, np.finfo(float).tiny)).min(axis=(0, 1))

    convex = sine > 0
    w = turns[:, 1] / np.where(convex, turns[:, 0], 1.0)
    low = np.where(convex, w.min(axis=0), 1.0)
    perspective = np.where(convex, w.max(axis=0) / low, np.inf)

    area = (z.conj() * following).imag.sum(axis=(0, 1)) / 4
    spread = (z.real**2 + z.imag**2).sum(axis=(0, 1))
    misfit = spread - 2 * abs((z[:, 0].conj() * z[:, 1]).sum(axis=0))
    return FaceFigures(sine, perspective, area, misfit)
