"""How a shape is painted: colours, gradients and strokes, as values."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from shapetween.model.effects import Group

if TYPE_CHECKING:
    from shapetween.model.drawing import Shape

__all__ = [
    "Colour",
    "FillRule",
    "Gradient",
    "Paint",
    "Pattern",
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
    shapes: "tuple[Shape, ...]" = field(compare=False)


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
