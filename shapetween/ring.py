"""One closed outline becoming another: matched, meshed, moved, and its curves carried along."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from shapetween.arclength import ArcLength
from shapetween.arrays import Curves, Floats, Index, Points
from shapetween.correspond import correspond
from shapetween.correspond.correspondence import Correspondence
from shapetween.geometry.bezier import flatten
from shapetween.matched import MatchedOutlines, Samples
from shapetween.mesh import MeshPair
from shapetween.meshfile import check_mesh
from shapetween.meshing import mesh_matched
from shapetween.observe import Observer
from shapetween.outline import Outline
from shapetween.unfold import Carried, bare, unfolded

__all__ = ["Folds", "RingMesh", "RingMorph", "morph_ring"]

Folds: TypeAlias = Literal["prevent", "allow"]
"""Whether the plane around a shape moves along so that nothing folds, or the bare mesh moves."""

#: Samples of the matched outlines that the mesh chooses its nodes from. More find better places
#: for nodes and cost the square of it.
SAMPLES = 512

#: Chords a curve is checked with where a polygon will do.
CHORDS = 16


@dataclass(frozen=True, slots=True, eq=False)
class RingMesh:
    """Two matched outlines and the mesh over them.

    Attributes
    ----------
    source, target : Outline
        Both clockwise as drawn.
    matching : Correspondence
    outlines : MatchedOutlines
    samples : Samples
        Matched points of the outlines.
    pair : MeshPair
        The first vertices are the nodes on the outline, in order; others lie inside.
    kept : (n,) intp
        Which samples those nodes are, increasing.
    found : str
        How the mesh was found.
    """

    source: Outline
    target: Outline
    matching: Correspondence
    outlines: MatchedOutlines
    samples: Samples
    pair: MeshPair
    kept: Index
    found: str


@dataclass(frozen=True, slots=True, eq=False)
class RingMorph:
    """An outline through the whole movement.

    Attributes
    ----------
    mesh : RingMesh
    carried : Carried
        The outline's curves, on nodes that move.
    """

    mesh: RingMesh
    carried: Carried

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        return self.carried.curves(t)


def morph_ring(
    source: Outline,
    target: Outline,
    *,
    method: str,
    folds: Folds,
    quads: int | None,
    pins: Points,
    mesh: MeshPair | None,
    observe: Observer,
) -> RingMorph:
    """Prepare one outline's movement.

    Parameters
    ----------
    source, target : Outline
        Closed, simple, clockwise as drawn, in one frame.
    method : str
        One of `shapetween.interpolate.METHODS`.
    folds : {"prevent", "allow"}
        Whether the plane around the outline moves along, so that nothing folds.
    quads : int or None
        About how many quads; None for as few as the shapes need.
    pins : (K, 4) float64
        Rows ax, ay, bx, by of points that belong together.
    mesh : MeshPair or None
        A mesh to use instead of a found one, its boundary on the outlines.
    observe : Observer
        Told of every stage.

    Raises
    ------
    OutlineError, OptionError, MeshError
        What is wrong with the outlines, the pins, the mesh.
    """
    if mesh is None:
        ring = _found_mesh(source, target, quads, pins, observe)
    else:
        ring = _given_mesh(source, target, mesh, observe)
    with observe("move"):
        if folds == "prevent":
            return RingMorph(
                ring, unfolded(ring.outlines, ring.samples, ring.pair, ring.kept, method)
            )
        return RingMorph(ring, bare(ring.outlines, ring.samples, ring.pair, ring.kept, method))


def _found_mesh(
    source: Outline, target: Outline, quads: int | None, pins: Points, observe: Observer
) -> RingMesh:
    with observe("match"):
        matching = correspond(source, target, pins if len(pins) else None)
        places = ArcLength(source), ArcLength(target)
        anchors = np.stack(
            [places[0].nearest(pins[:, :2])[0], places[1].nearest(pins[:, 2:])[0]], axis=1
        )
        outlines = MatchedOutlines(
            *places, matching.u, matching.v, anchors=anchors, exact=matching.affine is not None
        )
        samples = outlines.samples(SAMPLES)
    with observe("mesh"):
        found = mesh_matched(samples.source, samples.target, samples.joints, quads)
    return RingMesh(
        source, target, matching, outlines, samples, found.pair, found.nodes, found.level
    )


def _given_mesh(source: Outline, target: Outline, mesh: MeshPair, observe: Observer) -> RingMesh:
    with observe("match"):
        polygons = flatten(source.curves, CHORDS), flatten(target.curves, CHORDS)
        cycle = check_mesh(mesh, *polygons)
        places = ArcLength(source), ArcLength(target)
        anchors = np.stack(
            [
                places[0].nearest(mesh.source[cycle])[0],
                places[1].nearest(mesh.target[cycle])[0],
            ],
            axis=1,
        )
        # A given node lies on the outline up to how finely it was written; here it does exactly.
        on = places[0].point(anchors[:, 0]), places[1].point(anchors[:, 1])
        matching = correspond(source, target, np.concatenate(on, axis=1))
        outlines = MatchedOutlines(*places, matching.u, matching.v, anchors=anchors)
        w = outlines.parameter(anchors[:, 0])
        first = int(w.argmin())
        cycle, w = np.roll(cycle, -first), np.roll(w, -first)
        inner = np.setdiff1d(np.arange(len(mesh.source)), cycle)
        order = np.concatenate([cycle, inner])
        rank = np.argsort(order)
        vertices = [
            np.concatenate([np.roll(nodes, -first, axis=0), given[inner]])
            for nodes, given in zip(on, (mesh.source, mesh.target), strict=True)
        ]
        pair = MeshPair(*vertices, rank[mesh.quads], rank[mesh.triangles])
        samples = outlines.samples(SAMPLES)
        kept = np.abs(samples.w[:, None] - w).argmin(axis=0)
    return RingMesh(source, target, matching, outlines, samples, pair, kept, "given")
