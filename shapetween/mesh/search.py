"""The search for a mesh: which samples become nodes, and which quads lie between them.

The price of a mesh adds up over its faces and sides, so that one dissection finds the cheapest.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.mesh.contour import Contours, arc_waste, outside_lengths, rounded
from shapetween.mesh.dissection import Dissection, dissect, joined_chains, linked_chains
from shapetween.mesh.prices import QUAD_PRICE, quad_prices, side_prices, triangle_prices
from shapetween.mesh.quality import MIN_CORNER_SINE, FaceFigures
from shapetween.mesh.spans import Chains, Spans

__all__ = ["LEVELS", "Level", "Links", "Search"]

#: Price of a chord's length, so that of two dissections the one with shorter ribs is taken.
LENGTH_PRICE = 0.3

#: Price of chord length outside a shape. Smaller, and chords are taken that must be dropped when
#: the mesh is repaired; larger, and good ones are lost that graze a ripple of the outline.
OUTSIDE_PRICE = 60.0

#: Most quads priced in one search, about: a microsecond each. Shapes without limbs reach it, as
#: all chords stay inside them, and they need few nodes.
QUAD_LIMIT = 150_000

#: Faces measured at once. More fall out of the processor's caches and take twice as long.
AT_ONCE = 5000


@dataclass(frozen=True, slots=True)
class Level:
    """What a search may use.

    Attributes
    ----------
    name : str
    outside : float
        Most length of a chord outside either shape, which has an area of 1.
    side : float
        Most that one side may waste of a shape, as a share of its area.
    broken : bool
        Whether faces that are not convex in both shapes are taken too, to be repaired later.
    """

    name: str
    outside: float
    side: float
    broken: bool


#: Searches in the order tried; the first that finds a mesh is taken.
LEVELS = (
    Level("strict", 0.05, 0.12, False),
    Level("wide", 0.05, 0.3, False),
    Level("loose", 0.3, 0.8, True),
)


@dataclass(frozen=True, slots=True, eq=False)
class Links:
    """All pairs of candidates, measured as sides and as chords.

    Attributes
    ----------
    nodes : (n,) intp
        Candidates, as samples, in cyclic order; the last one is a node for certain.
    rank : (n,) intp
        How important each is; 0 the most.
    points : (2, n, 2) float64
    sides : (n, n) float64
        Price of a side between two candidates ``i < j``; infinite elsewhere.
    waste : (n, n) float64
        What such a side wastes of the shape that it wastes more of.
    closing, closing_waste : (n,) float64
        The same of a side from the last candidate round to each one.
    chords : (n, n) float64
        Price of a chord.
    outside : (n, n) float64
        Its length outside the shape that more is outside of; infinite where plainly `most` or more.
    most : float
        Length outside from which on a chord is of no use.
    """

    nodes: Index
    rank: Index
    points: Points
    sides: Floats
    waste: Floats
    closing: Floats
    closing_waste: Floats
    chords: Floats
    outside: Floats
    most: float

    @classmethod
    def between(cls, contours: Contours, candidates: Index, most: float) -> "Links":
        """Measure the pairs of candidates, (n,), of which the first is a node for certain."""
        rank = np.argsort((candidates - candidates[0] - 1) % len(contours), kind="stable")
        nodes = candidates[rank]
        points = contours.points[:, nodes]
        count = len(nodes)
        i, j = np.triu_indices(count, 1)
        wasted = arc_waste(contours, nodes[i], nodes[j])
        sides, waste = np.full((2, count, count), np.inf)
        sides[i, j], waste[i, j] = side_prices(wasted), np.maximum(*wasted)
        wasted = arc_waste(contours, np.full(count, nodes[-1]), nodes)
        wasted[:, -1] = np.inf
        outside = outside_lengths(contours.points, nodes, most)
        dx, dy = (points[:, None, :, axis] - points[:, :, None, axis] for axis in (0, 1))
        length = np.sqrt(dx * dx + dy * dy)
        price = OUTSIDE_PRICE * (outside[0] + outside[1]) + LENGTH_PRICE * (length[0] + length[1])
        return cls(
            nodes,
            rank,
            points,
            sides,
            waste,
            side_prices(wasted),
            np.maximum(*wasted),
            rounded(price),
            np.maximum(*outside),
            most,
        )

    def most_important(self, count: int) -> Mask:
        """Which candidates are among the most important ones, (n,)."""
        return np.asarray(self.rank < np.sort(self.rank)[count])

    def among(self, kept: Mask) -> "Links":
        """The same between some of the candidates."""
        pairs = np.ix_(kept, kept)
        return Links(
            self.nodes[kept],
            self.rank[kept],
            self.points[:, kept],
            self.sides[pairs],
            self.waste[pairs],
            self.closing[kept],
            self.closing_waste[kept],
            self.chords[pairs],
            self.outside[pairs],
            self.most,
        )

    def priced(self, level: Level) -> tuple[Floats, Floats, Floats]:
        """Prices as sides, as chords and as the closing side; infinite where not allowed."""
        return (
            np.where(self.waste < level.side, self.sides, np.inf),
            np.where(self.outside < level.outside, self.chords, np.inf),
            np.where(self.closing_waste < level.side, self.closing, np.inf),
        )


@dataclass(frozen=True, slots=True, eq=False)
class Search:
    """All faces between some candidates, priced but for the price of a quad.

    Attributes
    ----------
    nodes : (n,) intp
        Samples, in cyclic order; the last one is a node for certain.
    sides, chords : (n, n) float64
        Prices of links.
    closing : (n,) float64
        Prices of the side from the last node on to each.
    quads, triangles : (Q, 4), (T, 3) intp
        Numbers of nodes.
    quad_costs, triangle_costs : (Q,), (T,) float64
    """

    nodes: Index
    sides: Floats
    chords: Floats
    closing: Floats
    quads: Index
    quad_costs: Floats
    triangles: Index
    triangle_costs: Floats

    @classmethod
    def over(cls, links: Links, level: Level) -> "Search":
        """Price all faces between candidates, or between as many as there is time for."""
        least = -np.inf if level.broken else MIN_CORNER_SINE
        bounds = np.isfinite(np.minimum(*links.priced(level)[:2]))
        chains = Chains.of(Spans.of(links.points), linked_chains(bounds), least)
        while (expected := bounds.sum(axis=1)[chains.nodes[2]].sum()) > QUAD_LIMIT:
            # The number of quads grows with the fourth power of the number of nodes.
            count = int(len(links.nodes) * (QUAD_LIMIT / expected) ** 0.25)
            kept = links.most_important(count)
            links, chains = links.among(kept), chains.among(kept)
            bounds = bounds[np.ix_(kept, kept)]
        sides, chords, closing = links.priced(level)
        lids = np.isfinite(chords)
        lids[:, -1] |= np.isfinite(closing)
        first, second = joined_chains(chains.nodes, lids)
        price = partial(quad_prices, quad_price=0.0)
        valid, quad_costs = _valid(chains.quad_figures, (first, second), least, price)
        ends = chains.nodes[2][second[valid]]
        quads = np.stack([*chains.nodes[:, first[valid]], ends], axis=1)
        closed = np.flatnonzero(lids[chains.nodes[0], chains.nodes[2]])
        valid, triangle_costs = _valid(chains.triangle_figures, (closed,), least, triangle_prices)
        triangles = chains.nodes[:, closed[valid]].T
        return cls(
            links.nodes, sides, chords, closing, quads, quad_costs, triangles, triangle_costs
        )

    def cheapest(self, quad_price: float = QUAD_PRICE) -> Dissection:
        """The cheapest mesh at a price of a quad, its corners as samples."""
        found = dissect(
            self.sides,
            self.chords,
            self.closing,
            (self.quads, self.quad_costs + quad_price),
            (self.triangles, self.triangle_costs),
        )
        return Dissection(self.nodes[found.quads], self.nodes[found.triangles], found.cost)


def _valid(
    measure: Callable[..., FaceFigures],
    chains: tuple[Index, ...],
    least: float,
    price: Callable[[FaceFigures], Floats],
) -> tuple[Mask, Floats]:
    """Which faces of some chains have corners of at least some sine, and the prices of these."""
    kept, costs = [], []
    for start in range(0, len(chains[0]) + 1, AT_ONCE):
        figures = measure(*(some[start : start + AT_ONCE] for some in chains))
        valid = figures.sine >= least
        kept.append(valid)
        costs.append(price(figures)[valid])
    return np.concatenate(kept), np.concatenate(costs)
