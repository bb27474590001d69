import numpy as np

from shapetween.deform.check import crossing_frames, simple_frames
from shapetween.geometry.bezier import line_curves
from tests.deform.shapes import two_discs

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def test_frames_that_cross_or_touch_are_found() -> None:
    bow = SQUARE[[0, 2, 1, 3]]
    touching = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [0.5, 1.0]])
    assert simple_frames(np.stack([SQUARE, bow, touching])).tolist() == [True, False, False]


def test_rings_must_not_cross_each_other() -> None:
    nodes, _ = two_discs(0.0)
    near = nodes + np.repeat([[0.0, 0.0], [1.9, 0.0]], 12, axis=0)
    assert simple_frames(np.stack([nodes, near]), (12, 12)).tolist() == [True, False]


def test_only_closed_rings_that_cross_themselves_are_found() -> None:
    square, bow = (line_curves(p, np.roll(p, -1, axis=0)) for p in (SQUARE, SQUARE[[0, 2, 1, 3]]))
    frames = np.stack([np.concatenate([square, square + 0.5]), np.concatenate([square, bow])])
    assert crossing_frames(frames, (4, 4), (True, True)).tolist() == [False, True]
    assert crossing_frames(frames, (4, 4), (True, False)).tolist() == [False, False]
