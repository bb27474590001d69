"""The exact affine map between two outlines, where there is one.

Brought to unit covariance, an outline and its affine image differ by a rotation only, and equal
steps of arc length along one are equal steps along the other. So the map is a cyclic shift and a
rotation, which a Fourier transform finds.
"""

import math
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Affine, Complex, Floats, Points
from shapetween.geometry.linearmaps import as_complex
from shapetween.match.moments import area_moments
from shapetween.model.arclength import ArcLength, arc_length
from shapetween.model.outline import Outline

__all__ = ["AffineMatch", "register"]

#: Samples the shift is looked for with.
SHIFT_SAMPLES = 256

#: Every how many-th of them refines a shift; a match is exact or none, so a few tell.
REFINE_STEP = 4

#: Largest distance, in root mean square radii of the inside, at which a mapped point still counts
#: as met. Larger swallows real differences; smaller refuses copies rounded to two decimals.
MET = 1e-3

#: Shifts worth refining: least cyclic correlation, where 1 is a perfect match.
PROMISING = 0.99

#: Most shifts refined. Each is a symmetry of the outline, or nearly.
MOST_SHIFTS = 32

#: Error of a step between knots, as a share of the length, at which it is halved. Smaller makes
#: knots by the thousand.
KNOT_ERROR = 5e-7

#: Knots to begin with beside the joints. Fewer look straight where both thirds happen to lie on the
#: chord; more are cut out of what is straight.
FIRST_KNOTS = 64

#: How often a step is cut in three at most: then it is no longer than the error.
KNOT_CUTS = math.ceil(math.log(1 / (FIRST_KNOTS * KNOT_ERROR), 3))

#: Residuals closer than this, in the unit of `MET`, are equal: both maps are exact but for
#: rounding, and the one that turns less is meant.
AS_GOOD = 1e-6

#: Angles closer than this are equal.
SAME_ANGLE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class AffineMatch:
    """An affine map that takes one outline onto another.

    Attributes
    ----------
    matrix : (2, 3) float64
    u, v : (K,) float64
        Knots of the matching along source and target, over one turn.
    turn : float
        Rotation in the map's polar decomposition, radians.
    residual : float
        Largest distance of a mapped point, in root mean square radii.
    """

    matrix: Affine
    u: Floats
    v: Floats
    turn: float
    residual: float


@dataclass(frozen=True, slots=True, eq=False)
class _Whitened:
    """An outline mapped to centroid 0 and covariance 1."""

    arcs: ArcLength
    own: ArcLength
    root: Floats
    centroid: Points

    def points(self, places: Floats) -> Complex:
        """Points as complex numbers."""
        return as_complex(self.arcs.point(places))

    def moving(self, places: Floats) -> tuple[Complex, Complex]:
        """Points, and how they move along the outline, as complex numbers."""
        found, headings = self.arcs.point_and_tangent(places)
        return as_complex(found), as_complex(headings) * self.arcs.length

    def original(self, places: Floats) -> Floats:
        """Places along the outline as drawn."""
        return self.own.fraction(*self.arcs.locate(places))


@dataclass(frozen=True, slots=True)
class _Fit:
    shift: float
    angle: float
    residual: float


def register(source: Outline, target: Outline, pins: Floats | None = None) -> AffineMatch | None:
    """The affine map of positive determinant from source onto target, if there is one.

    Parameters
    ----------
    source, target : Outline
        Closed, of positive area.
    pins : (K, 2) float64, optional
        Places along source and target, fractions of their lengths, that must be matched.

    Returns
    -------
    AffineMatch or None
        Of several equally exact maps (symmetric shapes) the one that turns least.
    """
    a, b = _whiten(source), _whiten(target)
    # Corners stay corners and lengths lengths, so a first glance settles most pairs.
    if abs(a.arcs.length / b.arcs.length - 1) > 0.01:
        return None
    grid = np.arange(SHIFT_SAMPLES) / SHIFT_SAMPLES
    za, zb = a.points(grid), b.points(grid)
    product = np.fft.ifft(np.conj(np.fft.fft(za)) * np.fft.fft(zb))
    norm = np.sqrt((np.abs(za) ** 2).sum() * (np.abs(zb) ** 2).sum())
    likeness = np.abs(product) / norm
    peak = (likeness >= np.roll(likeness, 1)) & (likeness >= np.roll(likeness, -1))
    shifts = np.flatnonzero(peak & (likeness > PROMISING))
    if len(shifts) == 0:
        return None
    shifts = shifts[np.argsort(-likeness[shifts], kind="stable")][:MOST_SHIFTS]
    fits = _refined(a, b, grid[shifts], None)
    # A disc fits at every shift; then the one that does not turn is meant.
    upright = _unturned(a, b)
    start = int(np.argmax((product * np.exp(-1j * upright)).real))
    fits += _refined(a, b, grid[start : start + 1], upright)
    fits = [fit for fit in fits if fit.residual <= MET and _meets(a, b, fit, pins)]
    if not fits:
        return None
    exact = min(fit.residual for fit in fits)
    fits = [fit for fit in fits if fit.residual <= 2 * exact + AS_GOOD]
    turns = np.array([_turn(a, b, fit) for fit in fits])
    least = np.abs(turns).min()
    nearest = [k for k in range(len(fits)) if abs(turns[k]) <= least + SAME_ANGLE]
    chosen = max(nearest, key=lambda k: turns[k])
    best = fits[chosen]
    matrix = _matrix(a, b, best)
    u, v = _knots(a, b, best.shift)
    return AffineMatch(matrix, u, v, turn=float(turns[chosen]), residual=best.residual)


def _whiten(outline: Outline) -> _Whitened:
    _, centroid, covariance = area_moments(outline.curves)
    values, vectors = np.linalg.eigh(covariance)
    root = vectors * np.sqrt(values) @ vectors.T
    inverse = vectors / np.sqrt(values) @ vectors.T
    # Centred first: far from the origin the offset would cost digits.
    centred = Outline(outline.curves - centroid)
    white = centred.transformed(np.column_stack([inverse, np.zeros(2)]))
    return _Whitened(arc_length(white), arc_length(outline), root, centroid)


def _refined(a: _Whitened, b: _Whitened, shifts: Floats, angle: float | None) -> list[_Fit]:
    """Gauss-Newton for every shift, the best angle with it unless one is given; all at once."""
    grid = np.arange(0, SHIFT_SAMPLES, REFINE_STEP) / SHIFT_SAMPLES
    za = a.points(grid)
    found = shifts.copy()
    left, last = np.arange(len(found)), np.full(len(found), np.inf)
    while len(left):
        zb, direction = b.moving(grid + found[left, None])
        turn = _angles(za, zb, angle)
        gap = zb - np.exp(1j * turn) * za
        if angle is None:  # what a rotation does, the shift need not do
            spin = 1j * np.exp(1j * turn) * za
            along = (direction * spin.conj()).real.sum(axis=1) / (np.abs(spin) ** 2).sum(axis=1)
            direction = direction - spin * along[:, None]
        strength = (np.abs(direction) ** 2).sum(axis=1)
        held = ~(strength < 1e-9 * len(grid) * b.arcs.length**2)
        left, last = left[held], last[held]
        step = -(gap * direction.conj()).real.sum(axis=1)[held] / strength[held]
        found[left] += step
        going = np.abs(step) < last  # it converges quadratically, down to rounding; NaN ends it too
        left, last = left[going], np.abs(step)[going]
    zb = b.points(grid + found[:, None])
    turn = _angles(za, zb, angle)
    away = np.abs(zb - np.exp(1j * turn) * za).max(axis=1)
    rows = zip(found.tolist(), turn[:, 0].tolist(), away.tolist(), strict=True)
    return [_Fit(*row) for row in rows]


def _angles(za: Complex, zb: Complex, angle: float | None) -> Floats:
    """The best angle of each row of points, (S, 1), unless one is given."""
    if angle is not None:
        return np.full((len(zb), 1), angle)
    return np.asarray(np.angle((zb * za.conj()).sum(axis=1, keepdims=True)))


def _linear(a: _Whitened, b: _Whitened, angle: float) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(b.root @ np.array([[c, -s], [s, c]]) @ np.linalg.inv(a.root))


def _matrix(a: _Whitened, b: _Whitened, fit: _Fit) -> Affine:
    linear = _linear(a, b, fit.angle)
    return np.column_stack([linear, b.centroid - linear @ a.centroid])


def _turn(a: _Whitened, b: _Whitened, fit: _Fit) -> float:
    """Rotation in the polar decomposition of the map."""
    m = _linear(a, b, fit.angle)
    return float(np.arctan2(m[1, 0] - m[0, 1], m[0, 0] + m[1, 1]))


def _unturned(a: _Whitened, b: _Whitened) -> float:
    """The whitened angle with which the map as drawn does not turn.

    With the roots' product Q P, the map's turn is the angle plus that product's own.
    """
    product = np.linalg.inv(a.root) @ b.root
    return -float(np.arctan2(product[1, 0] - product[0, 1], product[0, 0] + product[1, 1]))


def _meets(a: _Whitened, b: _Whitened, fit: _Fit, pins: Floats | None) -> bool:
    if pins is None or len(pins) == 0:
        return True
    white = a.arcs.fraction(*a.own.locate(pins[:, 0]))
    away = b.original(white + fit.shift) - pins[:, 1]
    return bool((np.abs(away - np.round(away)) <= MET).all())


def _knots(a: _Whitened, b: _Whitened, shift: float) -> tuple[Floats, Floats]:
    """Matched places as drawn, dense enough to be linear between.

    Arc length as drawn against whitened arc length bends at joints and along curves.
    """
    joints = np.concatenate([a.arcs.joints, b.arcs.joints - shift])
    white = np.union1d(joints - np.floor(joints), np.arange(FIRST_KNOTS) / FIRST_KNOTS)
    # Joints of both that are one but for rounding would make steps of no length.
    white = white[np.diff(white, append=white[0] + 1) > 1e-9]
    white = np.append(white, white[0] + 1)
    u, v = _unrolled(a, white), _unrolled(b, white + shift)
    low, high = np.arange(len(white) - 1), np.arange(1, len(white))
    for _ in range(KNOT_CUTS):
        # Two places a step: at one alone, a step that bends both ways could look straight.
        thirds = white[low] + np.array([[1 / 3], [2 / 3]]) * (white[high] - white[low])
        between = _unrolled(a, thirds.ravel(), u[0]).reshape(2, -1)
        reached = _unrolled(b, thirds.ravel() + shift, v[0]).reshape(2, -1)
        share = (between - u[low]) / (u[high] - u[low])
        away = np.abs(reached - v[low] - share * (v[high] - v[low]))
        bent = away.max(axis=0) > KNOT_ERROR
        if not bent.any():
            break
        new = len(white) + np.arange(2 * bent.sum()).reshape(2, -1)
        white = np.concatenate([white, thirds[:, bent].ravel()])
        u = np.concatenate([u, between[:, bent].ravel()])
        v = np.concatenate([v, reached[:, bent].ravel()])
        low, high = (
            np.concatenate([low[bent], new[0], new[1]]),
            np.concatenate([new[0], new[1], high[bent]]),
        )
    order = np.argsort(white)
    return u[order], v[order]


def _unrolled(whitened: _Whitened, white: Floats, start: float | None = None) -> Floats:
    """Places as drawn, increasing from the first one, or from `start`, over one turn."""
    places = whitened.original(white)
    first = places[0] if start is None else start
    rest = first + (places - first) % 1.0
    if start is None:
        rest[-1] = first + 1
    return np.asarray(rest)
