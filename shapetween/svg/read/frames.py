"""What holds for everything inside an element, and an element with all that holds for it."""

from __future__ import annotations

from dataclasses import dataclass
from xml.etree.ElementTree import Element

from shapetween.base.arrays import Affine, Points
from shapetween.svg.read.style import Properties
from shapetween.svg.read.units import Viewport
from shapetween.svg.read.xml import label

__all__ = ["Frame", "Layer", "Placed"]


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """What is done to all that an element draws, after it is drawn.

    Attributes
    ----------
    element : Element
    frame : Frame
        Of the element, with its own transform.
    opacity : float
    blend : str
        A ``mix-blend-mode``.
    isolated : bool
    filters : str
        The ``filter`` property, "none" for nothing.
    mask : Element or None
        The ``mask`` that it names.
    clip : Element, str, (4, 2) float64 or None
        The ``clipPath`` that it names, a shape as style writes it, or the corners of a nested
        viewport in the drawing's user units.
    mask_mode : str
        A ``mask-mode``.
    """

    element: Element
    frame: Frame
    opacity: float = 1.0
    blend: str = "normal"
    isolated: bool = False
    filters: str = "none"
    mask: Element | None = None
    clip: Element | str | Points | None = None
    mask_mode: str = "match-source"

    @property
    def has_effect(self) -> bool:
        """Whether anything is done at all."""
        return (
            self.opacity < 1
            or self.blend != "normal"
            or self.isolated
            or self.filters != "none"
            or self.mask is not None
            or self.clip is not None
        )


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """What holds for everything inside an element.

    Attributes
    ----------
    matrix : (2, 3) float64
        From local coordinates to the drawing's user units.
    properties : Mapping
        The element's computed properties.
    viewport : Viewport
    pixel : float
        Size of a CSS pixel in the drawing's user units, for strokes that do not scale.
    layers : tuple of Layer
        The outermost first.
    uses : tuple of Element
        What the ``use`` elements outside draw.
    name : str
        What a shape drawn by ``use`` is called; empty outside of any.
    context : (str, str) or None
        Within a marker, the fill and the stroke of the line it is on.
    """

    matrix: Affine
    properties: Properties
    viewport: Viewport
    pixel: float = 1.0
    layers: tuple[Layer, ...] = ()
    uses: tuple[Element, ...] = ()
    name: str = ""
    context: tuple[str, str] | None = None

    @property
    def opacity(self) -> float:
        """Product of all opacities."""
        product = 1.0
        for layer in self.layers:
            product *= layer.opacity
        return product


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A shape's element, and the frame of its own coordinates."""

    element: Element
    tag: str
    frame: Frame

    @property
    def name(self) -> str:
        """What the shape is called: as the ``use`` that draws it, else by itself."""
        return self.frame.name or label(self.element)

    @property
    def values(self) -> Properties:
        """Attributes, overridden by properties."""
        return {**dict(self.element.items()), **self.frame.properties}
