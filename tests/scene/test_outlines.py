"""Areas and the lines round them go together."""

import numpy as np

from shapetween.scene.costs import Current
from shapetween.scene.items import items_of
from shapetween.scene.outlines import with_outlines
from shapetween.scene.relations import Scene, perceive
from shapetween.svg.read.reader import read_svg

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
LINE = 'fill="none" stroke="#000" stroke-width="3"'
BOX = '<path d="M10 10h80v80h-80z" fill="#ccc"/>'
FILLED = '<path d="M20 {y}h60v{h}h-60z" fill="{fill}"/><path d="M20 {y}h60v{h}h-60z" {line}/>'


def scene_of(inner: str) -> Scene:
    items, _ = items_of(read_svg(f"{HEAD}{inner}</svg>".encode(), "x").shapes, "x")
    return perceive(items, np.array([[0.0, 0.0], [100.0, 100.0]]))


def charged(y: float, fill: str) -> Scene:
    return scene_of(BOX + FILLED.format(y=y, h=80 - y, fill=fill, line=LINE))


def joined(
    pairs: list[tuple[int, int]], never: tuple[int, int] | None = None
) -> set[tuple[int, int]]:
    a, b = charged(20, "#3a3"), charged(60, "#c22")
    assert a.outlined.tolist() == b.outlined.tolist() == [-1, -1, 1]
    costs = np.ones((3, 3))
    if never is not None:
        costs[never] = np.inf
    first, second = np.array(pairs).T
    found = with_outlines(Current(first, second, costs[first, second]), a, b, costs)
    return set(zip(found.first.tolist(), found.second.tolist(), strict=True))


def test_an_area_goes_where_the_line_round_it_goes() -> None:
    assert joined([(0, 0), (2, 2)]) == {(0, 0), (1, 1), (2, 2)}


def test_the_line_round_an_area_goes_where_that_goes() -> None:
    assert joined([(0, 0), (1, 1)]) == {(0, 0), (1, 1), (2, 2)}


def test_what_is_taken_or_never_a_pair_stays_so() -> None:
    assert joined([(1, 0), (2, 2)]) == {(1, 0), (2, 2)}
    assert joined([(0, 0), (2, 2)], never=(1, 1)) == {(0, 0), (2, 2)}
