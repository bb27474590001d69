"""What rides on a plane: exact at both ends, with the plane in between."""

import numpy as np
import pytest

from shapetween.attach.nearby import Parts
from shapetween.attach.planes import AffinePlane
from shapetween.attach.riders import Leaver, Tip, riding
from shapetween.base.arrays import Affine
from shapetween.geometry.bezier import evaluate
from shapetween.model.outline import Outline
from tests.drawings import line, square
from tests.movements import circle
from tests.strategies import rotation

T = np.linspace(0, 1, 9)
EXTENTS = (100.0, 100.0)
TURN = np.column_stack([rotation(np.deg2rad(110)), [30.0, 5.0]])
SHEAR = np.array([[1.0, 1.5, 0.0], [0.0, 1.0, 0.0]])


def plane(matrix: Affine) -> AffinePlane:
    return AffinePlane(matrix, np.array([50.0, 50.0]))


def disc(x: float, y: float, radius: float) -> Outline:
    return Outline(circle(np.array([x, y]), radius))


def test_both_ends_are_exact_whatever_the_plane_does() -> None:
    first, second = square(10, 10, 50), square(30, 40, 20)
    for matrix in (TURN, SHEAR):
        rider = riding(Parts(first.curves, second.curves, True), plane(matrix), EXTENTS)
        frames = rider.curves(T)
        np.testing.assert_array_equal(frames[0], rider.source)
        np.testing.assert_array_equal(frames[-1], rider.target)
        np.testing.assert_array_equal(frames[:, 1:, 0], frames[:, :-1, 3])
        np.testing.assert_array_equal(frames[:, 0, 0], frames[:, -1, 3])


def test_what_fits_the_plane_goes_with_it() -> None:
    first = square(10, 10, 50)
    second = first.transformed(TURN)
    rider = riding(Parts(first.curves, second.curves, True), plane(TURN), EXTENTS)
    carried = plane(TURN).carried(first.curves.reshape(-1, 2), T)
    np.testing.assert_allclose(rider.curves(T).reshape(len(T), -1, 2), carried, atol=1e-9)


def test_what_turns_more_than_its_plane_keeps_its_size() -> None:
    first = line((40, 40), (60, 42), (70, 60)).rings[0]
    matrix = np.column_stack([rotation(np.deg2rad(80)), [80.0, -20.0]])
    second = first.transformed(matrix)
    rider = riding(Parts(first.curves, second.curves, False), plane(np.eye(2, 3)), EXTENTS)
    frames = rider.curves(T)
    lengths = np.linalg.norm(frames[:, :, 3] - frames[:, :, 0], axis=2)
    np.testing.assert_allclose(lengths, np.repeat(lengths[:1], len(T), axis=0))


def test_small_things_stay_round_where_the_plane_shears() -> None:
    eye, brought = disc(40, 40, 3), disc(100, 40, 3)
    rider = riding(Parts(eye.curves, brought.curves, True), plane(SHEAR), EXTENTS)
    for frame in rider.curves(T):
        points = evaluate(frame, T).reshape(-1, 2)
        radii = np.linalg.norm(points - points.mean(axis=0), axis=1)
        assert radii.max() < 1.1 * radii.min()


def test_smooth_joints_stay_smooth() -> None:
    first, second = disc(50, 50, 40), disc(40, 60, 30)
    rider = riding(Parts(first.curves, second.curves, True), plane(SHEAR), EXTENTS)
    for frame in rider.curves(T):
        leaving = frame[:, 1] - frame[:, 0]
        reaching = np.roll(frame[:, 3] - frame[:, 2], 1, axis=0)
        cosines = (leaving * reaching).sum(axis=1) / (
            np.linalg.norm(leaving, axis=1) * np.linalg.norm(reaching, axis=1)
        )
        assert cosines.min() > 0.999


@pytest.mark.parametrize("arrives", [False, True])
def test_leavers_close_to_their_centre_where_the_plane_takes_it(arrives: bool) -> None:
    ring = square(20, 20, 40)
    centre = np.array([35.0, 45.0])
    found = Leaver.of((ring.curves,), centre, arrives, plane(TURN), EXTENTS[0])
    frames = found.curves(T)[:: -1 if arrives else 1]
    np.testing.assert_array_equal(frames[0], ring.curves)
    (there,) = plane(TURN).hold(centre[None], arrives).at(np.array([1.0 - arrives]))
    np.testing.assert_allclose(frames[-1].reshape(-1, 2), np.repeat(there, 16, axis=0), atol=1e-9)


def test_a_leaver_goes_with_its_host() -> None:
    """The host leaves the plane's way; what lies on it stays on it."""
    host = riding(
        Parts(square(20, 20, 40).curves, square(50, 50, 40).curves, True),
        plane(np.eye(2, 3)),
        EXTENTS,
    )
    spot = square(35, 35, 10)
    centre = np.array([40.0, 40.0])
    alone, held = (
        Leaver.of((spot.curves,), centre, False, plane(np.eye(2, 3)), 100.0, on)
        for on in (None, host)
    )
    np.testing.assert_array_equal(held.curves(T)[0], spot.curves)
    middles = held.curves(T).mean(axis=(1, 2)) - alone.curves(T).mean(axis=(1, 2))
    np.testing.assert_allclose(middles, T[:, None] * [30, 30], atol=1e-9)


@pytest.mark.parametrize("arrives", [False, True])
def test_a_tip_grows_along_its_line_from_its_start(arrives: bool) -> None:
    bent = line((10, 10), (50, 10), (50, 50)).rings[0]
    found = Tip.of(bent.curves, arrives, plane(np.eye(2, 3)), 100.0)
    frames = found.curves(T)[:: 1 if arrives else -1]
    np.testing.assert_array_equal(frames[-1], bent.curves)
    for share, frame in zip(T, frames, strict=True):
        np.testing.assert_allclose(frame[0, 0], [10, 10])
        length = np.linalg.norm(np.diff(evaluate(frame, T), axis=1), axis=2).sum()
        assert length == pytest.approx(80 * share, abs=1e-6)
        np.testing.assert_allclose(frame[1:, 0], frame[:-1, 3], atol=1e-9)
