"""A style that changes with time, as animated attributes of a path and of its gradients.

No attribute ever runs to ``none``: browsers jump there, or never arrive. Nor to another gradient's
``url()``, which some paint black; a change of gradient needs a path of its own.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from shapetween.model.paint import Colour, Gradient, Paint, Stroke
from shapetween.model.tracks import StyleTrack
from shapetween.svg.write.animate import (
    animate,
    animate_choice,
    animate_number,
    animate_transform,
)
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import (
    ALPHA_DECIMALS,
    LATER,
    POINT_NAMES,
    ROUND,
    GradientDefs,
    alpha_text,
    as_circle,
    colour_text,
    paint_attributes,
    style_attributes,
)
from shapetween.svg.write.numbers import number

__all__ = ["animate_style"]

#: How far a colour or an alpha may be from its place between two keyframes: a step of the 255 a
#: screen has. Larger is seen as a tint; smaller chases the rounding of hexadecimals.
COLOUR_TOLERANCE = 1.0 / 255


def animate_style(
    path: ET.Element, track: StyleTrack, clock: Clock, gradients: GradientDefs, tolerance: float
) -> None:
    """Paint a path with the first style of a track, and let it run through the others.

    Parameters
    ----------
    path : Element
    track : StyleTrack
        One style for each sample of the clock; the path is hidden where they are not its own.
    clock : Clock
    gradients : GradientDefs
        Where to write gradients.
    tolerance : float
        How far lengths may be off between two keyframes, in user units.
    """
    styles = track.styles
    _animate_paint(path, "fill", [style.fill for style in styles], clock, gradients, tolerance)
    strokes = [style.stroke for style in styles if style.stroke is not None]
    if strokes:
        paints = [stroke.paint for stroke in strokes]
        _animate_paint(path, "stroke", paints, clock, gradients, tolerance)
    path.attrib.update(style_attributes(styles[0], gradients.decimals))

    if track.start > 0:
        path.attrib.update({**LATER, "visibility": "hidden"})
    shown = [track.start <= k < track.end for k in range(len(styles))]
    animate_choice(path, "visibility", clock, ["visible" if own else "hidden" for own in shown])
    animate_choice(path, "fill-rule", clock, [style.fill_rule for style in styles])
    _animate_share(path, "opacity", clock, [style.opacity for style in styles])
    if strokes:
        _animate_stroke(path, strokes, clock, gradients.decimals, tolerance)


def _animate_stroke(
    path: ET.Element, strokes: Sequence[Stroke], clock: Clock, decimals: int, tolerance: float
) -> None:
    """Everything of a stroke but its paint."""

    def length(value: float) -> str:
        return number(value, decimals)

    widths = np.array([stroke.width for stroke in strokes])
    animate_number(path, "stroke-width", clock, widths, tolerance, length)
    animate_choice(path, "stroke-linecap", clock, [stroke.cap for stroke in strokes])
    animate_choice(path, "stroke-linejoin", clock, [stroke.join for stroke in strokes])
    limits = np.array([stroke.miter_limit for stroke in strokes])
    animate_number(path, "stroke-miterlimit", clock, limits, COLOUR_TOLERANCE, alpha_text)
    dashes = np.array([stroke.dashes for stroke in strokes])
    picks = clock.pick(dashes[:, :, None], tolerance)
    texts = [" ".join(map(length, row)) for row in dashes[picks].tolist()]
    animate(path, "stroke-dasharray", clock, picks, texts)
    offsets = np.array([stroke.dash_offset for stroke in strokes])
    animate_number(path, "stroke-dashoffset", clock, offsets, tolerance, length)


def _animate_paint(
    path: ET.Element,
    name: str,
    paints: Sequence[Paint],
    clock: Clock,
    gradients: GradientDefs,
    tolerance: float,
) -> None:
    """``fill`` or ``stroke``, of paints that are all of one sort."""
    path.attrib.update(paint_attributes(name, paints[0], gradients))
    shades = [paint for paint in paints if isinstance(paint, Gradient)]
    colours = [paint for paint in paints if isinstance(paint, Colour)]
    if shades:
        _animate_gradient(gradients.element[-1], shades, clock, gradients.decimals, tolerance)
    elif colours:
        _animate_colour(path, name, f"{name}-opacity", clock, colours)


def _animate_gradient(
    element: ET.Element,
    track: Sequence[Gradient],
    clock: Clock,
    decimals: int,
    tolerance: float,
) -> None:
    """Let the gradient that was written for the first of a track run through the others."""
    stops = element.findall("stop")
    animate_choice(element, "spreadMethod", clock, [gradient.spread for gradient in track])
    circles = [circle for circle in map(as_circle, track) if circle is not None]
    if len(circles) == len(track):
        _animate_points(element, circles, clock, decimals, tolerance)
    else:
        _animate_ellipse(element, track, clock, decimals, tolerance)
    for k, stop in enumerate(stops):
        colours = [gradient.stops[k].colour for gradient in track]
        _animate_colour(stop, "stop-color", "stop-opacity", clock, colours)
        _animate_share(stop, "offset", clock, [gradient.stops[k].offset for gradient in track])


def _animate_points(
    element: ET.Element,
    track: Sequence[Gradient],
    clock: Clock,
    decimals: int,
    tolerance: float,
) -> None:
    points = np.array([gradient.points for gradient in track])
    for k, name in enumerate(POINT_NAMES[track[0].kind]):
        animate_number(
            element, name, clock, points[:, k], tolerance, lambda value: number(value, decimals)
        )


def _animate_ellipse(
    element: ET.Element,
    track: Sequence[Gradient],
    clock: Clock,
    decimals: int,
    tolerance: float,
) -> None:
    """Move, turn and stretch the unit circle; SMIL has no way to run through matrices.

    A matrix that is not symmetric is one that flattens the plane, and stays as it is.
    """
    a, b, c, d, e, f = np.array([gradient.matrix for gradient in track]).T
    if (np.abs(b - c) > ROUND * np.hypot(a, d)).any():
        return
    turn = np.unwrap(np.arctan2(2 * b, a - d)) / 2
    mean, half = (a + d) / 2, np.hypot((a - d) / 2, b)
    longest = float((mean + half).max())
    moves = {
        "translate": (np.stack([e, f], axis=1), tolerance, decimals),
        "rotate": (np.degrees(turn)[:, None], math.degrees(tolerance / longest), ALPHA_DECIMALS),
        "scale": (np.stack([mean + half, mean - half], axis=1), tolerance, decimals),
    }
    at_rest = []
    for kind, (values, allowed, places) in moves.items():
        picks = clock.pick(values[:, None], allowed)
        texts = [" ".join(number(v, places) for v in row) for row in values[picks].tolist()]
        animate_transform(element, "gradientTransform", kind, clock, picks, texts)
        at_rest.append(f"{kind}({texts[0]})")
    element.set("gradientTransform", "".join(at_rest))

    element.attrib.update({"cx": "0", "cy": "0", "r": "1"})
    fx, fy = np.array([gradient.points[3:] for gradient in track]).T
    cos, sin = np.cos(turn), np.sin(turn)
    for name, focus in (("fx", cos * fx + sin * fy), ("fy", cos * fy - sin * fx)):
        element.set(name, alpha_text(float(focus[0])))
        _animate_share(element, name, clock, focus.tolist())


def _animate_colour(
    element: ET.Element, name: str, alpha_name: str, clock: Clock, track: Sequence[Colour]
) -> None:
    parts = np.array([(colour.red, colour.green, colour.blue) for colour in track])
    picks = clock.pick(parts[:, None], COLOUR_TOLERANCE)
    animate(element, name, clock, picks, [colour_text(track[k]) for k in picks])
    _animate_share(element, alpha_name, clock, [colour.alpha for colour in track])


def _animate_share(element: ET.Element, name: str, clock: Clock, track: Sequence[float]) -> None:
    animate_number(element, name, clock, np.array(track), COLOUR_TOLERANCE, alpha_text)
