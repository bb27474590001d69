"""Letters and digits of a plain sans, drawn here from their centre lines, as one area each."""

import numpy as np
import shapely

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style

__all__ = ["GLYPHS", "drawn"]

WIDTH = 3.0

Line = tuple[tuple[float, float], ...]


def _arc(x: float, y: float, rx: float, ry: float, start: float, end: float) -> Line:
    """Points of an arc of an ellipse, angles in degrees, clockwise as drawn where they rise."""
    angle = np.deg2rad(np.linspace(start, end, max(3, round(abs(end - start) / 15) + 1)))
    points = np.column_stack([x + rx * np.cos(angle), y + ry * np.sin(angle)])
    return tuple((float(a), float(b)) for a, b in np.round(points, 4))


#: Centre lines in a box of 24: caps from 3 to 21, stems at 6 and 18.
GLYPHS: dict[str, tuple[Line, ...]] = {
    "A": (((5, 22), (12, 3), (19, 22)), ((7, 16), (17, 16))),
    "B": (
        ((13, 3), (6, 3), (6, 21), (14, 21), *_arc(14, 16.25, 4.5, 4.75, 90, -90), (6, 11.5)),
        ((12.5, 11.5), *_arc(13, 7.25, 4, 4.25, 90, -90), (6, 3)),
    ),
    "C": (_arc(13, 12, 7.5, 9, -45, -315),),
    "D": (((6, 3), (11, 3), *_arc(11, 12, 8, 9, -90, 90), (6, 21), (6, 3), (8, 3)),),
    "E": (((18, 3), (6, 3), (6, 21), (18, 21)), ((6, 12), (16, 12))),
    "F": (((18, 3), (6, 3), (6, 22)), ((6, 12), (16, 12))),
    "G": ((*_arc(13, 12, 7.5, 9, -45, -330), (19.5, 13), (13, 13)),),
    "H": (((6, 2), (6, 22)), ((18, 2), (18, 22)), ((6, 12), (18, 12))),
    "I": (((12, 2), (12, 22)),),
    "J": (((15, 2), (15, 16), *_arc(10, 16, 5, 5, 0, 150)),),
    "K": (((6, 2), (6, 22)), ((18, 3), (6, 14)), ((10, 10.5), (18, 22))),
    "L": (((6, 2), (6, 21), (18, 21)),),
    "M": (((5, 22), (5, 3), (12, 15), (19, 3), (19, 22)),),
    "N": (((6, 22), (6, 3), (18, 21), (18, 2)),),
    "O": ((*_arc(12, 12, 8, 9, 0, 360), *_arc(12, 12, 8, 9, 0, 30)),),
    "P": (((6, 22), (6, 3), (13, 3), *_arc(13, 8, 5, 5, -90, 90), (6, 13)),),
    "Q": ((*_arc(12, 12, 8, 9, 0, 360), *_arc(12, 12, 8, 9, 0, 30)), ((13, 16), (19, 22))),
    "R": (((6, 22), (6, 3), (13, 3), *_arc(13, 8, 5, 5, -90, 90), (6, 13)), ((12, 13), (18, 22))),
    "S": ((*_arc(12, 7.5, 5.5, 4.5, -30, -270), *_arc(12, 16.5, 5.5, 4.5, -90, 150)),),
    "T": (((4, 3), (20, 3)), ((12, 3), (12, 22))),
    "U": (((6, 2), (6, 15), *_arc(12, 15, 6, 6, 180, 0), (18, 2)),),
    "V": (((5, 2), (12, 21), (19, 2)),),
    "W": (((3, 2), (8, 21), (12, 6), (16, 21), (21, 2)),),
    "X": (((5, 2), (19, 22)), ((19, 2), (5, 22))),
    "Y": (((5, 2), (12, 12), (19, 2)), ((12, 12), (12, 22))),
    "Z": (((5, 3), (18, 3), (6, 21), (19, 21)),),
    "0": ((*_arc(12, 12, 6, 9, 0, 360), *_arc(12, 12, 6, 9, 0, 30)),),
    "1": (((8, 6), (13, 3), (13, 22)),),
    "2": ((*_arc(12, 8, 5.5, 5, 200, 390), (6, 21), (18, 21)),),
    "3": (_arc(12, 7.5, 5, 4.5, -150, 100), _arc(12, 16.5, 5.5, 4.5, -100, 150)),
    "4": (((19, 16), (5, 16), (15, 3), (15, 22)),),
    "5": (((17, 3), (7, 3), (7, 10.5), *_arc(12, 15.5, 6, 5.5, -110, 140)),),
    "6": (_arc(12, 15.5, 5.5, 5.5, 0, 390), _arc(13, 13.5, 6.5, 10.5, 165, 280)),
    "7": (((5, 3), (18, 3), (10, 22)),),
    "8": (_arc(12, 7.5, 4.5, 4.5, 90, 480), _arc(12, 16.5, 5.5, 4.5, -90, 300)),
    "9": (_arc(12, 8.5, 5.5, 5.5, 0, 390), _arc(11, 10.5, 6.5, 10.5, -15, 100)),
}


def drawn(glyph: str) -> Drawing:
    """A letter as the drawing of one area, holes left out of it."""
    lines = [
        shapely.LineString(line).buffer(WIDTH / 2, cap_style="flat", join_style="mitre")
        for line in GLYPHS[glyph]
    ]
    area = shapely.simplify(shapely.union_all(lines), 0.01)
    assert isinstance(area, shapely.Polygon), glyph
    # Slivers where lines meet are none of the letter's holes.
    holes = [ring for ring in area.interiors if shapely.Polygon(ring).area > 1]
    rings = tuple(_outline(shapely.get_coordinates(ring)[:-1]) for ring in (area.exterior, *holes))
    return Drawing((Shape(rings, Style(Colour())),), Box(0, 0, 24, 24))


def _outline(points: Points) -> Outline:
    outline = Outline(line_curves(points, np.roll(points, -1, axis=0)))
    return outline if outline.area > 0 else outline.reversed()
