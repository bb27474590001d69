"""What an item is cut into, and how a run is taken out of an outline."""

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from shapetween.model.outline import Outline
from shapetween.scene.items import Item
from shapetween.scene.places import Places, cut_alike

__all__ = ["Division", "Found", "piece_of", "run_of"]


@dataclass(frozen=True, slots=True, eq=False)
class Division:
    """The pieces of an item.

    Attributes
    ----------
    pieces : list of Item
        In paint order.
    pairs : list of (Item, int)
        Which pieces become which items of the other drawing.
    """

    pieces: list[Item]
    pairs: list[tuple[Item, int]]


Found: TypeAlias = dict[int, Division]
"""Divisions by item."""


def run_of(places: Places, start: float, end: float) -> Outline:
    """An outline's part between two shares, ``start < end``, past its start if it is closed."""
    if not places.outline.closed:
        knots = np.unique(np.array([0.0, start, end, 1.0]))
        curves = cut_alike(places, places, knots, knots).source
        own = Places(Outline(curves, False))
        first = int(np.abs(own.joints - start).argmin())
        last = int(np.abs(own.joints - end).argmin())
        return Outline(curves[first : max(last, first + 1)], False)
    knots = np.array([start, end, start + 1.0])
    curves = cut_alike(places, places, knots, knots).source
    own = Places(Outline(curves, False))
    last = int(np.abs(own.joints - (end - start)).argmin())
    return Outline(curves[: max(last, 1)], False)


def piece_of(item: Item, ring: Outline) -> Item:
    """A piece of a line."""
    return replace(item, rings=(ring,))
