"""An SVG file's bytes to a drawing, as browsers draw it.

The stages: bytes to a tree (`xml`), its style (`style`), the walk over what is painted (`walk`),
each element's curves and paint (`figure`). Nothing here opens a file or the network. What cannot
be carried is named in the drawing's warnings.
"""

from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.errors import BudgetError, InputError
from shapetween.geometry.affine import affine
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.svg.read.colours import CURRENT, parse_paint
from shapetween.svg.read.document import Document, Fonts, Pictures, title_of
from shapetween.svg.read.frames import Frame
from shapetween.svg.read.gradients import colour_of
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.painter import Painter, shape_box
from shapetween.svg.read.units import Viewport, common_unit
from shapetween.svg.read.viewbox import parse_view_box
from shapetween.svg.read.walk import walk

__all__ = ["read_svg"]

#: What percentages are of in a document without any size: the size browsers give such an object.
DEFAULT_SIZE = (300.0, 150.0)

#: How far anything is drawn, in sizes of what is shown. Farther and browsers, which count in single
#: precision, lose what is near; nearer and curves that run out of the page would show it.
FAR = 1e4


#: Attributes of the root that are kept: its size, and what it is to the page.
IN_PAGE = frozenset({"width", "height", "preserveAspectRatio", "class", "role"})

#: Attributes that name elements by ids, which need not be in what is written.
NAMING = frozenset(
    {"aria-labelledby", "aria-describedby", "aria-details", "aria-owns", "aria-controls"}
)


def read_svg(
    data: bytes,
    name: str,
    limits: Limits | None = None,
    pictures: Pictures | None = None,
    fonts: Fonts | None = None,
) -> Drawing:
    """Read a whole SVG document.

    Parameters
    ----------
    data : bytes
        The file: SVG text in any encoding it declares, gzipped or not.
    name : str
        What the user calls the file, for messages.
    limits : Limits, optional
        Budgets, by default those that no honest file meets.
    pictures : callable, optional
        Where pictures beside the file are found. If given, shapes keep patterns, and pictures are
        shapes, both with textures that only a picture of the drawing can show.
    fonts : callable, optional
        Where fonts are found. If given, each letter of a text is a shape.

    Returns
    -------
    Drawing
        In the user units of the root's view box. Without one, in the unit that the page's width
        and height are written in, as drawing programs show it: a page of 210mm by 297mm is 210 by
        297; px where they name none, or two. At least one shape. Rings
        that are only filled are closed; stroked ones stay open where they were drawn so.
        ``warnings`` names what the file holds that could not be carried.

    Raises
    ------
    InputError
        If it is not SVG, or nothing in it can be drawn.
    BudgetError
        If it passes one of the limits.
    """
    try:
        return _read(data, name, limits or Limits(), pictures, fonts)
    except (RecursionError, MemoryError):
        raise BudgetError(name, "is nested too deeply or too large to be read") from None


def _read(
    data: bytes, name: str, limits: Limits, pictures: Pictures | None, fonts: Fonts | None
) -> Drawing:
    document = Document(data, name, limits, pictures, fonts)
    root = document.root
    view_box = parse_view_box(root.get("viewBox"))
    if view_box is None and root.get("viewBox", "").strip():
        document.losses.add("its viewBox is malformed or has no area and was left out")
    page = _page(root)
    unit = 1.0 if view_box else common_unit(root.get("width"), root.get("height"))
    seen = view_box or page
    width, height = (seen.width, seen.height) if seen else DEFAULT_SIZE
    pixel = view_box.width / page.width if view_box and page else 1 / unit
    document.shown = Box(seen.x, seen.y, width, height) if seen else Box(0.0, 0.0, width, height)
    if seen:
        document.reach = FAR * max(abs(seen.x), abs(seen.y), width, height)
    written = affine(1 / unit, 0, 0, 1 / unit, 0, 0)
    frame = Frame(written, {}, Viewport(width, height), pixel)
    if seen and not view_box:
        seen = Box(0.0, 0.0, seen.width / unit, seen.height / unit)

    shapes = Painter(document).painted(walk(document, root, frame))
    shown = seen or _drawn_box(shapes) if shapes else None
    sheet = _sheet(document, shown) if shown else None
    losses = document.losses.lines()
    if not shapes:
        nothing = "holds nothing that can be drawn; expected shapes with a fill or a stroke"
        raise InputError(name, "; ".join([nothing, *losses]))
    assert shown is not None  # there are shapes
    if sheet is not None:
        shapes.insert(0, sheet)
    return Drawing(tuple(shapes), shown, title_of(root), tuple(losses), _in_page(root))


def _sheet(document: Document, box: Box) -> Shape | None:
    """What the root's style paints behind the drawing, as a shape that fills what is shown."""
    properties = document.style(document.root)
    text = properties.get("background-color") or properties.get("background", "none")
    value = parse_paint(text)
    if value is None or value.reference or "gradient(" in text.lower():
        if text.strip().lower() not in ("none", "initial", "unset"):
            document.losses.add("a background that is no colour was left out")
        return None
    colour = colour_of(properties, "color") if value.colour == CURRENT else value.colour
    if not isinstance(colour, Colour) or colour.alpha == 0:
        return None
    right, bottom = box.x + box.width, box.y + box.height
    corners = np.array([[box.x, box.y], [right, box.y], [right, bottom], [box.x, bottom]])
    ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
    return Shape((ring,), Style(colour))


def _in_page(root: Element) -> tuple[tuple[str, str], ...]:
    """Attributes of the root that say how it is shown in a page; what names an id is none."""
    return tuple(
        (name, value)
        for name, value in root.items()
        if name in IN_PAGE or (name.startswith("aria-") and name not in NAMING)
    )


def _page(root: Element) -> Box | None:
    """Width and height in px, if the document gives both."""
    sizes = [Viewport(0.0, 0.0).length(root.get(side), 0.0) for side in ("width", "height")]
    width, height = (size or 0.0 for size in sizes)
    return Box(0.0, 0.0, width, height) if width > 0 and height > 0 else None


def _drawn_box(shapes: list[Shape]) -> Box:
    boxes = np.stack([shape_box(shape) for shape in shapes])
    least, greatest = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    return Box(*least.tolist(), *(greatest - least).tolist())
