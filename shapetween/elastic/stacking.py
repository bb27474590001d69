"""The order in which shapes of two drawings are painted while one becomes the other.

It stays the same on the way, so it must serve both ends: what covers something in either drawing
is painted after it. Where two drawings contradict each other, a shape is painted in two places,
half of the time in each.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.elastic.pairing import Pairing
from shapetween.elastic.silhouette import Areas

__all__ = ["Layer", "stacked"]

#: Share of the smaller of two shapes that must be covered for their order to matter.
COVERED = 1e-3


@dataclass(frozen=True, slots=True)
class Layer:
    """A place in the order of painting.

    Attributes
    ----------
    source, target : int or None
        The shapes of both drawings that become each other there; None if there is no such shape.
    shown : (float, float)
        From when until when the shape is painted here.
    """

    source: int | None
    target: int | None
    shown: tuple[float, float] = (0.0, 1.0)


def stacked(areas: tuple[Areas, Areas], pairing: Pairing) -> list[Layer]:
    """Places of all pairs, and of shapes without a partner, the last on top.

    Parameters
    ----------
    areas : ((N,), (M,)) of shapely.Geometry
        What the shapes of both drawings cover, in paint order.
    pairing : Pairing

    Notes
    -----
    Both drawings' orders are kept wherever shapes overlap in them; beyond that it is the first
    drawing's order, and newcomers follow what they follow in their own drawing.
    """
    import shapely

    wished = _wished(len(areas[0]), pairing)
    laps = [_overlaps(side) for side in areas]
    sizes = [shapely.area(side) for side in areas]
    twice: set[tuple[int | None, int | None]] = set()
    while True:
        layers = [layer for item in wished for layer in _layers(*item, twice=item in twice)]
        graph = _Graph(len(layers))
        met = True
        for end, lap in enumerate(laps):
            own = {
                (layer.source, layer.target)[end]: k
                for k, layer in enumerate(layers)
                if layer.shown[end] == end
            }
            for under, over in lap:
                circle = graph.put(own[under], own[over])
                pairs = [
                    (max(sizes[0][i], sizes[1][j]), i, j)
                    for i, j in ((layers[k].source, layers[k].target) for k in circle)
                    if i is not None and j is not None and (i, j) not in twice
                ]
                if pairs:
                    # The smallest that is painted in two places opens the circle with least ado.
                    _, *item = min(pairs)
                    twice.add((item[0], item[1]))
                    met = False
        if met:
            return [layers[k] for k in graph.order()]


def _layers(source: int | None, target: int | None, *, twice: bool) -> tuple[Layer, ...]:
    if not twice:
        return (Layer(source, target),)
    return Layer(source, target, (0.0, 0.5)), Layer(source, target, (0.5, 1.0))


class _Graph:
    """What must be painted before what."""

    def __init__(self, count: int) -> None:
        self._above: list[set[int]] = [set() for _ in range(count)]
        self._below: list[set[int]] = [set() for _ in range(count)]

    def put(self, under: int, over: int) -> list[int]:
        """Demand that one is painted after another; what of the opposite follows already."""
        before: dict[int, int] = {over: over}
        todo = [over]
        while todo and under not in before:
            here = todo.pop()
            for k in sorted(self._above[here] - before.keys()):
                before[k] = here
                todo.append(k)
        if under in before:
            path = [under]
            while path[-1] != over:
                path.append(before[path[-1]])
            return path
        self._above[under].add(over)
        self._below[over].add(under)
        return []

    def order(self) -> list[int]:
        """All in an order that meets every demand, the first that may come first."""
        order: list[int] = []
        placed: set[int] = set()
        while len(order) < len(self._below):
            rest = (k for k in range(len(self._below)) if k not in placed)
            free = next(k for k in rest if self._below[k] <= placed)
            order.append(free)
            placed.add(free)
        return order


def _wished(count: int, pairing: Pairing) -> list[tuple[int | None, int | None]]:
    """The first drawing's order, newcomers above what they follow."""
    partner = dict(pairing.pairs)
    items: list[tuple[int | None, int | None]] = [(i, partner.get(i)) for i in range(count)]
    held = {j: i for i, j in pairing.pairs}
    below: tuple[int | None, int | None] | None = None
    for j in sorted([*held, *pairing.second_only]):
        if j in held:
            below = (held[j], j)
            continue
        place = items.index(below) + 1 if below is not None else 0
        items.insert(place, (None, j))
        below = (None, j)
    return items


def _overlaps(areas: Areas) -> list[tuple[int, int]]:
    """Pairs of areas that overlap, the lower first."""
    import shapely

    lower, upper = shapely.STRtree(areas).query(areas, predicate="intersects")
    lower, upper = lower[lower < upper], upper[lower < upper]
    common = shapely.area(shapely.intersection(areas[lower], areas[upper]))
    least = np.minimum(shapely.area(areas[lower]), shapely.area(areas[upper]))
    matter = common > COVERED * least
    return sorted(zip(lower[matter].tolist(), upper[matter].tolist(), strict=True))
