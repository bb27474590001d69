"""Figures of all faces between a few nodes in two shapes, put together from what they share.

Thousands of quads lie between the same nodes. What depends on two nodes is tabled, what depends on
three is measured once for each chain of two links, and a quad is two such chains and two corners.
"""

from dataclasses import dataclass
from functools import reduce

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index, Mask, Points
from shapetween.mesh.quality import FaceFigures

__all__ = ["Chains", "Spans"]


@dataclass(frozen=True, slots=True, eq=False)
class Spans:
    """Tables over all pairs of nodes; of n nodes, the pair a, b has the number ``a * n + b``.

    Attributes
    ----------
    count : int
        Number of nodes.
    steps : (2, n * n) complex128
        The way from a to b in each shape.
    inverse : (2, n * n) float64
        One over its length; 0 where the two lie on each other.
    spread : (n * n,) float64
        Sum of its squared lengths in the two shapes.
    overlap : (n * n,) complex128
        The way in the source, conjugate, times that in the target.
    """

    count: int
    steps: Complex
    inverse: Floats
    spread: Floats
    overlap: Complex

    @classmethod
    def of(cls, points: Points) -> "Spans":
        """Measure the pairs of nodes, (2, n, 2)."""
        z = points[..., 0] + 1j * points[..., 1]
        steps = (z[:, None] - z[:, :, None]).reshape(2, -1)
        squared = steps.real**2 + steps.imag**2
        inverse = np.sqrt(np.where(squared > 0, 1 / np.where(squared > 0, squared, 1.0), 0.0))
        return cls(
            points.shape[1], steps, inverse, squared[0] + squared[1], steps[0].conj() * steps[1]
        )

    def among(self, kept: Mask) -> "Spans":
        """The tables of some of the nodes."""
        pairs = np.flatnonzero(kept[:, None] & kept)
        return Spans(
            int(kept.sum()),
            self.steps.take(pairs, axis=1),
            self.inverse.take(pairs, axis=1),
            self.spread[pairs],
            self.overlap[pairs],
        )

    def pairs(self, first: Index, last: Index) -> Index:
        """Numbers of pairs of nodes."""
        return first * self.count + last

    def turns(self, reaching: Index, leaving: Index) -> tuple[Floats, Floats]:
        """How corners between two pairs turn.

        Parameters
        ----------
        reaching, leaving : (C,) intp
            Numbers of the pairs a, b and b, c.

        Returns
        -------
        turns : (2, C) float64
            Twice the area of a, b, c in each shape.
        sine : (C,) float64
            The lesser sine of the angle at b in the two.
        """
        turns = np.stack([(way[reaching].conj() * way[leaving]).imag for way in self.steps])
        sines = [
            turn * inverse[reaching] * inverse[leaving]
            for turn, inverse in zip(turns, self.inverse, strict=True)
        ]
        return turns, np.minimum(*sines)


@dataclass(frozen=True, slots=True, eq=False)
class Chains:
    """Chains of two links between nodes, i, k, l, measured at their middle and as triangles.

    Attributes
    ----------
    spans : Spans
    nodes : (3, C) intp
    sine : (C,) float64
        Least sine of the turn at k in the two shapes.
    ratio : (C,) float64
        Area of the triangle in the target over that in the source, where both are positive.
    area : (C,) float64
        Mean area of the triangle.
    spread, overlap : (C,) float64, complex128
        Sums of these over its three sides.
    """

    spans: Spans
    nodes: Index
    sine: Floats
    ratio: Floats
    area: Floats
    spread: Floats
    overlap: Complex

    @classmethod
    def of(cls, spans: Spans, nodes: Index, least: float) -> "Chains":
        """Measure those of some chains, (3, C), that turn by at least some sine in both shapes."""
        a, b, c = nodes
        turns, sine = spans.turns(spans.pairs(a, b), spans.pairs(b, c))
        kept = np.flatnonzero(sine >= least)
        nodes, turns, sine = nodes.take(kept, axis=1), turns.take(kept, axis=1), sine[kept]
        a, b, c = nodes
        sides = [spans.pairs(a, b), spans.pairs(b, c), spans.pairs(a, c)]
        return cls(
            spans,
            nodes,
            sine,
            _ratio(turns),
            _area(turns),
            reduce(np.add, [spans.spread[side] for side in sides]),
            reduce(np.add, [spans.overlap[side] for side in sides]),
        )

    def among(self, kept: Mask) -> "Chains":
        """Those between some of the nodes, which are numbered anew."""
        within = np.flatnonzero(kept[self.nodes].all(axis=0))
        number = np.cumsum(kept) - 1
        return Chains(
            self.spans.among(kept),
            number[self.nodes.take(within, axis=1)],
            self.sine[within],
            self.ratio[within],
            self.area[within],
            self.spread[within],
            self.overlap[within],
        )

    def triangle_figures(self, chains: Index) -> FaceFigures:
        """Figures of the triangles of some chains, (T,), as `face_figures` has them."""
        a, b, c = (corner[chains] for corner in self.nodes)
        ab, bc, ca = (self.spans.pairs(*pair) for pair in ((a, b), (b, c), (c, a)))
        sine = np.minimum(self.spans.turns(bc, ca)[1], self.spans.turns(ca, ab)[1])
        sine = np.minimum(sine, self.sine[chains])
        perspective = np.where(sine > 0, 1.0, np.inf)
        misfit = (self.spread[chains] - 2 * abs(self.overlap[chains])) / 3
        return FaceFigures(sine, perspective, self.area[chains], misfit)

    def quad_figures(self, first: Index, second: Index) -> FaceFigures:
        """Figures of quads a, b, c, d, as `face_figures` has them.

        Parameters
        ----------
        first, second : (Q,) intp
            Numbers of the chains a, b, c and b, c, d.
        """
        spans = self.spans
        a, b, c = (corner[first] for corner in self.nodes)
        d = self.nodes[2][second]
        da = spans.pairs(d, a)
        at_d, at_a = spans.turns(spans.pairs(c, d), da), spans.turns(da, spans.pairs(a, b))
        sines = [self.sine[first], self.sine[second], at_d[1], at_a[1]]
        ratios = [self.ratio[first], self.ratio[second], _ratio(at_d[0]), _ratio(at_a[0])]
        sine = reduce(np.minimum, sines)
        convex = sine > 0
        high, low = reduce(np.maximum, ratios), reduce(np.minimum, ratios)
        perspective = np.where(convex, high / np.where(convex, low, 1.0), np.inf)

        # Of the six pairs of corners two are diagonals, a-c and b-d, and b-c is in both chains.
        bc = spans.pairs(b, c)
        spread = self.spread[first] + self.spread[second] + spans.spread[da] - spans.spread[bc]
        overlap = self.overlap[first] + self.overlap[second] + spans.overlap[da]
        overlap -= spans.overlap[bc]
        misfit = (spread - 2 * abs(overlap)) / 4
        return FaceFigures(sine, perspective, self.area[first] + _area(at_d[0]), misfit)


def _ratio(turns: Floats) -> Floats:
    """Area in the target over that in the source, for triangles with two positive areas."""
    return np.asarray(turns[1] / np.where(turns[0] > 0, turns[0], 1.0))


def _area(turns: Floats) -> Floats:
    """Mean area of triangles in the two shapes."""
    return np.asarray((turns[0] + turns[1]) / 4)
