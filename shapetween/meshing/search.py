"""The search for a mesh: which samples become nodes, and which quads lie between them.

The price of a mesh adds up over its faces and sides, so that one dissection finds the cheapest:
quads cost little where they are few, sound and alike in both shapes; what no quad that moves well
covers costs its share of the area.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Index, Mask, Points
from shapetween.geometry.polygon import cross
from shapetween.meshing.contour import Contours, arc_waste, outside_lengths, settled
from shapetween.meshing.dissection import Dissection, completed_quads, dissect, linked_faces
from shapetween.meshing.quality import MIN_CORNER_SINE, FaceFigures, face_figures

__all__ = ["LEVELS", "Level", "Search", "quad_prices", "side_prices"]

#: Price of a quad. Larger, and limbs are left to the sides; smaller, and shapes fall to crumbs.
QUAD_PRICE = 0.5

#: Price of the whole area where no quad that moves well covers it.
UNCOVERED_PRICE = 100.0

#: Price of a quad that does not move well, besides its area.
UNUSABLE_PRICE = 1.5

#: Price of a triangle, besides its area.
TRIANGLE_PRICE = 1.5

#: Corner sine above which a quad costs nothing for its corners, and the price at sine 0.
ROUND_SINE, SHARP_PRICE = 0.6, 3.0

#: Price of log w_max / w_min squared: at a ratio of 4 it is one quad.
PERSPECTIVE_PRICE = 0.25

#: Price of what is left between the two shapes of a quad after the best rotation.
MISFIT_PRICE = 1.0

#: Price of a chord's length, so that of two dissections the one with shorter ribs is taken.
LENGTH_PRICE = 0.3

#: Price of chord length outside a shape. Smaller, and chords are taken that must be dropped when
#: the mesh is mended; larger, and good ones are lost that graze a ripple of the outline.
OUTSIDE_PRICE = 60.0

#: Price of a face that is not convex in both shapes and has to be cut anew, besides its area; and
#: of how far it is from convex, in sines.
BROKEN_PRICE, BENT_PRICE = 15.0, 4.0

#: Most quads priced in one search, about: a microsecond each. Shapes without limbs reach it, as
#: all chords stay inside them, and they need few nodes.
QUAD_LIMIT = 250_000

#: Share of the candidates kept when there are too many quads.
THINNING = 0.85


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
        Whether faces that are not convex in both shapes are taken too, to be mended later.
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


def quad_prices(figures: FaceFigures, quad_price: float = QUAD_PRICE) -> Floats:
    """Price of every quad, whatever its links cost."""
    sharp = np.clip(1 - figures.sine / ROUND_SINE, 0, 1)
    perspective = np.log(np.minimum(figures.perspective, 100.0)) ** 2
    return settled(
        quad_price
        + SHARP_PRICE * sharp**2
        + PERSPECTIVE_PRICE * np.minimum(perspective, 8.0)
        + MISFIT_PRICE * figures.misfit
        + ~figures.usable * (UNUSABLE_PRICE + UNCOVERED_PRICE * figures.area)
        + _broken_prices(figures)
    )


def triangle_prices(figures: FaceFigures) -> Floats:
    """Price of every triangle, whatever its links cost."""
    return settled(TRIANGLE_PRICE + UNCOVERED_PRICE * abs(figures.area) + _broken_prices(figures))


def _broken_prices(figures: FaceFigures) -> Floats:
    bend = MIN_CORNER_SINE - figures.sine
    return np.where(bend > 0, BROKEN_PRICE + BENT_PRICE * bend, 0.0)


def side_prices(waste: Floats) -> Floats:
    """Price of sides that waste so much of each shape, (2, ...) to (...)."""
    return settled(UNCOVERED_PRICE * waste.mean(axis=0))


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
    def over(cls, contours: Contours, candidates: Index, level: Level) -> "Search":
        """Price all faces between candidates, or between as many as there is time for.

        Parameters
        ----------
        contours : Contours
        candidates : (n,) intp
            Samples, most important first; the first becomes a node for certain.
        level : Level
        """
        anchor = candidates[0]
        order = np.argsort((candidates - anchor - 1) % len(contours), kind="stable")
        nodes = candidates[order]
        prices = _link_prices(contours, nodes, level)
        while True:
            points = contours.points[:, nodes]
            sides, chords, closing = prices
            links = np.isfinite(sides) | np.isfinite(chords)
            lids = np.isfinite(chords)
            lids[:, -1] |= np.isfinite(closing)
            triangles, chains = linked_faces(links, lids)
            if not level.broken:
                chains = chains[_bent(points, chains)]
            if links.sum(axis=1)[chains[:, 2]].sum() <= QUAD_LIMIT:
                break
            kept = order < THINNING * len(order)
            nodes = nodes[kept]
            order = order[kept]
            prices = sides[np.ix_(kept, kept)], chords[np.ix_(kept, kept)], closing[kept]
        quads = completed_quads(chains, links, lids)
        of_quads, of_triangles = face_figures(points[:, quads]), face_figures(points[:, triangles])
        quad_costs, triangle_costs = quad_prices(of_quads, 0.0), triangle_prices(of_triangles)
        if not level.broken:
            sound = of_quads.sine >= MIN_CORNER_SINE
            quads, quad_costs = quads[sound], quad_costs[sound]
            sound = of_triangles.sine >= MIN_CORNER_SINE
            triangles, triangle_costs = triangles[sound], triangle_costs[sound]
        return cls(nodes, sides, chords, closing, quads, quad_costs, triangles, triangle_costs)

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


def _link_prices(contours: Contours, nodes: Index, level: Level) -> tuple[Floats, Floats, Floats]:
    """Prices of all pairs of nodes as sides and as chords, and of sides on from the last node."""
    count = len(nodes)
    i, j = np.triu_indices(count, 1)
    waste = np.full((2, count, count), np.inf)
    waste[:, i, j] = arc_waste(contours, nodes[i], nodes[j])
    round_on = arc_waste(contours, np.full(count, nodes[-1]), nodes)
    sides, closing = (
        np.where((w < level.side).all(axis=0), side_prices(w), np.inf) for w in (waste, round_on)
    )
    closing[-1] = np.inf

    points = contours.points[:, nodes]
    outside = outside_lengths(contours.points, nodes)
    lengths = np.sqrt(((points[:, :, None] - points[:, None]) ** 2).sum(-1))
    chords = settled(OUTSIDE_PRICE * outside.sum(axis=0) + LENGTH_PRICE * lengths.sum(axis=0))
    return sides, np.where((outside < level.outside).all(axis=0), chords, np.inf), closing


def _bent(points: Points, chains: Index) -> Mask:
    """Which chains of three corners turn enough to be part of a quad, in both shapes."""
    a, b, c = (points[:, chains[:, corner]] for corner in range(3))
    to, on = b - a, c - b
    size = np.sqrt((to**2).sum(-1) * (on**2).sum(-1))
    return np.asarray((cross(to, on) >= MIN_CORNER_SINE * size).all(axis=0))
