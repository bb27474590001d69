"""One piece divides into several as a cell does, and several become one the same way back."""

import numpy as np
import pytest

from shapetween.fill import splitting
from shapetween.fill.regions import Region
from shapetween.fill.splitting import split_alike
from shapetween.model.drawing import Drawing
from shapetween.model.outline import Outline
from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg
from tests.movements import circle


def disc(x: float, y: float, radius: float) -> Outline:
    return Outline(circle(np.array([x, y]), radius))


def region(x: float, y: float, radius: float, *holes: Outline) -> Region:
    return Region(disc(x, y, radius), holes)


def drawing(d: str) -> Drawing:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><path d="{d}"/></svg>'
    return read_svg(text.encode(), "drawing")


def two() -> list[Region]:
    return [region(6, 12, 4.5), region(18, 12, 4.5)]


def test_the_pieces_are_the_whole_in_the_parts_order() -> None:
    parts = [region(18, 12, 4), region(6, 6, 4), region(6, 18, 3)]
    whole = region(12, 12, 9)
    pieces = split_alike(whole, parts)
    assert pieces is not None
    shares = np.array([part.area for part in parts]) / sum(part.area for part in parts)
    areas = np.array([piece.area for piece in pieces])
    assert areas.sum() == pytest.approx(whole.area, rel=1e-9)
    np.testing.assert_allclose(areas / whole.area, shares, atol=0.02)
    assert pieces[0].centre[0] > 12
    assert pieces[1].centre[1] < pieces[2].centre[1]


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e5])
def test_units_do_not_matter(size: float) -> None:
    whole = region(12 * size, 12 * size, 9 * size)
    parts = [region(6 * size, 12 * size, 4 * size), region(18 * size, 12 * size, 3 * size)]
    pieces, base = split_alike(whole, parts), split_alike(region(12, 12, 9), two())
    assert pieces is not None
    assert base is not None
    assert len(pieces) == len(base)
    assert pieces[0].area / whole.area == pytest.approx(16 / 25, abs=0.02)


@pytest.mark.parametrize(
    "parts",
    [
        [region(12, 12, 9)],
        [region(12, 12, 8), region(22, 2, 2)],  # an island
        [region(40, 12, 4), region(50, 12, 4)],  # elsewhere
        [region(3 + 4 * k, 12, 2) for k in range(5)],  # a crowd
    ],
)
def test_what_does_not_divide(parts: list[Region]) -> None:
    assert split_alike(region(12, 12, 9), parts) is None


def test_a_cut_that_leaves_more_pieces_than_parts_is_none() -> None:
    """A horseshoe cut across both legs."""
    shoe = drawing("M2 2H6V18H18V2H22V22H2Z").shapes[0].rings[0]
    parts = [region(12, 5, 4), region(12, 19, 4)]
    assert split_alike(Region(shoe), parts) is None


def test_a_hole_is_opened_by_the_cut() -> None:
    pieces = split_alike(region(12, 12, 9, disc(12, 12, 4)), two())
    assert pieces is not None
    assert [len(piece.holes) for piece in pieces] == [0, 0]
    assert sum(p.area for p in pieces) == pytest.approx(np.pi * (81 - 16), rel=1e-3)


@pytest.mark.parametrize("back", [False, True])
def test_a_cell_divides(back: bool) -> None:
    one, both = drawing("M3 3H21V21H3Z"), drawing("M3 3H9V21H3ZM15 3H21V21H15Z")
    movement = prepare(*((both, one) if back else (one, both))).movement
    t = np.linspace(0, 1, 9)
    frames = movement.at(1 - t if back else t)
    rings = [[ring for shape in frame.shapes for ring in shape.rings] for frame in frames]
    areas = np.array([[ring.area for ring in frame] for frame in rings])
    assert areas.shape == (9, 2)
    np.testing.assert_allclose(areas[:, 0], areas[:, 1], rtol=1e-3)
    # Nothing opens from a point: the halves go from 9 wide to 6.
    np.testing.assert_allclose(areas[:, 0], 18 * (9 - 3 * t), rtol=0.02)
    left = np.array([frame[0].box[0, 0] for frame in rings])
    np.testing.assert_allclose(left, left[0], atol=0.1)


def test_a_part_without_a_place_of_its_own_divides_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    import shapely

    cells = [shapely.Polygon(), shapely.box(0, 0, 24, 24)]
    monkeypatch.setattr(splitting, "_cells", lambda *_: cells)
    assert split_alike(region(12, 12, 9), two()) is None
