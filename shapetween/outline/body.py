"""Matched rings that move as one: outer outlines with their holes, and the curves they carry."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points, side_by_side
from shapetween.deform.check import simple_frames
from shapetween.deform.deformation import Deformation
from shapetween.deform.layout import ring_edges
from shapetween.geometry.bezier import flatten
from shapetween.geometry.linearmaps import as_complex, squared
from shapetween.geometry.polygon import polygon_area
from shapetween.match.correspondence import Correspondence
from shapetween.mesh.inner import is_too_large
from shapetween.mesh.pair import MeshPair
from shapetween.model.outline import Outline
from shapetween.outline.carry import Carrier
from shapetween.outline.detail import DetailedOutlines
from shapetween.outline.matched import MatchedOutlines, Samples
from shapetween.outline.seen import NOT_SEEN, Seen

__all__ = ["Carried", "Nodes", "RingMatch", "joined_meshes"]

#: Distance of a curve from the chords it is looked at with, as a share of the extent of all of
#: them, and points of a frame past which chords become fewer. Larger and curves cross where their
#: chords do not; smaller costs time, by its square root.
FLATNESS, MOST_POINTS = 1e-4, 8000

#: Least number of chords of a curve that is no line, and how many it may need by its flatness alone
#: and count as a line. Fewer miss what small curves do next to each other.
LEAST_CHORDS, LINE = 8, 0.1

#: Of how many frames one is asked how far the curves bend; they hardly change from one to the next.
BENT_FRAMES = 8

#: Curves of all frames that are held at once; more cost memory and are no quicker.
POINTS_AT_ONCE = 200_000

#: Curves of all frames past which frames are left out: more take seconds.
MOST_LOOKED = 1_500_000


@dataclass(frozen=True, slots=True, eq=False)
class RingMatch:
    """Two rings that become each other, matched, and meshed unless they are holes or previewed.

    Attributes
    ----------
    source, target : Outline
        Both clockwise as drawn, holes too.
    hole : bool
    matching : Correspondence
    outlines : MatchedOutlines or DetailedOutlines
    samples : Samples
        Matched points of the rings.
    kept : (n,) intp
        Samples that are nodes in any case, increasing; those of the mesh if there is one.
    pair : MeshPair or None
        The first vertices are those nodes, others lie inside; None for a hole and in a preview.
    found : str
        How the mesh was found.
    upright : bool
        Whether the ring is part of something larger, and so is not turned by itself.
    """

    source: Outline
    target: Outline
    hole: bool
    matching: Correspondence
    outlines: MatchedOutlines | DetailedOutlines
    samples: Samples
    kept: Index
    pair: MeshPair | None
    found: str
    upright: bool = False

    @property
    def unevened(self) -> bool:
        """Whether a mesh was found whose inner vertices are too many to be moved to better faces.

        The boundary's vertices come first: of a disc, there are two more of them than triangles.
        """
        if self.pair is None or self.found == "given":
            return False
        count = len(self.pair.source)
        faces = 2 * len(self.pair.quads) + len(self.pair.triangles)
        return is_too_large(count, 2 * count - faces - 2)

    @property
    def ends(self) -> tuple[Outline, Outline]:
        """What was matched: the outlines, or the coarse shapes that stand for them."""
        if isinstance(self.outlines, DetailedOutlines):
            return self.outlines.source.polygon, self.outlines.target.polygon
        return self.source, self.target

    @property
    def coarse(self) -> bool:
        """Whether the samples are the corners of coarse shapes, and the detail is carried."""
        return isinstance(self.outlines, DetailedOutlines)


def joined_meshes(rings: Sequence[RingMatch]) -> MeshPair:
    """The meshes of all outer rings as one pair of several components."""
    pairs = [ring.pair for ring in rings if ring.pair is not None]
    first = np.cumsum([0, *(len(p.source) for p in pairs)])
    return MeshPair(
        np.concatenate([p.source for p in pairs]),
        np.concatenate([p.target for p in pairs]),
        np.concatenate([p.quads + k for p, k in zip(pairs, first, strict=False)]),
        np.concatenate([p.triangles + k for p, k in zip(pairs, first, strict=False)]),
    )


@dataclass(frozen=True, eq=False)
class Nodes:
    """The samples of each ring that move as nodes.

    Attributes
    ----------
    rings : tuple of RingMatch
    chosen : tuple of (n_r,) intp
        Samples of each ring, increasing.
    """

    rings: tuple[RingMatch, ...]
    chosen: tuple[Index, ...]

    @cached_property
    def ends(self) -> tuple[Points, Points]:
        """All nodes, ring after ring, at the start and at the end."""
        samples = [(ring.samples, k) for ring, k in zip(self.rings, self.chosen, strict=True)]
        return (
            np.concatenate([s.source[k] for s, k in samples]),
            np.concatenate([s.target[k] for s, k in samples]),
        )

    @cached_property
    def parts(self) -> tuple[slice, ...]:
        """Where each ring's nodes stand among all of them."""
        first = np.cumsum([0, *(len(k) for k in self.chosen)]).tolist()
        return tuple(slice(a, b) for a, b in pairwise(first))

    @cached_property
    def carriers(self) -> tuple[Carrier, ...]:
        """The curves of each ring, cut at its nodes."""
        return tuple(
            Carrier(
                ring.outlines.cut(ring.samples.w[k]),
                ring.samples.w[k],
                self.ends[0][part],
                self.ends[1][part],
                ordered=ring.coarse,
            )
            for ring, k, part in zip(self.rings, self.chosen, self.parts, strict=True)
        )

    @property
    def many(self) -> bool:
        """Whether there are so many curves that not each is looked at in `LEAST_CHORDS`."""
        return LEAST_CHORDS * sum(carrier.count for carrier in self.carriers) > MOST_POINTS

    def curves(self, vertices: Points, t: Floats) -> Curves:
        """Control points, ring after ring, (F, P, 4, 2), for vertices that begin with the nodes.

        Outer rings run clockwise as drawn and holes the other way, so that the nonzero rule and
        the even-odd rule show the same.
        """
        drawn = []
        for ring, part, carrier in zip(self.rings, self.parts, self.carriers, strict=True):
            curves = carrier.curves(vertices[:, part], t)
            drawn.append(curves[:, ::-1, ::-1] if ring.hole else curves)
        return side_by_side(drawn)

    def simple(self, t: Floats, vertices: Points) -> Mask:
        """In which frames the drawn rings cross neither themselves nor each other, (F,)."""
        counts = np.array([carrier.count for carrier in self.carriers])
        count, first = int(counts.sum()), np.cumsum(counts) - counts
        least = np.repeat(-(-3 // counts), counts)  # a ring of less than three chords is none
        # Outlines of tens of thousands of curves are looked at less often, and a few at a time.
        looked = np.arange(0, len(t), 1 + len(t) * count // MOST_LOOKED)
        result = np.ones(len(t), dtype=bool)
        for some in np.array_split(looked, 1 + len(looked) * count // POINTS_AT_ONCE):
            curves = self.curves(vertices[some], t[some])
            chords = np.maximum(_chords(curves[::BENT_FRAMES]), least)
            sizes = tuple(np.add.reduceat(chords, first).tolist())
            result[some] = simple_frames(flatten(curves, chords), sizes)
        return result


def _chords(curves: Curves) -> Index:
    """How many chords show moving curves (F, P, 4, 2) well enough at all times, (P,).

    A curve lies within max |B''| / (8 n^2) of n chords, and |B''| is at most six times the largest
    second difference of its control points.
    """
    extent = np.ptp(curves[:, :, 0], axis=1).max(axis=1)
    bends = squared(np.diff(as_complex(curves), n=2)).max(axis=2).T / extent**2
    needed = np.sqrt(0.75 / FLATNESS) * bends.max(axis=1) ** 0.25
    chords = np.where(needed > LINE, np.maximum(np.ceil(needed), LEAST_CHORDS), 1)
    fewer = min(1.0, MOST_POINTS / chords.sum())
    return np.asarray(np.maximum(fewer * chords, 1), dtype=np.intp)


@dataclass(frozen=True, slots=True, eq=False)
class Carried:
    """The curves of a body's rings on moving nodes, and what was seen of them.

    Attributes
    ----------
    nodes : Nodes
    path : Deformation
        Its first vertices are the nodes.
    crossing : int
        At how many of the `checked` times the drawn curves cross.
    checked : int
    repaired : bool
        Whether inversions were found and repaired.
    setting : str
        What moves the nodes.
    quad_share : float
        Share of the inside that follows a quad.
    detail : bool
        Whether all that crosses is fine detail; the coarse shapes do not.
    seen : Seen
        What is to be seen of the crossings, where it was looked at.
    other_matching : bool
        Whether another matching than the best was taken, because that one is seen to cross.
    parted : bool
        Whether strands that crossed were parted.
    bare : bool
        Whether the meshes alone move the nodes, and nothing keeps them from folding.
    """

    nodes: Nodes
    path: Deformation
    crossing: int
    checked: int
    repaired: bool
    setting: str
    quad_share: float
    detail: bool = False
    seen: Seen = NOT_SEEN
    other_matching: bool = False
    parted: bool = False
    bare: bool = False

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(carrier.count for carrier in self.nodes.carriers)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), ring after ring, (F, P, 4, 2)."""
        return self.nodes.curves(self.path.vertices(t), t)

    def inside(self, t: Floats) -> tuple[Points, Floats]:
        """Places all over the inside that move along, (F, N, 2), and the area about each, (N,).

        Of a body without an ambient mesh, places along its outlines, and their lengths.
        """
        vertices = self.path.vertices(t)
        mesh = self.path.mesh
        if mesh is not None:
            faces = mesh.triangles[mesh.inside]
            return vertices[:, faces].mean(axis=2), np.abs(polygon_area(mesh.source[faces]))
        edges = ring_edges([np.arange(part.start, part.stop) for part in self.nodes.parts])
        ends = self.nodes.ends[0][edges]
        return vertices[:, edges].mean(axis=2), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
