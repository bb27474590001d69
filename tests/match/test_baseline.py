"""How outlines are matched, in figures that are known."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.base.errors import OptionError
from shapetween.fill.regions import regions_of
from shapetween.geometry.polygon import polygon_area
from shapetween.match.bends import bends_alike, plainly_the_same
from shapetween.match.candidate import Candidate, apart
from shapetween.match.certainty import doubt
from shapetween.match.costs import prepare
from shapetween.match.even import even_matchings
from shapetween.match.frames import Frame, Standing, handicap
from shapetween.match.matcher import Matcher
from shapetween.match.register import register
from shapetween.match.symmetry import Axes, aligned_ends, mirror_axes
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


def bent(points: Points, degrees: float) -> Points:
    """Leaning, and a little another shape."""
    return leaning(points + 0.06 * np.sin(7 * points[:, ::-1]), degrees)


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
    "a star that leans a little": lambda: (rounded(star(4, 6)), rounded(bent(star(4, 6), 9))),
    "a star that leans": lambda: (rounded(star(4, 6)), rounded(bent(star(4, 6), 22))),
    "a star that leans more": lambda: (rounded(star(4, 6)), rounded(bent(star(4, 6), 40))),
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


def test_how_alike_bends_are_is_known() -> None:
    figures = []
    for case in ("round stars", "T and T that leans", "horse and kangaroo"):
        found = matcher(case).match()
        sides = prepare(matcher(case).source), prepare(matcher(case).target)
        starts = [side.samples.start for side in sides]
        candidate = Candidate(found.u - starts[0], found.v - starts[1], found.cost, found.turn)
        figures.append(bends_alike(*sides, candidate))
    figures += [plainly_the_same(at, 0.7 * at) for at in np.linspace(0.5, 0.9, 9).tolist()]
    assert_known("match", "bends", figures)


def test_doubts_are_known() -> None:
    figures = [
        doubt([best, 1.3 * best, 2 * best + 0.01], [0.0, away, 0.6 * away])
        for best in (0.004, 0.013, 0.05, 0.3)
        for away in (0.01, 0.07, 0.15, 0.4)
    ]
    assert_known("match", "doubts", figures)


def test_what_turned_frames_have_to_be_better_by_is_known() -> None:
    figures = []
    for turn in (0.4, 1.75, 2.6):
        for slender, roundness in ((0.5, 0.5), (1.4, 0.75), (3.0, 0.95)):
            for unlike, stand in ((0.03, False), (0.17, True), (0.5, True)):
                sides = Standing(slender, 0.3, roundness), Standing(slender, 1.6, roundness)
                frames = Frame(0.0, 0.4 * unlike), Frame(turn, unlike)
                figures.append(handicap(*frames, *sides, even=(stand, stand), plain=0.3))
    assert_known("match", "frames", figures)


def test_axes_are_known() -> None:
    """Of outlines that are ever less even, and by how much these lean."""
    figures = []
    angle = 2 * np.pi * np.arange(96) / 96
    ways = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    for off in (0.0, 3e-5, 1.5e-4, 0.01, 0.05, 0.09, 0.2):
        wave = 1 + 0.2 * off * np.cos(angle) + off * np.cos(3 * angle + 40 * off)
        axes = mirror_axes(ways * wave[:, None])
        figures += [float(len(axes.ends)), float(axes.around is not None), float(axes.ends.sum())]
    for lean in (0.005, 0.015, 0.03, 0.05, 0.4, 0.9):
        one = Axes(np.array([0.1, 0.6]), np.array([0.0, 0.05 + lean]), None)
        other = Axes(np.array([0.2, 0.7]), np.array([lean, 0.05 + lean + 0.06]), None)
        found = aligned_ends(one, other, 0.0)
        figures += [float(len(found)), *(float(ends.sum()) for ends in found)]
    assert_known("match", "axes", figures)


def test_matchings_of_even_outlines_are_known() -> None:
    """Regular ones that are ever less so, of many axes and few."""
    figures = []
    for corners, bent in ((3, 0.0), (8, 0.0), (8, 0.04), (8, 0.09), (12, 0.0)):
        angle = 2 * np.pi * np.arange(2 * corners) / (2 * corners)
        radius = np.where(np.arange(2 * corners) % 2, 0.6, 1.0)
        shift = bent * np.sin(np.pi * np.arange(2 * corners) / corners)
        ways = np.stack([np.cos(angle + shift), np.sin(angle + shift)], axis=1)
        sides = prepare(polygon(ways * radius[:, None])), prepare(polygon(T - [3.5, 0.0]))
        rewards = np.zeros((len(sides[0].vertices.index), len(sides[1].vertices.index)))
        found = even_matchings(*sides, 0.0, rewards)
        figures += [float(len(found)), *(each.cost for each in found)]
        figures += [float(each.b[len(each.b) // 3]) for each in found]
    assert_known("match", "even", figures)


def test_which_pins_lie_on_their_outlines_is_known() -> None:
    one = Matcher(polygon(T), polygon(T * [1.0, 1.3]))
    kept = []
    for off in (0.1, 0.3, 0.45, 0.7, 1.1):
        try:
            found = one.match(np.array([[3.5, 9.0 + off, 3.5, 11.7]]))
        except OptionError:
            kept.append(0.0)
        else:
            kept.append(float(len(found.u)))
    assert_known("match", "pins beside", kept)


def test_how_far_matchings_are_apart_is_known() -> None:
    best, *others = matcher("hammer and wrench").alternatives()
    assert_known("match", "apart", [apart(best, other) for other in others])


def test_affine_maps_are_known() -> None:
    """How nearly one outline must be an affine image of another to count as one."""
    figures = []
    for seed, off in ((8, 3e-4), (8, 1.1e-3), (8, 2.4e-3), (9, 1.2e-3), (4, 6e-4), (4, 3e-3)):
        one = star(seed)
        rough = one + off * np.random.default_rng(seed).uniform(-1, 1, one.shape)
        found = register(polygon(one), polygon(rough).transformed(rotation(0.7, 3.0)))
        figures += [0.0] if found is None else [float(len(found.u)), found.turn, found.matrix[0, 0]]
    assert_known("match", "affine", figures)
