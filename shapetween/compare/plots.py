"""Plots over time as inline SVG: lines in the colours of their variants, and stripes.

Colours and text come from the page's style sheet, so that one plot serves light and dark.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.compare.measures import TIMES

__all__ = ["Series", "line_plot", "stripes"]

#: Size of a plot and where its axes are, in units that are pixels where it is widest.
WIDTH, HEIGHT = 440.0, 216.0
LEFT, RIGHT, TOP, BOTTOM = 46.0, 12.0, 12.0, 26.0

#: Height of one stripe's row.
ROW = 26.0

#: About how many lines the vertical axis has.
TICKS = 4

#: Room above and below the lines, as a share of their range.
HEADROOM = 0.06


@dataclass(frozen=True, slots=True, eq=False)
class Series:
    """Values of one variant at `TIMES`, and the class of its colour."""

    name: str
    css: str
    values: Floats


def line_plot(series: Sequence[Series], label: str, percent: bool) -> str:
    """Lines over time, the first of them on top of the others."""
    values = np.stack([s.values for s in series])
    low, high = float(values.min()), float(values.max())
    room = HEADROOM * (high - low) or 0.05 * abs(high) or 0.05
    low, high = low - room, high + room
    decimals, ticks = _ticks(low, high)
    parts = []
    for tick in ticks:
        y = _down(np.array(tick), low, high)
        text = f"{100 * tick:.{max(0, decimals - 2)}f} %" if percent else f"{tick:.{decimals}f}"
        parts.append(
            f'<line class="grid" x1="{LEFT:g}" x2="{WIDTH - RIGHT:g}" y1="{y:.1f}" y2="{y:.1f}"/>'
            f'<text x="{LEFT - 7:g}" y="{y + 3.6:.1f}" text-anchor="end">{text}</text>'
        )
    for one in reversed(series):
        points = " ".join(
            f"{x:.1f},{y:.1f}"
            for x, y in zip(_across(TIMES), _down(one.values, low, high), strict=True)
        )
        parts.append(
            f'<polyline class="line {one.css}" points="{points}">'
            f"<title>{escape(one.name)}</title></polyline>"
        )
    return _plot(label, HEIGHT, "".join(parts))


def stripes(rows: Sequence[tuple[str, str, Mask]], label: str) -> str:
    """A row for each variant, filled while something holds: (name, class of colour, (F,))."""
    parts = []
    height = TOP + ROW * len(rows) + BOTTOM
    step = float(_across(TIMES[1]) - _across(TIMES[0]))
    for k, (name, css, mask) in enumerate(rows):
        y = TOP + ROW * k
        parts.append(
            f'<rect class="lane" x="{LEFT:g}" y="{y + 5:g}" width="{WIDTH - LEFT - RIGHT:g}" '
            f'height="{ROW - 10:g}" rx="3"><title>{escape(name)}</title></rect>'
            f'<rect class="key {css}" x="{LEFT - 26:g}" y="{y + 8:g}" width="16" height="10" '
            f'rx="2"><title>{escape(name)}</title></rect>'
        )
        edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
        for first, last in edges.reshape(-1, 2).tolist():
            x = max(LEFT, float(_across(TIMES[first])) - step / 2)
            end = min(WIDTH - RIGHT, float(_across(TIMES[last - 1])) + step / 2)
            parts.append(
                f'<rect class="stripe {css}" x="{x:.1f}" y="{y + 5:g}" width="{end - x:.1f}" '
                f'height="{ROW - 10:g}" rx="2"/>'
            )
    return _plot(label, height, "".join(parts))


def _plot(label: str, height: float, inside: str) -> str:
    """Axes of time, a cursor for the moment shown, and what is inside."""
    axis = "".join(
        f'<text x="{_across(np.array(t)):.1f}" y="{height - 8:g}" text-anchor="{anchor}">'
        f"{t:g}</text>"
        for t, anchor in ((0.0, "middle"), (0.25, "middle"), (0.5, "middle"), (0.75, "middle"))
    )
    axis += f'<text x="{WIDTH - RIGHT:g}" y="{height - 8:g}" text-anchor="end">t = 1</text>'
    return (
        f'<svg class="plot" viewBox="0 0 {WIDTH:g} {height:g}" role="img" '
        f'aria-label="{escape(label)}" data-left="{LEFT:g}" data-right="{WIDTH - RIGHT:g}">'
        f'{inside}<line class="axis" x1="{LEFT:g}" x2="{WIDTH - RIGHT:g}" '
        f'y1="{height - BOTTOM:g}" y2="{height - BOTTOM:g}"/>{axis}'
        f'<line class="cursor" x1="{LEFT:g}" x2="{LEFT:g}" y1="{TOP:g}" '
        f'y2="{height - BOTTOM:g}"/></svg>'
    )


def _across(t: Floats) -> Floats:
    return np.asarray(LEFT + t * (WIDTH - LEFT - RIGHT))


def _down(values: Floats, low: float, high: float) -> Floats:
    return np.asarray(TOP + (high - values) / (high - low) * (HEIGHT - TOP - BOTTOM))


def _ticks(low: float, high: float) -> tuple[int, list[float]]:
    """Round values between two, and the decimals that they need."""
    rough = (high - low) / TICKS
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * k for k in (1, 2, 5, 10) if power * k >= rough * 0.999)
    decimals = max(0, -int(np.floor(np.log10(step) + 1e-9)))
    first, last = int(np.ceil(low / step)), int(np.floor(high / step))
    return decimals, [k * step for k in range(first, last + 1)]
