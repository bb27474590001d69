"""Android's animated vector drawable, in one file.

Its animators run between two values, each with a duration in whole milliseconds: a movement is one
animator after another. Paths keep relative whole numbers, for every one of them stands twice.

.. [Avd] Android developers, *AnimatedVectorDrawable*; AOSP, *ArgbEvaluator*, which blends colours
   in linear light.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.observe import Observer, unobserved
from shapetween.formats.grid import Grid, grid_of
from shapetween.formats.keyed import keyed
from shapetween.formats.names import identifiers
from shapetween.formats.options import WriteOptions
from shapetween.formats.plain import colour_losses, group_losses, plain_styles
from shapetween.formats.table import Segments, Written
from shapetween.model.gradients import in_normal_form
from shapetween.model.paint import Colour, Gradient, Paint, Stroke, Style
from shapetween.model.part import Part
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.animate_style import COLOUR_TOLERANCE
from shapetween.svg.write.elements import alpha_text, as_circle
from shapetween.svg.write.numbers import number
from shapetween.svg.write.paths import PathForm
from shapetween.timing.easing import Easing, easing_function
from shapetween.timing.keyframes import keyframes

__all__ = ["vector_drawable"]

#: Bytes of the longest text that Android's compiler keeps; a longer one crashes the application.
LONGEST = 32_767

#: Times at which paint is looked at, kept where it has all it needs on the way.
CLOCK = np.linspace(0.0, 1.0, 31)
INSIDE = (1e-6, 1 - 1e-6)

#: What ArgbEvaluator takes for the curve between values and light.
GAMMA = 2.2


@dataclass(frozen=True, slots=True)
class _Piece:
    """One animator: milliseconds, and what it runs between."""

    start: int
    end: int
    first: str
    last: str


@dataclass(frozen=True, slots=True)
class _Layer:
    """One path of the drawable.

    Attributes
    ----------
    name : str
    attributes : tuple of (str, str)
        At rest, without ``android:``.
    shades : tuple of (str, Gradient)
        Gradients, by the attribute that they fill.
    moves : tuple of (str, str, tuple of _Piece)
        Property, type, and what it does.
    """

    name: str
    attributes: tuple[tuple[str, str], ...]
    shades: tuple[tuple[str, Gradient], ...]
    moves: tuple[tuple[str, str, tuple[_Piece, ...]], ...]


def vector_drawable(
    segments: Segments, options: WriteOptions, observe: Observer = unobserved
) -> Written:
    """All of it as an animated vector drawable."""
    del observe
    movements = segments.movements
    grid = grid_of(
        [drawing for m in movements for drawing in m.at(np.array([0.0, 1.0]))], options.precision
    )
    easing = easing_function(options.easing)
    lengths = segments.lengths(options.duration)
    layers: list[_Layer] = []
    warnings = [*colour_losses(movements, ".xml"), *group_losses(movements, ".xml")]
    ends = np.cumsum([0.0, *(1000 * (each + options.hold) for each in lengths)]).tolist()
    for leg, movement in enumerate(movements):
        start = ends[leg] + 1000 * options.hold
        # The first is shown from the start on, and the last stays.
        shown = (round(ends[leg]), round(ends[leg + 1]))
        window = _Window(shown, start, ends[leg + 1], leg == len(movements) - 1)
        for place, part in enumerate(movement.parts, start=1):
            name = part.name or f"part {place}"
            made, lost = _part_layers(part, name, window, grid, options, easing)
            layers += made
            warnings += [f"{name}: {loss}" for loss in lost]
    layers = _named(layers)
    return Written.of(_document(layers, grid), warnings)


@dataclass(frozen=True, slots=True)
class _Window:
    """When a leg is seen and when it moves, in milliseconds; whether it stays at the end."""

    shown: tuple[int, int]
    start: float
    end: float
    stays: bool

    def at(self, clock: float) -> int:
        """The whole millisecond of a moment of the leg's own clock."""
        return round(self.start + clock * (self.end - self.start))


def _part_layers(
    part: Part, name: str, window: _Window, grid: Grid, options: WriteOptions, easing: Easing
) -> tuple[list[_Layer], list[str]]:
    """The paths of one part: one for each kind of its paint, two where a gradient changes."""
    styles = plain_styles(part, np.clip(easing(CLOCK), *INSIDE).tolist())
    keys = keyed(part, options, max(grid.box.width, grid.box.height), easing)
    form = PathForm.of(keys.shape.rings, keys.shape.closed, keys.shape.straight)
    texts = form.texts(grid.cells(form.points(keys.curves)), 0)
    times = [window.at(clock) for clock in keys.clock.tolist()]
    data = tuple(_runs(times, texts))
    losses = [*_losses(styles), *keys.losses]
    if max(map(len, texts), default=0) > LONGEST:
        losses.append(f"its path is longer than the {LONGEST} bytes that Android takes")
    layers: list[_Layer] = []
    for track in style_tracks(styles, by_words=True):
        shown = (
            window.shown[0] if track.start == 0 else window.at(float(CLOCK[track.start])),
            window.shown[1] if track.end == len(styles) else window.at(float(CLOCK[track.end])),
        )
        stays = window.stays and track.end == len(styles)
        for look in _looks(track.styles):
            layer = _layer(name, look, texts[0], data, window, shown, stays, grid)
            if layer is not None:
                layers.append(layer)
    return layers, losses


def _looks(styles: Sequence[Style]) -> Iterator[list[Style]]:
    """Styles whose gradients stand still: where they change, the last ones under fading first."""
    if all(_shades(style) == _shades(styles[0]) for style in styles):
        yield list(styles)
        return
    yield [_with_shades(style, styles[-1], 1.0) for style in styles]
    fading = np.linspace(1.0, 0.0, len(styles)).tolist()
    yield [_with_shades(s, styles[0], share) for s, share in zip(styles, fading, strict=True)]


def _shades(style: Style) -> tuple[Paint, ...]:
    paints = (style.fill, style.stroke.paint if style.stroke is not None else None)
    return tuple(paint for paint in paints if isinstance(paint, Gradient))


def _with_shades(style: Style, other: Style, opacity: float) -> Style:
    """A style with the gradients of another, and only so much of it to be seen."""
    fill = other.fill if isinstance(style.fill, Gradient) else style.fill
    stroke = style.stroke
    if stroke is not None and other.stroke is not None and isinstance(stroke.paint, Gradient):
        stroke = replace(stroke, paint=other.stroke.paint)
    return replace(style, fill=fill, stroke=stroke, opacity=style.opacity * opacity)


def _layer(
    name: str,
    styles: Sequence[Style],
    path: str,
    data: tuple[_Piece, ...],
    window: _Window,
    shown: tuple[int, int],
    stays: bool,
    grid: Grid,
) -> _Layer | None:
    """One path, or none if it is never seen."""
    first = styles[0]
    attributes: dict[str, str] = {"pathData": path}
    shades: list[tuple[str, Gradient]] = []
    moves: list[tuple[str, str, tuple[_Piece, ...]]] = []
    times = [window.at(clock) for clock in CLOCK.tolist()]
    if first.fill_rule == "evenodd":
        attributes["fillType"] = "evenOdd"
    paints: dict[str, list[Paint]] = {"fill": [style.fill for style in styles]}
    strokes = [style.stroke for style in styles if style.stroke is not None]
    if strokes:
        paints["stroke"] = [stroke.paint for stroke in strokes]
        attributes |= _stroke_attributes(strokes[0], grid)
        widths = np.array([stroke.width for stroke in strokes]) / grid.step
        moves.append(("strokeWidth", "floatType", tuple(_floats(widths, times, 2.0, 1))))
    seen = False
    for kind, track in paints.items():
        start = track[0]
        if start is None:
            continue
        if isinstance(start, Gradient):
            shades.append((f"{kind}Color", start))
        else:
            colours = [paint for paint in track if isinstance(paint, Colour)]
            attributes[f"{kind}Color"] = _colour(colours[0])
            moves.append((f"{kind}Color", "colorType", tuple(_colours(colours, times))))
        alphas = np.array(
            [
                style.opacity * (paint.alpha if isinstance(paint, Colour) else 1.0)
                for style, paint in zip(styles, track, strict=True)
            ]
        )
        if not (alphas > 0).any():
            attributes[f"{kind}Alpha"] = "0"
            continue
        seen = True
        pieces = list(_floats(alphas, times, COLOUR_TOLERANCE, 4))
        rest = "0" if shown[0] > 0 else alpha_text(float(alphas[0]))
        if rest != "1":
            attributes[f"{kind}Alpha"] = rest
        moves.append((f"{kind}Alpha", "floatType", tuple(_within(pieces, alphas, shown, stays))))
    if not seen:
        return None
    moves.append(("pathData", "pathType", data))
    kept = tuple(move for move in moves if move[2])
    return _Layer(name, tuple(attributes.items()), tuple(shades), kept)


def _stroke_attributes(stroke: Stroke, grid: Grid) -> dict[str, str]:
    attributes = {"strokeWidth": number(stroke.width / grid.step, 1)}
    if stroke.cap != "butt":
        attributes["strokeLineCap"] = stroke.cap
    if stroke.join != "miter":
        attributes["strokeLineJoin"] = stroke.join
    attributes["strokeMiterLimit"] = number(stroke.miter_limit, 3)
    return attributes


def _runs(times: Sequence[int], texts: Sequence[str]) -> Iterator[_Piece]:
    """Animators from each value to the next; those that take no time or change nothing are none."""
    at, value = times[0], texts[0]
    for time, text in zip(times[1:], texts[1:], strict=True):
        if time > at and text != value:
            yield _Piece(at, time, value, text)
        at, value = time, text


def _floats(
    track: Floats, times: Sequence[int], tolerance: float, decimals: int
) -> Iterator[_Piece]:
    picks = keyframes(track[:, None, None], CLOCK, tolerance).tolist()
    return _runs([times[k] for k in picks], [number(float(track[k]), decimals) for k in picks])


def _colours(colours: Sequence[Colour], times: Sequence[int]) -> Iterator[_Piece]:
    """Keyframes so dense that it matters little whether they are blended as values or as light."""
    values = np.array([(c.red, c.green, c.blue) for c in colours])
    both = [keyframes(v[:, :, None], CLOCK, COLOUR_TOLERANCE) for v in (values, values**GAMMA)]
    picks = np.unique(np.concatenate(both)).tolist()
    return _runs([times[k] for k in picks], [_colour(colours[k]) for k in picks])


def _within(
    pieces: Sequence[_Piece], alphas: Floats, shown: tuple[int, int], stays: bool
) -> Iterator[_Piece]:
    """An alpha that is 0 before and after a path has its time."""
    start, end = shown
    own = [piece for piece in pieces if piece.start >= start and piece.end <= end]
    if start > 0 and not (own and own[0].start <= start):
        value = alpha_text(float(alphas[0])) if not own else own[0].first
        yield _Piece(start, start + 1, value, value)
    yield from own
    if not stays:
        yield _Piece(end, end + 1, "0", "0")


def _colour(colour: Colour) -> str:
    """The colour without its alpha."""
    return "#" + "".join(f"{round(255 * v):02x}" for v in (colour.red, colour.green, colour.blue))


def _losses(styles: Sequence[Style]) -> list[str]:
    losses = []
    strokes = [style.stroke for style in styles if style.stroke is not None]
    shades = [shade for style in styles for shade in _shades(style) if isinstance(shade, Gradient)]
    if any(stroke.dashes for stroke in strokes):
        losses.append("dashes become a whole line in .xml")
    if any(_shades(style) != _shades(styles[0]) for style in styles):
        losses.append("its gradient fades from first to last where it stands in .xml")
    if any(shade.kind == "radial" and as_circle(in_normal_form(shade)) is None for shade in shades):
        losses.append("an oval gradient becomes a round one in .xml")
    if any(shade.kind == "radial" and shade.points[:2] != shade.points[3:] for shade in shades):
        losses.append("a radial gradient has its focus at its centre in .xml")
    return losses


def _named(layers: Sequence[_Layer]) -> list[_Layer]:
    names = identifiers([layer.name for layer in layers], "part")
    return [replace(layer, name=name) for layer, name in zip(layers, names, strict=True)]


def _document(layers: Sequence[_Layer], grid: Grid) -> str:
    width, height = grid.size
    lines = [
        '<animated-vector xmlns:android="http://schemas.android.com/apk/res/android"',
        '    xmlns:aapt="http://schemas.android.com/aapt">',
        ' <aapt:attr name="android:drawable">',
        f'  <vector android:width="{number(grid.box.width, 4)}dp" '
        f'android:height="{number(grid.box.height, 4)}dp" '
        f'android:viewportWidth="{number(width, 3)}" android:viewportHeight="{number(height, 3)}">',
    ]
    for layer in layers:
        attributes = [("name", layer.name), *layer.attributes]
        written = " ".join(f'android:{name}="{escape(value)}"' for name, value in attributes)
        if not layer.shades:
            lines.append(f"   <path {written}/>")
            continue
        lines.append(f"   <path {written}>")
        for name, shade in layer.shades:
            lines += [f'    <aapt:attr name="android:{name}">', *_gradient(shade, grid)]
            lines.append("    </aapt:attr>")
        lines.append("   </path>")
    lines += ["  </vector>", " </aapt:attr>"]
    for layer in layers:
        if layer.moves:
            lines += _target(layer)
    return "\n".join([*lines, "</animated-vector>"]) + "\n"


def _target(layer: _Layer) -> Iterator[str]:
    """What one path does."""
    yield f' <target android:name="{layer.name}">'
    yield '  <aapt:attr name="android:animation">'
    yield "   <set>"
    for name, kind, pieces in layer.moves:
        yield '    <set android:ordering="sequentially">'
        at = 0
        for piece in pieces:
            offset = f' android:startOffset="{piece.start - at}"' if piece.start > at else ""
            yield (
                f'     <objectAnimator android:propertyName="{name}" android:valueType="{kind}" '
                f'android:duration="{piece.end - piece.start}"{offset} '
                f'android:valueFrom="{piece.first}" android:valueTo="{piece.last}" '
                'android:interpolator="@android:anim/linear_interpolator"/>'
            )
            at = piece.end
        yield "    </set>"
    yield "   </set>"
    yield "  </aapt:attr>"
    yield " </target>"


def _gradient(shade: Gradient, grid: Grid) -> Iterator[str]:
    """A gradient at rest."""
    normal = in_normal_form(shade)
    origin = np.array([grid.box.x, grid.box.y])

    def cells(values: Sequence[float], shift: bool = True) -> list[str]:
        points = np.array(values).reshape(-1, 2)
        return [number(v, 1) for v in ((points - origin * shift) / grid.step).ravel().tolist()]

    if normal.kind == "linear":
        numbers = zip(("startX", "startY", "endX", "endY"), cells(normal.points), strict=True)
    else:
        a, b, c, d, e, f = normal.matrix
        cx, cy, r = normal.points[:3]
        centre = cells((e + a * cx + c * cy, f + b * cx + d * cy))
        radius = number(abs(a * d - b * c) ** 0.5 * r / grid.step, 1)
        numbers = zip(("centerX", "centerY", "gradientRadius"), (*centre, radius), strict=True)
    mode = {"pad": "clamp", "reflect": "mirror", "repeat": "repeat"}[shade.spread]
    geometry = " ".join(f'android:{name}="{value}"' for name, value in numbers)
    yield f'     <gradient android:type="{shade.kind}" android:tileMode="{mode}" {geometry}>'
    for stop in shade.stops:
        alpha = f"{round(255 * stop.colour.alpha):02x}"
        colour = f"#{alpha}{_colour(stop.colour).removeprefix('#')}"
        offset = alpha_text(stop.offset)
        yield f'      <item android:offset="{offset}" android:color="{colour}"/>'
    yield "     </gradient>"
