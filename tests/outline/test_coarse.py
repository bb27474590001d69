"""Coarse shapes of outlines of very many curves."""

import numpy as np
import pytest

from shapetween.deform.check import simple_frames
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline
from shapetween.outline.coarse import coarse
from tests.coasts import coast


@pytest.mark.parametrize("most", [12, 60, 200])
def test_a_coarse_shape_is_a_simple_polygon_of_so_many_corners_at_most(most: int) -> None:
    found = coarse(coast(1, 3000), most)
    assert found is not None
    assert 4 <= len(found.corners) <= most
    assert (np.diff(found.corners) > 0).all()
    assert simple_frames(found.polygon.curves[None, :, 0]).all()


def test_its_corners_are_points_of_the_outline_itself() -> None:
    outline = coast(2, 3000)
    found = coarse(outline, 50)
    assert found is not None
    starts = {tuple(p) for p in found.polygon.curves[:, 0].tolist()}
    assert starts <= {tuple(p) for p in outline.curves[:, 0].tolist()}


def test_nothing_of_the_outline_is_farther_off_than_it_says() -> None:
    import shapely

    found = coarse(coast(3, 3000), 50)
    assert found is not None
    side = shapely.LinearRing(found.polygon.curves[:, 0])
    off = shapely.distance(side, shapely.points(found.outline.curves[:, 0])).max()
    assert 0 < off <= found.left_out


def test_a_place_is_lifted_square_to_its_side_and_corners_onto_themselves() -> None:
    outline = coast(4, 3000)
    found = coarse(outline, 40)
    assert found is not None
    corners = found.lengths.joints
    np.testing.assert_allclose(found.lifted(corners), found.corners, atol=1e-9)
    middles = corners + np.diff(corners, append=1.0) / 2
    places = found.lifted(middles)
    assert (np.diff(places) > 0).all()
    sides = found.polygon.curves[:, 3] - found.polygon.curves[:, 0]
    offset = found.points(places) - (found.polygon.curves[:, 0] + found.polygon.curves[:, 3]) / 2
    along = (offset * sides).sum(axis=1) / (sides**2).sum(axis=1)
    assert np.abs(along).max() < 0.1


def test_an_outline_of_few_curves_has_a_coarse_shape_too() -> None:
    corners = np.array([[0.0, 0], [4, 0], [4, 1], [0, 1]])
    found = coarse(Outline(line_curves(corners, np.roll(corners, -1, axis=0))), 100)
    assert found is not None
    np.testing.assert_array_equal(found.corners, np.arange(4))
