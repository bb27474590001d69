"""Panels that show two drawings side by side, each over a grid in its own file's units."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.model.blend import from_oklab
from shapetween.model.outline import Outline
from shapetween.svg.write.elements import colour_text
from shapetween.svg.write.numbers import number, path_data

__all__ = [
    "FAINT",
    "FOOT",
    "HEAD",
    "INK",
    "INSIDE",
    "MARGIN",
    "Panel",
    "colour",
    "draw_frame",
    "draw_outline",
    "panels",
    "px",
    "text_at",
]

#: Lengths of the picture, in its own units, which are pixels at its natural size.
PANEL, MARGIN, GUTTER, HEAD, FOOT = 620.0, 44.0, 56.0, 64.0, 40.0

#: Room around the shapes, as a share of their larger side; labels need it.
PADDING = 0.07

#: Decimals of lengths in the picture.
PIXEL_DECIMALS = 2

#: Width of a letter of a title, about.
LETTER = 9.6

#: About how many grid lines across the larger side.
GRID_LINES = 10

#: Turn from one quad's hue to the next: the golden angle, so that near numbers differ most.
HUE_TURN = math.pi * (3 - math.sqrt(5))

#: OKLab lightness that quads take in turn, and their chroma: light enough for dark numbers.
LIGHTNESSES, CHROMA = (0.86, 0.79, 0.91), 0.105

INK, FAINT, GRID, INSIDE = "#1d2430", "#6b7482", "#e6e9ee", "#f1f3f6"


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """Where one of two drawings is shown, and how its units become the picture's.

    Attributes
    ----------
    left, top : float
        Of the room that its title and its box stand in.
    low, high : (2,) float64
        Least and greatest corner that it shows, in the drawing's own units.
    """

    left: float
    top: float
    low: Points
    high: Points

    @property
    def scale(self) -> float:
        """The picture's units to one of the drawing's."""
        return PANEL / float((self.high - self.low).max())

    @property
    def size(self) -> Points:
        """Width and height of its box, in the picture's units."""
        return (self.high - self.low) * self.scale

    def place(self, points: Points) -> Points:
        """From the file's units to the picture's."""
        return np.asarray((points - self.low) * self.scale + (self.left, self.top + HEAD))


def panels(
    first: Sequence[Points], second: Sequence[Points], top: float = 0.0
) -> tuple[Panel, Panel]:
    """Two panels side by side that show all of these points, with room around them.

    Parameters
    ----------
    first, second : sequence of (N, 2) float64
        What each has to show, in each drawing's own units.
    top : float
        Where the row of both begins.
    """
    left = _panel(first, MARGIN, top)
    return left, _panel(second, MARGIN + float(left.size[0]) + GUTTER + MARGIN, top)


def _panel(shown: Sequence[Points], left: float, top: float) -> Panel:
    points = np.concatenate(shown)
    low, high = points.min(axis=0), points.max(axis=0)
    # A dot of no extent, or a line of none but one way, still needs a scale.
    room = PADDING * (float((high - low).max()) or 1.0)
    return Panel(left, top, low - room, high + room)


def draw_frame(root: ET.Element, panel: Panel, name: str) -> None:
    """The name, a grid, and what its lines are worth."""
    group = ET.SubElement(root, "g")
    top = panel.top + HEAD
    width, height = panel.size.tolist()
    letters = max(8, int(width / LETTER))
    title = name if len(name) <= letters else f"{name[: letters - 1]}…"
    text_at(group, panel.left, top - 34, title, {"font-size": "17", "font-weight": "600"})
    lines = []
    for axis in (0, 1):
        for value in _ticks(float(panel.low[axis]), float(panel.high[axis])):
            point = panel.low.copy()
            point[axis] = value
            x, y = panel.place(point).tolist()
            label = f"{value:.10g}"
            if axis == 0:
                lines.append(f"M{px(x)} {px(top)}v{px(height)}")
                attributes = {"class": "tick", "text-anchor": "middle"}
                text_at(group, x, top - 6, label, attributes)
            else:
                lines.append(f"M{px(panel.left)} {px(y)}h{px(width)}")
                attributes = {"class": "tick", "text-anchor": "end"}
                text_at(group, panel.left - 6, y + 3.5, label, attributes)
    ET.SubElement(group, "path", {"d": "".join(lines), "stroke": GRID, "fill": "none"})


def _ticks(low: float, high: float) -> Floats:
    """Round numbers between two, about as many as there is room for."""
    rough = (high - low) / GRID_LINES
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * k for k in (1, 2, 5, 10) if power * k >= rough)
    # Adding 0 turns a -0 into 0.
    return np.asarray(np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step + 0.0)


def colour(index: int) -> str:
    """A light colour, unlike those of the numbers before and after."""
    hue = index * HUE_TURN
    lightness = LIGHTNESSES[index % len(LIGHTNESSES)]
    lab = np.array([lightness, CHROMA * math.cos(hue), CHROMA * math.sin(hue)])
    return colour_text(from_oklab(lab))


def draw_outline(
    root: ET.Element, panel: Panel, rings: Sequence[Outline], attributes: dict[str, str]
) -> None:
    """Rings as one path."""
    curves = panel.place(np.concatenate([ring.curves for ring in rings]))
    counts = [len(ring.curves) for ring in rings]
    closed = [ring.closed for ring in rings]
    d = path_data(curves[None], counts, closed, PIXEL_DECIMALS)[0]
    ET.SubElement(root, "path", {"d": d, **attributes})


def text_at(
    parent: ET.Element, x: float, y: float, text: str, attributes: dict[str, str]
) -> ET.Element:
    """Text that stands at a place of the picture."""
    element = ET.SubElement(parent, "text", {"x": px(x), "y": px(y), **attributes})
    element.text = text
    return element


def px(value: float) -> str:
    """A length as the picture writes it."""
    return number(value, PIXEL_DECIMALS)
