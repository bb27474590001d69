import numpy as np
import pytest
import shapely

from shapetween.base.arrays import Index, Points
from shapetween.geometry.polygon import polygon_area
from shapetween.mesh.contour import Contours, arc_waste, left_out, outside_lengths, rounded
from tests.mesh.pairs import comb, matched, regular, spiral, star, untangled


def contour(ring: Points, count: int = 200, offset: float = 0.0) -> Points:
    """Even samples but for a ripple, so that no chord lies along a side."""
    points = matched(ring, ring, count, offset)[0]
    noise = np.random.default_rng(0).normal(0, 1e-5, points.shape)
    return np.asarray((points + noise) / np.sqrt(polygon_area(points)))


@pytest.mark.parametrize("ring", [regular(30), star(), comb(4), spiral()])
def test_length_outside_is_that_of_the_difference(ring: Points) -> None:
    points = contour(ring)
    nodes = np.arange(0, len(points), 5)
    lengths = outside_lengths(np.stack([points, points]), nodes, np.inf)[0]
    i, j = np.nonzero(np.isfinite(lengths))
    assert (i < j).all()
    chords = shapely.linestrings(np.stack([points[nodes[i]], points[nodes[j]]], axis=1))
    outside = shapely.length(shapely.difference(chords, shapely.Polygon(points)))
    np.testing.assert_allclose(lengths[i, j], outside, atol=1e-9)


def test_chords_that_stay_inside_both_are_never_passed_over() -> None:
    rng = np.random.default_rng(3)
    points = np.stack([contour(untangled(rng, 12), 96), contour(untangled(rng, 12), 96)][:1] * 2)
    nodes = np.arange(0, points.shape[1], 3)
    lengths = outside_lengths(points, nodes, np.inf)[0]
    i, j = np.triu_indices(len(nodes), 2)
    chords = shapely.linestrings(np.stack([points[0, nodes[i]], points[0, nodes[j]]], axis=1))
    inside = shapely.covers(shapely.Polygon(points[0]), chords)
    np.testing.assert_allclose(lengths[i, j][inside], 0, atol=1e-12)


def test_chords_outside_the_first_are_not_measured_in_the_second() -> None:
    rings = matched(comb(4), regular(30), 200)[:2]
    points = np.stack([ring / np.sqrt(polygon_area(ring)) for ring in rings])
    points += np.random.default_rng(0).normal(0, 1e-5, points.shape)
    nodes = np.arange(0, points.shape[1], 3)
    everything, some = (outside_lengths(points, nodes, most) for most in (np.inf, 0.05))
    np.testing.assert_array_equal(some[0], everything[0])
    short = everything[0] < 0.05
    np.testing.assert_array_equal(some[1], np.where(short, everything[1], np.inf))
    assert 0 < np.isfinite(some[1]).sum() < np.isfinite(everything[1]).sum()


def test_an_arc_on_its_chord_wastes_nothing_and_a_limb_wastes_more_than_its_area() -> None:
    limb = np.array(
        [[0.0, 0.0], [10, 0], [10, 10], [5.05, 10], [5.05, 19], [4.95, 19], [4.95, 10], [0, 10]]
    )
    points = contour(limb, 400)
    contours = Contours.of(np.stack([points, points]))
    scale = 1 / np.sqrt(polygon_area(limb))

    def sample(corner: int) -> Index:
        return np.asarray(((points - limb[corner] * scale) ** 2).sum(axis=1).argmin())

    straight = arc_waste(contours, sample(0), sample(1))
    assert straight.max() < 1e-4
    spike = arc_waste(contours, sample(3), sample(6))
    assert spike.min() > 10 * 0.1 * 9 * scale**2
    wrapping = arc_waste(contours, sample(7), sample(0))
    assert wrapping.max() < 1e-4


def test_area_left_out_is_that_of_the_symmetric_difference() -> None:
    angle = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    points = contour(regular(90) * (1 + 0.1 * np.cos(5 * angle))[:, None], 300)
    nodes = np.arange(4, len(points), 17)
    lost = left_out(Contours.of(np.stack([points, points])), nodes)
    shape = shapely.Polygon(points)
    expected = shape.symmetric_difference(shapely.Polygon(points[nodes])).area
    np.testing.assert_allclose(lost, expected, rtol=1e-6)


def test_settled_numbers_add_up_exactly() -> None:
    values = rounded(np.random.default_rng(1).random(1000) * 100)
    assert values.sum() == values[::-1].cumsum()[-1]
    np.testing.assert_allclose(rounded(values + 1e-13), values, atol=0)
