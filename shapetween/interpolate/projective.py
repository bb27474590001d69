"""The projective methods: every quad by its homography, the whole by force equilibrium.

.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007.
"""

from abc import ABC, abstractmethod
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Floats, Index, Points, times
from shapetween.geometry.homography import triangle_affinities
from shapetween.geometry.polygon import corner_sines, polygon_area
from shapetween.geometry.rotation import coherent_angles, linear_between, polar
from shapetween.interpolate.align import Alignment
from shapetween.interpolate.faces import (
    both_areas,
    check_triangles,
    connected_parts,
    shared_edges,
)
from shapetween.interpolate.quads import QuadMotion, check_quads
from shapetween.interpolate.rigid import RigidFaces
from shapetween.mesh.pair import MeshPair

__all__ = ["AlignedFaces", "PaperProjective", "Projective"]

#: Source radius at which the paper's line turns. The paper warns of small ones, which bend the
#: movement of every quad; from 10 on it is the limit's but for some ten-thousandths.
PAPER_SCALE = 10.0

#: Even times at which a quad is looked at before it is moved rigidly.
LOOKS = 33

#: Least corner sine on the way, as a share of the least at the ends. 0 lets quads be as good as
#: triangles, where homographies throw their inside about; larger leaves more quads to `QuadMotion`.
KEPT_SINE = 0.25


#: Corners at all times that are moved in one go. More take memory by the gigabyte, and no longer
#: fit in a processor's cache; with fewer most of the time goes to calls.
AT_ONCE = 100_000


class AlignedFaces(ABC):
    """Faces moved alone, then pulled together into one mesh: [WKD07]_, section 5."""

    def __init__(self, pair: MeshPair, weights: Floats) -> None:
        self.pair = pair
        self._alignment = Alignment(pair, weights)

    @abstractmethod
    def loose_corners(self, t: Floats) -> Points:
        """Corners of every face moved on its own, face after face, (F, C, 2)."""

    def vertices(self, t: ArrayLike) -> Points:
        """All vertices at the times (F,), shape (F, V, 2); exactly the pair's own at 0 and 1."""
        moments = times(t)
        some = max(1, AT_ONCE // max(self.pair.quads.size + self.pair.triangles.size, 1))
        result = np.zeros((len(moments), *self.pair.source.shape))
        for first in range(0, len(moments), some):
            now = np.s_[first : first + some]
            result[now] = self._alignment.vertices(self.loose_corners(moments[now]))
        result[moments == 0] = self.pair.source
        result[moments == 1] = self.pair.target
        return result

    def residual(self, t: ArrayLike) -> Floats:
        """How much the faces disagree after alignment, root mean square in user units, (F,)."""
        corners = self.loose_corners(times(t))
        return self._alignment.residual(corners, self._alignment.vertices(corners))


class Projective(AlignedFaces):
    """A mesh pair moved projectively, its corners as rigidly as they can be.

    Parameters
    ----------
    pair : MeshPair
        Quads convex and turning the same way at both ends; triangles move affinely.

    Raises
    ------
    DegenerateQuadError
        If a quad has no projective in-between.
    MeshError
        If a triangle has no area at one end, or is inverted.

    Notes
    -----
    [WKD07]_ ends on the question where to put a quad's source. Here the homography's own
    in-between is not used for the corners at all: these turn rigidly and change their shape
    evenly (`RigidFaces`), and the homography onto them then carries what is inside. It is nearer
    to what really happens in everything that was tried, and the way back is the same. A quad that
    would lose its convexity on the way follows the paper throughout, from whichever of its ends
    is the squarer, which no quad can lose its convexity by.
    """

    def __init__(self, pair: MeshPair) -> None:
        check_quads(pair.source[pair.quads], pair.target[pair.quads])
        check_triangles(pair)
        faces = [pair.quads, pair.triangles]
        parts = connected_parts(faces, len(pair.source))
        weights = both_areas(pair, faces, parts)
        super().__init__(pair, weights)
        self._quads, self._triangles = RigidFaces.of(pair, weights, parts)
        ends, between = self._least_sines()
        bad = between < KEPT_SINE * ends.min(axis=0)
        forward = ends[0] >= ends[1]
        self._others = [
            (chosen, _paper_motion(self._quads, chosen, backward), backward)
            for backward in (False, True)
            if len(chosen := np.flatnonzero(bad & (forward ^ backward)))
        ]

    def _least_sines(self) -> tuple[Floats, Floats]:
        """Least corner sine of each quad at both ends, (2, Q), and at any time, (Q,)."""
        moments = np.linspace(0, 1, LOOKS)
        some = max(1, AT_ONCE // max(self.pair.quads.size, 1))
        turning: Floats = np.zeros(0)
        rows = []
        for first in range(0, LOOKS, some):
            looks = corner_sines(self._quads.turned(moments[first : first + some]))  # (F, Q, 4)
            if first == 0:
                turning = np.sign(looks[:1].sum(axis=-1, keepdims=True))
            rows.append((looks * turning).min(axis=-1))
        least = np.concatenate(rows)  # (F, Q)
        return least[[0, -1]], least.min(axis=0)

    def loose_corners(self, t: Floats) -> Points:
        """Corners of every face moved on its own, face after face, (F, C, 2)."""
        quads, triangles = self._quads.turned(t), self._triangles.turned(t)
        for chosen, motion, backward in self._others:
            start = (self._quads.target if backward else self._quads.source)[chosen]
            quads[:, chosen] = motion.corners(start, 1 - t if backward else t)
        quads, triangles = self._quads.placed(quads, t), self._triangles.placed(triangles, t)
        frames = len(t)
        return np.concatenate(
            [quads.reshape(frames, -1, 2), triangles.reshape(frames, -1, 2)], axis=1
        )


def _paper_motion(quads: RigidFaces, chosen: Index, backward: bool) -> QuadMotion:
    """Motion of some quads by [WKD07]_, turning the same way round as they would rigidly."""
    start, end, wanted = quads.source[chosen], quads.target[chosen], quads.angles[chosen]
    if backward:
        start, end, wanted = end, start, -wanted
    motion = QuadMotion.between(start, end)
    turn = 2 * np.pi
    return replace(motion, angles=motion.angles + turn * np.round((wanted - motion.angles) / turn))


class PaperProjective(AlignedFaces):
    """A mesh pair moved by the paper's own form of the projective method.

    Parameters
    ----------
    pair : MeshPair
        Quads convex and turning the same way at both ends; triangles move affinely.
    scale : float or None
        Source radius of the paper's turning line (see `interpolate_quads`); None for the limit of
        an infinite one.

    Raises
    ------
    DegenerateQuadError
        If a quad has no projective in-between.
    MeshError
        If a triangle has no area at one end, or is inverted.

    Notes
    -----
    [WKD07]_, sections 3 to 5. Rotation angles are made coherent over the mesh first; the paper
    takes each alone, and quads near a half turn then part ways.
    """

    def __init__(self, pair: MeshPair, scale: float | None = PAPER_SCALE) -> None:
        check_triangles(pair)
        quads, triangles = pair.quads, pair.triangles
        motion = QuadMotion.between(pair.source[quads], pair.target[quads], scale)
        areas = np.concatenate([np.abs(polygon_area(pair.source[f])) for f in (quads, triangles)])
        super().__init__(pair, areas)
        p, q = pair.source[triangles], pair.target[triangles]
        angles, self._stretches = polar(triangle_affinities(p, q))
        edges = shared_edges([f for f in (quads, triangles) if len(f)])
        angles = coherent_angles(np.concatenate([motion.angles, angles]), edges, areas)
        self._motion = replace(motion, angles=angles[: len(quads)])
        self._angles = angles[len(quads) :]

    def loose_corners(self, t: Floats) -> Points:
        """Corners of every face moved on its own, face after face, (F, C, 2)."""
        frames = len(t)
        corners = self._motion.corners(self.pair.source[self.pair.quads], t)
        p, q = self.pair.source[self.pair.triangles], self.pair.target[self.pair.triangles]
        centre, end = p.mean(axis=1, keepdims=True), q.mean(axis=1, keepdims=True)
        linear = linear_between(self._angles, self._stretches, t)
        moved = (p - centre) @ np.swapaxes(linear, -1, -2)
        moved += centre + t[:, None, None, None] * (end - centre)
        return np.concatenate(
            [corners.reshape(frames, -1, 2), moved.reshape(frames, -1, 2)], axis=1
        )
