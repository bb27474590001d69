"""What holds for everything inside an element, and an element with all that holds for it."""

from dataclasses import dataclass
from xml.etree.ElementTree import Element

from shapetween.base.arrays import Affine, Points
from shapetween.svg.read.document import label
from shapetween.svg.read.style import Properties
from shapetween.svg.read.units import Viewport

__all__ = ["Clip", "Frame", "Placed"]


@dataclass(frozen=True, slots=True, eq=False)
class Clip:
    """A region outside which nothing is painted.

    Attributes
    ----------
    frame : Frame
        Of the element that is clipped, with all its transforms.
    element : Element or None
        The ``clipPath``, or None where `corners` are given.
    clipped : Element
        The element that is clipped.
    corners : (4, 2) float64 or None
        The edge of a nested viewport, in the drawing's user units.
    """

    frame: "Frame"
    clipped: Element
    element: Element | None = None
    corners: Points | None = None


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
    opacity : float
        Product of all group opacities outside.
    translucent : tuple of Element
        The groups that had one.
    clips : tuple of Clip
    uses : tuple of Element
        What the ``use`` elements outside draw.
    name : str
        What a shape drawn by ``use`` is called; empty outside of any.
    """

    matrix: Affine
    properties: Properties
    viewport: Viewport
    pixel: float = 1.0
    opacity: float = 1.0
    translucent: tuple[Element, ...] = ()
    clips: tuple[Clip, ...] = ()
    uses: tuple[Element, ...] = ()
    name: str = ""


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
