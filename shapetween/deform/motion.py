"""The motion of an ambient mesh: every triangle turns and stretches as evenly as the others let it.

For every triangle there is a wanted Jacobian J_t, the identity at 0 and J at 1. The vertices x at
t are those of least

    sum_T w [ (1 - t) a |J_A(x) - R J_t|^2 + t b |J_B(x) - R J_t J^-1|^2 ]
      + lambda sum_edges |x_j - x_i - l u|^2,

where J_A and J_B are the Jacobians of x on the triangle's source and target, a and b their areas,
R a rotation of each triangle's own, l the wanted length of an outline's edge and u its direction.
R and u are found in turns with x, as in [SA07]_, and J_t of the inside is scaled as a whole so
that the area of the shape keeps to its path. Inside triangles have weight 1 and outside ones
less: the outside keeps parts from passing through each other. At the ends all
terms are zero at once, so they are met exactly; backwards in time the energy is the same.

.. [SA07] O. Sorkine, M. Alexa, *As-rigid-as-possible surface modeling*, SGP 2007.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Complex, Floats, Index, Points, row_sums, times
from shapetween.deform.banded import BandSystem
from shapetween.deform.jacobians import gradients, jacobians, polar_path, spread_angles
from shapetween.deform.layout import ring_edges
from shapetween.deform.mesh import AmbientMesh
from shapetween.deform.triangulate import triangle_edges
from shapetween.geometry.linearmaps import LinearMaps, as_complex, squared

__all__ = ["AmbientMotion", "InsideTarget", "Stiffness"]

InsideTarget: TypeAlias = Callable[[Floats, LinearMaps], LinearMaps]
"""Wanted Jacobians of the inside triangles at times (F,), given what they would do by themselves;
both of shape (F, T_inside), from pose to pose."""

#: Weight of the linear blend that carries triangles which are inverted at an end. It only has to
#: keep the system regular.
BLEND_WEIGHT = 1e-3
#: Rounds of finding rotations and vertices in turns. More come nearer to the least energy; fewer
#: keep more of the wanted rotations.
ROUNDS = 4
#: How strongly a triangle holds to the rotation first wanted, against the one that fits. None, and
#: triangles that shrink to nothing spin; much, and limbs are kept short.
PRIOR = 0.5
#: The same for the directions of edges.
EDGE_PRIOR = 0.5
#: Least area, as a share of the wanted one, that the correction of the area believes.
LEAST_AREA = 0.25
#: Laplacian of a triangle's edges, all of weight 1.
_UNIFORM = 3.0 * np.eye(3) - 1.0
#: Stands in for triangles whose own shape cannot be used.
_ANY_TRIANGLE = np.array([0.0, 1.0, 1j])


@dataclass(frozen=True, slots=True)
class Stiffness:
    """What resists in a motion.

    Attributes
    ----------
    outside : float
        Weight of the outside triangles. Larger keeps parts further apart and turns them less.
    length : float
        Weight of the lengths of the outlines' edges. Larger keeps limbs longer and areas less.
    """

    outside: float = 0.5
    length: float = 9.5


@dataclass(frozen=True, slots=True, eq=False)
class AmbientMotion:
    """A mesh prepared to move; `vertices` asks it for times.

    Attributes
    ----------
    mesh : AmbientMesh
    target : InsideTarget or None
        What the inside triangles should do; by default they turn and stretch evenly.
    """

    mesh: AmbientMesh
    target: InsideTarget | None
    _ends: tuple[Complex, Complex]
    _jacobians: LinearMaps
    _angles: Floats
    _pulls: tuple[Complex, Complex]
    _edges: "_Edges"
    _system: BandSystem
    _weights: tuple[Floats, Floats]

    @classmethod
    def prepare(
        cls,
        mesh: AmbientMesh,
        stiffness: Stiffness | None = None,
        target: InsideTarget | None = None,
    ) -> "AmbientMotion":
        """Compute all that does not depend on time."""
        stiffness = stiffness or Stiffness()
        ends = (
            as_complex(mesh.poses[0].normalise(mesh.source)),
            as_complex(mesh.poses[1].normalise(mesh.target)),
        )
        corners = [points[mesh.triangles] for points in ends]
        for half in corners:
            half[mesh.inverted] = _ANY_TRIANGLE
        (shapes_a, areas_a), (shapes_b, areas_b) = gradients(corners[0]), gradients(corners[1])
        whole, body = jacobians(shapes_a, corners[1]), LinearMaps.of(mesh.body.matrix)
        whole = LinearMaps(
            np.where(mesh.inverted, body.a, whole.a), np.where(mesh.inverted, body.b, whole.b)
        )
        angles = mesh.body.angle + spread_angles(
            whole.turned(np.exp(-1j * np.asarray(mesh.body.angle))).angles,
            mesh.triangles,
            areas_a + areas_b,
            mesh.inside,
            ~mesh.inverted,
        )
        # A large triangle far outside counts no more than a usual one inside, or the emptiness
        # about a thin shape would hold it.
        sizes = np.sqrt(areas_a * areas_b)
        usual = sizes[mesh.inside].mean()
        outer = stiffness.outside * np.minimum(1, usual / sizes)
        weights = np.where(mesh.inside, 1.0, outer) * ~mesh.inverted
        weights_a, weights_b = weights * areas_a, weights * areas_b
        pull_a, pull_b = weights_a[:, None] * shapes_a, weights_b[:, None] * shapes_b
        blend = BLEND_WEIGHT * mesh.inverted[:, None, None] * _UNIFORM
        edges = _Edges.of(mesh, ends, angles, stiffness.length)
        fixed = np.zeros(len(mesh.source), dtype=bool)
        fixed[mesh.frame] = True
        system = BandSystem.of(
            np.concatenate([mesh.triangles, edges.elements]),
            fixed,
            np.concatenate([_products(pull_a, shapes_a) + blend, edges.blocks]),
            np.concatenate([_products(pull_b, shapes_b) + blend, edges.blocks]),
        )
        pulls = pull_a, whole.inverse()[:, None](pull_b)
        return cls(mesh, target, ends, whole, angles, pulls, edges, system, (weights_a, weights_b))

    def vertices(self, t: ArrayLike) -> Points:
        """Vertices at the times (F,), in user units, (F, V, 2); the mesh's own at 0 and 1."""
        at = times(t)
        return self.mesh.placed(self.posed(at), at)

    def posed(self, t: Floats) -> Complex:
        """Vertices at the times (F,), from pose to pose, (F, V)."""
        mesh, time, body = self.mesh, t[:, None], self.mesh.body.at(t)
        source, target = self._ends
        linear = (1 - time) * source + time * target
        at = linear.copy()
        at[:, mesh.frame] = body[:, None](source[mesh.frame])
        solve = self._system.solver(t, at)
        wanted = self._wanted(t)
        pulls = time[..., None] * (self._pulls[1] - self._pulls[0]) + self._pulls[0]
        # What a triangle adds to the right side if its rotation stays as wanted; any other one
        # turns this, and the sum over its corners of x times the conjugate tells which fits.
        forces = wanted[..., None](pulls)
        against = forces.conj()
        blend = (BLEND_WEIGHT * linear[:, mesh.triangles[mesh.inverted]]) @ _UNIFORM
        prior = PRIOR * self._norms(wanted, t)
        lengths, areas = self._edges.lengths(body, t), self._areas(body, t)
        wanted_edges = lengths * _unit(self._edges.directions(wanted, t))
        turns = np.ones_like(forces[..., 0])
        grown, edges = np.ones(len(t)), wanted_edges
        for step in range(1 + ROUNDS):
            if step:
                fitting = row_sums(at[:, mesh.triangles] * against)
                area = np.maximum(self._edges.area(at), LEAST_AREA * areas)
                grown = grown * np.sqrt(areas / area)
                turns = _unit(fitting + prior) * np.where(mesh.inside, grown[:, None], 1)
                edges = lengths * _unit(self._edges.between(at) + EDGE_PRIOR * wanted_edges)
            parts = turns[..., None] * forces
            parts[:, mesh.inverted] = blend
            at = solve(np.concatenate([parts, self._edges.parts(edges)], axis=1))
        return at

    def _norms(self, wanted: LinearMaps, t: Floats) -> Floats:
        """What the energy of each triangle would be if nothing moved, (F, T)."""
        at_target = wanted.after(self._jacobians.inverse()).squares
        time = t[:, None]
        from_source, from_target = self._weights
        return (1 - time) * from_source * wanted.squares + time * from_target * at_target

    def _areas(self, body: LinearMaps, t: Floats) -> Floats:
        """Wanted area of all outlines, (F,): its root goes straight, but for the body's motion."""
        ratio = 1 / np.linalg.det(self.mesh.body.matrix)
        return np.asarray(body.determinants * ((1 - t) + t * np.sqrt(ratio)) ** 2)

    def _wanted(self, t: Floats) -> LinearMaps:
        """Wanted Jacobians of all triangles, from pose to pose, (F, T)."""
        wanted = polar_path(self._jacobians, self._angles, t)
        if self.target is not None:
            inside = self.mesh.inside
            by_quads = self.target(t, wanted[:, inside])
            wanted.a[:, inside], wanted.b[:, inside] = by_quads.a, by_quads.b
        return wanted


@dataclass(frozen=True, slots=True, eq=False)
class _Edges:
    """Edges of the outlines as elements that hold their length.

    Attributes
    ----------
    elements : (N, 3) intp
        The two ends, and -1.
    blocks : (N, 3, 3) float64
    start, end : (N,) complex128
        The edges as vectors in both poses.
    beside : (N,) intp
        The inside triangle beside each.
    angles : (N,) float64
        Where that triangle is inverted, the angle each edge turns by; else not a number.
    body : () linear map
        Where the motion of the whole ends.
    """

    elements: Index
    blocks: Floats
    start: Complex
    end: Complex
    beside: Index
    angles: Floats
    body: LinearMaps

    @classmethod
    def of(
        cls, mesh: AmbientMesh, ends: tuple[Complex, Complex], angles: Floats, weight: float
    ) -> "_Edges":
        """Edges of a mesh's rings, all of one weight, given the triangles' angles (T,)."""
        edges = ring_edges(mesh.rings)
        known, sides = triangle_edges(mesh.triangles)
        code = known @ [len(mesh.source), 1]
        sides = sides[np.searchsorted(code, np.sort(edges, axis=1) @ [len(mesh.source), 1])]
        beside = np.where(mesh.inside[sides[:, 0]], sides[:, 0], sides[:, 1])
        start, end = (points[edges[:, 1]] - points[edges[:, 0]] for points in ends)
        place = np.arange(len(edges), dtype=np.float64)
        valid = ~mesh.inverted[beside]
        near = angles[beside]
        if valid.any():
            near = np.interp(place, place[valid], near[valid], period=len(edges))
        block = weight * np.array([[1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
        return cls(
            np.pad(edges, ((0, 0), (0, 1)), constant_values=-1),
            np.broadcast_to(block, (len(edges), 3, 3)),
            start,
            end,
            beside,
            np.where(mesh.inverted[beside], _edge_angles(start, end, near), np.nan),
            LinearMaps.of(mesh.body.matrix),
        )

    def between(self, points: Complex) -> Complex:
        """The edges between moving points (F, V), (F, N)."""
        return points[:, self.elements[:, 1]] - points[:, self.elements[:, 0]]

    def area(self, points: Complex) -> Floats:
        """Area within all outlines, holes left out, (F,) for points (F, V)."""
        first, second = points[:, self.elements[:, 0]], points[:, self.elements[:, 1]]
        return np.asarray((first.conj() * second).imag.sum(axis=1) / 2)

    def directions(self, wanted: LinearMaps, t: Floats) -> Complex:
        """The edges as the wanted Jacobians (F, T) beside them turn them, (F, N)."""
        by_angle = np.exp(1j * t[:, None] * np.nan_to_num(self.angles)) * self.start
        return np.where(np.isnan(self.angles), wanted[:, self.beside](self.start), by_angle)

    def lengths(self, whole: LinearMaps, t: Floats) -> Floats:
        """Wanted lengths (F, N): straight between the ends, but for the motion of the whole.

        Source and target edge each go the way of the whole, (F,), and the two lengths are
        blended, so that affine images keep to it.
        """
        forth = np.abs(whole[:, None](self.start))
        back = np.abs(whole[:, None](self.body.inverse()(self.end)))
        return np.asarray((1 - t)[:, None] * forth + t[:, None] * back)

    def parts(self, wanted: Complex) -> Complex:
        """What wanted edges (F, N) add to the right side, (F, N, 3)."""
        pull = self.blocks[:, 0, 0] * wanted
        return np.stack([-pull, pull, np.zeros_like(pull)], axis=2)


def _products(left: Complex, right: Complex) -> Floats:
    """Products of the corners' vectors, (T, 3, 3) of (T, 3) and (T, 3)."""
    return np.asarray((left[:, :, None] * right.conj()[:, None]).real)


def _unit(numbers: Complex) -> Complex:
    """Numbers of absolute value 1, or 0, with the same direction."""
    size = np.sqrt(squared(numbers))
    return np.asarray(numbers / np.where(size > 0, size, 1))


def _edge_angles(start: Complex, end: Complex, near: Floats) -> Floats:
    """Angles by which edges turn, nearest to given ones, (N,)."""
    angles = np.angle(end * start.conj())
    return np.asarray(angles + 2 * np.pi * np.round((near - angles) / (2 * np.pi)))
