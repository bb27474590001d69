"""Where the limits of fills lie: each case is looked at over a range across its limit."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from shapetween.base.observe import unobserved
from shapetween.fill import splitting
from shapetween.fill.appearing import _middle
from shapetween.fill.morph import _by_size, _is_main, _limit_notices, _shared_corners, morph_fill
from shapetween.fill.pairing import Thing, pair_things
from shapetween.fill.pinned import pinned_rings
from shapetween.fill.regions import Region, _encloses, _resolved, regions_of
from shapetween.fill.settings import FillSettings
from shapetween.fill.small import blend_small
from shapetween.fill.splitting import split_alike
from shapetween.model.outline import Outline
from tests.baseline import assert_known
from tests.drawings import area, ring, square
from tests.match.shapes import polygon, rounded


def squares(sizes: Any) -> tuple[Region, ...]:
    return tuple(Region(square(0, 0, float(size))) for size in sizes)


def detailed(size: float, corners: int) -> Region:
    angle = 2 * np.pi * np.arange(corners) / corners
    return Region(polygon(size * np.stack([np.cos(angle), np.sin(angle)], axis=1)))


def test_how_many_pieces_get_meshes_is_known() -> None:
    figures = []
    for pieces in (
        squares(np.linspace(9, 10, 60)),
        squares(np.geomspace(1, 0.005, 14)),
        tuple(detailed(float(size), 70) for size in np.geomspace(1, 0.02, 14)),
        tuple(detailed(float(size), 40) for size in np.geomspace(1, 0.02, 14)),
        tuple(detailed(float(size), 150) for size in np.geomspace(1, 0.02, 14)),
    ):
        every = tuple((k, k) for k in range(len(pieces)))
        figures.append(len(_by_size(every, pieces, pieces)[0]))
    assert_known("fill", "meshed", figures)


def test_what_is_told_of_many_pieces_and_curves_is_known() -> None:
    def body(curves: int) -> Any:
        outline = SimpleNamespace(curves=np.zeros((curves, 4, 2)))
        return [SimpleNamespace(source=outline, target=outline)]

    figures = [len(_limit_notices([body(4)] * count, "a")) for count in range(1, 40)]
    figures += [len(_limit_notices([body(int(n))], "a")) for n in np.geomspace(200, 3000, 30)]
    assert_known("fill", "told of many", [sum(figures[:39]), sum(figures[39:])])


def test_how_many_holes_become_holes_is_known() -> None:
    holes = [square(4 + 12 * (k % 6), 4 + 12 * (k // 6), 3 + k / 9).reversed() for k in range(36)]
    shape = area(square(0, 0, 80), *holes)
    own = FillSettings(
        "linear", "allow", None, np.zeros((0, 4)), (), unobserved, meshed=True, effort="line"
    )
    track, notices = morph_fill(shape, area(square(0, 0, 90), *holes), own, ("a", "b"), alone=True)
    figures = [len(track.counts), len(notices), len(track.appearing)]
    assert_known("fill", "holes", figures)


def test_what_is_most_of_a_shape_is_known() -> None:
    main = [_is_main(squares([10, *[size] * 3])) for size in np.geomspace(1, 12, 40)]
    shared = _shared_corners(list(range(40)), squares(np.geomspace(1, 100, 40)))
    assert_known("fill", "main", [sum(main), sum(shared.values())])


def test_how_far_large_things_pair_is_known() -> None:
    figures = []
    for size in (4.0, 30.0, 90.0):
        one, staying = Thing(np.zeros(2), size), Thing(np.array([90.0, 90.0]), 50.0)
        others = [Thing(np.array([40.0, 0.0]), size / f) for f in np.geomspace(1, 1e5, 200)]
        found = [pair_things([one, staying], [other, staying], 100).pairs for other in others]
        figures.append(sum(map(len, found)))
    assert_known("fill", "far", figures)


def test_of_holes_as_near_the_first_is_pinned() -> None:
    first = 0
    for nearer in np.geomspace(1e-8, 1e-5, 40):
        holes = [square(38, 40, 10).reversed(), square(52 - nearer, 40, 10).reversed()]
        rings = [square(0, 0, 100), *holes]
        pins = np.array([[50.0, 45.0, 50.0, 45.0]])
        first += (0, 0) in pinned_rings(rings, rings, pins).holes
    assert_known("fill", "pinned", [first])


def test_what_counts_as_apart_is_known() -> None:
    figures = []
    for overlap in np.geomspace(1e-5, 1e-3, 24):
        found, _ = regions_of(area(square(0, 0, 10), square(10 - 10 * overlap, 0, 10)), "a")
        figures.append(sum(region.outer.area for region in found))
    slivers = [_encloses(ring([(0, 0), (5, h), (10, 0)])) for h in np.geomspace(1e-9, 1e-6, 40)]
    assert_known("fill", "apart", [*figures, sum(slivers)])


@pytest.mark.parametrize("seed", range(4))
def test_rounding_does_not_cut_what_touches(seed: int) -> None:
    random = np.random.default_rng(seed)
    size = 7.3
    corners = [((0, 0), 1.0), ((1, 0.2), 0.6), ((0.5, 0.5), 1.0)]
    noise = 1e-12 * random.normal(size=(3, 2))
    rings = [square(size * x, size * y, size * side) for (x, y), side in corners]
    noisy = [
        square(size * x + dx, size * y + dy, size * side)
        for ((x, y), side), (dx, dy) in zip(corners, noise, strict=True)
    ]
    counts = [
        [len(region.outer.curves) for region in _resolved(one, "nonzero", "a")]
        for one in (rings, noisy)
    ]
    assert counts[0] == counts[1]


def test_what_is_shown_is_not_moved() -> None:
    (found,) = _resolved([square(0, 0, 3), square(1, 1, 6)], "nonzero", "a")
    corners = np.sort(np.unique(found.outer.curves[:, 0].round(11)))
    np.testing.assert_allclose(corners, np.unique(corners.round(0)), atol=1e-10)


def test_which_small_contours_turn_is_known() -> None:
    turned = []
    for tall in np.linspace(0.1, 1.0, 30):
        angle = 2 * np.pi * np.arange(12) / 12
        oval = np.stack([np.cos(angle), tall * np.sin(angle)], axis=1)
        lying = oval @ np.array([[0.5, 0.866], [-0.866, 0.5]])
        turned.append(blend_small(rounded(oval), rounded(lying)).angle != 0.0)
    assert_known("fill", "turned", [sum(turned)])


def test_which_contours_are_one_is_known() -> None:
    first = 0
    corners = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    for off in np.geomspace(1e-10, 1e-5, 40):
        for way in (np.pi / 4 - off, np.pi / 4 + off):
            c, s = np.cos(way), np.sin(way)
            turned = corners @ np.array([[c, s], [-s, c]])
            first += blend_small(polygon(corners), polygon(turned)).target[0, 0, 1] > 0
    assert_known("fill", "one", [first])


def test_what_divides_is_known() -> None:
    whole = Region(square(0, 0, 60))
    figures = []
    for count in range(2, 12):
        bars = [(60 / count * k, 60 / count * (k + 0.8)) for k in range(count)]
        parts = [Region(ring([(x, 0), (z, 0), (z, 60), (x, 60)])) for x, z in bars]
        figures.append(split_alike(whole, parts) is not None)
    unlike = [
        split_alike(whole, [Region(square(0, 0, 30)), Region(square(32, 0, side))]) is not None
        for side in np.linspace(6, 30, 30)
    ]
    apart = [
        split_alike(whole, [Region(square(0, 0, 28)), Region(square(32 + gap, 0, 28))]) is not None
        for gap in np.linspace(0, 400, 80)
    ]
    assert_known("fill", "divides", [sum(figures), sum(unlike), sum(apart)])


def test_cells_that_cannot_be_even_are_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    cell = splitting._cell

    def counted(*arguments: Any) -> Any:
        asked.append(1)
        return cell(*arguments)

    monkeypatch.setattr(splitting, "_cell", counted)
    whole = splitting._area([square(0, 0, 10).curves[:, 0]])
    splitting._cells(whole, np.array([[5.0, 5.0], [5.0, 5.0]]), np.array([0.5, 0.5]))
    assert_known("fill", "given up", [len(asked)])


def test_where_curved_rings_close_is_known() -> None:
    """Crescents and drops, whose middle is that of a circle in them."""
    figures: list[float] = []
    for bend in (0.2, 0.5, 0.8, 1.1):
        back = np.array([[0, 0], [0, 90], [100, 90], [100, 0]], dtype=np.float64)
        forth = np.array([[100, 0], [100, 80 * bend], [0, 80 * bend], [0, 0]])
        figures += _middle(Outline(np.stack([back, forth])).clockwise()).tolist()
    assert_known("fill", "middles of curved rings", figures)
