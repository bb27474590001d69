"""A triangulation of the whole plane that fits two sets of matched outlines.

It is built around one of the two and then laid around the other. Where that is impossible some
triangles stay inverted; they are marked, and the motion leaves them out.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index, Mask, Points, frozen, row_sums
from shapetween.base.errors import OutlineError, ShapeError
from shapetween.deform.layout import FRAME_CORNERS, Layout, ring_edges
from shapetween.deform.pose import AffinePath, Pose, affine_path
from shapetween.deform.untangle import Untangler
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.geometry.polygon import polygon_area

__all__ = ["AmbientMesh", "ambient_mesh"]

#: Radius of the frame over that of the shapes. Smaller, and limbs that swing out are held back;
#: larger costs triangles.
FRAME_RADIUS = 1.6
#: Rings of neighbours refined with triangles that stay inverted. Fewer leave meshes tangled
#: that more would free; more cost triangles.
REFINED_RINGS = 2
#: Share of inverted triangles that is left alone: the motion gets by with a few, and patience costs
#: seconds.
TOLERATED = 0.03
#: Least area of a triangle over the square of its longest side. Thinner ones count as
#: inverted: their Jacobians are rounding error.
LEAST_ASPECT = 1e-7
#: Relative difference below which two measures of shapes are the same.
SAME = 1e-9
#: Steps of the grid, in a shape's size, that nodes are put on while the mesh is fitted to them.
#: Untangling what resists makes rounding into other meshes, and the same drawings backwards in
#: time, or in other units, differ by rounding. More and it shows again; fewer and nodes that lie
#: close become one.
STEPS = 2.0**30


@dataclass(frozen=True, slots=True, eq=False)
class AmbientMesh:
    """Triangles over two arrays of vertices: nodes of the outlines first, then frame, then free.

    Attributes
    ----------
    source, target : (V, 2) float64
    triangles : (T, 3) intp
        Of positive area in both, but for those `inverted`.
    inside : (T,) bool
        Triangles inside the outlines.
    rings : tuple of (N_r,) intp
        Nodes of each outline in order.
    poses : (Pose, Pose)
        Poses of source and target.
    body : AffinePath
        Motion of the shapes as a whole, between their poses; the frame follows it.
    inverted : (T,) bool
        Triangles inverted, or almost without area, on one side.
    """

    source: Points
    target: Points
    triangles: Index
    inside: Mask
    rings: tuple[Index, ...]
    poses: tuple[Pose, Pose]
    body: AffinePath
    inverted: Mask = field(init=False)

    def __post_init__(self) -> None:
        """Copy and lock the arrays; find the inverted triangles."""
        for name in ("source", "target"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64, last=(2,)))
        object.__setattr__(self, "triangles", frozen(self.triangles, np.intp, last=(3,)))
        object.__setattr__(self, "inside", frozen(self.inside, np.bool_, ndim=1))
        inverted = _thin(self.source[self.triangles]) | _thin(self.target[self.triangles])
        object.__setattr__(self, "inverted", frozen(inverted, np.bool_, ndim=1))

    @property
    def nodes(self) -> int:
        """Number of nodes of the outlines, the first vertices."""
        return sum(len(ring) for ring in self.rings)

    @property
    def frame(self) -> Index:
        """Vertices of the frame, in order."""
        return np.arange(self.nodes, self.nodes + FRAME_CORNERS)

    def placed(self, posed: Complex, t: Floats) -> Points:
        """Vertices in user units at the times (F,), (F, V, 2); the mesh's own at 0 and 1.

        Parameters
        ----------
        posed : (F, V) complex128
            Vertices as they move from pose to pose: about the origin, the size left out. Fewer
            than V are the first ones.
        t : (F,) float64
        """
        time = t[:, None]
        first, last = self.poses
        centre = as_complex((1 - time) * first.centre + time * last.centre)
        placed = as_points(posed * ((1 - time) * first.size + time * last.size) + centre[:, None])
        count = posed.shape[1]  # at the ends it is there but for rounding
        placed[t == 0], placed[t == 1] = self.source[:count], self.target[:count]
        return placed


def ambient_mesh(
    source: Points, target: Points, rings: Sequence[Index] | None = None, *, refine: bool = True
) -> AmbientMesh:
    """Triangulate the plane around two sets of matched outlines.

    Swapping source and target gives the same triangles.

    Parameters
    ----------
    source, target : (N, 2) float64
        Matched nodes. The rings of each must not cross; outer ones run clockwise as drawn, holes
        the other way.
    rings : sequence of (N_r,) intp, optional
        Nodes of each ring, every node in one; by default all nodes make one ring.
    refine : bool
        Whether to split triangles, and try again, where the mesh stays tangled: slower.

    Raises
    ------
    ShapeError
        If the nodes are not as many on both sides.
    OutlineError
        If an area is not positive, or two nodes coincide.
    MeshError
        If rings cross.
    """
    a, b = frozen(source, np.float64, last=(2,)), frozen(target, np.float64, last=(2,))
    if a.shape != b.shape or len(a) < 3:
        raise ShapeError(f"{len(a)} nodes and {len(b)}; they must be as many, at least 3")
    loops = tuple(frozen(r, np.intp, ndim=1) for r in rings or [np.arange(len(a))])
    edges = ring_edges(loops)
    poses = tuple(Pose.of(p, float(sum(polygon_area(p[r]) for r in loops))) for p in (a, b))
    ordered = _is_base(poses[0].normalise(a), poses[1].normalise(b), edges)
    first, second = [poses[0].normalise(a), poses[1].normalise(b)][:: 1 if ordered else -1]
    body = affine_path(first, second)
    vertices, layout = _fit(first, second, body, loops, refine)
    if not ordered:
        vertices, body = vertices[::-1], body.reversed()
    source, target = (
        np.concatenate([nodes, pose.place(points[len(nodes) :])])
        for nodes, pose, points in zip((a, b), poses, vertices, strict=True)
    )
    return AmbientMesh(
        source,
        target,
        layout.triangles,
        layout.inside,
        loops,
        (poses[0], poses[1]),
        body,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Attempt:
    """A layout around one shape, laid about the other one's nodes.

    Attributes
    ----------
    layout : Layout
    nodes : (N, 2) float64
        Nodes of the other shape.
    swapped : bool
        Whether the layout was built around the second shape.
    placed : (V, 2) float64
        Vertices about the other shape.
    inverted : int
        How many triangles are inverted there.
    """

    layout: Layout
    nodes: Points
    swapped: bool
    placed: Points
    inverted: int

    @classmethod
    def at(
        cls, layout: Layout, nodes: Points, swapped: bool, *, patient: bool = False
    ) -> "_Attempt":
        """Lay a layout about nodes, starting harmonically."""
        fixed = np.arange(len(layout.points)) < layout.fixed
        untangler = Untangler.of(layout.points, layout.triangles, fixed)
        start = layout.points.copy()
        start[: len(nodes)] = nodes
        placed, inverted = untangler.untangle(untangler.harmonic(start), patient=patient)
        return cls(layout, nodes, swapped, placed, inverted)

    def refined(self) -> "_Attempt":
        """The same with the triangles split that are inverted, and those around them."""
        layout = self.layout.refined(_thin(self.placed[self.layout.triangles]), REFINED_RINGS)
        return _Attempt.at(layout, self.nodes, self.swapped)


def _fit(
    first: Points, second: Points, body: AffinePath, rings: Sequence[Index], refine: bool
) -> tuple[tuple[Points, Points], Layout]:
    """Vertices of both shapes over one layout, built around whichever serves.

    The other shape is brought near by the motion of the whole, so that affine images come out
    exactly.
    """
    forth, back = body.matrix, np.linalg.inv(body.matrix)
    shapes = tuple(
        (np.round(STEPS * rest) / STEPS, np.round(STEPS * other) / STEPS)
        for rest, other in ((first, second @ back.T), (second, first @ forth.T))
    )
    if any(len(np.unique(as_complex(p))) < len(p) for pair in shapes for p in pair):
        raise OutlineError("two nodes of the outlines coincide")
    best: _Attempt | None = None
    for attempt in _attempts(shapes, rings, refine):
        if best is None or attempt.inverted < best.inverted:
            best = attempt
        if not best.inverted:
            break
    assert best is not None
    rest, placed = best.layout.points, best.placed
    return ((placed @ back.T, rest) if best.swapped else (rest, placed @ forth.T)), best.layout


def _attempts(
    shapes: tuple[tuple[Points, Points], ...], rings: Sequence[Index], refine: bool
) -> Iterator[_Attempt]:
    """Ever dearer ways to fit both shapes: around either, with finer meshes, with more steps."""
    coarse, fine = [], []
    for swapped, (rest, other) in enumerate(shapes):
        radius = FRAME_RADIUS * float(np.linalg.norm([rest, other], axis=2).max())
        coarse.append(_Attempt.at(Layout.around(rest, rings, radius), other, bool(swapped)))
        yield coarse[-1]
    if not refine:
        return
    for attempt in sorted(coarse, key=lambda attempt: attempt.inverted):
        fine.append(attempt.refined())
        yield fine[-1]
    shares = [attempt.inverted / len(attempt.layout.triangles) for attempt in coarse + fine]
    if min(shares) > TOLERATED:
        best = min(fine, key=lambda attempt: attempt.inverted)
        yield _Attempt.at(best.layout, best.nodes, best.swapped, patient=True)


def _thin(corners: Points) -> Mask:
    """Which triangles (T, 3, 2) are inverted or almost without area."""
    longest = row_sums((corners - np.roll(corners, 1, axis=1)) ** 2).max(axis=1)
    return np.asarray(polygon_area(corners) <= LEAST_ASPECT * longest)


def _is_base(first: Points, second: Points, edges: Index) -> bool:
    """Whether the first of two normalised shapes is the one to build on.

    Decided by measures that no similarity changes, so that time can run backwards: the length of
    the outline, then, for mirror images, the sense of its third moments.
    """
    measures = []
    for points in (first, second):
        ends = points[edges]
        weights = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        z = ends.mean(axis=1) @ np.array([1, 1j])
        z = z - (weights @ z) / weights.sum()
        third, moment = weights @ (z * np.abs(z) ** 2), weights @ z**2
        size = weights @ np.abs(z) ** 2
        measures.append((weights.sum(), (third**2 * moment.conjugate()).imag / size**4))
    for ours, theirs in zip(*measures, strict=True):
        if abs(ours - theirs) > SAME * (abs(ours) + abs(theirs) + SAME):
            return bool(ours > theirs)
    return True
