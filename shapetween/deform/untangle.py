"""Placing the free vertices of a triangulation so that no triangle is inverted.

The energy is that of [GKKDU21]_: distortion over a regularised determinant,

    sum_T w_T (|J|^2 + 1 + det^2 J) / (2 chi(det J, eps)),
    chi(d, eps) = (d + sqrt(d^2 + eps^2)) / 2,

finite for inverted triangles while eps > 0. It is lowered by Newton steps whose Hessian is made
positive triangle by triangle in closed form [SdGK19]_, one step for every eps, while eps follows
the worst determinant down.

.. [GKKDU21] V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov,
   *Foldover-free maps in 50 lines of code*, ACM TOG 40(4), 2021.
.. [SdGK19] B. Smith, F. de Goes, T. Kim, *Analytic eigensystems for isotropic distortion
   energies*, ACM TOG 38(1), 2019.
"""

from dataclasses import dataclass

import numpy as np
from numpy.linalg import LinAlgError

from shapetween.base.arrays import Complex, Floats, Index, Mask, Points
from shapetween.deform.banded import BandPattern, factorised, numbered, substituted
from shapetween.deform.jacobians import gradients, jacobians
from shapetween.geometry.linearmaps import LinearMaps, as_complex, as_points, squared

__all__ = ["Untangler"]

#: Least share by which eps falls at a step, usually and with patience. Smaller is slower and
#: untangles more of the hard meshes; larger and the steps lose the path.
EPS_DECREASE, PATIENT_DECREASE = 0.3, 0.2
#: Ratio of energies after and before a step above which eps may fall. Smaller loses the path of a
#: far start; larger waits for nothing.
SETTLED = 0.8
#: First eps, as a share of the worst determinant.
FIRST_EPS = 0.2
#: eps once no triangle is inverted, and where a hopeless search ends.
LAST_EPS = 1e-7
#: Steps without fewer inverted triangles after which the search ends, usually and with patience.
IMPATIENCE, PATIENCE = 20, 30
#: Steps that even out a mesh without inverted triangles. Fewer leave slivers, which make the motion
#: stiff where they lie; more take time.
SMOOTHING_STEPS = 6
#: Steps at most.
MAX_STEPS = 250
#: Armijo's constant, and the shortest step tried.
SUFFICIENT, SHORTEST = 1e-4, 1e-6
#: What steps are rounded to, as a share of the extent. Finer and a mesh that resists ends elsewhere
#: on another processor; coarser and it is less even than it can be.
GRAIN = 2.0**-20
#: Share of the energy that rounding may add to it. Smaller and at the bottom of a valley it decides
#: whether a step is taken or halved; larger and steps that go up count as down.
ROUNDING = 1e-12
#: Least eigenvalue of a triangle's Hessian over its largest. Zero makes the matrix singular.
EIGENVALUE_FLOOR = 1e-8


@dataclass(frozen=True, slots=True, eq=False)
class Untangler:
    """The free vertices of one triangulation, and the shapes its triangles should keep.

    Attributes
    ----------
    triangles : (T, 3) intp
    free : (U,) intp
        Vertices to place, in the order of the unknowns.
    shape_gradients : (T, 3) complex128
        Gradients on the rest shapes.
    areas : (T,) float64
        Areas of the rest shapes.
    """

    triangles: Index
    free: Index
    shape_gradients: Complex
    areas: Floats
    _weights: Floats
    _grain: float
    _single: BandPattern
    _double: BandPattern

    @classmethod
    def of(cls, rest: Points, triangles: Index, fixed: Mask) -> "Untangler":
        """Prepare for rest positions (V, 2), all triangles positive, and fixed vertices (V,)."""
        shape_gradients, areas = gradients(as_complex(rest)[triangles])
        # Small triangles matter more than their area, or they are crushed first.
        root = np.sqrt(areas)
        elements, free = numbered(triangles, fixed)
        pairs = 2 * elements[:, :, None] + np.arange(2)
        pairs = np.where(elements[:, :, None] >= 0, pairs, -1).reshape(-1, 6)
        single, double = BandPattern.of(elements, len(free)), BandPattern.of(pairs, 2 * len(free))
        weights, grain = root / root.sum(), GRAIN * float(np.ptp(rest, axis=0).max())
        return cls(triangles, free, shape_gradients, areas, weights, grain, single, double)

    def harmonic(self, points: Points) -> Points:
        """Place the free vertices harmonically on the rest shape; affine maps come out exactly.

        Parameters
        ----------
        points : (V, 2) float64
            Only the fixed vertices are read.
        """
        stiffness = (
            (self.areas[:, None] * self.shape_gradients)[:, :, None]
            * self.shape_gradients.conj()[:, None]
        ).real
        known = points.copy()
        known[self.free] = 0
        pull = stiffness @ known[self.triangles]
        right = np.stack([-self._single.vector(pull[..., axis]) for axis in (0, 1)], axis=1)
        known[self.free] = substituted(factorised(self._single.band(stiffness)), right)
        return known

    def determinants(self, points: Points) -> Floats:
        """Area of every triangle over its rest area, (T,)."""
        return self._maps(as_complex(points)).determinants

    def untangle(self, points: Points, *, patient: bool = False) -> tuple[Points, int]:
        """Lower the energy until no triangle is inverted, then even the mesh out a little.

        Parameters
        ----------
        points : (V, 2) float64
        patient : bool
            Whether to go slowly, for what resists the usual way.

        Returns
        -------
        points : (V, 2) float64
            Those with the fewest inverted triangles met, or the last without any.
        inverted : int
            How many triangles are inverted in it.
        """
        decrease = PATIENT_DECREASE if patient else EPS_DECREASE
        patience = PATIENCE if patient else IMPATIENCE
        state = self._state(as_complex(points))
        best, waited, smoothed = (len(self.triangles) + 1, state.points), 0, 0
        worst = state.determinants.min()
        eps = LAST_EPS if worst > 0 else LAST_EPS + FIRST_EPS * abs(worst)
        known, after = 0.0, 0.0
        for _ in range(MAX_STEPS):
            before, known = after if eps == known else self._energy(state, eps), eps
            moved = self._step(state, eps, before)
            if moved is None:
                break
            state, after = moved
            worst, inverted = state.determinants.min(), int((state.determinants <= 0).sum())
            if inverted == 0:
                best = (0, state.points)
                smoothed += 1
                eps = LAST_EPS
                if smoothed > SMOOTHING_STEPS:
                    break
                continue
            waited = 0 if inverted < best[0] else waited + 1
            best = min(best, (inverted, state.points), key=lambda pair: pair[0])
            if after > SETTLED * before:
                eps = min(eps, _next_eps(eps, worst, decrease))
            if waited >= patience or eps < LAST_EPS:
                break
        return as_points(best[1]), best[0]

    def _maps(self, points: Complex) -> LinearMaps:
        return jacobians(self.shape_gradients, points[self.triangles])

    def _state(self, points: Complex) -> "_State":
        maps = self._maps(points)
        turning, stretching = squared(maps.a), squared(maps.b)
        return _State(points, maps, turning - stretching, 2 * (turning + stretching))

    def _energy(self, state: "_State", eps: float) -> float:
        det = state.determinants
        return float(self._weights @ ((state.squares + 1 + det**2) / (2 * _chi(det, eps)[0])))

    def _step(self, state: "_State", eps: float, before: float) -> "tuple[_State, float] | None":
        """One Newton step with a line search: new state and energy, or None if none is lower."""
        forces, blocks = _newton(state, eps, self.shape_gradients)
        slope = self._double.vector(self._weights[:, None] * forces)
        band = self._double.band(self._weights[:, None, None] * blocks)
        if not np.isfinite(slope).all():
            return None
        try:
            step = -substituted(factorised(band), slope[:, None])[:, 0]
        except LinAlgError:
            return None
        descent = float(step @ slope)
        # What rounding did to the step would grow from each to the next where a mesh resists.
        move = np.zeros_like(state.points)
        move[self.free] = self._grain * np.round(step / self._grain).view(np.complex128)
        length = 1.0
        while length > SHORTEST:
            trial = self._state(state.points + length * move)
            energy = self._energy(trial, eps)
            if energy <= before * (1 + ROUNDING) + SUFFICIENT * length * descent:
                return trial, energy
            length /= 2
        return None


@dataclass(frozen=True, slots=True, eq=False)
class _State:
    """Vertices (V,), and of every triangle its map, determinant and squared norm, (T,)."""

    points: Complex
    maps: LinearMaps
    determinants: Floats
    squares: Floats


def _chi(det: Floats, eps: float) -> tuple[Floats, Floats]:
    """Regularised determinant and its root term, without cancellation."""
    root = np.sqrt(det**2 + eps**2)
    larger = (np.abs(det) + root) / 2
    return np.where(det >= 0, larger, eps**2 / (4 * larger)), root


def _next_eps(eps: float, worst: float, decrease: float) -> float:
    """The rule of [GKKDU21]_, section 3: eps such that chi stays above a shrinking bound."""
    bound = (1 - decrease) * float(_chi(np.array(worst), eps)[0])
    return 2 * float(np.sqrt(bound * (bound - worst))) if worst < bound else LAST_EPS


def _newton(state: _State, eps: float, shape_gradients: Complex) -> tuple[Floats, Floats]:
    """Gradients (T, 6) and positive Hessians (T, 6, 6) of each triangle's energy by its corners.

    With n = |J|^2 and d = det J the energy is f(n, d). In p = |a| and q = |b| of the map
    ``a z + b conj(z)`` both are simple, n = 2 (p^2 + q^2) and d = p^2 - q^2, so the Hessian by a
    and b has a 2 x 2 block for p and q and two single eigenvalues, for the phases of a, the twist,
    and of b, the flip ([SdGK19]_, section 4); negative ones are raised to almost zero.
    """
    det = state.determinants
    chi, root = _chi(det, eps)
    first, second = chi / root, eps**2 / (2 * root**3)
    half = (state.squares + 1 + det**2) / 2
    f_n, f_nd = 0.5 / chi, -0.5 * first / chi**2
    f_d = det / chi - half * first / chi**2
    f_dd = 1 / chi - (2 * det * first + half * second) / chi**2 + 2 * half * first**2 / chi**3

    a, b, conjugate = state.maps.a[:, None], state.maps.b[:, None], shape_gradients.conj()
    twist, flip = 4 * f_n + 2 * f_d, 4 * f_n - 2 * f_d
    forces = (twist[:, None] * a * shape_gradients + flip[:, None] * b * conjugate) / 2

    p, q = np.abs(a), np.abs(b)
    pp, qq = p[:, 0] ** 2, q[:, 0] ** 2
    h_pp, h_qq = twist + pp * (16 * f_nd + 4 * f_dd), flip + qq * (4 * f_dd - 16 * f_nd)
    h_pq = -4 * np.sqrt(pp * qq) * f_dd
    middle, spread = (h_pp + h_qq) / 2, np.hypot((h_pp - h_qq) / 2, h_pq)
    values = np.stack([middle + spread, middle - spread, twist, flip])
    high, low, twist, flip = np.maximum(values, EIGENVALUE_FLOOR * np.abs(values).max(axis=0))
    # Of the block, what its eigenvalues have in common and what sets them apart.
    apart = (high - low) / (2 * np.where(spread > 0, spread, 1.0))
    middle, tilt, h_pq = (high + low) / 2, apart * (h_pp - h_qq) / 2, apart * h_pq

    along_a = shape_gradients * (a / np.where(p > 0, p, 1.0) + (p == 0)) / 2
    along_b = conjugate * (b / np.where(q > 0, q, 1.0) + (q == 0)) / 2
    rows = np.stack([along_a, along_b, 1j * along_a, 1j * along_b], axis=1)
    by_p = (middle + tilt)[:, None] * along_a + h_pq[:, None] * along_b
    by_q = (middle - tilt)[:, None] * along_b + h_pq[:, None] * along_a
    weighted = np.stack([by_p, by_q, twist[:, None] * rows[:, 2], flip[:, None] * rows[:, 3]], 1)
    blocks = np.swapaxes(rows.view(np.float64), 1, 2) @ weighted.view(np.float64)
    return forces.view(np.float64), blocks
