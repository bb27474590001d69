"""How outlines are matched, in figures that are known."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.fill.regions import regions_of
from shapetween.geometry.polygon import polygon_area
from shapetween.match.matcher import Matcher
from shapetween.model.outline import Outline
from shapetween.svg.read.reader import read_svg
from tests.baseline import assert_known
from tests.match.shapes import disc, polygon, rotation, rounded, star

INPUTS = Path(__file__).resolve().parents[2] / "gallery/inputs"

PLACES = np.linspace(0.0, 1.0, 9)[:-1]

U = np.array([[0, 0], [2, 0], [2, 6], [3, 6], [3, 0], [5, 0], [5, 8], [0, 8]], dtype=float)
T = np.array([[0, 0], [7, 0], [7, 2], [4.5, 2], [4.5, 9], [2.5, 9], [2.5, 2], [0, 2]])
BAR = np.array([[0.0, 0.0], [9.0, 0.0], [9.0, 2.0], [0.0, 2.5]])


def drawn(name: str) -> Outline:
    """The largest outer ring of a drawing of the gallery."""
    path = INPUTS / f"{name}.svg"
    found = read_svg(path.read_bytes(), path.name)
    shape = max(found.shapes, key=lambda s: abs(polygon_area(s.rings[0].curves[:, 0])))
    return regions_of(shape, name)[0][0].outer


def leaning(points: Points, degrees: float) -> Points:
    return points @ rotation(np.radians(degrees))[:, :2].T


CASES = {
    "stars": lambda: (polygon(star(3)), polygon(star(5))),
    "round stars": lambda: (rounded(star(11, 7)), rounded(star(12, 7))),
    "a disc and a star": lambda: (disc(), rounded(star(21, 5))),
    "a star that is turned": lambda: (
        rounded(star(4, 6)),
        rounded(leaning(star(4, 6) * 1.05, 140)),
    ),
    "a star moved affinely": lambda: (
        polygon(star(8)),
        polygon(star(8)).transformed(rotation(0.7, 3.0)),
    ),
    "U and T": lambda: (polygon(U), polygon(T)),
    "T and T that leans": lambda: (polygon(T), polygon(leaning(T * [1.0, 0.8], 35))),
    "a bar and one that stands": lambda: (polygon(BAR), polygon(leaning(BAR * [1.0, 0.6], 75))),
    "T and T upside down": lambda: (polygon(T), polygon(leaning(T * [1.1, 0.9], 180))),
    "horse and kangaroo": lambda: (drawn("horse"), drawn("kangaroo")),
    "hammer and wrench": lambda: (drawn("hammer"), drawn("wrench")),
    "leaves": lambda: (drawn("maple-leaf"), drawn("monstera-leaf")),
    "tree and umbrella": lambda: (drawn("palm-tree"), drawn("umbrella")),
    "camel and elephant": lambda: (drawn("camel"), drawn("elephant")),
    "key and letter": lambda: (drawn("key"), drawn("letter-k")),
    "airplane and jet": lambda: (drawn("airplane"), drawn("jet")),
    "run and walk": lambda: (drawn("run"), drawn("walk")),
}


@cache
def matcher(case: str) -> Matcher:
    return Matcher(*CASES[case]())


def after(u: Points, v: Points) -> list[float]:
    """Where eight places of the source go, whatever turn they are counted in."""
    places = np.interp(PLACES + np.ceil(u[0] - PLACES), u, v) - v[0]
    return [float(v[0] % 1.0), *places.tolist()]


@pytest.mark.parametrize("case", CASES)
def test_the_matching_is_known(case: str) -> None:
    found = matcher(case).match()
    figures = [
        found.cost,
        min(found.runner_up, 9.0),
        found.turn,
        ["sure", "likely", "unsure"].index(found.confidence),
        float(matcher(case).faces_other_way(found)),
        *after(found.u, found.v),
    ]
    assert_known("match", case, figures)


@pytest.mark.parametrize("case", ["U and T", "hammer and wrench", "round stars"])
def test_other_matchings_are_known(case: str) -> None:
    found = matcher(case).alternatives()
    figures = [float(len(found))]
    for other in found:
        figures += [other.cost, other.turn, *after(other.u, other.v)]
    assert_known("match", f"others of {case}", figures)


@pytest.mark.parametrize("case", ["U and T", "horse and kangaroo", "round stars"])
def test_matchings_with_pins_are_known(case: str) -> None:
    pins = np.array([[0.1, 0.3], [0.45, 0.62]])
    found = matcher(case).match(pins)
    assert_known("match", f"pins on {case}", [found.cost, found.turn, *after(found.u, found.v)])
