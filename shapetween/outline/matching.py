"""Matching and meshing two rings, outers by themselves and holes along with their outers."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer
from shapetween.deform.check import simple_frames
from shapetween.geometry.bezier import flatten
from shapetween.geometry.rotation import rotations
from shapetween.match import Correspondence, Matcher, correspond
from shapetween.match.matcher import ALTERNATIVES
from shapetween.mesh import mesh_matched
from shapetween.mesh.file import check_mesh
from shapetween.mesh.pair import MeshPair
from shapetween.model.arclength import ArcLength, arc_length
from shapetween.model.outline import Outline
from shapetween.outline.body import RingMatch
from shapetween.outline.coarse import Coarse, coarse
from shapetween.outline.detail import DetailedOutlines
from shapetween.outline.matched import MatchedOutlines
from shapetween.outline.settling import settled

__all__ = ["CORNERS", "match_hole", "match_outer", "next_matches", "unmeshed", "upright_of"]

#: Samples of the matched outlines that the mesh chooses its nodes from. More find better places
#: for nodes and cost the square of it.
SAMPLES = 512

#: Samples of what has no mesh of its own: a hole, and any ring of a preview. With fewer, nodes miss
#: corners; more take longer.
BARE_SAMPLES = 256

#: Chords a curve is checked with where a polygon will do.
CHORDS = 16

#: Least step between two knots on coarse shapes, as a share of their lengths. Less, and what lies
#: between two of them has no extent; more loses what is matched closely.
APART = 1e-6

#: Curves of one outline from which on both are meshed and moved by their coarse shapes. Fewer are
#: drawn shapes, whose every curve means something.
MANY_CURVES = 600

#: Corners of all coarse outlines of a shape at most. More keep more of the shape from folding, and
#: cost time with their square.
CORNERS = 100


def match_outer(
    source: Outline,
    target: Outline,
    *,
    quads: int | None,
    pins: Points,
    mesh: MeshPair | None,
    upright: bool,
    observe: Observer,
    corners: int = CORNERS,
    choice: int = 1,
    meshed: bool = True,
) -> RingMatch:
    """Match and mesh two outer rings.

    Parameters
    ----------
    source, target : Outline
        Closed, simple, clockwise as drawn, in one frame.
    quads : int or None
        About how many quads; None for as few as the shapes need.
    pins : (K, 4) float64
        Rows ax, ay, bx, by of points that belong together.
    mesh : MeshPair or None
        A mesh to use instead of a found one, its boundary on the outlines.
    upright : bool
        Whether the rings are parts of larger drawings, and so are not turned by themselves to
        match better.
    observe : Observer
        Told of every stage.
    corners : int
        Corners at most of the coarse shapes that outlines of very many curves are moved by.
    choice : int
        Which of the distinct matchings to take, the best one being 1.
    meshed : bool
        Whether a mesh is wanted; a preview does without.

    Raises
    ------
    OutlineError, OptionError, MeshError
        What is wrong with the outlines, the pins, the mesh, the choice.
    """
    if mesh is not None:
        if len(pins):
            raise OptionError(
                f"pin {pins[0, 0]:.6g},{pins[0, 1]:.6g}: lies on a shape whose mesh says already "
                "what goes where; expected one or the other"
            )
        return _given_mesh(source, target, mesh, observe)
    if choice > 1 and len(pins):
        raise OptionError(f"matching: {choice} and pins exclude each other; expected one of them")
    with observe("match"):
        matcher = Matcher(source, target)
        matching = matcher.match(pins) if len(pins) else _chosen(matcher, choice)
        if upright:
            matching = upright_of(matching)
    if max(len(source.curves), len(target.curves)) >= MANY_CURVES and not len(pins):
        coarsely = _by_coarse_shapes(source, target, matching, quads, observe, corners)
        if coarsely is not None:
            return coarsely
    if meshed:
        found = _meshed(source, target, matching, quads, pins, observe)
        return replace(found, upright=upright)
    places = arc_length(source), arc_length(target)
    anchors = _anchors(*places, pins)
    return unmeshed(places, matching, anchors, samples=SAMPLES, upright=upright)


def _chosen(matcher: Matcher, choice: int) -> Correspondence:
    """One of the distinct matchings, by its number."""
    if choice == 1:
        return matcher.match()
    known = matcher.alternatives(max(choice, ALTERNATIVES))
    if choice > len(known):
        raise OptionError(
            f"matching: {choice} is none; these outlines have {len(known)} that are distinct"
        )
    return known[choice - 1]


def _by_coarse_shapes(
    source: Outline,
    target: Outline,
    matching: Correspondence,
    quads: int | None,
    observe: Observer,
    corners: int,
) -> RingMatch | None:
    """Mesh what is left of two matched outlines without their detail, which is carried.

    None where one is an affine image of the other, or has no simple coarse shape.
    """
    if matching.affine is not None:
        return None
    with observe("match"):
        ends = coarse(source, corners), coarse(target, corners)
        if ends[0] is None or ends[1] is None:
            return None
        outlines = DetailedOutlines(ends[0], ends[1], *_lowered(ends[0], ends[1], matching))
        samples = outlines.samples()
        if not simple_frames(np.stack([samples.source, samples.target])).all():
            return None
    with observe("mesh"):
        found = mesh_matched(samples.source, samples.target, samples.joints, quads)
    return RingMatch(
        source, target, False, matching, outlines, samples, found.nodes, found.pair, found.level
    )


def _lowered(first: Coarse, second: Coarse, matching: Correspondence) -> tuple[Floats, Floats]:
    """Knots of the matching on the coarse polygons."""
    u, v = first.lowered(matching.u[:-1]), second.lowered(matching.v[:-1])
    u, v = (at[0] + (at - at[0]) % 1 for at in (u, v))
    # Places side by side on an outline that wanders back are one on its polygon.
    kept = [0]
    for k in range(1, len(u)):
        if min(u[k] - u[kept[-1]], v[k] - v[kept[-1]], 1 + u[0] - u[k], 1 + v[0] - v[k]) > APART:
            kept.append(k)
    return np.append(u[kept], u[0] + 1), np.append(v[kept], v[0] + 1)


def next_matches(ring: RingMatch, quads: int | None, observe: Observer) -> Iterator[RingMatch]:
    """The same two rings by their next best matchings, best first."""
    for matching in Matcher(ring.source, ring.target).alternatives()[1:]:
        if matching.turn == 0 or ring.matching.turn != 0:
            found = _meshed(ring.source, ring.target, matching, quads, np.zeros((0, 4)), observe)
            yield replace(found, upright=ring.upright)


def match_hole(
    source: Outline, target: Outline, turned: float, observe: Observer, pins: Points | None = None
) -> RingMatch:
    """Match two holes of rings that are matched already.

    Parameters
    ----------
    source, target : Outline
        Both clockwise as drawn.
    turned : float
        Angle by which the outer rings turn, radians; a hole turns with its ring.
    observe : Observer
        Told of the stage.
    pins : (K, 4) float64, optional
        Rows ax, ay, bx, by of points that belong together.

    Raises
    ------
    OptionError
        If the pins do not follow one another alike round both.
    """
    with observe("match"):
        turn = np.column_stack([rotations(np.asarray(turned)), np.zeros(2)])
        places = arc_length(source), arc_length(target)
        anchors = _anchors(*places, np.zeros((0, 4)) if pins is None else pins)
        matching = upright_of(correspond(source.transformed(turn), target, anchors))
        return unmeshed(places, matching, anchors, hole=True, upright=True)


def unmeshed(
    places: tuple[ArcLength, ArcLength],
    matching: Correspondence,
    anchors: Floats,
    *,
    samples: int = BARE_SAMPLES,
    hole: bool = False,
    upright: bool,
) -> RingMatch:
    """Two rings of a matching, without a mesh.

    Parameters
    ----------
    places : (ArcLength, ArcLength)
        Of both rings.
    matching : Correspondence
    anchors : (K, 2) float64
        Places that belong together exactly.
    samples : int
        About how many; where a hole goes follows those of its outer ring.
    hole, upright : bool
        As of `RingMatch`.
    """
    outlines = _outlines(places, matching, anchors if len(anchors) else None)
    points = outlines.samples(samples)
    # Two nodes far apart are enough to start from.
    apart = np.linalg.norm(points.source - points.source[0], axis=1)
    kept = np.unique([0, int(apart.argmax())])
    ends = places[0].outline, places[1].outline
    found = "hole" if hole else "preview"
    return RingMatch(*ends, hole, matching, outlines, points, kept, None, found, upright)


def _outlines(
    places: tuple[ArcLength, ArcLength], matching: Correspondence, anchors: Floats | None
) -> MatchedOutlines:
    """Both outlines read as one, as they settle; with anchors, as it was asked for."""
    u, v = matching.u, matching.v
    exact = matching.affine is not None
    if not exact and anchors is None:
        u, v = settled(*places, u, v)
    return MatchedOutlines(*places, u, v, anchors=anchors, exact=exact)


def upright_of(matching: Correspondence) -> Correspondence:
    """The best matching that does not turn the ring, unless the two are the same but for place."""
    if matching.affine is not None or matching.turn == 0:
        return matching
    return next((m for m in matching.others if m.turn == 0), matching)


def _meshed(
    source: Outline,
    target: Outline,
    matching: Correspondence,
    quads: int | None,
    pins: Points,
    observe: Observer,
) -> RingMatch:
    with observe("match"):
        places = arc_length(source), arc_length(target)
        anchors = _anchors(*places, pins) if len(pins) else None
        outlines = _outlines(places, matching, anchors)
        samples = outlines.samples(SAMPLES)
    with observe("mesh"):
        mesh = mesh_matched(samples.source, samples.target, samples.joints, quads)
    return RingMatch(
        source, target, False, matching, outlines, samples, mesh.nodes, mesh.pair, mesh.level
    )


def _anchors(source: ArcLength, target: ArcLength, pins: Points) -> Floats:
    """Places of pins on both outlines, (K, 2)."""
    return np.stack([source.nearest(pins[:, :2])[0], target.nearest(pins[:, 2:])[0]], axis=1)


def _given_mesh(source: Outline, target: Outline, mesh: MeshPair, observe: Observer) -> RingMatch:
    with observe("match"):
        polygons = flatten(source.curves, CHORDS), flatten(target.curves, CHORDS)
        cycle = check_mesh(mesh, *polygons)
        places = arc_length(source), arc_length(target)
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
        ends = [
            np.concatenate([np.roll(nodes, -first, axis=0), given[inner]])
            for nodes, given in zip(on, (mesh.source, mesh.target), strict=True)
        ]
        pair = MeshPair(ends[0], ends[1], rank[mesh.quads], rank[mesh.triangles])
        samples = outlines.samples(SAMPLES)
        kept = np.abs(samples.w[:, None] - w).argmin(axis=0)
    return RingMatch(source, target, False, matching, outlines, samples, kept, pair, "given")
