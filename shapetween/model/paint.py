"""How a shape is painted: colours, gradients and strokes, and what is done to shapes together.

A group is what SVG calls so: shapes next to each other in paint order, drawn apart and then laid
on what is below as one picture, with opacity, blending, filters and masks. Every shape carries the
groups that it is in. A mask is made of shapes, and so is a pattern: that is why shapes are here.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from shapetween.model.outline import Outline

__all__ = [
    "Colour",
    "FillRule",
    "Filter",
    "Gradient",
    "Group",
    "Mask",
    "Paint",
    "Pattern",
    "Primitive",
    "Shape",
    "Stop",
    "Stroke",
    "Style",
    "Texture",
]

FillRule: TypeAlias = Literal["nonzero", "evenodd"]


@dataclass(frozen=True, slots=True)
class Colour:
    """An sRGB colour, not premultiplied, every component from 0 to 1.

    Where it is the page's to choose, `reference` is what asks for it, as ``currentColor``; the
    components are then what it is where the page says nothing.
    """

    red: float = 0.0
    green: float = 0.0
    blue: float = 0.0
    alpha: float = 1.0
    reference: str = ""


@dataclass(frozen=True, slots=True)
class Stop:
    """A gradient's colour at an offset from 0 to 1."""

    offset: float
    colour: Colour


@dataclass(frozen=True, slots=True)
class Gradient:
    """A linear or radial gradient in the drawing's own units.

    Attributes
    ----------
    kind : {"linear", "radial"}
    points : tuple of float
        x1, y1, x2, y2 of a linear gradient; cx, cy, r, fx, fy of a radial one.
    matrix : tuple of float
        a, b, c, d, e, f of the map from those points to user units.
    stops : tuple of Stop
    spread : {"pad", "reflect", "repeat"}
    """

    kind: Literal["linear", "radial"]
    points: tuple[float, ...]
    matrix: tuple[float, ...]
    stops: tuple[Stop, ...]
    spread: Literal["pad", "reflect", "repeat"] = "pad"


Paint: TypeAlias = Colour | Gradient | None
"""What fills an area; None leaves it unpainted."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A painted line of a certain width, in user units."""

    paint: Colour | Gradient
    width: float = 1.0
    cap: Literal["butt", "round", "square"] = "butt"
    join: Literal["miter", "round", "bevel"] = "miter"
    miter_limit: float = 4.0
    dashes: tuple[float, ...] = ()
    dash_offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Texture:
    """A picture or a pattern, as the SVG that draws it; only drawings read for pictures have any.

    Attributes
    ----------
    name : str
        What errors call the file.
    root : str
        Attributes of the document's root, as text.
    definitions : str
        What the document holds, as text; none of it is drawn by itself.
    element : str
        What draws the texture, as text, over and around the area that it fills.
    matrix : tuple of float
        a, b, c, d, e, f of the map from the element's coordinates to user units.
    size : (float, float)
        Width and height that percentages are of.
    """

    name: str
    root: str
    definitions: str
    element: str
    matrix: tuple[float, ...]
    size: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Pattern:
    """A tile that fills an area over and over.

    Attributes
    ----------
    tile : (float, float)
        Width and height.
    matrix : tuple of float
        a, b, c, d, e, f of the map from the tile's corner and units to user units.
    alpha : float
    text : str
        The tile's content as it was written; two are alike if they have the same.
    shapes : tuple of Shape
        That content, from the tile's own corner on.
    """

    tile: tuple[float, float]
    matrix: tuple[float, ...]
    alpha: float
    text: str
    shapes: tuple[Shape, ...] = field(compare=False)


@dataclass(frozen=True, slots=True)
class Style:
    """Everything that paints one shape.

    A texture fills it where pictures are made, a pattern where SVG is written; anywhere else, and
    beside other paints, `fill` stands for it. `groups` are those that the shape is in, the
    outermost first. `crisp` says that edges are drawn without shades, so that none show where
    shapes meet.
    """

    fill: Paint = field(default_factory=Colour)
    stroke: Stroke | None = None
    opacity: float = 1.0
    fill_rule: FillRule = "nonzero"
    texture: Texture | None = None
    pattern: Pattern | None = None
    groups: tuple[Group, ...] = ()
    crisp: bool = False


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


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Rings that are filled or stroked together, as one path.

    Attributes
    ----------
    rings : tuple of Outline
        In the drawing's user units, all transforms applied.
    style : Style
    name : str
        The element's ``id``, else its label, else empty.
    """

    rings: tuple[Outline, ...]
    style: Style
    name: str = ""
