"""Area, centroid and second moments of what a ring of cubics encloses, exactly."""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import derivatives, evaluate

__all__ = ["area_moments"]

#: Six nodes integrate polynomials of degree 11 exactly: x^3 dy of a cubic has that degree.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)


def area_moments(curves: Curves) -> tuple[float, Points, Floats]:
    """Area, centroid and covariance of the area inside a closed ring.

    Parameters
    ----------
    curves : (N, 4, 2) float64

    Returns
    -------
    area : float
        Signed, positive when the ring runs clockwise as drawn.
    centroid : (2,) float64
    covariance : (2, 2) float64
        Mean square offsets from the centroid over the area.

    Notes
    -----
    Green's theorem: the integral of x^p y^q over the area is that of x^(p+1) y^q / (p+1) dy along
    the ring.
    """
    origin = curves[0, 0]
    local = curves - origin
    t = (NODES + 1) / 2
    x, y = np.moveaxis(evaluate(local, t), -1, 0)
    dy = derivatives(local, t)[..., 1] * WEIGHTS / 2
    area = float((x * dy).sum())
    mean = np.array([(x * x / 2 * dy).sum(), (x * y * dy).sum()]) / area
    xx, xy, yy = (x * x * x / 3 * dy).sum(), (x * x * y / 2 * dy).sum(), (x * y * y * dy).sum()
    second = np.array([[xx, xy], [xy, yy]]) / area
    return area, mean + origin, second - np.outer(mean, mean)
