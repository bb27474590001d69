"""Outlines of very many curves carried by their coarse shapes."""

import numpy as np
import pytest

from shapetween.base.arrays import Curves, Floats
from shapetween.deform.check import simple_frames
from shapetween.geometry.bezier import line_curves, signed_area
from shapetween.match import correspond
from shapetween.model.outline import Outline
from shapetween.outline.carry import Carrier
from shapetween.outline.coarse import Coarse, coarse
from shapetween.outline.detail import DetailedOutlines
from tests.coasts import coast

TIMES = np.linspace(0, 1, 13)

CORNERS = 40


def detailed(source: Outline, target: Outline) -> DetailedOutlines:
    first, second = coarse(source, CORNERS), coarse(target, CORNERS)
    assert first is not None
    assert second is not None
    matching = correspond(first.polygon, second.polygon)
    return DetailedOutlines(first, second, matching.u, matching.v)


def moved(outlines: DetailedOutlines, t: Floats, *, ordered: bool = True) -> Curves:
    """The curves on nodes that go straight."""
    samples = outlines.samples()
    time = t[:, None, None]
    nodes = (1 - time) * samples.source + time * samples.target
    pieces = outlines.cut(samples.w)
    carrier = Carrier(pieces, samples.w, samples.source, samples.target, ordered=ordered)
    return carrier.curves(nodes, t)


@pytest.mark.parametrize("seeds", [(1, 2), (3, 4)])
def test_the_pieces_are_both_outlines_whole(seeds: tuple[int, int]) -> None:
    ends = coast(seeds[0], 2000), coast(seeds[1], 2000)
    outlines = detailed(*ends)
    pieces = outlines.cut(outlines.samples().w)
    for cut, outline in zip((pieces.source, pieces.target), ends, strict=True):
        np.testing.assert_array_equal(cut[:, 3], np.roll(cut[:, 0], -1, axis=0))
        assert signed_area(cut) == pytest.approx(outline.area, rel=1e-12)
        joints = {tuple(p) for p in outline.curves[:, 0].tolist()}
        assert joints <= {tuple(p) for p in cut[:, 0].tolist()}
    assert (np.diff(pieces.w) >= 0).all()
    both = np.ptp(pieces.source, axis=1).any(axis=1) | np.ptp(pieces.target, axis=1).any(axis=1)
    assert both.all()  # no piece is a point at both ends
    assert len(pieces.w) <= 1.1 * sum(len(outline.curves) for outline in ends)


def test_no_more_crosses_on_the_way_than_at_the_ends() -> None:
    outlines = detailed(coast(1, 2000), coast(2, 2000))
    points = moved(outlines, TIMES)[:, :, 0]
    assert simple_frames(points).all()


def test_where_one_outline_wanders_the_other_stands_still() -> None:
    # A straight shore and one with a bay that widens inland, in a square of land.
    bay = [(4, 0), (3.5, 2), (2, 2.5), (2.5, 3.5), (6, 3.5), (6.5, 2.5), (5, 2), (4.6, 0)]
    square = [(8, 0), (8, 8), (0, 8), (0, 0)]
    shapes = [np.array(points, dtype=float) for points in (bay + square, square)]
    ends = [Outline(line_curves(p, np.roll(p, -1, axis=0))) for p in shapes]
    # Both known by the square's corners alone.
    coarse_ends = Coarse(ends[0], np.arange(8.0, 12.0), 4.0), Coarse(ends[1], np.arange(4.0), 0.0)
    knots = np.arange(5) / 4
    outlines = DetailedOutlines(*coarse_ends, knots, knots)
    points = moved(outlines, TIMES)[:, :, 0]
    assert simple_frames(points[:-1]).all()
    pieces = outlines.cut(outlines.samples().w)
    wandering = ~np.isin(pieces.source[:, 0, 0], [0, 8]) & ~np.isin(pieces.source[:, 3, 0], [0, 8])
    assert wandering.sum() >= 7
    assert not np.ptp(pieces.target[wandering], axis=1).any()


def test_nothing_depends_on_the_unit() -> None:
    ends = coast(1, 1500), coast(2, 1500)
    scale = np.array([[1e4, 0, 3e4], [0, 1e4, -2e4]])
    small = moved(detailed(*ends), TIMES)
    large = moved(detailed(ends[0].transformed(scale), ends[1].transformed(scale)), TIMES)
    np.testing.assert_allclose((large - scale[:, 2]) / 1e4, small, atol=1e-6)


def test_both_ends_are_exact() -> None:
    outlines = detailed(coast(1, 1500), coast(2, 1500))
    pieces = outlines.cut(outlines.samples().w)
    drawn = moved(outlines, np.array([0.0, 1.0]))
    np.testing.assert_array_equal(drawn[0], pieces.source)
    np.testing.assert_array_equal(drawn[1], pieces.target)
