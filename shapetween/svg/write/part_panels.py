"""Both drawings side by side, what becomes each other in one colour, what has no partner in grey.

The numbers are those of the shapes, as ``--match`` wants them. Below stands what a report lists:
who becomes whom, at what cost, and what stays alone.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

from shapetween.base.arrays import Points
from shapetween.model.outline import Outline
from shapetween.svg.write.panels import (
    FAINT,
    FOOT,
    HEAD,
    INK,
    MARGIN,
    Panel,
    colour,
    draw_frame,
    draw_outline,
    panels,
    px,
    text_at,
)

__all__ = ["PART_STYLE", "Drawn", "PartView", "draw_parts"]

#: Height of a line of the list, and how many there are at most in each of its columns: what is
#: listed below must still be found from what is shown above.
LINE, MOST_LINES = 17.0, 40

#: Letters of a line of the list. More run into the next column.
MOST_LETTERS = 92

#: Fill of what has no partner.
ALONE = "#eceef1"

#: Least width of a line in the picture's pixels: of a thinner one no colour is seen.
LEAST_WIDTH = 5.0

PART_STYLE = (
    ".part{stroke:#1d2430;stroke-width:1.2;stroke-linejoin:round}"
    ".line{fill:none;stroke-linejoin:round;stroke-linecap:round}"
    ".alone{stroke:#8a93a0;stroke-dasharray:5 4}"
    ".tag{font-size:12px;font-weight:600;text-anchor:middle;"
    "paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}"
    ".list{font-size:11.5px}"
    "g.of:hover .part{stroke:#d9480f;stroke-width:2.4}g.of:hover .line{stroke:#ffd23f}"
)


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """A part as one of the drawings has it.

    Attributes
    ----------
    order : int
        Its place in the paint order.
    shape : int
        Number of its shape, from 1, in paint order.
    name : str
        That shape's, empty if it has none.
    rings : tuple of Outline
        Of an area, or one line; in the file's own units.
    width : float
        Of a line, in the same units; 0 of an area.
    label : (2,) float64
        Where its number stands.
    """

    order: int
    shape: int
    name: str
    rings: tuple[Outline, ...]
    width: float
    label: Points

    @property
    def called(self) -> str:
        """As a list calls it."""
        return f"#{self.shape} {self.name}".rstrip()


@dataclass(frozen=True, slots=True, eq=False)
class PartView:
    """Who becomes whom, or who stays alone.

    Attributes
    ----------
    first, second : Drawn or None
        In the first drawing and in the second; one of them may be missing.
    cost : float
        Of the pair; of what stays alone what its best partner would cost more than being alone.
    reason : str
        Why.
    """

    first: Drawn | None
    second: Drawn | None
    cost: float
    reason: str

    @property
    def told(self) -> str:
        """In one line."""
        if self.first is not None and self.second is not None:
            line = f"{self.first.called} becomes {self.second.called}: {self.reason}"
            return line + (f", cost {self.cost:.2f}" if math.isfinite(self.cost) else "")
        one = self.first or self.second
        assert one is not None
        line = f"{one.called} {'goes' if self.second is None else 'comes'}"
        if math.isfinite(self.cost):
            return line + f" alone: its best partner would cost {self.cost:.2f} more"
        return line + " alone"


def draw_parts(
    root: ET.Element, parts: Sequence[PartView], names: tuple[str, str], top: float
) -> tuple[float, float]:
    """Draw parts side by side, and say how far to the right and down the picture then reaches.

    Parameters
    ----------
    root : Element
        The picture.
    parts : sequence of PartView
        In the order in which they are listed.
    names : (str, str)
        What the two files are called.
    top : float
        Where they begin.
    """
    firsts = [(k, view.first) for k, view in enumerate(parts) if view.first is not None]
    seconds = [(k, view.second) for k, view in enumerate(parts) if view.second is not None]
    left, right = panels(
        [ring.box for _, drawn in firsts for ring in drawn.rings],
        [ring.box for _, drawn in seconds for ring in drawn.rings],
        top,
    )
    for panel, side, name in ((left, firsts, names[0]), (right, seconds, names[1])):
        draw_frame(root, panel, name)
        for k, drawn in sorted(side, key=lambda one: one[1].order):
            _draw_part(root, panel, drawn, parts[k], k)
        for _, drawn in side:
            x, y = panel.place(drawn.label).tolist()
            attributes = {"class": "tag", "pointer-events": "none"}
            text_at(root, x, y + 4, f"#{drawn.shape}", attributes)
    reach = right.left + float(right.size[0]) + MARGIN
    bottom = top + HEAD + float(max(left.size[1], right.size[1])) + 2 * LINE
    return reach, _draw_list(root, parts, reach, bottom) + FOOT


def _draw_part(root: ET.Element, panel: Panel, drawn: Drawn, view: PartView, k: int) -> None:
    """A part in its pair's colour, a line as wide as it is drawn between two edges of ink."""
    group = ET.SubElement(root, "g", {"class": "of"})
    alone = view.first is None or view.second is None
    ET.SubElement(group, "title").text = view.told + f"\n--match {_match(view)}"
    fill = ALONE if alone else colour(k)
    kind = "part alone" if alone else "part"
    if drawn.width:
        width = max(drawn.width * panel.scale, LEAST_WIDTH)
        for stroke, wide in ((INK, width), (fill, width - 2.4)):
            attributes = {"class": "line", "stroke": stroke, "stroke-width": px(wide)}
            draw_outline(group, panel, drawn.rings, attributes)
        return
    draw_outline(group, panel, drawn.rings, {"class": kind, "fill": fill, "fill-rule": "evenodd"})


def _match(view: PartView) -> str:
    """What of ``--match`` keeps this pair, or this part alone."""
    return ":".join("" if one is None else f"#{one.shape}" for one in (view.first, view.second))


def _draw_list(root: ET.Element, parts: Sequence[PartView], width: float, top: float) -> float:
    """Lines of text in two columns, and where they end."""
    told = [view.told for view in parts]
    if len(told) > 2 * MOST_LINES:
        more = len(told) - 2 * MOST_LINES + 1
        told[2 * MOST_LINES - 1 :] = [f"and {more} more; see --report"]
    rows = -(-len(told) // 2)
    for k, line in enumerate(told):
        shown = line if len(line) <= MOST_LETTERS else f"{line[: MOST_LETTERS - 1]}…"
        x = MARGIN + (k // rows) * (width - MARGIN) / 2
        y = top + LINE * (k % rows)
        attributes = {"x": px(x), "y": px(y - 9), "width": "10", "height": "10", "rx": "2"}
        matched = k < len(parts) and parts[k].first is not None and parts[k].second is not None
        if k < len(parts) and not (len(parts) > len(told) and k == len(told) - 1):
            fill = colour(k) if matched else ALONE
            ET.SubElement(root, "rect", attributes | {"fill": fill, "stroke": FAINT})
        text_at(root, x + 16, y, shown, {"class": "list"})
    return top + LINE * rows
