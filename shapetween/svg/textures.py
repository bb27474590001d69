"""Patterns and pictures of a document as textures, and textures as documents of their own.

A texture is drawn far over the edge of the shape that it fills, so that its edge never shows where
the shape moves. Whoever draws it may draw what strangers wrote: see `shapetween.raster.resvg`.

.. [SVG2] *Scalable Vector Graphics 2*, sections 12.3 and 14.3.
"""

import copy
import xml.etree.ElementTree as ET

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import compose
from shapetween.model.drawing import Box
from shapetween.model.gradients import IDENTITY
from shapetween.model.paint import Paint, Texture
from shapetween.svg.read.document import Document, href
from shapetween.svg.read.frames import Frame, Placed
from shapetween.svg.read.xml import SVG, XLINK, local_name
from shapetween.svg.write.elements import GradientDefs, paint_attributes
from shapetween.svg.write.numbers import number

__all__ = ["pattern_texture", "picture_texture", "plain_texture", "texture_svg"]

#: Digits after the point of lengths, which are in units of any size.
DECIMALS = 9

#: Most textures of a document: each is drawn by itself.
MOST_TEXTURES = 200

#: Properties of the root that it does not hand down.
OWN_PROPERTIES = frozenset(
    {"clip-path", "display", "filter", "mask", "mix-blend-mode", "opacity", "overflow", "transform"}
)


def pattern_texture(
    document: Document, reference: str, box: Box, frame: Frame, alpha: float
) -> Texture | None:
    """What a ``pattern`` fills a shape with; None, with a warning, if there are too many.

    Parameters
    ----------
    document : Document
    reference : str
        Id of the pattern.
    box : Box
        The shape's own bounding box in its local coordinates, without its stroke.
    frame : Frame
        The shape's own.
    alpha : float
        ``fill-opacity``.
    """
    if box.width <= 0 or box.height <= 0:
        return None
    x, y, width, height = (number(v, DECIMALS) for v in (box.x, box.y, box.width, box.height))
    # A stroke as wide as that covers all of the box at once and as much around it. A pattern in
    # units of the box does not count the stroke as part of it.
    wide = number(2 * max(box.width, box.height), DECIMALS)
    style = (
        f"fill:none;stroke:url(#{reference});stroke-opacity:{number(alpha, 4)};"
        f"stroke-width:{wide};stroke-linejoin:miter;stroke-dasharray:none"
    )
    element = f"<path d='M{x} {y}h{width}v{height}h-{width}z' style={_quoted(style)}/>"
    return _texture(document, element, frame, definitions=True)


#: What is told of a pattern's image; those outside of patterns are told where they are drawn.
LOST_IN_PATTERN = "an image in a pattern is not in the file or its folder and was left out"


def picture_texture(document: Document, placed: Placed, box: Box) -> Texture | None:
    """What an ``image`` shows; None, with a warning, if it cannot be had.

    Parameters
    ----------
    document : Document
    placed : Placed
    box : Box
        Where it is in its local coordinates.
    """
    address = _address(document, href(placed.element))
    if not address:
        document.losses.add("an image that is not in the file or its folder was left out")
        return None
    values = {
        "href": address,
        "x": number(box.x, DECIMALS),
        "y": number(box.y, DECIMALS),
        "width": number(box.width, DECIMALS),
        "height": number(box.height, DECIMALS),
        "preserveAspectRatio": placed.element.get("preserveAspectRatio", "xMidYMid"),
        "image-rendering": placed.frame.properties.get("image-rendering", "auto"),
    }
    element = f"<image {_attributes(values)}/>"
    return _texture(document, element, placed.frame, definitions=False)


def plain_texture(paint: Paint, box: Box) -> Texture:
    """A colour or a gradient as a texture over a box in user units."""
    defs = GradientDefs(DECIMALS)
    attributes = paint_attributes("fill", paint, defs)
    definitions = "".join(ET.tostring(child, "unicode") for child in defs.element)
    # Ids stand alone in this document, whatever they begin with.
    texts = [text.replace("\0", "g") for text in (definitions, _attributes(attributes))]
    place = {
        "x": number(box.x, DECIMALS),
        "y": number(box.y, DECIMALS),
        "width": number(box.width, DECIMALS),
        "height": number(box.height, DECIMALS),
    }
    element = f"<rect {_attributes(place)} {texts[1]}/>"
    return Texture("", "", texts[0], element, IDENTITY, (1.0, 1.0))


def texture_svg(texture: Texture, window: Affine, width: int, height: int) -> str:
    """A document that draws a texture.

    Parameters
    ----------
    texture : Texture
    window : (2, 3) float64
        From user units to the picture's pixels.
    width, height : int
        Of the picture, in pixels.
    """
    # The view box is as large as the document's own, which percentages are of; so what is drawn
    # is first taken from pixels to its units.
    wide, high = texture.size
    back = np.array([[wide / width, 0.0, 0.0], [0.0, high / height, 0.0]])
    own = np.array(texture.matrix).reshape(3, 2).T
    matrix = compose(back, compose(window, own)).T.ravel().tolist()
    attributes = {
        "width": str(width),
        "height": str(height),
        "viewBox": f"0 0 {wide:.15g} {high:.15g}",
        "preserveAspectRatio": "none",
    }
    transform = " ".join(f"{v:.15g}" for v in matrix)
    return (
        f'<svg xmlns="{SVG}" {_attributes(attributes)} {texture.root}>'
        f"<defs>{texture.definitions}</defs>"
        f'<g transform="matrix({transform})">{texture.element}</g></svg>'
    )


def _texture(
    document: Document, element: str, frame: Frame, *, definitions: bool
) -> Texture | None:
    document.textures += 1
    if document.textures > MOST_TEXTURES:
        document.losses.add("of too many patterns and pictures the last were left out")
        return None
    root, text = "", ""
    if definitions:
        properties = document.cascade.properties(document.root, {})
        root = _attributes({k: v for k, v in properties.items() if k not in OWN_PROPERTIES})
        text = _definitions(document)
    viewport = frame.viewport
    matrix = tuple(frame.matrix.T.ravel().tolist())
    return Texture(document.name, root, text, element, matrix, (viewport.width, viewport.height))


def _definitions(document: Document) -> str:
    """All that a document holds, without addresses of anything outside it."""
    if document.definitions is None:
        children = [copy.deepcopy(child) for child in document.root]
        every = [part for child in children for part in child.iter()]
        patterns = (each for each in every if local_name(each) == "pattern")
        in_patterns = {part for pattern in patterns for part in pattern.iter()}
        for element in every:
            if not isinstance(element.tag, str):
                continue
            if element.tag == local_name(element):
                element.tag = f"{{{SVG}}}{element.tag}"
            address = href(element)
            if address and not address.startswith("#"):
                is_picture = local_name(element) == "image"
                inside = _address(document, address) if is_picture else ""
                for name in ("href", f"{{{XLINK}}}href"):
                    element.attrib.pop(name, None)
                if inside:
                    element.set("href", inside)
                elif is_picture and element in in_patterns:
                    document.losses.add(LOST_IN_PATTERN, address[:40])
        document.definitions = "".join(ET.tostring(child, "unicode") for child in children)
    return document.definitions


def _address(document: Document, address: str) -> str:
    """An image's address if it holds the image itself; else that of a copy, or nothing."""
    if address.startswith("data:"):
        return address
    return document.pictures(address) or "" if document.pictures is not None else ""


def _attributes(values: dict[str, str]) -> str:
    return " ".join(f"{name}={_quoted(value)}" for name, value in values.items())


def _quoted(value: str) -> str:
    """The value of an attribute, with its quotes."""
    from xml.sax.saxutils import quoteattr  # brings all that speaks to networks along

    return quoteattr(value)
