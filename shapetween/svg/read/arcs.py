"""Elliptical arcs as cubic Bezier curves.

Arcs become cubics before any transform is applied: the image of an arc under a skew is an arc of
another ellipse, the image of a cubic is the cubic of the images.

.. [SVG2] *Scalable Vector Graphics 2*, appendix B.2: elliptical arc implementation notes.
"""

from cmath import phase
from dataclasses import dataclass
from math import ceil, cos, inf, pi, radians, sin, sqrt, tan

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Curves

__all__ = ["ARC_HANDLE", "Arc", "arc_curves"]

#: Handle length of a quarter circle of radius 1, that touches the circle at its ends and middle.
ARC_HANDLE = 4 / 3 * (sqrt(2) - 1)

#: What an arc may exceed a quarter turn by before it is cut once more: rounding of a quarter.
QUARTER_SLACK = 1e-9


@dataclass(frozen=True, slots=True)
class Arc:
    """An arc between two points, which differ, on an ellipse whose radii are not zero."""

    start: complex
    end: complex
    radius: complex
    rotation: float
    large_arc: bool
    sweep: bool


def arc_curves(arc: Arc) -> Curves:
    """The arc as one cubic for each quarter turn begun, (N, 4, 2).

    Off the ellipse by at most 0.03 % of its radius.

    Notes
    -----
    From end points to centre as in [SVG2]_, section B.2.4; the angles by ``cmath.phase``, which
    loses nothing for short arcs of large ellipses.
    """
    start, end = complex(arc.start), complex(arc.end)
    turn = radians(arc.rotation % 360)
    axis = complex(cos(turn), sin(turn))
    radius_x, radius_y = abs(arc.radius.real), abs(arc.radius.imag)

    half = (start - end) / 2 * axis.conjugate()
    u = complex(half.real / radius_x, half.imag / radius_y)  # start, on the unit circle's scale
    size = abs(u)
    if not 0 < size < inf:
        line = (2 * start + end) / 3, (start + 2 * end) / 3
        return _points(np.array([[start, *line, end]]))
    if size >= 1:  # no such ellipse: the least that reaches
        radius_x, radius_y = radius_x * size, radius_y * size
        u, away = u / size, 0.0
    else:
        away = sqrt(1 - size * size) / size
    side = -1 if arc.large_arc == arc.sweep else 1
    centre = u * complex(0, -away) * side
    first, last = phase(u - centre), phase(-u - centre)
    sweep = (last - first) % (2 * pi) if arc.sweep else -((first - last) % (2 * pi))

    count = max(1, ceil(abs(sweep) / (pi / 2) - QUARTER_SLACK))
    circle = np.exp(1j * (first + sweep * np.arange(count + 1) / count))
    handle = 4 / 3 * tan(sweep / count / 4) * 1j * circle
    unit = np.stack(
        [circle[:-1], circle[:-1] + handle[:-1], circle[1:] - handle[1:], circle[1:]], axis=1
    )
    local = unit + centre
    drawn = (local.real * radius_x + 1j * local.imag * radius_y) * axis + (start + end) / 2
    drawn[0, 0], drawn[-1, 3] = start, end
    drawn[1:, 0] = drawn[:-1, 3]
    return _points(drawn)


def _points(curves: NDArray[np.complex128]) -> Curves:
    return np.stack([curves.real, curves.imag], axis=-1)
