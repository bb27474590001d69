"""Where the limits of deformations lie: each case is looked at over a range across its limit."""

import tracemalloc
from collections.abc import Iterator
from types import SimpleNamespace

import numpy as np
import pytest

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.base.ends import End
from shapetween.deform import mesh as meshing
from shapetween.deform.check import LOOKED, crossing_frames
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.locate import MeshBinder, PointLocator
from shapetween.deform.mesh import _is_base, _thin, ambient_mesh
from shapetween.deform.pose import affine_path
from shapetween.deform.schedule import solve
from shapetween.geometry.bezier import line_curves
from tests.baseline import assert_known
from tests.deform.shapes import blob


def edges(count: int) -> np.ndarray:
    return np.stack([np.arange(count), (np.arange(count) + 1) % count], axis=1)


def normalised(points: np.ndarray) -> np.ndarray:
    away = points - points.mean(axis=0)
    return np.asarray(away / np.sqrt((away**2).sum() / len(away)))


def test_how_like_affine_images_must_be_is_known() -> None:
    source = normalised(blob(5, 20))
    sheared = source @ np.array([[1.2, 0.5], [0.0, 0.9]])
    noise = np.random.default_rng(1).normal(size=source.shape)
    shears = [
        affine_path(source, sheared + off * noise).matrix[0, 1]
        for off in (3e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1)
    ]
    assert_known("deform", "affine", shears)


def test_half_a_turn_goes_forwards_whatever_rounding_says() -> None:
    source = normalised(blob(5, 20))
    forwards = 0
    for off in np.geomspace(1e-10, 1e-8, 40):
        angle = np.pi + off
        c, s = np.cos(angle), np.sin(angle)
        forwards += affine_path(source, source @ np.array([[c, s], [-s, c]])).angle > 0
    assert_known("deform", "half turns", [forwards])


def test_what_is_thin_is_known() -> None:
    corners = [[[0, 0], [1, 0], [0.5, height]] for height in np.geomspace(1e-8, 1e-6, 60)]
    assert_known("deform", "thin", [_thin(np.array(corners)).sum()])


def test_which_of_two_alike_is_the_base_does_not_hang_on_rounding() -> None:
    one = normalised(blob(7, 12))
    bases = [_is_base(one, one * (1 + off), edges(12)) for off in np.geomspace(1e-11, 1e-7, 60)] + [
        _is_base(one * (1 + off), one, edges(12)) for off in np.geomspace(1e-11, 1e-7, 60)
    ]
    assert_known("deform", "bases", [sum(bases[:60]), sum(bases[60:])])


def test_how_finely_curves_are_looked_at_is_known() -> None:
    """A narrow strip whose sides are curves that bulge towards each other."""
    crossing = []
    for bulge in np.linspace(0.0, 4.0, 60):
        lower = np.array([[0, 0], [1, bulge], [2, 0], [3, 0]], dtype=float)
        right = line_curves(np.array([[3.0, 0.0]]), np.array([[3.0, 1.0]]))[0]
        upper = np.array([[3, 1], [2, 1], [1, 1], [0, 1]], dtype=float)
        left = line_curves(np.array([[0.0, 1.0]]), np.array([[0.0, 0.0]]))[0]
        crossing.append(bool(crossing_frames(np.array([[lower, right, upper, left]]), [4], [True])))
    assert_known("deform", "looked at", [sum(crossing), len(LOOKED), *LOOKED.tolist()])


def test_memory_of_finding_places_is_bounded() -> None:
    mesh = ambient_mesh(blob(5, 40), blob(6, 40))
    locator = PointLocator(mesh, End.SOURCE)
    points = mesh.source.mean(axis=0) + 1e4 * np.random.default_rng(1).normal(size=(20_000, 2))
    tracemalloc.start()
    locator.locate(points)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert_known("deform", "memory", [round(peak / 2e7)])


def test_places_far_out_are_bound_to_what_is_near() -> None:
    mesh = ambient_mesh(blob(5, 14), blob(6, 14))
    middle, size = mesh.source.mean(axis=0), np.ptp(mesh.source, axis=0).max()
    ways = np.stack([np.cos(np.arange(24)), np.sin(np.arange(24))], axis=1)
    found = [
        MeshBinder(mesh).bind(middle + far * size * ways, End.SOURCE).weights
        for far in (0.3, 0.6, 1.0)
    ]
    assert_known("deform", "far out", [float(np.abs(one).sum()) for one in found])


@pytest.mark.parametrize("seed", range(3))
def test_the_nearest_triangles_hold_what_is_inside(seed: int) -> None:
    """Few are looked through all, which takes longer."""
    mesh = ambient_mesh(blob(seed, 30), blob(seed + 9, 30))
    locator = PointLocator(mesh, End.SOURCE)
    inside = mesh.source[mesh.triangles].mean(axis=1)
    calls = []
    best = locator._best

    def counted(points: np.ndarray, among: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        calls.append(among.shape)
        return best(points, among)

    locator._best = counted  # type: ignore[method-assign]
    locator.locate(0.7 * inside + 0.3 * mesh.source[mesh.triangles[:, 0]])
    figures = [float(sum(rows * columns for rows, columns in calls))]
    assert_known("deform", f"looked through {seed}", figures)


def test_what_share_of_inverted_triangles_is_tolerated_is_known(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of layouts of a thousand triangles, of which ever more stay inverted."""
    whole = SimpleNamespace(triangles=range(1000))

    class Attempt:
        layout, nodes, swapped = whole, None, False

        def __init__(self, inverted: int) -> None:
            self.inverted = inverted

        def refined(self) -> "Attempt":
            return self

    patient = 0
    for inverted in range(5, 95, 3):
        first = Attempt(inverted)
        made = SimpleNamespace(at=lambda *_, first=first, **__: first)
        monkeypatch.setattr(meshing, "_Attempt", made)
        monkeypatch.setattr(meshing, "Layout", SimpleNamespace(around=lambda *_: whole))
        shapes = (np.zeros((4, 2)), np.ones((4, 2)))
        patient += len(list(meshing._attempts((shapes, shapes), [], True))) > 4
    assert_known("deform", "patience", [patient])


def test_at_how_many_times_motions_are_solved_and_repaired_is_known() -> None:
    """The first look finds a crossing, the second one none."""
    mesh = ambient_mesh(blob(5, 20), blob(6, 20), [np.arange(20)])
    counts = []
    for answers in ([True], [False, True]):
        looks = iter(answers)

        def look(t: Floats, _: Points, looks: Iterator[bool] = looks) -> Mask:
            return np.full(len(t), next(looks))

        solved = solve(mesh, look)
        assert isinstance(solved.motion, KeyedMotion)
        counts.append(float(len(solved.motion.keys)))
    assert_known("deform", "times", counts)
