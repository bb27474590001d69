"""Where the limits of outlines lie: each case is looked at over a range across its limit."""

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from shapetween.base.observe import unobserved
from shapetween.outline import coarse as coarsening
from shapetween.outline.carry import _folded, _straight, affine_between
from shapetween.outline.coarse import coarse
from shapetween.outline.matching import match_outer
from shapetween.outline.parting import _neighbours, _Places, _step
from tests.baseline import assert_known
from tests.match.shapes import rounded, star


def lobed(corners: int, lobes: int) -> Any:
    angle = 2 * np.pi * np.arange(corners) / corners
    radius = 1 + 0.3 * np.cos(lobes * angle) + 0.02 * np.cos(37 * angle)
    return rounded(radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1))


@cache
def matched(corners: int) -> Any:
    return match_outer(
        lobed(corners, 3),
        lobed(corners, 4),
        quads=None,
        pins=np.zeros((0, 4)),
        mesh=None,
        upright=True,
        observe=unobserved,
    )


def test_from_how_many_curves_coarse_shapes_are_matched_is_known() -> None:
    figures = [float(matched(corners).coarse) for corners in (310, 590, 610)]
    figures.append(len(matched(610).samples.w))
    assert_known("outline", "coarse from", figures)


def test_coarse_shapes_are_known() -> None:
    figures = []
    for outline, most in ((lobed(300, 3), 40), (rounded(star(3)), 12), (rounded(star(4)), 4)):
        found = coarse(outline, most)
        assert found is not None
        figures += [len(found.corners), found.left_out, *found.lowered(np.arange(5) / 5).tolist()]
    assert coarsening.coarse(rounded(star(5)), 4) is not None
    assert_known("outline", "coarse", figures)


def test_which_maps_are_affine_is_known() -> None:
    """Of points ever flatter, stretched ever more, and ever less alike."""
    points = star(6, 14)
    figures = []
    for flat in np.geomspace(1e-7, 1e-5, 24):
        source = points * [1.0, flat]
        figures.append(float(np.trace(affine_between(source, source * [2.0, 5.0])[1]) > 6.5))
    noise = np.random.default_rng(1).normal(size=points.shape)
    for stretch in np.linspace(1.2, 8, 24):
        rough = points * [stretch, 1.0] + 0.05 * noise
        figures.append(float(np.ptp(np.diag(affine_between(points, rough)[1])) > 1e-9))
    for off in np.geomspace(1e-4, 1e-2, 24):
        rough = points * [20.0, 1.0] + off * 20 * noise
        figures.append(float(np.ptp(np.diag(affine_between(points, rough)[1])) > 1e-9))
    assert_known("outline", "affine", [sum(figures[k : k + 24]) for k in (0, 24, 48)])


def test_what_is_folded_or_straight_is_known() -> None:
    offs = np.geomspace(1e-10, 1e-8, 40)
    curves = np.array([[[0, 0], [off, 0], [1, 1], [2, 0]] for off in offs])
    bent = np.array([[[0, 0], [1, off], [2, 0], [3, 0]] for off in np.geomspace(1e-4, 1e-1, 40)])
    assert_known("outline", "folded", [_folded(curves).sum(), _straight(bent).sum()])


def strands(gap: float, count: int = 200) -> tuple[np.ndarray, _Places]:
    """Places along two strands of one ring that lie beside each other."""
    along = np.linspace(0.0, 1.0, count // 2)
    here = np.concatenate([along, along[::-1] + 1j * gap])
    every = np.arange(count)
    following = (every + 1) % count
    ways = np.abs(here[following] - here)
    places = _Places(
        following, every, following, np.full(count, 0.25), np.zeros(count, dtype=np.intp),
        np.cumsum(ways) - ways, np.full(count, ways.sum()),
    )  # fmt: skip
    return here, places


def test_which_places_are_neighbours_is_known() -> None:
    figures = []
    for gap in (0.01, 0.03, 0.07):
        here, places = strands(gap)
        found = _neighbours(here, here, places, 1.0)
        figures += [len(found.place), float(found.clear.sum()), found.deepest]
    assert_known("outline", "neighbours", figures)


def test_how_far_what_crosses_is_pushed_is_known() -> None:
    figures = []
    here, places = strands(0.02)
    for deep in (0.0205, 0.03, 0.044, 0.046, 0.06):
        through = here - 1j * deep * (here.imag > 0)
        step = _step(through, _neighbours(through, here, places, 1.0), places, len(here))
        figures += [0.0] if step is None else [float(np.abs(step).sum())]
    assert_known("outline", "pushed", figures)


@pytest.mark.parametrize("side", [0, 1])
def test_of_a_drag_only_so_many_places_are_kept(side: int) -> None:
    from shapetween.outline.preview import _Kept

    looked = []

    class Line:
        def nearest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            looked.append(1)
            return np.zeros(1), np.zeros(1)

    kept = _Kept(SimpleNamespace(), 0.0, (1.0, 1.0))  # type: ignore[arg-type]
    kept.__dict__["lengths"] = (Line(), Line())
    for _ in range(2):
        for x in range(990):
            kept._nearest(side, float(x), 0.0)
    assert len(looked) == 990
    for x in range(990, 1100):
        kept._nearest(side, float(x), 0.0)
    assert len(kept._known) == 100
