"""What the parts of a mesh cost, in quads about; the mesh that costs least is taken.

Quads cost little where they are few, valid and alike in both shapes. What no quad that moves well
covers costs its share of the area.
"""

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.mesh.contour import rounded
from shapetween.mesh.quality import MIN_CORNER_SINE, FaceFigures

__all__ = ["QUAD_PRICE", "quad_prices", "side_prices", "triangle_prices"]

#: Price of a quad. Larger, and limbs are left to the sides; smaller, and shapes fall to slivers.
QUAD_PRICE = 0.5

#: Price of the whole area where no quad that moves well covers it. Larger, and there are more
#: quads and, where shapes are unlike, triangles; smaller, and parts are left to the sides.
UNCOVERED_PRICE = 180.0

#: Price of a quad that does not move well, besides its area.
UNUSABLE_PRICE = 1.5

#: Price of a triangle, besides its area.
TRIANGLE_PRICE = 1.5

#: Corner sine above which a quad costs nothing for its corners, and the price at sine 0.
ROUND_SINE, SHARP_PRICE = 0.6, 3.0

#: Price of log w_max / w_min squared: at a ratio of 4 it is one quad.
PERSPECTIVE_PRICE = 0.25

#: Price of what is left between the two shapes of a quad after the best rotation.
MISFIT_PRICE = 1.0

#: Price of a face that is not convex in both shapes and has to be cut anew, besides its area; and
#: of how far it is from convex, in sines.
BROKEN_PRICE, BENT_PRICE = 30.0, 4.0


def quad_prices(figures: FaceFigures, quad_price: float = QUAD_PRICE) -> Floats:
    """Price of every quad, whatever its links cost."""
    sharp = np.clip(1 - figures.sine / ROUND_SINE, 0, 1)
    perspective = np.log(np.minimum(figures.perspective, 100.0)) ** 2
    return rounded(
        quad_price
        + SHARP_PRICE * sharp**2
        + PERSPECTIVE_PRICE * np.minimum(perspective, 8.0)
        + MISFIT_PRICE * figures.misfit
        + ~figures.usable * (UNUSABLE_PRICE + UNCOVERED_PRICE * abs(figures.area))
        + _broken_prices(figures)
    )


def triangle_prices(figures: FaceFigures) -> Floats:
    """Price of every triangle, whatever its links cost."""
    return rounded(TRIANGLE_PRICE + UNCOVERED_PRICE * abs(figures.area) + _broken_prices(figures))


def _broken_prices(figures: FaceFigures) -> Floats:
    bend = MIN_CORNER_SINE - figures.sine
    return np.where(bend > 0, BROKEN_PRICE + BENT_PRICE * bend, 0.0)


def side_prices(waste: Floats) -> Floats:
    """Price of sides that waste so much of each shape, (2, ...) to (...)."""
    return rounded(UNCOVERED_PRICE * ((waste[0] + waste[1]) / 2))
