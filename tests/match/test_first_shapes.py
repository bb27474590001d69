"""The shapes people try first, every one to every other: what is even at both ends stays even."""

from itertools import permutations

import numpy as np
import pytest
import shapely
import shapely.affinity

from shapetween.geometry.bezier import flatten
from shapetween.model.drawing import Drawing
from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg

#: Path of each shape in a box of 24, and the axes it is even about: upright, level.
SHAPES = {
    "circle": ("M12 3a9 9 0 1 1 0 18a9 9 0 1 1 0-18z", "ul"),
    "square": ("M4 4h16v16h-16z", "ul"),
    "triangle": ("M12 3l10 17h-20z", "u"),
    "star": (
        "M12 2l2.35 6.76 7.16.15-5.7 4.33 2.07 6.85L12 16l-5.88 4.09 2.07-6.85-5.7-4.33 7.16-.15z",
        "u",
    ),
    "heart": ("M12 21C5 15 2 12 2 8a5 5 0 0 1 10-2a5 5 0 0 1 10 2c0 4-3 7-10 13z", "u"),
    "ring": (
        "M12 3a9 9 0 1 1 0 18a9 9 0 1 1 0-18zM12 7a5 5 0 1 0 0 10a5 5 0 1 0 0-10z",
        "ul",
    ),
    "play": ("M6 3l15 9-15 9z", "l"),
    "bars": ("M5 4h5v16h-5zM14 4h5v16h-5z", "ul"),
}

TIMES = np.array([0.2, 0.5, 0.8])

#: Greatest area by which a frame is off its mirror image, as a share of it.
UNEVEN = 0.02


def read(name: str) -> Drawing:
    path = f'<path d="{SHAPES[name][0]}"/>'
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{path}</svg>'
    return read_svg(text.encode(), name)


def area(drawing: Drawing) -> shapely.Geometry:
    """What a drawing shows, by the even-odd rule for each shape."""
    shown = []
    for shape in drawing.shapes:
        whole: shapely.Geometry = shapely.Polygon()
        for ring in shape.rings:
            if len(points := flatten(ring.curves, 16)) > 2:
                whole = shapely.symmetric_difference(
                    whole, shapely.make_valid(shapely.Polygon(points))
                )
        shown.append(whole)
    return shapely.union_all(shown)


@pytest.mark.parametrize("names", list(permutations(SHAPES, 2)), ids="-".join)
def test_even_shapes_stay_even(names: tuple[str, str]) -> None:
    axes = set(SHAPES[names[0]][1]) & set(SHAPES[names[1]][1])
    if not axes:
        pytest.skip("they have no axis in common as drawn")
    for frame in prepare(read(names[0]), read(names[1])).movement.at(TIMES):
        shown = area(frame)
        middle = np.array(shown.envelope.centroid.coords[0])
        for axis in axes:
            x, y = 2 * middle
            flip = (-1, 0, 0, 1, x, 0) if axis == "u" else (1, 0, 0, -1, 0, y)
            image = shapely.affinity.affine_transform(shown, flip)
            off = shapely.symmetric_difference(shown, image).area / shown.area
            assert off < UNEVEN, f"{axis} at {frame.title}: {off:.3f}"
