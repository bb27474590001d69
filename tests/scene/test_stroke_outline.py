"""A stroke's outline: all of the region at both ends, and one width in between."""

import numpy as np
import pytest
import shapely

from shapetween.base.arrays import Curves
from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.model.outline import Outline
from shapetween.scene.strokes.contour import stroke_rings
from shapetween.scene.strokes.outline import StrokeOutline, stroke_outline
from shapetween.scene.strokes.segmentation import outlined_strokes
from tests.scene.strokes import arc, flat, painted, polyline, region_of
from tests.scene.test_centrelines import STROKES


def area_of(rings: list[Curves]) -> shapely.Geometry:
    """What rings show by the rule nonzero, if none of them crosses itself."""
    parts = sorted(
        (shapely.Polygon(flat(ring, 16).round(9)) for ring in rings), key=lambda p: -p.area
    )
    return parts[0].difference(parts[1]) if len(parts) == 2 else parts[0]


def split(curves: Curves, counts: tuple[int, ...]) -> list[Curves]:
    return np.split(curves, np.cumsum(counts)[:-1])


@pytest.mark.parametrize("name", STROKES)
def test_limbs_are_the_region(name: str) -> None:
    region = region_of(painted(STROKES[name], 1.6))
    strokes = outlined_strokes(region)
    assert strokes is not None
    union = shapely.union_all([area_of([r.curves for r in s.rings]) for s in strokes])
    whole = painted(STROKES[name], 1.6)
    assert union.symmetric_difference(whole).area < 1e-3 * whole.area
    # Nothing is lost: each curve of the region is one of the limbs', unless a limb starts on it.
    mine = {tuple(np.round(c.ravel(), 6)) for s in strokes for r in s.rings for c in r.curves}
    rings = [region.outer, *(hole.reversed() for hole in region.holes)]
    theirs = [tuple(np.round(c.ravel(), 6)) for ring in rings for c in ring.curves]
    assert sum(c in mine for c in theirs) >= len(theirs) - 8


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("cap", ["butt", "round", "square"])
@pytest.mark.parametrize("join", ["miter", "round", "bevel"])
def test_a_strokes_rings_are_what_it_paints(closed: bool, cap: str, join: str) -> None:
    corners = np.array([[0.0, 0], [10, 0], [10, 8], [3, 12]])
    ends = np.roll(corners, -1, axis=0) if closed else corners[1:]
    line = Outline(line_curves(corners[: len(ends)], ends), closed)
    rings = stroke_rings(line, 1.4, cap, join)  # type: ignore[arg-type]
    chain = shapely.LinearRing(corners) if closed else shapely.LineString(corners)
    joins = {"miter": "mitre", "round": "round", "bevel": "bevel"}[join]
    caps = {"butt": "flat", "round": "round", "square": "square"}[cap]
    painted_area = chain.buffer(
        0.7,
        quad_segs=64,
        cap_style=caps,
        join_style=joins,
        mitre_limit=4,
    )
    # The inner corner of a bend runs past itself; the rule nonzero fills that.
    got = area_of([ring.curves for ring in rings])
    got = shapely.make_valid(got, method="structure")
    assert got.symmetric_difference(painted_area).area < 2e-3 * painted_area.area


def moved(
    line_a: Outline, line_b: Outline, width: float
) -> tuple[StrokeOutline, Curves, list[tuple[Outline, ...]]]:
    rings = (
        stroke_rings(line_a, width, "round", "round"),
        stroke_rings(line_b, width, "butt", "miter"),
    )
    bound = stroke_outline((line_a.curves, line_b.curves), line_a.closed, rings)
    assert bound is not None
    t = np.linspace(0, 1, 9)[:, None, None, None]
    return bound, (1 - t) * line_a.curves + t * line_b.curves, list(rings)


PAIRS = {
    "bend": (polyline((0, 0), (10, 0), (10, 8)), polyline((0, 2), (9, 4), (16, 12))),
    "straight to bent": (polyline((0, 0), (10, 0), (18, 0)), polyline((0, 2), (9, 4), (9, 12))),
    "arc": (arc((0, 0), 8, 0, 2), arc((3, 0), 5, 20, 2)),
    "ring": (arc((0, 0), 8, 0, 4), arc((3, 0), 5, 0, 4)),
    "bar": (polyline((0, 0), (10, 0)), polyline((0, 3), (14, 9))),
}


@pytest.mark.parametrize("name", PAIRS)
def test_ends_are_exact_and_the_width_stays(name: str) -> None:
    one, other = PAIRS[name]
    bound, lines, rings = moved(one, other, 1.2)
    t = np.linspace(0, 1, len(lines))
    curves = bound.curves(lines, t)
    for k, end in ((0, 0), (-1, 1)):
        got, wanted = split(curves[k], bound.counts), [r.curves for r in rings[end]]
        assert area_of(got).symmetric_difference(area_of(wanted)).area < 2e-3 * area_of(wanted).area
        points = np.concatenate(wanted).reshape(-1, 2)
        mine = np.concatenate(got).reshape(-1, 2)
        nodes = np.concatenate([w[:, 0] for w in wanted])
        away = np.abs(nodes[:, None] - mine).sum(-1).min(axis=1)
        assert away.max() < 1e-9 * np.ptp(points)
    for frame in range(len(t)):
        line = Outline(lines[frame], one.closed)
        for ring in split(curves[frame], bound.counts):
            assert (ring[1:, 0] == ring[:-1, 3]).all()
            assert (ring[0, 0] == ring[-1, 3]).all()
        chain = np.concatenate([flat(line.curves), line.curves[-1:, 3]])
        # Half way along each of the line's curves the walls are half the width off on both sides.
        middle = evaluate(line.curves, np.array([0.5]))[:, 0]
        walls = shapely.MultiLineString([flat(r, 32) for r in split(curves[frame], bound.counts)])
        away = shapely.distance(walls, shapely.points(middle))
        assert away == pytest.approx(0.6, rel=0.02)
        far = shapely.distance(shapely.LineString(chain), shapely.points(curves[frame][:, 0]))
        assert far.max() < 0.6 * 1.6  # a mitred corner reaches out, nothing else does


def test_a_ring_that_does_not_follow_the_line_is_refused() -> None:
    line = polyline((0, 0), (10, 0))
    ring = stroke_rings(line, 1.0, "round", "round")
    away = [r.transformed(np.array([[1.0, 0, 0], [0, 1, 30]])) for r in ring]
    assert stroke_outline((line.curves, line.curves), False, (ring, away)) is None


def test_a_ring_that_is_not_drawn_as_it_is_is_refused() -> None:
    """Where a line runs into itself a place may be taken for another."""
    loop = polyline((0, 0), (60, 0), (60, 20), (52, 26), (50, 20), (70, 6), (90, 60), (40, 70))
    straight = polyline(*((float(k), 100.0) for k in range(8)))
    rings = [stroke_rings(line, 3.0, "round", "round") for line in (loop, straight)]
    assert rings[0] is not None
    assert rings[1] is not None
    found = stroke_outline((loop.curves, straight.curves), False, (rings[0], rings[1]))
    if found is not None:
        drawn = found.curves(loop.curves[None], np.zeros(1))[0]
        assert Outline(drawn).area == pytest.approx(rings[0][0].area, rel=1e-3)


def test_what_lies_beside_a_bit_without_length_keeps_its_reach_as_the_bit_grows() -> None:
    one = polyline((0, 0), (10, 0), (10.01, 0), (20, 0))
    other = polyline((0, 0), (6, 0), (12, 0), (20, 0))

    def ring(start: float, end: float, reach: float) -> tuple[Outline, ...]:
        corners = [(0, -0.5), (start, -0.5), (end, -0.5), (20, -0.5), (20, 0.5), (0, 0.5)]
        points = np.array(corners, float)
        curves = line_curves(points, np.roll(points, -1, axis=0))
        curves[1, 1:3, 0] = start + reach, end - reach
        return (Outline(curves),)

    rings = ring(10, 10.01, 0.4), ring(6, 12, 2.0)
    bound = stroke_outline((one.curves, other.curves), False, rings)
    assert bound is not None
    t = np.linspace(0, 1, 9)
    share = t[:, None, None, None]
    drawn = bound.curves((1 - share) * one.curves + share * other.curves, t)
    assert drawn[..., 0].min() > -1e-9
    assert drawn[..., 0].max() < 20 + 1e-9
