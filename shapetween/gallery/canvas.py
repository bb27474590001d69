"""Drawing figures: panels, faces and lines that stand still or move back and forth together."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points, Quads
from shapetween.geometry.homography import apply_homography, quad_homographies
from shapetween.model.drawing import Box
from shapetween.svg.write.animate import animate
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import document, text_of
from shapetween.svg.write.numbers import number
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Timeline

__all__ = ["FAINT", "INK", "Canvas", "Panel", "checkerboard"]

#: Colours of text and lines.
INK, FAINT, PAPER = "#22262e", "#6a6f7a", "#fbfaf7"

#: Decimals of lengths, in pixels at natural size, and how far a moving point may be off.
DECIMALS, TOLERANCE = 1, 0.25

#: Samples of the movement among which keyframes are chosen.
SAMPLES = 61

#: Room inside a panel, as a share of what it shows.
ROOM = 0.06

UNIT_SQUARE = np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]])


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """A window onto some points: how their units become the canvas's."""

    middle: Points
    scale: float
    at: Points

    @classmethod
    def onto(cls, points: Points, x: float, y: float, width: float, height: float) -> "Panel":
        """A window in the rectangle given that shows all of the points, (..., 2)."""
        flat = points.reshape(-1, 2)
        low, high = flat.min(axis=0), flat.max(axis=0)
        scale = float((np.array([width, height]) / ((high - low) * (1 + 2 * ROOM))).min())
        return cls((low + high) / 2, scale, np.array([x + width / 2, y + height / 2]))

    def moved(self, x: float, y: float) -> "Panel":
        """The same window elsewhere."""
        return Panel(self.middle, self.scale, self.at + np.array([x, y]))

    def place(self, points: Points) -> Points:
        """From the points' units to the canvas's."""
        return np.asarray((points - self.middle) * self.scale + self.at)


class Canvas:
    """An SVG of a fixed size whose moving parts go back and forth.

    Parameters
    ----------
    width, height : float
    title : str
    seconds : float
        Of one way.
    """

    def __init__(self, width: float, height: float, title: str, seconds: float = 3.0) -> None:
        self._root = document(Box(0, 0, width, height), title)
        self._root.set("width", number(width, 0))
        self._root.set("height", number(height, 0))
        self._root.set("font-family", "system-ui,'Segoe UI','DejaVu Sans',sans-serif")
        ET.SubElement(self._root, "rect", {"width": "100%", "height": "100%", "fill": PAPER})
        schedule = Schedule.of("ease-in-out", SAMPLES)
        self._clock = Clock(schedule, True, Timeline((seconds,), "alternate"))

    @property
    def times(self) -> Floats:
        """Times at which whatever moves is to be given, (F,)."""
        return self._clock.schedule.time

    def faces(self, points: Points, **style: str) -> None:
        """Polygons (N, K, 2), or (F, N, K, 2) at `times`, as one path."""
        self._path(points, "Z", style)

    def lines(self, points: Points, **style: str) -> None:
        """Polylines, likewise."""
        self._path(points, "", {"fill": "none", **style})

    def dots(self, points: Points, radius: float, **style: str) -> None:
        """Discs at points that stand still, (N, 2)."""
        for x, y in points.tolist():
            place = {"cx": number(x, DECIMALS), "cy": number(y, DECIMALS)}
            ET.SubElement(self._root, "circle", {**place, "r": number(radius, DECIMALS), **style})

    def text(self, x: float, y: float, text: str, size: float = 15.0, **style: str) -> None:
        """A line of text."""
        place = {"x": number(x, DECIMALS), "y": number(y, DECIMALS)}
        look = {"fill": INK, "font-size": number(size, DECIMALS)}
        attributes = {name.replace("_", "-"): value for name, value in style.items()}
        ET.SubElement(self._root, "text", place | look | attributes).text = text

    def svg(self) -> str:
        """The document as text."""
        return text_of(self._root)

    def _path(self, points: Points, end: str, style: dict[str, str]) -> None:
        attributes = {name.replace("_", "-"): value for name, value in style.items()}
        path = ET.SubElement(self._root, "path", {"stroke-linejoin": "round", **attributes})
        frames = points if points.ndim == 4 else points[None]
        picks = (
            self._clock.pick(frames.reshape(len(frames), -1, 2), TOLERANCE)
            if len(frames) > 1
            else np.zeros(1, np.intp)
        )
        values = ["".join(_polyline(p) + end for p in frame) for frame in frames[picks].tolist()]
        path.set("d", values[0])
        animate(path, "d", self._clock, picks, values)


def _polyline(points: list[list[float]]) -> str:
    return "M" + "L".join(f"{number(x, DECIMALS)} {number(y, DECIMALS)}" for x, y in points)


def checkerboard(quads: Quads, count: int) -> tuple[Points, Points]:
    """Corners of the dark and the light cells of a board on each quad, each (Q, N, 4, 2).

    The board lies in the quad as one does that is seen in perspective; `count` cells along a side.
    """
    row, column = np.divmod(np.arange(count * count), count)
    corner = np.stack([column, row], axis=-1)[:, None] + UNIT_SQUARE[0]
    places = corner / count  # (count^2, 4, 2)
    dark = (row + column) % 2 == 0
    matrix = quad_homographies(np.broadcast_to(UNIT_SQUARE, quads.shape), quads)
    flat = np.broadcast_to(places.reshape(-1, 2), (len(quads), 4 * count * count, 2))
    cells = apply_homography(matrix, flat).reshape(len(quads), -1, 4, 2)
    return cells[:, dark], cells[:, ~dark]
