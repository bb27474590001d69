"""Fills and strokes of Lottie."""

import math
from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.formats.grid import Grid
from shapetween.formats.lottie.properties import Json, fixed, moving
from shapetween.model.gradients import in_normal_form
from shapetween.model.paint import Colour, Gradient, Paint, Stroke, Style
from shapetween.svg.write.animate_style import COLOUR_TOLERANCE
from shapetween.svg.write.elements import as_circle

__all__ = ["paint_losses", "painted", "visible"]

CAPS = {"butt": 1, "round": 2, "square": 3}
JOINS = {"miter": 1, "round": 2, "bevel": 3}
RULES = {"nonzero": 1, "evenodd": 2}

#: Decimals of shares of one; of shares of a hundred two fewer are as fine.
SHARE_DECIMALS = 4

#: Lengths in cells that may be off between two keyframes: a fifth of a pixel at 1000 px.
LENGTH_TOLERANCE = 2.0


def painted(styles: Sequence[Style], frames: Floats, grid: Grid) -> list[Json]:
    """The stroke and the fill of a track, in this order: what comes first is on top.

    Parameters
    ----------
    styles : sequence of Style
        One for each of the frames, with paints of one sort.
    frames : (S,) float64
    grid : Grid
    """
    items = []
    strokes = [style.stroke for style in styles if style.stroke is not None]
    if strokes and any(stroke.width > 0 for stroke in strokes):
        paints: list[Paint] = [stroke.paint for stroke in strokes]
        items.append(_paint("s", paints, frames, grid) | _stroke(strokes, frames, grid))
    fills = [style.fill for style in styles]
    if fills[0] is not None:
        items.append(_paint("f", fills, frames, grid) | {"r": RULES[styles[0].fill_rule]})
    return items


def visible(styles: Sequence[Style]) -> bool:
    """Whether any of it is ever to be seen."""
    return any(
        style.opacity > 0
        and any(
            _alpha(paint) > 0
            for paint in (style.fill, style.stroke.paint if style.stroke is not None else None)
        )
        for style in styles
    )


def paint_losses(styles: Sequence[Style]) -> list[str]:
    """What of the styles Lottie cannot hold."""
    losses = []
    strokes = [style.stroke for style in styles if style.stroke is not None]
    shades = [
        paint
        for paint in (*(s.fill for s in styles), *(stroke.paint for stroke in strokes))
        if isinstance(paint, Gradient)
    ]
    if any(shade.kind == "radial" and as_circle(in_normal_form(shade)) is None for shade in shades):
        losses.append("an oval gradient becomes a round one in Lottie")
    if any(shade.spread != "pad" for shade in shades):
        losses.append("a gradient that repeats ends with its last colour in Lottie")
    if any(stroke.miter_limit != strokes[0].miter_limit for stroke in strokes):
        losses.append("a line's miter limit stays as it starts in Lottie")
    return losses


def _alpha(paint: Paint) -> float:
    """The greatest alpha of a paint."""
    if paint is None:
        return 0.0
    if isinstance(paint, Colour):
        return paint.alpha
    return max((stop.colour.alpha for stop in paint.stops), default=0.0)


def _paint(kind: str, paints: Sequence[Paint], frames: Floats, grid: Grid) -> Json:
    """Colours or gradients, as fill ("f") or stroke ("s")."""
    shades = [paint for paint in paints if isinstance(paint, Gradient)]
    if shades:
        return {"ty": f"g{kind}", "o": fixed(100), **_gradient(shades, frames, grid)}
    colours = [paint for paint in paints if isinstance(paint, Colour)]
    values = np.array([(c.red, c.green, c.blue) for c in colours])
    alphas = 100 * np.array([c.alpha for c in colours])
    return {
        "ty": "fl" if kind == "f" else "st",
        "c": moving(values, frames, COLOUR_TOLERANCE, SHARE_DECIMALS),
        "o": moving(alphas, frames, 100 * COLOUR_TOLERANCE, SHARE_DECIMALS - 2),
    }


def _gradient(shades: Sequence[Gradient], frames: Floats, grid: Grid) -> Json:
    """Where a gradient lies, and its stops."""
    stops = [_stops(shade) for shade in shades]
    if all(stop[len(shades[0].stops) * 4 + 1 :: 2].min() >= 1 for stop in stops):
        stops = [stop[: len(shades[0].stops) * 4] for stop in stops]
    colours = moving(np.array(stops), frames, COLOUR_TOLERANCE, SHARE_DECIMALS)
    result: Json = {"g": {"p": len(shades[0].stops), "k": colours}}
    if shades[0].kind == "linear":
        lines = np.array([in_normal_form(shade).points for shade in shades]).reshape(-1, 2, 2)
        lines = (lines - (grid.box.x, grid.box.y)) / grid.step
        return result | {
            "t": 1,
            "s": moving(lines[:, 0], frames, LENGTH_TOLERANCE, 1),
            "e": moving(lines[:, 1], frames, LENGTH_TOLERANCE, 1),
        }
    circles = np.array([_circle(shade) for shade in shades])
    centres = (circles[:, :2] - (grid.box.x, grid.box.y)) / grid.step
    rims = centres + np.stack([circles[:, 2] / grid.step, np.zeros(len(circles))], axis=1)
    offsets = circles[:, 3:]
    angles = np.degrees(np.unwrap(np.arctan2(offsets[:, 1], offsets[:, 0])))
    return result | {
        "t": 2,
        "s": moving(centres, frames, LENGTH_TOLERANCE, 1),
        "e": moving(rims, frames, LENGTH_TOLERANCE, 1),
        "h": moving(100 * np.hypot(*offsets.T), frames, 0.2, 2),
        "a": moving(angles, frames, 0.2, 2),
    }


def _circle(shade: Gradient) -> tuple[float, ...]:
    """Centre, radius of a circle of the same area, and the focus in shares of that radius."""
    normal = in_normal_form(shade)
    a, b, c, d, e, f = normal.matrix
    cx, cy, r, fx, fy = normal.points
    radius = math.sqrt(abs(a * d - b * c)) * r
    x, y = fx - cx, fy - cy
    size = radius if radius > 0 else 1.0
    focus = (a * x + c * y) / size, (b * x + d * y) / size
    return e + a * cx + c * cy, f + b * cx + d * cy, radius, *focus


def _stops(shade: Gradient) -> Floats:
    """Offset, red, green, blue of each stop, and then offset and alpha of each."""
    rows = [(s.offset, s.colour.red, s.colour.green, s.colour.blue) for s in shade.stops]
    alphas = [(s.offset, s.colour.alpha) for s in shade.stops]
    return np.array([v for row in (*rows, *alphas) for v in row])


def _stroke(strokes: Sequence[Stroke], frames: Floats, grid: Grid) -> Json:
    """Everything of a stroke but its paint."""
    first = strokes[0]
    widths = np.array([stroke.width for stroke in strokes]) / grid.step
    result: Json = {
        "w": moving(widths, frames, LENGTH_TOLERANCE, 1),
        "lc": CAPS[first.cap],
        "lj": JOINS[first.join],
    }
    if first.join == "miter":
        result["ml"] = first.miter_limit
    if first.dashes:
        # An odd pattern is read twice over, so that dashes and gaps change places.
        twice = 1 + len(first.dashes) % 2
        dashes = np.array([stroke.dashes * twice for stroke in strokes]) / grid.step
        offsets = np.array([stroke.dash_offset for stroke in strokes]) / grid.step
        # Each has a name of its own: without one lottie-web draws nothing at all.
        result["d"] = [
            {
                "n": "dg"[k % 2],
                "nm": f"{'dash' if k % 2 == 0 else 'gap'} {k // 2 + 1}",
                "v": moving(dashes[:, k], frames, LENGTH_TOLERANCE, 1),
            }
            for k in range(dashes.shape[1])
        ]
        offset = moving(offsets, frames, LENGTH_TOLERANCE, 1)
        result["d"].append({"n": "o", "nm": "offset", "v": offset})
    return result
