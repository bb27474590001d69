"""Moving an outline's nodes so that nothing folds: an ambient mesh moves along, and is checked.

The quads give target Jacobians to the inside of a mesh of the whole plane, whose outside keeps
parts from passing through each other. The drawn curves are checked all along the movement; where
they cross, the mesh is made stiffer, then the nodes denser, one setting for the whole movement.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.base.errors import MeshError, OutlineError
from shapetween.deform.check import simple_frames
from shapetween.deform.mesh import AmbientMesh, ambient_mesh
from shapetween.deform.schedule import CHECKED_TIMES, SolvedMotion, solve
from shapetween.geometry.polygon import polygon_area
from shapetween.geometry.rotation import linear_between, rotations
from shapetween.interpolate import Tween, tween
from shapetween.mesh.pair import MeshPair
from shapetween.outline.body import Carried, Nodes, RingMatch, joined_meshes
from shapetween.outline.carry import affine_between
from shapetween.outline.nodes import outline_nodes
from shapetween.outline.quad_target import QuadJacobianTarget

__all__ = ["DETAIL_TIMES", "MOST_NODES", "TOLERANCES", "bare", "unfolded"]

#: Greatest distance of an outline from its nodes' polygon, as a share of the root of the area:
#: the first is enough for most pairs, finer ones cost time and are for details that cross.
TOLERANCES = (0.03, 0.012, 0.005)

#: Nodes past which an ambient mesh takes long, and what the first tolerance is then multiplied
#: by to come near as many.
MOST_NODES, COARSER = 220, (1.5, 2.5, 4.0)

#: Times at which the whole detail of an outline of thousands of curves is checked.
DETAIL_TIMES = 21

#: Stands in for triangles whose own shape cannot be used.
ANY_TRIANGLE = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])

#: Greatest distance of neighbouring nodes in the same unit.
SPAN = 0.6


def unfolded(
    rings: Sequence[RingMatch], method: str, tolerances: Sequence[float] = TOLERANCES
) -> Carried:
    """The first of ever stronger settings that crosses nowhere, else the one that crosses least.

    Parameters
    ----------
    rings : sequence of RingMatch
        At least one of them no hole.
    method : str
        What moves the quads.
    tolerances : sequence of float
        How near the nodes' polygon stays to the outline, in the order tried.
    """
    best: Carried | None = None
    for found in _settings(tuple(rings), method, tolerances):
        if best is None or found.crossing < best.crossing:
            best = found
        # The bare meshes cannot do better than coarse shapes that do not cross.
        if not best.crossing or best.detail:
            return best
    loose = bare(rings, method)
    return loose if best is None or loose.crossing < best.crossing else best


def _nodes(rings: tuple[RingMatch, ...], tolerance: float) -> Nodes:
    return Nodes(
        rings,
        tuple(
            # The corners of a coarse shape are as few as they may be already.
            np.arange(len(ring.samples.w))
            if ring.coarse
            else outline_nodes(
                ring.samples.source,
                ring.samples.target,
                ring.kept,
                tolerance=tolerance,
                span=SPAN,
            )
            for ring in rings
        ),
    )


def _settings(
    rings: tuple[RingMatch, ...], method: str, tolerances: Sequence[float]
) -> Iterator[Carried]:
    pair = joined_meshes(rings)
    for tolerance in tolerances:
        nodes = _nodes(rings, tolerance)
        if len(nodes.ends[0]) > MOST_NODES:
            if tolerance != tolerances[0]:
                return
            nodes = min(
                (_nodes(rings, factor * tolerance) for factor in COARSER),
                key=lambda n: abs(len(n.ends[0]) - MOST_NODES),
            )
        sizes = tuple(len(k) for k in nodes.chosen)
        if not simple_frames(np.stack(nodes.ends), sizes).all():
            continue
        loops = [
            np.arange(part.start, part.stop)[:: -1 if ring.hole else 1]
            for ring, part in zip(rings, nodes.parts, strict=True)
        ]
        try:
            mesh = ambient_mesh(*nodes.ends, loops)
        except (MeshError, OutlineError):
            continue
        target, quad_share = _quad_target(mesh, pair, method)
        if any(ring.coarse for ring in rings):
            yield _with_detail(nodes, solve(mesh, None, target), method, quad_share)
            return
        solved = solve(mesh, nodes.simple, target, denser=tolerance != tolerances[-1])
        stiffness = solved.stiffness
        setting = (
            f"{method} in an ambient mesh: nodes within {tolerance:g}, "
            f"outside {stiffness.outside:g}, length {stiffness.length:g}"
        )
        inner = (solved.crossing > 0) & (solved.crossing < 1)
        yield Carried(
            nodes,
            solved.motion,
            int(inner.sum()),
            CHECKED_TIMES - 2,  # the ends are the drawings themselves, whatever they do
            solved.repaired,
            setting,
            quad_share,
        )
        # Where the mesh stays tangled more nodes cost seconds and tangle it again.
        if mesh.inverted.any():
            return


def _with_detail(nodes: Nodes, solved: SolvedMotion, method: str, quad_share: float) -> Carried:
    """A motion that keeps coarse shapes from crossing, and what their detail does on it."""
    t = np.linspace(0, 1, DETAIL_TIMES)
    crossing = int((~nodes.simple(t, solved.motion.vertices(t))[1:-1]).sum())
    setting = (
        f"{method} in an ambient mesh: coarse shapes, outside {solved.stiffness.outside:g}, "
        f"length {solved.stiffness.length:g}"
    )
    coarse = ((solved.crossing > 0) & (solved.crossing < 1)).any()
    return Carried(
        nodes,
        solved.motion,
        crossing,
        DETAIL_TIMES - 2,
        solved.repaired,
        setting,
        quad_share,
        detail=crossing > 0 and not coarse,
    )


def _quad_target(
    mesh: AmbientMesh, pair: MeshPair, method: str
) -> tuple[QuadJacobianTarget | None, float]:
    """What the quads want of the inside of the ambient mesh, and of how much of it.

    The ambient mesh moves between the poses of the two shapes, so the quads are moved between the
    same poses: an affine pair then asks the same of both.
    """
    sizes = [pose.size for pose in mesh.poses]
    posed = MeshPair(pair.source / sizes[0], pair.target / sizes[1], pair.quads, pair.triangles)
    corners = [
        points[mesh.triangles[mesh.inside]] / size
        for points, size in zip((mesh.source, mesh.target), sizes, strict=True)
    ]
    for half in corners:  # inverted triangles follow nothing, and must not be in the way
        half[mesh.inverted[mesh.inside]] = ANY_TRIANGLE
    target = QuadJacobianTarget.of(posed, tween(posed, method), *corners)
    if target is None:
        return None, 0.0
    areas = np.abs(polygon_area(corners[0]))
    return target, float(areas[target.follows].sum() / areas.sum())


def bare(rings: Sequence[RingMatch], method: str) -> Carried:
    """The meshes' own nodes, moved by the method alone; holes go with the shape as a whole."""
    nodes = Nodes(tuple(rings), tuple(ring.kept for ring in rings))
    path = _BarePath.of(nodes, method)
    t = np.linspace(0, 1, CHECKED_TIMES)
    simple = nodes.simple(t, path.vertices(t))
    crossing = int((~simple[1:-1]).sum())
    return Carried(
        nodes, path, crossing, CHECKED_TIMES - 2, False, f"{method} alone", 1.0, bare=True
    )


@dataclass(frozen=True, slots=True, eq=False)
class _BarePath:
    """Nodes of a body whose outer rings follow their meshes."""

    tween: Tween
    outer: Index
    vertices_of: Index
    holes: Index
    ends: tuple[Points, Points]
    angle: Floats
    stretch: Floats

    @property
    def mesh(self) -> None:
        """Nothing else can be bound to it."""

    @classmethod
    def of(cls, nodes: Nodes, method: str) -> "_BarePath":
        first, outer, vertices, holes = 0, [], [], []
        for ring, part in zip(nodes.rings, nodes.parts, strict=True):
            here = np.arange(part.start, part.stop)
            if ring.pair is None:
                holes.append(here)
                continue
            outer.append(here)
            vertices.append(np.arange(first, first + len(here)))
            first += len(ring.pair.source)
        ends = nodes.ends
        angle, stretch = affine_between(*ends)
        return cls(
            tween(joined_meshes(nodes.rings), method),
            np.concatenate(outer),
            np.concatenate(vertices),
            np.concatenate([np.zeros(0, dtype=np.intp), *holes]),
            ends,
            np.reshape(angle, (1,)),
            stretch[None],
        )

    def vertices(self, t: Floats) -> Points:
        """Nodes at the times (F,), (F, n, 2)."""
        result = np.zeros((len(t), *self.ends[0].shape))
        result[:, self.outer] = self.tween.vertices(t)[:, self.vertices_of]
        if len(self.holes):
            general = linear_between(self.angle, self.stretch, t)[:, 0]
            back = np.linalg.inv(rotations(self.angle) @ self.stretch)[0]
            time = t[:, None, None]
            means = [p.mean(axis=0) for p in self.ends]
            start, end = (p[self.holes] - m for p, m in zip(self.ends, means, strict=True))
            local = (1 - time) * start + time * (end @ back.T)
            centre = (1 - t)[:, None] * means[0] + t[:, None] * means[1]
            result[:, self.holes] = local @ np.swapaxes(general, 1, 2) + centre[:, None]
        return result
