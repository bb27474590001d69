"""Curves that are one curve at all times become one."""

import numpy as np
import pytest

from shapetween.base.arrays import Curves
from shapetween.geometry import merging
from shapetween.geometry.bezier import evaluate, line_curves, sub_curves
from shapetween.geometry.merging import merged_curves

ARC = np.array([[[0.0, 0.0], [10.0, 30.0], [60.0, 50.0], [90.0, 10.0]]])


def pieces(cuts: list[float], curve: Curves = ARC) -> Curves:
    edges = np.array([0.0, *cuts, 1.0])
    return sub_curves(np.repeat(curve, len(edges) - 1, axis=0), edges[:-1], edges[1:])


def turned(curves: Curves, angles: list[float]) -> Curves:
    return np.stack(
        [curves @ np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]) for a in angles]
    )


def test_pieces_of_a_curve_become_it_again() -> None:
    stack = turned(pieces([0.1, 0.15, 0.4, 0.8]), [0.0, 0.3, 0.9, 2.0])
    made, rings = merged_curves(stack, (5,), 1e-6, 1e-9)
    assert rings == (1,)
    np.testing.assert_allclose(made, turned(ARC, [0.0, 0.3, 0.9, 2.0]), atol=1e-10)


def test_a_straight_side_is_one_line() -> None:
    corners = np.array([[0.0, 0], [1, 0], [4, 0], [9, 0], [9, 9], [0, 9]])
    stack = np.repeat(line_curves(corners, np.roll(corners, -1, axis=0))[None], 3, axis=0)
    made, rings = merged_curves(stack, (6,), 1e-6, 1e-9)
    assert rings == (4,)
    np.testing.assert_allclose(made[0, 0], line_curves(corners[0], corners[3]), atol=1e-12)


def test_a_joint_that_opens_on_the_way_stays() -> None:
    """It is one curve at both ends."""
    stack = np.repeat(pieces([0.5])[None], 5, axis=0)
    bent = stack.copy()
    bent[2, 0, 3] += 1.0
    bent[2, 1, 0] += 1.0
    assert merged_curves(stack, (2,), 1e-6, 1e-9)[1] == (1,)
    assert merged_curves(bent, (2,), 1e-6, 1e-9)[1] == (2,)
    # Between the samples of the first look too.
    longer = np.repeat(stack[:1], 40, axis=0)
    longer[3, 0, 3] += 1.0
    longer[3, 1, 0] += 1.0
    assert merged_curves(longer, (2,), 1e-6, 1e-9)[1] == (2,)


def test_rings_stay_apart() -> None:
    stack = np.repeat(np.concatenate([pieces([0.3]), pieces([0.6])])[None], 3, axis=0)
    made, rings = merged_curves(stack, (2, 0, 2), 1e-6, 1e-9)
    assert rings == (1, 0, 1)
    np.testing.assert_allclose(made, np.repeat(np.repeat(ARC[None], 2, axis=1), 3, axis=0))


def test_what_is_merged_stays_within_the_distance() -> None:
    """However many pieces there are, each of which is a little off."""
    rng = np.random.default_rng(3)
    for allowed in (0.01, 0.1, 1.0):
        cuts = np.sort(rng.uniform(0, 1, 30)).tolist()
        stack = np.repeat(pieces(cuts)[None], 4, axis=0)
        # Joints are moved along with their handles.
        shift = rng.normal(0, 0.02, (2, 30, 2))
        stack[1:3, :-1, 2:] += shift[:, :, None]
        stack[1:3, 1:, :2] += shift[:, :, None]
        made, (count,) = merged_curves(stack, (31,), allowed, 1e-9)
        dense = evaluate(made, np.linspace(0, 1, 2000)).reshape(4, -1, 2)
        points = evaluate(stack, np.linspace(0, 1, 9)).reshape(4, -1, 2)
        away = np.linalg.norm(points[:, :, None] - dense[:, None], axis=-1).min(axis=2)
        assert away.max() <= allowed + 0.03
        assert count < 31 or allowed == 0.01


def test_what_is_gone_at_an_end_merges_with_its_like() -> None:
    """A curve that grows out of a point has no direction there."""
    growth = np.array([0.0, 0.3, 1.0])[:, None, None, None]
    made, rings = merged_curves(growth * pieces([0.2, 0.7])[None], (3,), 1e-6, 1e-9)
    assert rings == (1,)
    np.testing.assert_allclose(made, growth * ARC[None], atol=1e-10)


def test_a_piece_without_length_is_none_of_a_curve() -> None:
    point = np.zeros((1, 4, 2))
    stack = np.repeat(np.concatenate([point, pieces([])])[None], 3, axis=0)
    assert merged_curves(stack, (2,), 1e-6, 1e-9)[1] == (2,)


def test_what_only_moves_and_grows_is_looked_at_when_it_is_largest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It merges as if it were looked at at all times, also where it grows beyond its ends."""
    rng = np.random.default_rng(5)
    coast = np.cumsum(rng.normal([0.6, 0.1], 1.0, (60, 2)), axis=0)
    form = line_curves(coast, np.roll(coast, -1, axis=0))
    for sizes in (np.linspace(0, 1, 31), np.concatenate([np.linspace(1, 2, 16), [1.0]])):
        moves = np.linspace(0, 700, len(sizes))[:, None] * [1.0, -0.4]
        stack = moves[:, None, None] + sizes[:, None, None, None] * form
        assert merging._alike(stack, merging.ALIKE * 0.2) is not None
        monkeypatch.setattr(merging, "ALIKE", 0.0)
        every, count = merged_curves(stack, (60,), 0.4, 0.2)
        monkeypatch.undo()
        made, rings = merged_curves(stack, (60,), 0.4, 0.2)
        assert rings == count
        assert 1 < rings[0] < 55
        np.testing.assert_allclose(made, every, atol=1e-9)
        np.testing.assert_array_equal(made[[0, -1]], every[[0, -1]])
    # What turns while it grows is looked at all the time.
    bent = sizes[:, None, None, None] * turned(form, (3 * sizes).tolist())
    assert merging._alike(bent, merging.ALIKE * 0.2) is None
