"""Styles through time, sorted out so that only numbers change within a track.

A player can run from one colour to another and from one width to another. It cannot run from
nothing to a colour, nor from a colour or one kind of gradient to another kind. Here what is absent
for a while becomes the nearest paint, fully transparent; colours beside gradients become gradients
of one colour; and where the kind still changes, the track is cut.
"""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeVar

from shapetween.model.blend import faded
from shapetween.model.gradients import IDENTITY, in_normal_form, solid_gradient
from shapetween.model.paint import Colour, Gradient, Paint, Stroke, Style

__all__ = ["StyleTrack", "style_tracks"]

#: Share of a dash pattern that its gaps may take and count as closed: where they are not seen, but
#: the seams of dashes that meet are.
CLOSED = 1e-5

PaintT = TypeVar("PaintT", Paint, Colour | Gradient)


@dataclass(frozen=True, slots=True)
class StyleTrack:
    """Styles at every sample, of which some are this track's to show.

    Attributes
    ----------
    styles : tuple of Style
        One for each sample; outside its own samples the track holds its first or last style.
        All fills are absent, all colours, or all gradients in normal form of the same kind and
        number of stops. So are all strokes' paints, and all strokes have as many dashes.
    start, end : int
        The first sample that is the track's own, and the first after it that is not.
    """

    styles: tuple[Style, ...]
    start: int
    end: int


def style_tracks(styles: Sequence[Style], *, by_words: bool = False) -> list[StyleTrack]:
    """Cut styles through time into tracks, most often one.

    Parameters
    ----------
    styles : sequence of Style
        One for each sample.
    by_words : bool
        Whether to cut also where a fill rule, a line's cap or its join changes, for players that
        cannot change those.
    """
    fills = _of_one_sort([style.fill for style in styles])
    strokes = _strokes([style.stroke for style in styles])
    whole = [
        style
        if style.fill is fill and style.stroke is stroke
        else replace(style, fill=fill, stroke=stroke)
        for style, fill, stroke in zip(styles, fills, strokes, strict=True)
    ]
    sorts = [(_sort(style), _words(style) if by_words else None) for style in whole]
    cuts = [k for k in range(1, len(sorts)) if sorts[k] != sorts[k - 1]]
    return [
        StyleTrack(
            (whole[start],) * start
            + tuple(whole[start:end])
            + (whole[end - 1],) * (len(whole) - end),
            start,
            end,
        )
        for start, end in pairwise([0, *cuts, len(whole)])
    ]


def _sort(style: Style) -> tuple[object, ...]:
    """What must be equal in two styles for a player to run from one to the other."""
    stroke = style.stroke
    paints = [style.fill] if stroke is None else [style.fill, stroke.paint]
    shades = [(p.kind, len(p.stops)) if isinstance(p, Gradient) else None for p in paints]
    return (*shades, None if stroke is None else len(stroke.dashes))


def _words(style: Style) -> tuple[object, ...]:
    """What has nothing between its values."""
    stroke = style.stroke
    fill_rule = None if style.fill is None else style.fill_rule
    return fill_rule, *((stroke.cap, stroke.join) if stroke is not None else ())


def _of_one_sort(paints: Sequence[PaintT]) -> list[PaintT]:
    """The paints with none missing, and either all of them colours or all gradients."""
    gradients = [k for k, paint in enumerate(paints) if isinstance(paint, Gradient)]
    present = gradients or [k for k, paint in enumerate(paints) if paint is not None]
    if not present or (not gradients and len(present) == len(paints)):
        return list(paints)
    track: list[PaintT] = []
    for k, paint in enumerate(paints):
        near = paints[_nearest(present, k)]
        if paint is None:
            assert near is not None  # it is one of those present
            paint = faded(near, 0.0)
        elif isinstance(paint, Colour) and isinstance(near, Gradient):
            paint = solid_gradient(paint, near)
        track.append(in_normal_form(paint) if isinstance(paint, Gradient) else paint)
    return _unflattened(track)


def _unflattened(track: list[PaintT]) -> list[PaintT]:
    """The paints, where a line that is flattened to a point lies as it does at the nearest time.

    What it paints has no size then, and players have no such lines. Where it is so all the time,
    it is its last colour.
    """
    lines = [p if isinstance(p, Gradient) and p.kind == "linear" else None for p in track]
    flat = [line is not None and line.matrix != IDENTITY for line in lines]
    if not any(flat):
        return track
    known = [k for k, line in enumerate(lines) if line is not None and not flat[k]]
    result = list(track)
    for k, line in enumerate(lines):
        if line is None or not flat[k]:
            continue
        near = lines[_nearest(known, k)] if known else None
        if near is None:
            stops = tuple(replace(stop, colour=line.stops[-1].colour) for stop in line.stops)
            result[k] = replace(line, matrix=IDENTITY, stops=stops)
        else:
            result[k] = replace(line, matrix=IDENTITY, points=near.points)
    return result


def _nearest(samples: Sequence[int], sample: int) -> int:
    """Nearest of rising samples, the later of two: what is reached is more like what follows."""
    place = bisect_left(samples, sample)
    near = samples[max(place - 1, 0) : place + 1]
    return min(near, key=lambda other: (abs(other - sample), -other))


def _strokes(strokes: Sequence[Stroke | None]) -> Sequence[Stroke | None]:
    """The strokes with none missing, unless all are, and with paints of one sort."""
    present = [k for k, stroke in enumerate(strokes) if stroke is not None]
    if not present:
        return strokes
    nearest = [strokes[_nearest(present, k)] for k in range(len(strokes))]
    filled = [_without_seams(stroke) for stroke in nearest if stroke is not None]
    paints = _of_one_sort([stroke.paint for stroke in filled])
    return [
        replace(near, paint=paint if stroke is not None else faded(paint, 0.0))
        for near, paint, stroke in zip(filled, paints, strokes, strict=True)
    ]


def _without_seams(stroke: Stroke) -> Stroke:
    """The stroke unbroken if all gaps between its dashes are closed."""
    gaps, length = stroke.dashes[1::2], sum(stroke.dashes)
    # An odd pattern is read twice over, so that its dashes are gaps too.
    if len(stroke.dashes) % 2 == 0 and sum(gaps) <= CLOSED * length:
        return replace(stroke, dashes=())
    return stroke
