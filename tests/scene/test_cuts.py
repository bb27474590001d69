"""Areas that come apart into several: which do, and where they are cut."""

import numpy as np
import pytest

from shapetween.scene.cuts.areas import divided_areas
from shapetween.scene.items import items_of
from shapetween.scene.relations import Scene, perceive
from shapetween.svg.read.reader import read_svg

VIEW = np.array([[0.0, 0.0], [100.0, 100.0]])


def scene(inner: str) -> Scene:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{inner}</svg>'
    return perceive(items_of(read_svg(text.encode(), "x").shapes, "x")[0], VIEW)


def boxes(*corners: tuple[float, float, float, float], more: str = "") -> str:
    form = '<rect x="{}" y="{}" width="{}" height="{}" {}/>'
    return "".join(form.format(x, y, w, h, more) for x, y, w, h in corners)


TILES = [(8, 8, 38, 38), (54, 8, 38, 38), (8, 54, 38, 38), (54, 54, 38, 38)]
ROWS = [(8, 8, 84, 38), (8, 54, 84, 38)]


@pytest.mark.parametrize("more", ["", 'rx="8"'])
def test_rows_come_apart_into_the_tiles_that_lie_in_them(more: str) -> None:
    rows, tiles = scene(boxes(*ROWS, more=more)), scene(boxes(*TILES, more=more))
    found = divided_areas(rows, tiles)
    assert sorted(found) == [0, 1]
    for k, division in found.items():
        for piece, j in division.pairs:
            assert np.linalg.norm(piece.centre - tiles.centres[j]) < 8
            assert rows.items[k].box[0, 1] <= tiles.centres[j, 1] <= rows.items[k].box[1, 1]
    assert sorted(j for d in found.values() for _, j in d.pairs) == [0, 1, 2, 3]


def test_a_row_with_nothing_in_its_place_stays_whole() -> None:
    rows = scene(boxes((8, 8, 84, 38), (8, 54, 84, 38)))
    assert not divided_areas(rows, scene(boxes(*TILES[:3], (54, 30, 38, 10))))
    assert not divided_areas(rows, scene(boxes(*TILES[:3])))


def test_other_things_than_boxes_are_not_shared_out() -> None:
    star = '<path d="M50 52l8 14 18 4-12 14 2 16-16-6-16 6 2-16-12-14 18-4z"/>'
    assert not divided_areas(scene(boxes(ROWS[0]) + star), scene(boxes(*TILES)))


@pytest.mark.parametrize(("hole", "cut"), [("M40 40h20v20h-20z", 0), ("M20 40h16v20h-16z", 1)])
def test_no_cut_runs_through_a_hole(hole: str, cut: int) -> None:
    whole = scene(f'<path fill-rule="evenodd" d="M10 10h80v80h-80z{hole}"/>')
    halves = scene(boxes((10, 10, 36, 80), (54, 10, 36, 80)))
    assert len(divided_areas(whole, halves)) == cut
