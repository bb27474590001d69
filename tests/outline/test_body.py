import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.outline.body import FLATNESS, _chords


@given(st.integers(0, 10**6), st.floats(-6, 6))
def test_chords_stay_near_their_curves_at_all_times(seed: int, decade: float) -> None:
    random = np.random.default_rng(seed)
    curves = 10.0**decade * random.uniform(-1, 1, (3, 5, 4, 2))
    chords = _chords(curves)
    extent = np.ptp(curves[:, :, 0], axis=1).max(axis=1)
    for curve, count in zip(np.swapaxes(curves, 0, 1), chords.tolist(), strict=True):
        points = evaluate(curve, np.arange(2 * count + 1) / (2 * count))
        away = np.linalg.norm(points[:, 1::2] - (points[:, :-1:2] + points[:, 2::2]) / 2, axis=2)
        assert (away.max(axis=1) <= FLATNESS * extent).all()


def test_lines_are_one_chord_and_huge_outlines_have_few() -> None:
    corners = np.random.default_rng(1).uniform(0, 1e6, (6, 2))
    lines = line_curves(corners, np.roll(corners, -1, axis=0))[None]
    assert _chords(lines).tolist() == [1] * 6
    bent = lines.copy()
    bent[0, 2, 1] += 1e4
    assert _chords(bent)[2] > 5
    assert (_chords(np.repeat(bent, 4000, axis=1)) == 1).all()
