"""Paint between two paints.

Colours meet in OKLab, where halfway looks halfway, with alpha premultiplied, so that a colour
that cannot be seen does not tint the other. What their chroma would lose between hues that differ
is given back in part, or made up for by light: halfway between blue and orange lies no mud. They
change in the middle of the time, and are themselves in most of it. Nothing at all (`None`) stands
for the other paint, fully transparent. Gradients are mixed as they would look if the shape had
stayed in its first place, and then moved along with it.

.. [Ott20] B. Ottosson, *A perceptual color space for image processing*, 2020.
"""

import math
from dataclasses import replace
from functools import lru_cache
from typing import TypeVar

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.model.blend_groups import blend_groups
from shapetween.model.gradients import (
    common_offsets,
    in_normal_form,
    moved_style,
    on_offsets,
    solid_gradient,
)
from shapetween.model.paint import Colour, Gradient, Paint, Pattern, Stop, Stroke, Style
from shapetween.model.srgb import linear_to_srgb, srgb_to_linear
from shapetween.model.whole import WholeMotion

__all__ = ["blend", "blend_colours", "blend_paints", "faded", "from_oklab", "to_oklab"]

#: Linear sRGB to the cone responses, and their cube roots to OKLab ([Ott20]_).
CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
CONES_BACK, LAB_BACK = np.linalg.inv(CONES), np.linalg.inv(LAB)

#: What a radian costs by which a gradient turns as drawn, where one by which it turns within its
#: shape costs 1. Without it, light that comes from above on a shape and on the same shape upside
#: down would as well make a whole turn; from 1 on gradients no longer spin with shapes that do.
SPIN_COST = 0.5

#: From when until when colours change, as shares of the time. Longer, and most of a movement is
#: seen in colours of neither drawing; shorter, and they flash.
CHANGES = (0.15, 0.85)

#: Share of the chroma lost between two hues that is given back, by its square, and lightness in
#: place of what is lost still. Without them yellow becomes blue through grey; with more of the one,
#: hues are seen that belong to neither, and with more of the other, a flash of white.
GIVEN_BACK, LIGHTER = 0.6, 0.5

#: Square of the chroma, as a share of that expected, below which less is given back: what is nearly
#: grey has no hue of its own. Smaller, and between opposite hues colour jumps from one to the
#: other.
GREY = 0.15

#: Angle next to a half turn backwards that counts as one forwards.
HALF_TURN_TIE = 1e-9

ValueT = TypeVar("ValueT")


def blend(a: Style, b: Style, t: float, motion: WholeMotion | None = None) -> Style:
    """The style at time `t` on the way from one style to another.

    Parameters
    ----------
    a, b : Style
    t : float
        From 0 to 1; exactly `a` at 0 and `b` at 1.
    motion : WholeMotion, optional
        How the painted shape moves, which gradients follow; without it they stay.

    Notes
    -----
    What has nothing between its values (fill rule, caps, joins) changes at 1/2.
    """
    if t <= 0:
        return a
    if t >= 1:
        return b
    if motion is None:
        return _between(a, b, t, 0.0)
    # Where the shape was first both gradients stand still; the mixture of them is then moved.
    at_home = _between(a, moved_style(b, motion.back), t, motion.turn)
    return moved_style(at_home, motion.at(t))


def _between(a: Style, b: Style, t: float, turn: float) -> Style:
    if a == b:
        return a
    return Style(
        fill=blend_paints(a.fill, b.fill, t, turn),
        stroke=_strokes_between(a, b, t, turn),
        opacity=_mix(a.opacity, b.opacity, t),
        fill_rule=_either(a.fill_rule, b.fill_rule, t),
        groups=blend_groups(a.groups, b.groups, t, lambda p, q: _between(p, q, t, turn)),
        crisp=_either(a.crisp, b.crisp, t),
        pattern=_blend_patterns(a.pattern, b.pattern, t),
    )


def _blend_patterns(a: Pattern | None, b: Pattern | None, t: float) -> Pattern | None:
    """A pattern that both have, on its way; of two that differ nothing, but their mean colours."""
    if a is None or b is None or (a.text, a.tile) != (b.text, b.tile):
        return None
    return replace(a, matrix=_mix_all(a.matrix, b.matrix, t), alpha=_mix(a.alpha, b.alpha, t))


def blend_paints(a: Paint, b: Paint, t: float, turn: float = 0.0) -> Paint:
    """The paint at time `t`, which is not before 0 nor after 1.

    Parameters
    ----------
    a, b : Paint
    t : float
    turn : float
        By how much what they paint turns meanwhile, in radians; they are seen from it.

    Notes
    -----
    A colour beside a gradient is that gradient with equal stops. Two gradients of one kind blend
    their geometry and their stops, after both have stops at all offsets of either. A linear and a
    radial gradient, or two that spread differently, have nothing between them: the first fades
    into one colour up to t = 1/2, halfway between the mean colours of both, and the second
    unfolds out of it.
    """
    if t <= 0 or a == b:
        return a
    if t >= 1:
        return b
    if a is None:
        return None if b is None else faded(b, t)
    if b is None:
        return faded(a, 1 - t)
    if isinstance(a, Colour):
        if isinstance(b, Colour):
            return blend_colours(a, b, t)
        return _blend_gradients(solid_gradient(a, b), b, t, turn)
    if isinstance(b, Colour):
        return _blend_gradients(a, solid_gradient(b, a), t, turn)
    if a.kind == b.kind and a.spread == b.spread:
        return _blend_gradients(a, b, t, turn)
    meeting = blend_colours(_mean_colour(a), _mean_colour(b), 0.5)
    return blend_paints(a, meeting, 2 * t) if t < 0.5 else blend_paints(meeting, b, 2 * t - 1)


def blend_colours(a: Colour, b: Colour, t: float) -> Colour:
    """The colour at time `t`, through OKLab with premultiplied alpha.

    Alpha changes evenly, what else is to be seen in the middle of the time.

    Examples
    --------
    >>> grey = blend_colours(Colour(0, 0, 0), Colour(1, 1, 1), 0.5)
    >>> round(grey.red, 3)
    0.389
    """
    alpha = _mix(a.alpha, b.alpha, t)
    if (a.red, a.green, a.blue) == (b.red, b.green, b.blue):
        same = a.reference if a.reference == b.reference else ""
        return replace(a, alpha=alpha, reference=same)
    share = t * b.alpha / alpha if alpha > 0 else t
    low, high = CHANGES
    time = min(max((share - low) / (high - low), 0.0), 1.0)
    return from_oklab(_lively(to_oklab(a), to_oklab(b), time * time * (3 - 2 * time)), alpha)


def _lively(a: Floats, b: Floats, share: float) -> Floats:
    """Between two points (3,) of OKLab, and off the greys between them."""
    mixed = (1 - share) * a + share * b
    expected = (1 - share) * math.hypot(a[1], a[2]) + share * math.hypot(b[1], b[2])
    if expected > 0:
        kept = (mixed[1] ** 2 + mixed[2] ** 2) / expected**2
        growth = 1 + GIVEN_BACK * max(1 - kept, 0.0) / (kept + GREY)  # of the square
        mixed[1:] *= math.sqrt(growth)
        mixed[0] += LIGHTER * expected * max(1 - growth * kept, 0.0)
    return mixed


@lru_cache(maxsize=4096)
def to_oklab(colour: Colour) -> Floats:
    """OKLab of a colour without its alpha, (3,)."""
    srgb = np.array([colour.red, colour.green, colour.blue])
    return np.asarray(LAB @ np.cbrt(CONES @ srgb_to_linear(srgb)))


def from_oklab(lab: Floats, alpha: float = 1.0) -> Colour:
    """The sRGB colour nearest to a point (3,) of OKLab, component by component."""
    linear = np.clip(CONES_BACK @ (LAB_BACK @ lab) ** 3, 0.0, 1.0)
    red, green, blue = np.clip(linear_to_srgb(linear), 0.0, 1.0).tolist()
    return Colour(red, green, blue, alpha)


def faded(paint: Colour | Gradient, share: float) -> Colour | Gradient:
    """The same paint with its alpha times `share`."""
    if isinstance(paint, Colour):
        return replace(paint, alpha=paint.alpha * share)
    stops = (
        replace(s, colour=replace(s.colour, alpha=s.colour.alpha * share)) for s in paint.stops
    )
    return replace(paint, stops=tuple(stops))


def _blend_gradients(a: Gradient, b: Gradient, t: float, turn: float) -> Gradient:
    """Between gradients of one kind and spread."""
    offsets = common_offsets(a, b)
    first, second = (on_offsets(in_normal_form(gradient), offsets) for gradient in (a, b))
    if first.kind == "linear":
        points = _mix_lines(first.points, second.points, t, turn)
    else:
        points = _mix_all(first.points, second.points, t)
    return Gradient(
        first.kind,
        points,
        _mix_all(first.matrix, second.matrix, t),
        tuple(
            Stop(p.offset, blend_colours(p.colour, q.colour, t))
            for p, q in zip(first.stops, second.stops, strict=True)
        ),
        first.spread,
    )


def _mix_lines(
    a: tuple[float, ...], b: tuple[float, ...], t: float, turn: float
) -> tuple[float, ...]:
    """A line between two, by its middle, its length and its direction."""
    lines = np.array([a, b]).reshape(2, 2, 2)
    middle = (1 - t) * lines[0].mean(axis=0) + t * lines[1].mean(axis=0)
    first, last = lines[:, 1] - lines[:, 0]
    length = _mix(float(np.linalg.norm(first)), float(np.linalg.norm(last)), t)
    angle = float(np.arctan2(cross(first, last), first @ last))
    # Half a turn either way is one forwards, or rounding would choose.
    angle += 2 * math.pi * (angle < HALF_TURN_TIE - math.pi)
    ways = (angle, angle - 2 * math.pi, angle + 2 * math.pi)
    way = min(ways, key=lambda angle: abs(angle) + SPIN_COST * abs(turn + angle))
    half = length / 2 * np.array(rotations(np.array(t * way)) @ first / np.linalg.norm(first))
    return (*(middle - half).tolist(), *(middle + half).tolist())


def _mean_colour(gradient: Gradient) -> Colour:
    """Mean over the offsets from 0 to 1, weighted by alpha."""
    offsets = np.clip([stop.offset for stop in gradient.stops], 0.0, 1.0)
    edges = np.concatenate([[0.0], (offsets[1:] + offsets[:-1]) / 2, [1.0]])
    widths = np.diff(edges)
    alphas = np.array([stop.colour.alpha for stop in gradient.stops])
    alpha = float(widths @ alphas)
    weights = widths * alphas / alpha if alpha > 0 else widths
    labs = np.array([to_oklab(stop.colour) for stop in gradient.stops])
    return from_oklab(weights @ labs, alpha)


def _strokes_between(a: Style, b: Style, t: float, turn: float) -> Stroke | None:
    """The stroke of a style on its way.

    One of the colour of what it goes round is a border of that, and grows from nothing: fading, it
    would be a grey rim.
    """
    for one, share in ((a, 1 - t), (b, t)):
        other = b if one is a else a
        if one.stroke is None or other.stroke is not None or other.fill is None:
            continue
        if one.stroke.paint == one.fill:
            return replace(one.stroke, width=one.stroke.width * share)
    return _blend_strokes(a.stroke, b.stroke, t, turn)


def _blend_strokes(a: Stroke | None, b: Stroke | None, t: float, turn: float) -> Stroke | None:
    if a is None:
        return None if b is None else replace(b, paint=faded(b.paint, t))
    if b is None:
        return replace(a, paint=faded(a.paint, 1 - t))
    paint = blend_paints(a.paint, b.paint, t, turn)
    assert paint is not None  # neither of the two is
    first, second = _equal_dashes(a, b)
    return Stroke(
        paint=paint,
        width=_mix(a.width, b.width, t),
        cap=_either(a.cap, b.cap, t),
        join=_either(a.join, b.join, t),
        miter_limit=_mix(a.miter_limit, b.miter_limit, t),
        dashes=_mix_all(first, second, t),
        dash_offset=_mix(a.dash_offset, b.dash_offset, t),
    )


def _equal_dashes(a: Stroke, b: Stroke) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Dash patterns of both in as many numbers; an unbroken line has the other's gaps closed."""
    # An odd pattern is read twice over, so that dashes and gaps change places (SVG 2, 13.5.6).
    first, second = (s.dashes * (1 + len(s.dashes) % 2) for s in (a, b))
    if not first:
        first = _closed_gaps(second)
    if not second:
        second = _closed_gaps(first)
    length = math.lcm(len(first), len(second))
    return first * (length // max(len(first), 1)), second * (length // max(len(second), 1))


def _closed_gaps(dashes: tuple[float, ...]) -> tuple[float, ...]:
    """Dashes grown over the gaps after them."""
    pairs = zip(dashes[::2], dashes[1::2], strict=True)
    return tuple(length for dash, gap in pairs for length in (dash + gap, 0.0))


def _mix(a: float, b: float, t: float) -> float:
    return (1 - t) * a + t * b


def _mix_all(a: tuple[float, ...], b: tuple[float, ...], t: float) -> tuple[float, ...]:
    return tuple(_mix(x, y, t) for x, y in zip(a, b, strict=True))


def _either(a: ValueT, b: ValueT, t: float) -> ValueT:
    return a if t < 0.5 else b
