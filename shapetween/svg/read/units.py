"""Lengths in user units.

.. [CSS] *CSS Values and Units Module Level 4*, section 6.2: 96 px to the inch.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite, sqrt

from shapetween.svg.read.transform import NUMBER

__all__ = ["Viewport", "common_unit", "number", "numbers"]

_LENGTH = re.compile(rf"\s*({NUMBER})\s*([A-Za-z%]*)\s*", re.ASCII)
_SEPARATED = re.compile(rf"[\s,]*({NUMBER})", re.ASCII)

_PIXELS = {
    "": 1.0,
    "px": 1.0,
    "pt": 96 / 72,
    "pc": 16.0,
    "in": 96.0,
    "cm": 96 / 2.54,
    "mm": 96 / 25.4,
    "q": 96 / 101.6,
}
#: Units that follow the font, as shares of its size; 0.5 stands for the x-height and the width of
#: the nought, which only the font itself knows.
_OF_FONT = {"em": 1.0, "ex": 0.5, "ch": 0.5}

#: Units of the view, in its hundredths; browsers take the page's, which a drawing fills.
_OF_VIEW: dict[str, Callable[[float, float], float]] = {
    "vw": lambda width, height: width,
    "vh": lambda width, height: height,
    "vmin": min,
    "vmax": max,
}

#: The greatest number kept: browsers hold coordinates in single precision.
GREATEST = 3.4e38


def number(text: str | None) -> float | None:
    """A plain number or a percentage as a share of 1; None if it is neither."""
    found = _LENGTH.fullmatch(text or "")
    if found is None and text and "(" in text:
        from shapetween.svg.read.calc import calculated  # off the path of `import shapetween`

        shares = {"": 1.0, "%": 0.01}
        return calculated(text, lambda v, unit: v * shares[unit] if unit in shares else None)
    if found is None or found[2] not in ("", "%"):
        return None
    value = float(found[1]) / (100 if found[2] else 1)
    return value if abs(value) <= GREATEST else None


def numbers(text: str, most: int) -> tuple[list[float], str]:
    """Up to `most` numbers separated by spaces or commas, and what is left of the text."""
    values: list[float] = []
    position = 0
    while len(values) < most and (found := _SEPARATED.match(text, position)):
        value = float(found[1])
        if not isfinite(value) or abs(value) > GREATEST:
            break
        values.append(value)
        position = found.end()
    return values, text[position:].strip(" \t\r\n,")


def common_unit(*lengths: str | None) -> float:
    """Pixels in the absolute unit that all these lengths are written in; 1 if there is no such."""
    found = [_LENGTH.fullmatch(text or "") for text in lengths]
    units = {match[2].lower() if match else "" for match in found}
    return _PIXELS.get(units.pop(), 1.0) if len(units) == 1 else 1.0


@dataclass(frozen=True, slots=True)
class Viewport:
    """What percentages and font units are measured against.

    Attributes
    ----------
    width, height : float
        Size of the nearest view box in user units.
    font_size, root_font_size : float
    """

    width: float
    height: float
    font_size: float = 16.0
    root_font_size: float = 16.0

    @property
    def diagonal(self) -> float:
        """What a percentage refers to that is neither across nor down (SVG 2, section 8.9)."""
        return sqrt((self.width**2 + self.height**2) / 2)

    def length(self, text: str | None, of: float) -> float | None:
        """A length in user units; None if it is missing, malformed or ``auto``.

        Parameters
        ----------
        text : str or None
        of : float
            What 100% stands for.
        """
        found = _LENGTH.fullmatch(text or "")
        if found is None:
            return self._calculated(text, of) if text and "(" in text else None
        return self._measured(float(found[1]), found[2].lower(), of)

    def _calculated(self, text: str, of: float) -> float | None:
        from shapetween.svg.read.calc import calculated  # off the path of `import shapetween`

        return calculated(text, lambda value, unit: self._measured(value, unit, of))

    def _measured(self, value: float, unit: str, of: float) -> float | None:
        if unit == "%":
            value *= of / 100
        elif unit in _PIXELS:
            value *= _PIXELS[unit]
        elif unit in _OF_FONT:
            value *= _OF_FONT[unit] * self.font_size
        elif unit == "rem":
            value *= self.root_font_size
        elif unit in _OF_VIEW:
            value *= _OF_VIEW[unit](self.width, self.height) / 100
        else:
            return None
        return value if abs(value) <= GREATEST else None
