"""One filled shape as a style sheet: keyframes of a clip path, or of a path's data.

What is clipped may be anything in a page: a colour, a photograph, a video. And a style sheet has
what SVG has not: `animation-direction`, hover, `animation-timeline`. It holds keyframes only, so it
is larger than a module or an SVG of the same movement.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Mask
from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer, unobserved
from shapetween.formats.grid import CELLS
from shapetween.formats.keyed import Keyed, keyed
from shapetween.formats.names import identifier
from shapetween.formats.options import WriteOptions
from shapetween.formats.plain import colour_losses, group_losses, plain_styles
from shapetween.formats.table import Segments, Written
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Gradient, Paint, Style
from shapetween.model.part import Part
from shapetween.model.tracks import style_tracks
from shapetween.model.united import united
from shapetween.svg.write.animate_style import COLOUR_TOLERANCE
from shapetween.svg.write.elements import alpha_text
from shapetween.svg.write.numbers import number
from shapetween.svg.write.paths import PathForm, on_grid
from shapetween.timing.easing import easing_function
from shapetween.timing.keyframes import keyframes

__all__ = ["css"]

#: Decimals of a keyframe's percentage: a thousandth of it is a twentieth of a frame in ten seconds.
PERCENT_DECIMALS = 3

#: Between the end of one leg and the start of the next, in percent: the least that is written.
STEP = 10.0**-PERCENT_DECIMALS

#: Times at which paint is looked at, kept where it has all it needs on the way.
PAINT_TIMES = np.clip(np.linspace(0.0, 1.0, 31), 1e-6, 1 - 1e-6)


def css(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """All of it as a style sheet.

    Raises
    ------
    OptionError
        If there is more than one part, or a line: a clip path can be neither.
    """
    del observe
    easing = easing_function(options.easing)
    parts = [_only_part(movement) for movement in segments.movements]
    warnings = group_losses(segments.movements, ".css")
    page = _Page.of(segments.movements[0].box, options)
    plan = _plan(segments, options)
    rules: dict[float, list[str]] = {}
    paints: list[tuple[float, str, str]] = []
    for part, (start, end) in zip(parts, plan.ways, strict=True):
        if rules:
            start = max(start, max(rules) + STEP)
        size = max(page.box.width, page.box.height)
        keys = keyed(part, options, size, easing)
        styles = plain_styles(part, easing(PAINT_TIMES).tolist())
        track = style_tracks(styles)[0].styles
        evenodd = any(style.fill_rule == "evenodd" for style in styles)
        warnings += [*_losses(styles), *keys.losses]
        if not _reference(track):
            warnings += colour_losses(segments.movements, ".css")

        def place(clock: float, start: float = start, end: float = end) -> float:
            return round(start + clock * (end - start), PERCENT_DECIMALS)

        for clock, text in zip(keys.clock.tolist(), page.texts(keys, evenodd), strict=True):
            rules.setdefault(place(clock), []).append(f"{page.attribute}:{text}")
        if len(keys.clock) == 1:
            rules.setdefault(place(1.0), []).append(rules[place(0.0)][0])
        for clock, attribute, value in _paint(track, page.paint):
            paints.append((place(clock), attribute, value))
    values: dict[str, set[str]] = {}
    for _, attribute, value in paints:
        values.setdefault(attribute, set()).add(value)
    # What never changes is no keyframe's: a page may set a colour of its own instead.
    still = [f"{key}:{min(found)}" for key, found in values.items() if len(found) == 1]
    still = [each for each in still if each != "opacity:1"]
    for at, attribute, value in paints:
        if len(values[attribute]) > 1:
            rules.setdefault(at, []).append(f"{attribute}:{value}")
    name = identifier(segments.name, "morph")
    return Written.of(_sheet(name, page, still, rules, plan, options), warnings)


@dataclass(frozen=True, slots=True)
class _Plan:
    """Where in an animation's one run, in percent, each leg starts and ends; seconds of it."""

    seconds: float
    delay: float
    ways: list[tuple[float, float]]


def _plan(segments: Segments, options: WriteOptions) -> _Plan:
    """One run of it. There and back, half of the rest at each turn is before, and half after."""
    hold, lengths = options.hold, segments.lengths(options.duration)
    swing = options.loop == "alternate"
    before = hold / 2 if swing else hold
    last = hold if options.loop == "repeat" and not segments.closed else 0.0
    after = hold / 2 if swing else last
    starts = [before + sum(lengths[:leg]) + leg * hold for leg in range(len(lengths))]
    ends = [start + length for start, length in zip(starts, lengths, strict=True)]
    whole = ends[-1] + after
    ways = [
        (100 * start / whole, 100 * end / whole) for start, end in zip(starts, ends, strict=True)
    ]
    return _Plan(whole, before if swing else 0.0, ways)


@dataclass(frozen=True, slots=True)
class _Page:
    """How a path is written.

    Attributes
    ----------
    box : Box
        The view box.
    scale : float
        From user units to pixels.
    decimals : int
        Of pixels or, in ``shape()``, of percentages.
    form : {"path", "shape", "d"}
    """

    box: Box
    scale: float
    decimals: int
    form: str

    @classmethod
    def of(cls, box: Box, options: WriteOptions) -> "_Page":
        """For a view box; in ``d`` it keeps its own units."""
        side = max(box.width, box.height)
        scale = 1.0
        if options.size is not None and options.css != "d":
            sides = (box.width, box.height)
            scale = min(asked / own for asked, own in zip(options.size, sides, strict=False))
        if options.css == "shape":
            return cls(box, 1.0, 2, "shape")
        decimals = options.precision
        if decimals is None:
            decimals = max(0, math.ceil(-math.log10(side * scale / CELLS) - 1e-9))
        return cls(box, scale, decimals, options.css)

    @property
    def attribute(self) -> str:
        """What is animated."""
        return "d" if self.form == "d" else "clip-path"

    @property
    def paint(self) -> str:
        """What its paint is called."""
        return "fill" if self.form == "d" else "background-color"

    def texts(self, keys: Keyed, evenodd: bool) -> list[str]:
        """What the attribute is at every keyframe."""
        curves = keys.curves
        if self.form != "d":
            curves = curves - (self.box.x, self.box.y)
        shape = keys.shape
        if self.form == "shape":
            percent = 100 * curves / (self.box.width, self.box.height)
            rule = "evenodd " if evenodd else ""
            return [
                f"shape({rule}{_shape(frame, shape.rings, shape.closed, shape.straight)})"
                for frame in percent
            ]
        form = PathForm.of(shape.rings, shape.closed, shape.straight)
        points = on_grid(form.points(curves * self.scale), self.decimals)
        rule = "evenodd," if evenodd and self.form == "path" else ""
        return [f'path({rule}"{text}")' for text in form.texts(points, self.decimals)]

    @property
    def measures(self) -> list[str]:
        """Declarations of how large the box must be."""
        width, height = (number(v * self.scale, 3) for v in (self.box.width, self.box.height))
        if self.form == "path":
            return [f"width:{width}px", f"height:{height}px"]
        return [f"aspect-ratio:{width}/{height}"] if self.form == "shape" else []


def _shape(curves: Curves, rings: Sequence[int], closed: Sequence[bool], straight: Mask) -> str:
    """The commands of ``shape()``, in percent."""

    def at(point: Floats) -> str:
        return " ".join(f"{number(v, 2)}%" for v in point.tolist())

    commands = []
    first = 0
    for ring, (count, is_closed) in enumerate(zip(rings, closed, strict=True)):
        commands.append(f"{'move to' if ring else 'from'} {at(curves[first, 0])}")
        for k in range(first, first + count):
            start, one, two, end = curves[k]
            del start
            inner = "" if straight[k] else f" with {at(one)}/{at(two)}"
            commands.append(f"{'line' if straight[k] else 'curve'} to {at(end)}{inner}")
        if is_closed:
            commands.append("close")
        first += count
    return ",".join(commands)


def _only_part(movement: Movement) -> Part:
    """What is painted, as one part: several of one plain colour are united.

    Raises
    ------
    OptionError
        If they cannot be, there are none, or one has a line.
    """
    seen = [part for part in movement.parts if any(_painted(s) for s in _some_styles(part))]
    styles = [style for part in seen for style in _some_styles(part)]
    if any(style.stroke is not None for style in styles):
        raise OptionError(
            ".css holds a filled shape, and here is one with a line; expected -o OUT.svg or OUT.mjs"
        )
    if len(seen) > 1 and all(style == Style(styles[0].fill) for style in styles):
        return united(seen)
    if len(seen) != 1:
        raise OptionError(
            f".css holds one shape, and here are {len(seen)} of different paint; "
            "expected -o OUT.svg or OUT.mjs"
        )
    return seen[0]


def _some_styles(part: Part) -> list[Style]:
    return plain_styles(part, (1e-6, 0.25, 0.5, 0.75, 1 - 1e-6))


def _painted(style: Style) -> bool:
    return style.opacity > 0 and (style.fill is not None or style.stroke is not None)


def _losses(styles: Sequence[Style]) -> list[str]:
    losses = []
    if any(isinstance(style.fill, Gradient) for style in styles):
        losses.append("a gradient becomes one colour in .css; set a background of your own")
    if len({style.fill_rule for style in styles}) > 1:
        losses.append("the fill rule is evenodd all the time in .css")
    return losses


def _paint(styles: Sequence[Style], attribute: str) -> list[tuple[float, str, str]]:
    """When on the leg's clock the colour and the opacity are what: time, attribute and value."""
    rows = np.array([[*_colour(style.fill), style.opacity] for style in styles])
    reference = _reference(styles)
    clock = np.linspace(0.0, 1.0, len(rows))
    picks = keyframes(rows[:, :, None], clock, COLOUR_TOLERANCE)
    if (rows == rows[0]).all():
        picks = picks[:1]
    declared: list[tuple[float, str, str]] = []
    for pick in picks.tolist():
        red, green, blue, alpha, opacity = rows[pick].tolist()
        channels = " ".join(str(round(255 * part)) for part in (red, green, blue))
        clear = "" if alpha == 1 else f"/{alpha_text(alpha)}"
        shade = reference or f"rgb({channels}{clear})"
        declared.append((clock[pick], attribute, shade))
        declared.append((clock[pick], "opacity", alpha_text(opacity)))
    return declared


def _reference(styles: Sequence[Style]) -> str:
    """What asks the page for the colour, if that is the same all the time and opaque."""
    fills = {style.fill for style in styles}
    (fill, *others) = fills
    plain = isinstance(fill, Colour) and not others and fill.alpha == 1
    return fill.reference if plain and isinstance(fill, Colour) else ""


def _colour(paint: Paint) -> tuple[float, float, float, float]:
    """A paint as one colour."""
    if isinstance(paint, Colour):
        return paint.red, paint.green, paint.blue, paint.alpha
    if paint is None:
        return 0.0, 0.0, 0.0, 0.0
    stops = np.array(
        [(s.colour.red, s.colour.green, s.colour.blue, s.colour.alpha) for s in paint.stops]
    )
    red, green, blue, alpha = stops.mean(axis=0).tolist()
    return red, green, blue, alpha


def _sheet(
    name: str,
    page: _Page,
    still: Sequence[str],
    rules: dict[float, list[str]],
    plan: _Plan,
    options: WriteOptions,
) -> str:
    """The text of the style sheet."""
    first = min(rules)
    percent: Callable[[float], str] = lambda place: f"{number(place, PERCENT_DECIMALS)}%"  # noqa: E731
    endless = "" if options.loop == "once" else " infinite"
    turning = " alternate" if options.loop == "alternate" else ""
    delay = f" {number(plan.delay, 4)}s" if plan.delay else ""
    animation = f"{name} {number(plan.seconds, 4)}s linear{delay}{endless}{turning} both"
    own = [*page.measures, *still, *rules[first], f"animation:{animation}"]
    places = sorted(rules)
    held = {0.0: rules[first], **rules} if first > 0 else dict(rules)
    if places[-1] < 100:
        held[100.0] = rules[places[-1]]
    frames = "".join(f" {percent(place)}{{{';'.join(held[place])}}}\n" for place in sorted(held))
    use = f'<path class="{name}">' if page.form == "d" else f'<div class="{name}">'
    return (
        f"/* Made with shapetween; for {use} */\n"
        f".{name}{{{';'.join(own)}}}\n"
        f"@keyframes {name}{{\n{frames}}}\n"
        f"@media (prefers-reduced-motion:reduce){{.{name}{{animation:none}}}}\n"
    )
