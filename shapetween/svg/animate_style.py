"""A style that changes with time, as animated attributes of a path and of its gradients.

No attribute ever runs to ``none``: browsers jump there, or never arrive. Paint that is absent for
a while is the nearest paint at hand, fully transparent.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from shapetween.blend import faded
from shapetween.gradients import in_normal_form, solid_gradient
from shapetween.paint import Colour, Gradient, Paint, Stroke, Style
from shapetween.svg.animate import Clock, animate, animate_choice, animate_number, animate_transform
from shapetween.svg.elements import (
    ALPHA_DECIMALS,
    POINT_NAMES,
    ROUND,
    GradientDefs,
    alpha_text,
    as_circle,
    colour_text,
    paint_attributes,
    style_attributes,
)
from shapetween.svg.numbers import number

__all__ = ["animate_style"]

#: How far a colour or an alpha may be from its place between two keyframes: a step and a half of
#: the 255 a screen has. Larger is seen as a tint; smaller chases the rounding of hexadecimals.
COLOUR_TOLERANCE = 1.5 / 255


def animate_style(
    path: ET.Element,
    styles: Sequence[Style],
    clock: Clock,
    gradients: GradientDefs,
    tolerance: float,
) -> None:
    """Paint a path with the first of some styles, and let it run through the others.

    Parameters
    ----------
    path : Element
    styles : sequence of Style
        One for each sample of the clock.
    clock : Clock
    gradients : GradientDefs
        Where to write gradients.
    tolerance : float
        How far lengths may be off between two keyframes, in user units.
    """
    decimals = gradients.decimals
    _animate_paint(path, "fill", [style.fill for style in styles], clock, gradients, tolerance)
    strokes = _strokes_throughout([style.stroke for style in styles])
    if strokes:
        paints = [stroke.paint for stroke in strokes]
        _animate_paint(path, "stroke", paints, clock, gradients, tolerance)
    first = replace(styles[0], stroke=strokes[0] if strokes else None)
    path.attrib.update(style_attributes(first, decimals))

    animate_choice(path, "fill-rule", clock, [style.fill_rule for style in styles])
    _animate_share(path, "opacity", clock, [style.opacity for style in styles])
    if strokes:
        _animate_stroke(path, strokes, clock, decimals, tolerance)


def _strokes_throughout(strokes: Sequence[Stroke | None]) -> list[Stroke]:
    """The strokes with none missing, unless all are: then there is nothing to write."""
    present = [k for k, stroke in enumerate(strokes) if stroke is not None]
    filled = []
    for k, stroke in enumerate(strokes):
        if stroke is not None:
            filled.append(stroke)
        elif present:
            near = strokes[min(present, key=lambda other: abs(other - k))]
            assert near is not None
            filled.append(replace(near, paint=faded(near.paint, 0.0)))
    return filled


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
    if len({len(stroke.dashes) for stroke in strokes}) == 1:
        dashes = np.array([stroke.dashes for stroke in strokes])
        picks = clock.pick(dashes[:, :, None], tolerance)
        texts = [" ".join(map(length, row)) for row in dashes[picks].tolist()]
        animate(path, "stroke-dasharray", clock, picks, texts)
    else:
        texts = [" ".join(map(length, stroke.dashes)) or "0" for stroke in strokes]
        animate_choice(path, "stroke-dasharray", clock, texts)
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
    """``fill`` or ``stroke``."""
    track = _paints_throughout(paints)
    colours = [paint for paint in track if isinstance(paint, Colour)]
    if not track:
        path.set(name, "none")
    elif colours:
        path.attrib.update(paint_attributes(name, colours[0], gradients))
        _animate_colour(path, name, f"{name}-opacity", clock, colours)
    else:
        shades = [in_normal_form(paint) for paint in track if isinstance(paint, Gradient)]
        # Gradients of one kind run through one element; a change of kind is a jump to another.
        kinds = [(shade.kind, shade.spread, len(shade.stops)) for shade in shades]
        starts = [k for k in range(len(kinds)) if k == 0 or kinds[k] != kinds[k - 1]]
        urls: list[str] = []
        for start, end in pairwise([*starts, len(kinds)]):
            held = np.clip(np.arange(len(kinds)), start, end - 1)
            url = _animate_gradient([shades[k] for k in held], clock, gradients, tolerance)
            urls += [url] * (end - start)
        path.set(name, urls[0])
        animate_choice(path, name, clock, urls)


def _paints_throughout(paints: Sequence[Paint]) -> list[Paint]:
    """The paints with none missing, and either all of them colours or all gradients."""
    gradients = [k for k, paint in enumerate(paints) if isinstance(paint, Gradient)]
    present = gradients or [k for k, paint in enumerate(paints) if paint is not None]
    track: list[Paint] = []
    for k, paint in enumerate(paints):
        if not present:
            break
        near = paints[min(present, key=lambda other: abs(other - k))]
        assert near is not None
        if paint is None:
            paint = faded(near, 0.0)
        elif isinstance(paint, Colour) and isinstance(near, Gradient):
            paint = solid_gradient(paint, near)
        track.append(paint)
    return track


def _animate_gradient(
    track: Sequence[Gradient], clock: Clock, gradients: GradientDefs, tolerance: float
) -> str:
    """Write one gradient that runs through others of its kind; how a paint refers to it."""
    element, url = gradients.add(track[0])
    stops = element.findall("stop")
    circles = [circle for circle in map(as_circle, track) if circle is not None]
    if len(circles) == len(track):
        _animate_points(element, circles, clock, gradients.decimals, tolerance)
    else:
        _animate_ellipse(element, track, clock, gradients.decimals, tolerance)
    for k, stop in enumerate(stops):
        colours = [gradient.stops[k].colour for gradient in track]
        _animate_colour(stop, "stop-color", "stop-opacity", clock, colours)
        _animate_share(stop, "offset", clock, [gradient.stops[k].offset for gradient in track])
    return url


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
