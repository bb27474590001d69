"""What is done to shapes together after they are painted: opacity, blending, filters, masks.

A group is what SVG calls so: shapes next to each other in paint order, drawn apart and then laid
on what is below as one picture. Every shape carries the groups that it is in.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from shapetween.model.drawing import Shape

__all__ = ["Filter", "Group", "Mask", "Primitive"]


@dataclass(frozen=True, slots=True)
class Primitive:
    """One step of a filter, or a part of one, as SVG writes it.

    Attributes
    ----------
    tag : str
    attributes : tuple of (str, str)
    children : tuple of Primitive
    lengths : tuple of (str, tuple of float)
        Attributes that are lengths in user units, and grow with the drawing.
    """

    tag: str
    attributes: tuple[tuple[str, str], ...]
    children: tuple[Primitive, ...] = ()
    lengths: tuple[tuple[str, tuple[float, ...]], ...] = ()


@dataclass(frozen=True, slots=True)
class Filter:
    """Steps that make a picture of the picture of a group.

    Attributes
    ----------
    primitives : tuple of Primitive
        At least one.
    region : (float, float, float, float)
        x, y, width and height of what is kept.
    in_box : bool
        Whether those are shares of the box around what is drawn; else lengths.
    box_units : bool
        The same for lengths in the primitives.
    matrix : tuple of float
        a, b, c, d, e, f of the map from the units of those lengths to user units.
    """

    primitives: tuple[Primitive, ...]
    region: tuple[float, float, float, float]
    in_box: bool
    box_units: bool
    matrix: tuple[float, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Mask:
    """Shapes whose brightness says how much is shown: all where they are white, nothing else.

    Attributes
    ----------
    shapes : tuple of Shape
        In paint order, in user units.
    plain : bool
        Whether they are one area, all white: a clip.
    """

    shapes: tuple[Shape, ...]
    plain: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """What is done to all shapes of a group: first the filter, then the masks, then the rest.

    Attributes
    ----------
    key : object
        Equal for all shapes that are in the group, and for no others.
    opacity : float
    blend : str
        A ``mix-blend-mode``.
    isolated : bool
        Whether what blends inside does not see what is below.
    filter : Filter or None
    masks : tuple of Mask
    share : float
        How much of all that is done, from 0 to 1.
    """

    key: object
    opacity: float = 1.0
    blend: str = "normal"
    isolated: bool = False
    filter: Filter | None = None
    masks: tuple[Mask, ...] = ()
    share: float = 1.0
