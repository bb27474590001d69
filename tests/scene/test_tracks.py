"""Frames that drawings move in, and what becomes of tracks that are made of others."""

import numpy as np
import pytest

from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.model.part import CurveTrack
from shapetween.scene.items import items_of
from shapetween.scene.motion import choose
from shapetween.scene.motion.holes import Opening
from shapetween.scene.motion.tracks import Blend, Frame, Framed, Mirrored, Shared
from shapetween.scene.places import Pieces

CORNERS = np.array([[1.0, 1.0], [5.0, 1.0], [5.0, 4.0], [1.0, 4.0]])
RING = line_curves(CORNERS, np.roll(CORNERS, -1, axis=0))
TIMES = np.array([0.0, 0.3, 0.5, 1.0])


def square(shift: float = 0.0) -> Blend:
    pieces = Pieces(RING, RING + np.array([2.0 + shift, 0.0]), True)
    return Blend(pieces, np.array([[3, 2.5], [5, 2.5]]))


@pytest.mark.parametrize("off", [-1e-12, 0.0, 1e-12])
def test_a_card_seen_on_its_edge_shows_the_same_side_whatever_rounding_says(off: float) -> None:
    """Half-way through turning over, its width is nothing but rounding."""
    centres = np.array([[3.0, 2.5], [3.0, 2.5]])
    frame = Frame(centres, 0.0, np.diag([-1.0 + off, 1.0]), over=0)
    moved = frame.carried(np.repeat(RING[None], 1, axis=0), np.array([0.5]))
    assert moved[0, 0, 0, 0] < moved[0, 1, 0, 0]
    assert 0.2 < np.ptp(moved[0, ..., 0]) < 0.5


def test_a_track_in_a_frame_is_itself_at_the_start() -> None:
    frame = Frame(np.array([[0.1, 0.2], [7.0, 3.0]]), 0.7, np.eye(2) * 1.3)
    framed = Framed(square(), frame)
    np.testing.assert_array_equal(framed.curves(np.zeros(1))[0], RING)
    assert framed.closed == (True,)
    assert not framed.areas


def test_what_a_track_is_made_of_is_changed_wherever_it_stands() -> None:
    """As the studio does while a pin is dragged."""
    old, new = square(), square(1.0)
    tracks: list[CurveTrack] = [
        Shared(old),
        Mirrored(old, 0, (3.0, 5.0)),
        Opening(Shared(old), closes=False),
    ]
    for track in tracks:
        fresh = track.following(lambda own: new if own is old else own)
        assert type(fresh) is type(track)
        gap = fresh.curves(TIMES) - track.curves(TIMES)
        assert np.abs(gap[-1]).max() == pytest.approx(1.0)


def test_corners_are_not_matched_where_an_outline_turns_far_too_much(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked = []
    monkeypatch.setattr(choose, "registered", lambda *ends: asked.append(ends))
    for teeth, looked in ((3, True), (12, False)):
        angle = 2 * np.pi * np.arange(2 * teeth) / (2 * teeth)
        radius = np.where(np.arange(2 * teeth) % 2, 5.0, 9.0)
        corners = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
        ((item,), _) = items_of((Shape((ring,), Style(Colour())),), "star")
        choose.corners_suffice(item, item)
        assert bool(asked) == looked
        asked.clear()
