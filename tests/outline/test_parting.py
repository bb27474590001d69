"""Strands that run into each other on the way are kept apart."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from shapetween.base.arrays import Complex, Floats
from shapetween.base.observe import unobserved
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.model.outline import Outline
from shapetween.outline import alone, parting
from shapetween.outline.alone import looked_at, moved_alone
from shapetween.outline.body import Carried
from shapetween.outline.matching import match_outer
from shapetween.outline.parting import parted
from shapetween.outline.unfold import unfolded
from tests.baseline import assert_known
from tests.match.shapes import polygon

TIMES = np.linspace(0, 1, CHECKED_TIMES)
U = np.array([[0, 0], [2, 0], [2, 6], [3, 6], [3, 0], [5, 0], [5, 8], [0, 8]], dtype=float)


@cache
def closing(by: float, backwards: bool = False, unit: float = 1.0) -> Carried:
    """A U that hardly changes but for its left arm, which leans `by` towards the other half-way."""
    ends = [unit * U, unit * (U * [1, 1.05])][:: -1 if backwards else 1]
    first, second = (polygon(points) for points in ends)
    # An arm that lies aside is no affine image.
    second = Outline(second.curves + unit * 1e-2 * np.sin(second.curves[..., ::-1] / unit))
    ring = match_outer(
        first, second, quads=None, pins=np.zeros((0, 4)), mesh=None, upright=False,
        observe=unobserved,
    )  # fmt: skip
    body = unfolded([ring], "projective")
    motion = body.path
    assert isinstance(motion, KeyedMotion)
    vertices = motion.vertices(TIMES) / unit
    arm = (vertices[..., 0] < 2.2) & (np.arange(vertices.shape[1]) < len(body.nodes.ends[0]))
    lean = by * arm * np.clip(1 - vertices[..., 1] / 6, 0, 1) * np.sin(np.pi * TIMES)[:, None]
    sizes = (1 - TIMES) * motion.mesh.poses[0].size + TIMES * motion.mesh.poses[1].size
    path = KeyedMotion.of(motion.mesh, motion.posed(TIMES) + unit * lean / sizes[:, None])
    simple = body.nodes.simple(TIMES, path.vertices(TIMES))
    return looked_at(replace(body, path=path, crossing=int((~simple[1:-1]).sum())))


def moves(first: Carried, second: Carried) -> Floats:
    """How far the nodes of the one are from the other's, (F, N)."""
    nodes = slice(0, len(first.nodes.ends[0]))
    gap = first.path.vertices(TIMES)[:, nodes] - second.path.vertices(TIMES)[:, nodes]
    return np.asarray(np.linalg.norm(gap, axis=2))


@pytest.mark.parametrize("by", [1.2, 1.5])
def test_arms_that_would_cross_are_kept_apart_and_no_more_than_that(by: float) -> None:
    body = closing(by)
    assert body.crossing > 20
    assert not body.seen.nothing
    found = parted(body)
    assert found is not None
    assert found.parted
    assert not (~found.nodes.simple(TIMES, found.path.vertices(TIMES))).any()
    far = moves(body, found)
    overlap = by - 1
    assert 0.3 * overlap < far.max() < 1.5 * overlap
    # Only what touches moves: the foot of the U stays.
    foot = body.nodes.ends[0][:, 1] > 6.5
    assert far[:, foot].max() < 0.05 * far.max()
    # The ends are the drawings, and what was pushed comes and goes smoothly.
    assert far[[0, -1]].max() == 0
    assert np.abs(np.diff(far, axis=0)).max() < 0.1 * far.max()


def test_the_way_back_is_parted_alike() -> None:
    found = [parted(closing(1.4, backwards=way)) for way in (False, True)]
    there, back = (body.curves(TIMES) for body in found if body is not None)
    for t in (40, 80, 120):
        low, high = (frame[..., 0].min() for frame in (there[t], back[::-1][t]))
        assert low == pytest.approx(high, abs=0.05)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_parting_has_no_unit(unit: float) -> None:
    plain, other = parted(closing(1.4)), parted(closing(1.4, unit=unit))
    assert plain is not None
    assert other is not None
    gap = other.curves(TIMES) / unit - plain.curves(TIMES)
    assert np.abs(gap).max() < 1e-3


def test_free_vertices_of_the_mesh_follow() -> None:
    body = closing(1.5)
    found = parted(body)
    assert found is not None
    assert found.path.mesh is not None
    first = found.path.mesh.nodes + len(found.path.mesh.frame)
    gap = found.path.vertices(TIMES) - body.path.vertices(TIMES)
    if gap.shape[1] > first:
        assert 0 < np.abs(gap[:, first:]).max() <= np.abs(gap[:, :first]).max()


def test_outlines_of_too_many_places_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parting, "MOST_PLACES", 8)
    assert parted(closing(1.2)) is None


def test_what_crosses_is_parted_before_another_matching_is_tried(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    body = closing(1.2)

    def never(*_: object) -> None:
        raise AssertionError("another matching was tried")

    monkeypatch.setattr(alone, "unfolded", lambda *_: body)
    monkeypatch.setattr(alone, "next_matches", never)
    found = moved_alone(
        list(body.nodes.rings), "projective", None, unobserved, rough=False, decided=False
    )
    assert found.parted
    assert not found.crossing
    assert found.seen.nothing


@pytest.mark.parametrize("by", [1.2, 1.5])
def test_what_is_parted_is_known(by: float) -> None:
    found = parted(closing(by))
    assert found is not None
    curves = found.curves(TIMES[8:-8:12])
    assert_known("outline", f"arms that lean by {by}", curves[:, ::3, 0].ravel().tolist())


def test_strands_that_stay_crossed_are_given_up_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    tried = []

    def stuck(shown: Complex, push: Complex, *rest: object) -> Complex:
        tried.append(len(shown))
        return push

    monkeypatch.setattr(parting, "_without_contacts", stuck)
    assert parted(closing(1.5)) is None
    assert len(tried) == 1
