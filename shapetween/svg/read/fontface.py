"""Fonts as they are used to set text: words to glyphs, glyphs to outlines."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from shapetween.geometry.bezier import line_curves
from shapetween.svg.read.pathdata import Subpath

__all__ = ["Face", "Glyph", "face_of"]


@dataclass(frozen=True, slots=True)
class Glyph:
    """A glyph of a shaped run, in shares of the font's size, y down.

    Attributes
    ----------
    number : int
        In its font; 0 is the one for what the font has not.
    cluster : int
        The first of the run's characters that it stands for.
    advance : float
    x, y : float
        Where it is drawn, from the pen.
    """

    number: int
    cluster: int
    advance: float
    x: float
    y: float


class Face:
    """One font.

    Parameters
    ----------
    name : str
    data : bytes
        The file.
    index : int
        Which font of the file.
    weight : int
        For fonts of any weight.
    """

    def __init__(self, name: str, data: bytes, index: int, weight: int) -> None:
        import uharfbuzz

        self.name = name
        self._harfbuzz = uharfbuzz
        face = uharfbuzz.Face(data, index)
        self._font: Any = uharfbuzz.Font(face)
        self._units = float(face.upem or 1000)
        self._font.set_variations({"wght": weight})
        self._outlines: dict[int, tuple[Subpath, ...]] = {}

    def has(self, character: str) -> bool:
        """Whether the font has a glyph for a character."""
        return bool(self._font.get_nominal_glyph(ord(character)))

    def shaped(self, text: str, right_to_left: bool, features: dict[str, bool]) -> list[Glyph]:
        """The glyphs of a run of text, from left to right."""
        buffer = self._harfbuzz.Buffer()
        buffer.add_str(text)
        buffer.guess_segment_properties()
        if right_to_left:
            buffer.direction = "rtl"
        self._harfbuzz.shape(self._font, buffer, features)
        units = self._units
        return [
            Glyph(
                info.codepoint,
                info.cluster,
                place.x_advance / units,
                place.x_offset / units,
                -place.y_offset / units,
            )
            for info, place in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True)
        ]

    def metric(self, name: str, default: float) -> float:
        """One of OpenType's metrics, as a share of the size, up counted positive."""
        value = self._font.get_metric_position(getattr(self._harfbuzz.OTMetricsTag, name))
        return default if value is None else float(value) / self._units

    def outline(self, number: int) -> tuple[Subpath, ...]:
        """A glyph's outline at size 1, y down."""
        if number not in self._outlines:
            pen = _Pen(self._units)
            self._font.draw_glyph_with_pen(number, pen)
            self._outlines[number] = pen.finished()
        return self._outlines[number]


class _Pen:
    """Collects what HarfBuzz draws, as fontTools' pens do."""

    def __init__(self, units: float) -> None:
        self._units = units
        self._subpaths: list[Subpath] = []
        self._curves: list[np.ndarray[Any, np.dtype[np.float64]]] = []
        self._start = self._at = np.zeros(2)

    def _point(self, given: tuple[float, float]) -> np.ndarray[Any, np.dtype[np.float64]]:
        return np.array([given[0] / self._units, -given[1] / self._units])

    def moveTo(self, point: tuple[float, float]) -> None:
        self.endPath()
        self._start = self._at = self._point(point)

    def lineTo(self, point: tuple[float, float]) -> None:
        end = self._point(point)
        self._curves.append(line_curves(self._at[None], end[None])[0])
        self._at = end

    def curveTo(self, *points: tuple[float, float]) -> None:
        handles = [self._point(point) for point in points]
        self._curves.append(np.stack([self._at, *handles]))
        self._at = handles[-1]

    def qCurveTo(self, *points: tuple[float, float]) -> None:
        handle, end = (self._point(point) for point in points)
        first, last = (self._at + 2 * handle) / 3, (end + 2 * handle) / 3
        self._curves.append(np.stack([self._at, first, last, end]))
        self._at = end

    def closePath(self) -> None:
        self.endPath()

    def endPath(self) -> None:
        if self._curves:
            self._subpaths.append(Subpath(np.stack(self._curves), self._start, True))
        self._curves = []

    def finished(self) -> tuple[Subpath, ...]:
        self.endPath()
        return tuple(self._subpaths)


@lru_cache(maxsize=64)
def face_of(name: str, data: bytes, index: int, weight: int) -> Face:
    """The font of a file, set up once."""
    return Face(name, data, index, weight)
