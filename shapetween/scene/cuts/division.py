"""What an item is cut into, and which pieces become what."""

from dataclasses import dataclass, replace
from typing import TypeAlias

from shapetween.model.outline import Outline
from shapetween.scene.items import Item

__all__ = ["Division", "Found", "piece_of"]


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


def piece_of(item: Item, ring: Outline) -> Item:
    """A piece of a line."""
    return replace(item, rings=(ring,), cut=True)
