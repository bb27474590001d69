"""The second drawing in the first one's frame, mirrored where that is asked for."""

import numpy as np
import pytest

from shapetween.base.errors import OptionError
from shapetween.model.drawing import Box, Drawing
from shapetween.model.fit import Fit, fit_matrix
from shapetween.pipeline import Options, prepare
from tests.drawings import area, drawing, ring

FLAG = [(10.0, 10.0), (60.0, 30.0), (10.0, 50.0), (10.0, 90.0), (5.0, 90.0), (5.0, 10.0)]


@pytest.mark.parametrize("fit", ["view", "geometry", "none"])
def test_a_flip_mirrors_about_the_upright_axis_of_what_is_fitted(fit: Fit) -> None:
    one = drawing(area(ring(FLAG)))
    other = Drawing((area(ring(FLAG)),), Box(0, 0, 200, 160))
    plain, flipped = (fit_matrix(one, other, fit, flip) for flip in ("none", "b"))
    assert np.linalg.det(flipped[:, :2]) == pytest.approx(-np.linalg.det(plain[:, :2]))
    box = other.drawn if fit == "geometry" else other.box
    points = np.array([[3.0, 7.0], [50.0, 60.0]])
    image = np.column_stack([2 * box.x + box.width - points[:, 0], points[:, 1]])
    wanted = image @ plain[:, :2].T + plain[:, 2]
    assert points @ flipped[:, :2].T + flipped[:, 2] == pytest.approx(wanted)


def test_a_drawing_and_its_mirror_image_stand_still_when_one_is_flipped() -> None:
    one = drawing(area(ring(FLAG)))
    mirrored = drawing(area(ring([(100 - x, y) for x, y in FLAG[::-1]])))
    movement = prepare(one, mirrored, Options(flip="b")).movement
    first, *rest = movement.at(np.linspace(0, 1, 5))
    for frame in rest:
        away = frame.shapes[0].rings[0].curves - first.shapes[0].rings[0].curves
        assert np.abs(away).max() < 1e-6


def test_there_are_two_flips() -> None:
    one = drawing(area(ring(FLAG)))
    with pytest.raises(OptionError, match="flip: 'a' is none of none, b"):
        fit_matrix(one, one, "view", "a")  # type: ignore[arg-type]
