"""Styles through time, cut where their kind changes."""

from dataclasses import replace
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from shapetween.model.blend import blend
from shapetween.model.gradients import IDENTITY
from shapetween.model.paint import Colour, Gradient, Stop, Stroke, Style
from shapetween.model.tracks import style_tracks

RED, BLUE = Colour(1.0), Colour(0.0, 0.0, 1.0)
UP = Gradient("linear", (0, 0, 0, 9), (1, 0, 0, 1, 0, 0), (Stop(0, RED), Stop(1, BLUE)))
ROUND = Gradient("radial", (0, 0, 1, 0, 0), (9, 0, 0, 9, 5, 5), (Stop(0, RED), Stop(1, BLUE)))
LINE = Stroke(RED, 2.0)

fills = st.sampled_from([None, RED, BLUE, UP, ROUND])
strokes = st.sampled_from([None, LINE, replace(LINE, paint=UP), replace(LINE, dashes=(3.0, 1.0))])
styles = st.builds(Style, fills, strokes)


@given(st.lists(styles, min_size=1, max_size=8))
def test_tracks_share_out_all_samples(given_styles: list[Style]) -> None:
    tracks = style_tracks(given_styles)
    assert tracks[0].start == 0
    assert tracks[-1].end == len(given_styles)
    for track in tracks:
        assert len(track.styles) == len(given_styles)
        assert len({type(style.fill) for style in track.styles}) == 1
        assert len({type(style.stroke) for style in track.styles}) == 1
        assert len({style.stroke and len(style.stroke.dashes) for style in track.styles}) == 1
        held = track.styles[: track.start + 1]
        assert set(held) == {track.styles[track.start]}
    for before, after in pairwise(tracks):
        assert before.end == after.start


@given(st.lists(styles, min_size=1, max_size=8))
def test_what_is_absent_stays_unseen(given_styles: list[Style]) -> None:
    for track in style_tracks(given_styles):
        for k in range(track.start, track.end):
            fill = track.styles[k].fill
            if given_styles[k].fill is None and fill is not None:
                stops = fill.stops if isinstance(fill, Gradient) else (Stop(0, fill),)
                assert all(stop.colour.alpha == 0 for stop in stops)
            elif isinstance(given_styles[k].fill, Colour):
                stops = fill.stops if isinstance(fill, Gradient) else ()
                assert all(stop.colour == given_styles[k].fill for stop in stops)


def test_numbers_alone_need_one_track() -> None:
    between = [blend(Style(RED), Style(UP, LINE), t) for t in (0.0, 0.3, 0.6, 1.0)]
    assert len(style_tracks(between)) == 1


def test_a_change_of_kind_is_a_cut() -> None:
    between = [blend(Style(UP), Style(ROUND), k / 10) for k in range(11)]
    first, second = style_tracks(between)
    assert (first.end, second.start) == (5, 5)


def test_dashes_that_meet_are_an_unbroken_line() -> None:
    closed = Style(None, replace(LINE, dashes=(4.0, 0.0)))
    assert style_tracks([closed])[0].styles[0].stroke == LINE


def test_a_line_that_is_flattened_lies_as_it_last_did() -> None:
    """A shape that shrinks to nothing takes its gradient along, which ends as a point."""
    stops = (Stop(0.0, Colour(1, 0, 0)), Stop(1.0, Colour(0, 0, 1)))
    sizes = (1.0, 0.5, 0.0, 0.0)
    shades = [Gradient("linear", (0, 0, 8, 0), (k, 0, 0, k, 0, 0), stops) for k in sizes]
    (track,) = style_tracks([Style(shade) for shade in shades])
    found = [style.fill for style in track.styles]
    assert all(isinstance(fill, Gradient) and fill.matrix == IDENTITY for fill in found)
    assert [fill.points for fill in found if isinstance(fill, Gradient)][1:] == [(0, 0, 4, 0)] * 3
    (track,) = style_tracks([Style(shades[-1])] * 2)
    (fill, _) = (style.fill for style in track.styles)
    assert isinstance(fill, Gradient)
    assert {stop.colour for stop in fill.stops} == {stops[-1].colour}
