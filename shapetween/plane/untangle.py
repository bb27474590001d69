"""Placing the free vertices of a triangulation so that no triangle is turned over.

The energy is that of [GKKDU21]_: distortion over a regularised determinant,

    sum_T w_T (|J|^2 + 1 + det^2 J) / (2 chi(det J, eps)),
    chi(d, eps) = (d + sqrt(d^2 + eps^2)) / 2,

finite for turned triangles while eps > 0. It is lowered by Newton steps whose Hessian is made
positive triangle by triangle in closed form [SdGK19]_, one step for every eps, while eps follows
the worst determinant down.

.. [GKKDU21] V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov,
   *Foldover-free maps in 50 lines of code*, ACM TOG 40(4), 2021.
.. [SdGK19] B. Smith, F. de Goes, T. Kim, *Analytic eigensystems for isotropic distortion
   energies*, ACM TOG 38(1), 2019.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, solveh_banded

from shapetween.arrays import Floats, Index, Mask, Points
from shapetween.geometry.rotation import rotations
from shapetween.plane.banded import BandPattern, numbered
from shapetween.plane.jacobians import gradients, jacobians

__all__ = ["Untangler"]

#: Least share by which eps falls at a step, usually and with patience. Smaller is slower and
#: untangles more of the hard meshes; larger and the steps lose the path.
EPS_DECREASE, PATIENT_DECREASE = 0.5, 0.1
#: Ratio of energies after and before a step above which eps may fall. Smaller loses the path of a
#: far start; larger waits for nothing.
SETTLED = 0.8
#: First eps, as a share of the worst determinant.
FIRST_EPS = 0.2
#: eps once no triangle is turned over, and where a hopeless search ends.
LAST_EPS = 1e-7
#: Steps without fewer turned triangles after which the search ends, usually and with patience.
IMPATIENCE, PATIENCE = 12, 60
#: Steps that even out a mesh without turned triangles. Fewer leave slivers, which make the motion
#: stiff where they lie; more take time.
SMOOTHING_STEPS = 6
#: Steps at most.
MAX_STEPS = 250
#: Armijo's constant, and the shortest step tried.
SUFFICIENT, SHORTEST = 1e-4, 1e-6
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
    hats : (T, 3, 2) float64
        Gradients on the rest shapes.
    areas : (T,) float64
        Areas of the rest shapes.
    """

    triangles: Index
    free: Index
    hats: Floats
    areas: Floats
    _single: BandPattern
    _double: BandPattern

    @classmethod
    def of(cls, rest: Points, triangles: Index, fixed: Mask) -> "Untangler":
        """Prepare for rest positions (V, 2), all triangles positive, and fixed vertices (V,)."""
        hats, areas = gradients(rest[triangles])
        elements, free = numbered(triangles, fixed)
        pairs = 2 * elements[:, :, None] + np.arange(2)
        pairs = np.where(elements[:, :, None] >= 0, pairs, -1).reshape(-1, 6)
        single, double = BandPattern.of(elements, len(free)), BandPattern.of(pairs, 2 * len(free))
        return cls(triangles, free, hats, areas, single, double)

    def harmonic(self, points: Points) -> Points:
        """Place the free vertices harmonically on the rest shape; affine maps come out exactly.

        Parameters
        ----------
        points : (V, 2) float64
            Only the fixed vertices are read.
        """
        stiffness = (self.areas[:, None, None] * self.hats) @ np.swapaxes(self.hats, 1, 2)
        known = points.copy()
        known[self.free] = 0
        pull = stiffness @ known[self.triangles]
        right = np.stack([-self._single.vector(pull[..., axis]) for axis in (0, 1)], axis=1)
        known[self.free] = solveh_banded(self._single.band(stiffness), right, lower=True)
        return known

    def determinants(self, points: Points) -> Floats:
        """Area of every triangle over its rest area, (T,)."""
        return np.asarray(np.linalg.det(jacobians(self.hats, points[self.triangles])))

    def untangle(self, points: Points, *, patient: bool = False) -> tuple[Points, int]:
        """Lower the energy until no triangle is turned over, then even the mesh out a little.

        Parameters
        ----------
        points : (V, 2) float64
        patient : bool
            Whether to go slowly, for what resists the usual way.

        Returns
        -------
        points : (V, 2) float64
            Those with the fewest turned triangles met, or the last without any.
        turned : int
            How many triangles are turned over in it.
        """
        decrease = PATIENT_DECREASE if patient else EPS_DECREASE
        patience = PATIENCE if patient else IMPATIENCE
        best, waited, smoothed = (len(self.triangles) + 1, points), 0, 0
        worst = self.determinants(points).min()
        eps = LAST_EPS if worst > 0 else LAST_EPS + FIRST_EPS * abs(worst)
        for _ in range(MAX_STEPS):
            before = self._energy(points, eps)
            moved = self._step(points, eps, before)
            if moved is None:
                break
            points, after = moved
            determinants = self.determinants(points)
            worst, turned = determinants.min(), int((determinants <= 0).sum())
            if turned == 0:
                best = (0, points)
                smoothed += 1
                eps = LAST_EPS
                if smoothed > SMOOTHING_STEPS:
                    break
                continue
            waited = 0 if turned < best[0] else waited + 1
            best = min(best, (turned, points), key=lambda pair: pair[0])
            if after > SETTLED * before:
                eps = min(eps, _next_eps(eps, worst, decrease))
            if waited >= patience or eps < LAST_EPS:
                break
        return best[1], best[0]

    @property
    def _weights(self) -> Floats:
        """Small triangles matter more than their area, or they are crushed first."""
        root = np.sqrt(self.areas)
        return np.asarray(root / root.sum())

    def _energy(self, points: Points, eps: float) -> float:
        j = jacobians(self.hats, points[self.triangles])
        det = j[:, 0, 0] * j[:, 1, 1] - j[:, 0, 1] * j[:, 1, 0]
        chi = _chi(det, eps)[0]
        return float((self._weights * ((j**2).sum((1, 2)) + 1 + det**2) / (2 * chi)).sum())

    def _step(self, points: Points, eps: float, before: float) -> tuple[Points, float] | None:
        """One Newton step with a line search: new points and energy, or None if none is lower."""
        forces, blocks = _newton(jacobians(self.hats, points[self.triangles]), eps, self.hats)
        weights = self._weights
        slope = self._double.vector(weights[:, None] * forces)
        band = self._double.band(weights[:, None, None] * blocks)
        try:
            step = -solveh_banded(band, slope, lower=True, overwrite_ab=True)
        except (LinAlgError, ValueError):
            return None
        descent = float(step @ slope)
        length = 1.0
        while length > SHORTEST:
            trial = points.copy()
            trial[self.free] += length * step.reshape(-1, 2)
            energy = self._energy(trial, eps)
            if energy <= before + SUFFICIENT * length * descent:
                return trial, energy
            length /= 2
        return None


def _chi(det: Floats, eps: float) -> tuple[Floats, Floats]:
    """Regularised determinant and its root term, without cancellation."""
    root = np.sqrt(det**2 + eps**2)
    larger = (np.abs(det) + root) / 2
    return np.where(det >= 0, larger, eps**2 / (4 * larger)), root


def _next_eps(eps: float, worst: float, decrease: float) -> float:
    """The rule of [GKKDU21]_, section 3: eps such that chi stays above a shrinking bound."""
    bound = (1 - decrease) * float(_chi(np.array(worst), eps)[0])
    return 2 * float(np.sqrt(bound * (bound - worst))) if worst < bound else LAST_EPS


def _newton(j: Floats, eps: float, hats: Floats) -> tuple[Floats, Floats]:
    """Gradients (T, 6) and positive Hessians (T, 6, 6) of each triangle's energy by its corners.

    With n = |J|^2 and d = det J the energy is f(n, d). In the frames of the singular vectors its
    Hessian has a 2 x 2 block for scalings and two single eigenvalues, for the twist and the flip
    ([SdGK19]_, section 4); negative ones are raised to almost zero.
    """
    a, b, c, d = j[:, 0, 0], j[:, 0, 1], j[:, 1, 0], j[:, 1, 1]
    det = a * d - b * c
    chi, root = _chi(det, eps)
    first, second = chi / root, eps**2 / (2 * root**3)
    half = ((j**2).sum((1, 2)) + 1 + det**2) / 2
    f_n, f_nd = 0.5 / chi, -0.5 * first / chi**2
    f_d = det / chi - half * first / chi**2
    f_dd = 1 / chi - (2 * det * first + half * second) / chi**2 + 2 * half * first**2 / chi**3

    cofactor = np.stack([np.stack([d, -c], axis=-1), np.stack([-b, a], axis=-1)], axis=-2)
    stress = 2 * f_n[:, None, None] * j + f_d[:, None, None] * cofactor
    forces = (hats @ np.swapaxes(stress, 1, 2)).reshape(-1, 6)

    # J = R(left) diag(s1, s2) R(right), s2 negative where the triangle is turned over.
    sum_angle, difference = np.arctan2(c - b, a + d), np.arctan2(c + b, a - d)
    s1 = (np.hypot(a + d, c - b) + np.hypot(a - d, c + b)) / 2
    s2 = (np.hypot(a + d, c - b) - np.hypot(a - d, c + b)) / 2
    h11 = 2 * f_n + f_dd * s2**2 + 4 * f_nd * det
    h22 = 2 * f_n + f_dd * s1**2 + 4 * f_nd * det
    h12 = f_d + f_dd * det + 2 * f_nd * (s1**2 + s2**2)
    mean, spread = (h11 + h22) / 2, np.hypot((h11 - h22) / 2, h12)
    values = np.stack([mean + spread, mean - spread, 2 * f_n + f_d, 2 * f_n - f_d], axis=1)
    values = np.maximum(values, EIGENVALUE_FLOOR * np.abs(values).max(axis=1, keepdims=True))

    angle = np.arctan2(2 * h12, h11 - h22) / 2
    cos, sin, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(a), np.full_like(a, 0.5**0.5)
    modes = np.stack(
        [cos, zero, zero, sin, -sin, zero, zero, cos, zero, -one, one, zero, zero, one, one, zero],
        axis=1,
    ).reshape(-1, 4, 2, 2)
    left, right = rotations((difference + sum_angle) / 2), rotations((sum_angle - difference) / 2)
    modes = left[:, None] @ modes @ right[:, None]
    rows = (hats[:, None] @ np.swapaxes(modes, 2, 3)).reshape(-1, 4, 6)
    return forces, np.swapaxes(rows, 1, 2) @ (values[..., None] * rows)
