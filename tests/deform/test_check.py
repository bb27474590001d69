import numpy as np
import pytest

from shapetween.deform import check
from shapetween.deform.check import crossing_frames, simple_frames
from shapetween.geometry.bezier import line_curves
from tests.baseline import assert_known
from tests.deform.shapes import two_discs

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


#: A gate whose right post comes down onto its sill by its fifth corner.
GATE = np.array([[0.0, 0.0], [4, 0], [4, 1], [3, 1], [2.5, 0.2], [2, 1], [0, 1]])


def lowered(by: float) -> np.ndarray:
    """The gate with its corner so far below its sill."""
    points = GATE.copy()
    points[4, 1] = -by
    return points


def test_frames_that_cross_are_found_and_those_that_touch_are_not() -> None:
    bow = SQUARE[[0, 2, 1, 3]]
    folded = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [0.5, 1.0]])
    assert simple_frames(np.stack([SQUARE, bow, folded])).tolist() == [True, False, True]


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_rounding_does_not_say_whether_what_touches_crosses(scale: float) -> None:
    noise = np.random.default_rng(3).normal(size=(40, 7, 2)) * 1e-15
    touching = np.stack([lowered(0.0) + each for each in noise])
    assert simple_frames(scale * touching).all()
    assert not simple_frames(scale * np.stack([lowered(by) for by in (1e-3, 0.1)])).any()


def test_how_deep_strands_cross_that_do_is_known() -> None:
    depths = np.geomspace(1e-8, 1e-3, 60)
    crossing = [simple_frames(np.stack([lowered(by)]))[0] for by in depths]
    assert_known("deform", "depths", [float(np.sum(crossing))])


def test_what_crosses_just_at_its_corners_does() -> None:
    """A strand that goes through another one at corners of both crosses by no two edges alone."""
    eight = np.array([[0.0, 0.0], [1, 1], [2, 2], [2, 0], [1, 1], [0, 2]])
    assert not simple_frames(eight[None])[0]
    small = [np.array([[0.0, 0], [2, 2], [4, 2], [4, -s], [2, -s], [2, 2], [0, 4]]) for s in (0, 1)]
    assert not simple_frames(np.stack(small)).any()
    tiny = []
    for size in np.geomspace(1e-5, 1e-2, 60):
        lobe = size * np.array([[0.0, 0.0], [1, 1], [2, 1], [1, 0.5], [0, 0]])[1:]
        tiny.append(
            simple_frames(np.concatenate([[[0.0, 0.0]], lobe, [[0, 0], [0, 1], [-1, 0]]])[None])
        )
    assert_known("deform", "small lobes", [float(np.sum(tiny))])


def test_rings_that_touch_do_not_cross() -> None:
    beside = [SQUARE + np.array([1.0 - by, 0.25]) for by in (0.0, 1e-12, 1e-3)]
    frames = np.stack([np.concatenate([SQUARE, other]) for other in beside])
    assert simple_frames(frames, (4, 4)).tolist() == [True, True, False]
    corner = np.concatenate([SQUARE, 0.5 * SQUARE + [[0.5, 0.25]]])
    assert simple_frames(corner[None], (4, 4))[0]


def test_rings_must_not_cross_each_other() -> None:
    nodes, _ = two_discs(0.0)
    near = nodes + np.repeat([[0.0, 0.0], [1.9, 0.0]], 12, axis=0)
    assert simple_frames(np.stack([nodes, near]), (12, 12)).tolist() == [True, False]


def test_frames_are_found_alike_however_few_are_looked_at_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    t = np.linspace(0, 1, 90)[:, None]
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    wide = 0.7 + np.sin(9 * t) * np.cos(2 * angle)
    frames = np.stack([wide * np.cos(angle), (1 + t) * np.sin(angle)], axis=-1)
    frames[60:80, 7] = frames[60:80, 27]  # a tip that touches the other side, or comes through
    found = simple_frames(frames)
    assert 10 < found.sum() < 80
    for strides, pairs in (((1,), 1), ((5, 1), 1), ((50, 3, 1), 2)):
        monkeypatch.setattr(check, "STRIDES", strides)
        monkeypatch.setattr(check, "MOST_PAIRS", pairs)
        np.testing.assert_array_equal(simple_frames(frames), found)


def test_only_closed_rings_that_cross_themselves_are_found() -> None:
    square, bow = (line_curves(p, np.roll(p, -1, axis=0)) for p in (SQUARE, SQUARE[[0, 2, 1, 3]]))
    frames = np.stack([np.concatenate([square, square + 0.5]), np.concatenate([square, bow])])
    assert crossing_frames(frames, (4, 4), (True, True)).tolist() == [False, True]
    assert crossing_frames(frames, (4, 4), (True, False)).tolist() == [False, False]
