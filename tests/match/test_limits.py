"""Where the limits of matching lie: each case is looked at over a range across its limit."""

import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from shapetween.base.errors import OptionError, OutlineError
from shapetween.match import register as registering
from shapetween.match.costs import prepare, sample_features, upright_features
from shapetween.match.even import even_matchings
from shapetween.match.facing import faces_other_way
from shapetween.match.features import describe
from shapetween.match.match import _Comparison
from shapetween.match.matcher import Matcher, registered
from shapetween.match.pins import places_in_order
from shapetween.match.register import register
from shapetween.match.sampling import sample
from shapetween.match.symmetry import Axes, aligned_ends, mirror_axes
from shapetween.match.vertices import salient_vertices
from tests.baseline import assert_known
from tests.match.shapes import disc, polygon, rotation, rounded, star


def regular(corners: int, inner: float = 0.6) -> np.ndarray:
    angle = np.pi * np.arange(2 * corners) / corners
    radius = np.where(np.arange(2 * corners) % 2, inner, 1.0)
    return np.stack([np.sin(angle), np.cos(angle)], axis=1) * radius[:, None]


def axes(count: int, *, uneven: float = 0.0, deviations: np.ndarray | None = None) -> Axes:
    """As many evenly round an outline, every other end a little aside."""
    ends = (np.arange(2 * count) + uneven * (np.arange(2 * count) % 2)) / (2 * count)
    return Axes(ends, np.pi * np.arange(2 * count) / count, None, deviations)


def test_outlines_of_hardly_any_area_are_refused() -> None:
    refused = 0
    for height in np.geomspace(3e-10, 1e-8, 24):
        thin = polygon(np.array([[0.0, 0.0], [1.0, 0.0], [0.5, height]]))
        try:
            Matcher(thin, thin)
        except OutlineError:
            refused += 1
    assert_known("match", "thin outlines refused", [refused])


def test_pins_on_one_spot_are_refused() -> None:
    refused = 0
    for gap in np.geomspace(2e-7, 5e-6, 24):
        try:
            places_in_order(np.array([[0.1, 0.2], [0.1 + gap, 0.2 + gap], [0.5, 0.6]]))
        except OptionError:
            refused += 1
    assert_known("match", "pins on one spot", [refused])


def test_what_counts_as_symmetric_is_known() -> None:
    deviations = np.geomspace(1e-3, 0.2, 24)
    ends = np.linspace(0.0, 1.0, 24, endpoint=False)
    alone = [Axes(ends[:1], ends[:1], None, deviations[k : k + 1]).even for k in range(24)]
    beside = [
        len(Axes(ends, ends, None, deviations[::-1] + least).beside(other).ends)
        for least in (0.0, 0.04)
        for other in (Axes(ends[:1], ends[:1], None, np.array([d])) for d in deviations)
    ]
    assert_known("match", "symmetric", [sum(alone), *beside])


def test_what_counts_as_a_disc_is_known() -> None:
    angle = 2 * np.pi * np.arange(96) / 96
    ways = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    round_ones = [
        mirror_axes(ways * (1 + bump * np.cos(5 * angle))[:, None]).around is not None
        for bump in np.geomspace(1e-3, 0.05, 32)
    ]
    assert_known("match", "discs", [sum(round_ones)])


def test_which_axes_are_tried_is_known() -> None:
    leans = np.geomspace(0.004, 0.9, 24)
    figures = [len(aligned_ends(axes(3), axes(4), lean)) for lean in leans]
    figures += [len(aligned_ends(axes(6), axes(9), lean)) for lean in leans[::6]]
    found = [aligned_ends(axes(4, uneven=off), axes(4), 0.0) for off in np.geomspace(0.02, 0.5, 16)]
    figures += [len(each) for each in found]
    figures.append(len(aligned_ends(axes(9, uneven=0.3), axes(9, uneven=0.3), 0.0)))
    assert_known("match", "axes tried", figures)


def test_noise_moves_no_end_of_an_axis() -> None:
    points = sample(polygon(regular(5))).points
    noise = 1e-11 * np.random.default_rng(2).normal(size=points.shape)
    one, other = mirror_axes(points), mirror_axes(points + noise)
    assert (one.ends == other.ends).all()


def test_a_straight_side_has_no_vertex() -> None:
    along = np.linspace(0.0, 1.0, 4, endpoint=False)
    side = np.stack([along, np.zeros(4)], axis=1)
    turns = [np.array([[0.0, 1.0], [-1.0, 0.0]])] * 3
    corners = [side]
    for turn in turns:
        corners.append(corners[-1] @ turn + [corners[-1][-1] + (corners[-1][1] - corners[-1][0])])
    square = np.concatenate(corners)
    counts = []
    for bump in np.geomspace(2e-10, 8e-9, 24):
        points = square.copy()
        points[2, 1] -= bump
        counts.append(int((salient_vertices(points).weight > 0).sum()))
    assert_known("match", "vertices", counts)


def test_which_turned_frames_are_tried_is_known() -> None:
    figures = []
    for degrees in (2, 5, 8, 11, 14, 20, 30, 40):
        lean = rotation(np.radians(degrees))[:, :2]
        bent = star(4, 6) + 0.06 * np.sin(7 * star(4, 6)[:, ::-1])
        sides = prepare(rounded(star(4, 6))), prepare(rounded(bent @ lean.T))
        figures.append(len(_Comparison(*sides, np.zeros((0, 2)))._ranked(forced=False)))
    assert_known("match", "frames tried", figures)


def test_matchings_of_many_sectors_are_known() -> None:
    sides = prepare(polygon(regular(12))), prepare(polygon(regular(12, 0.8)))
    rewards = np.zeros((len(sides[0].vertices.index), len(sides[1].vertices.index)))
    found = even_matchings(*sides, 0.0, rewards)
    assert_known("match", "sectors", [len(found[0].a), found[0].cost, *found[0].b[:5].tolist()])


def test_how_far_positions_are_stretched_is_known() -> None:
    figures = []
    for wide in (1.5, 3.0, 6.0, 20.0):
        bar = np.array([[0.0, 0.0], [wide, 0.0], [wide, 1.0], [0.0, 1.2]])
        places = np.arange(8) / 8
        found = upright_features(sample_features(prepare(polygon(bar)), places))
        figures += [float(np.abs(found.spread).sum()), float(np.abs(found.ranks).sum())]
    assert_known("match", "stretched", figures)


def test_ranks_of_a_needle_are_numbers() -> None:
    needle = np.array([[0.0, 0.0], [20000.0, 0.0], [20000.0, 1.0], [0.0, 1.2]])
    found = upright_features(sample_features(prepare(polygon(needle)), np.arange(8) / 8))
    assert np.isfinite(found.ranks).all()


@pytest.mark.parametrize("cached", [prepare, lambda one: registered(one, one)])
def test_the_last_few_outlines_are_kept(cached: Callable[[Any], object]) -> None:
    outlines = [polygon(star(seed, 5)) for seed in range(40)]
    first = [cached(one) for one in outlines]
    kept = 0
    for one, found in zip(outlines[::-1], first[::-1], strict=True):
        if cached(one) is not found:
            break
        kept += 1
    assert kept == (8 if cached is prepare else 16)


def test_affine_copies_are_known() -> None:
    """By what is left over, by how often they are cut, and which way a regular one turns."""
    figures = []
    for seed in (8, 9):
        one = star(seed)
        rough = one + 3e-4 * np.random.default_rng(seed).uniform(-1, 1, one.shape)
        found = register(polygon(one), polygon(rough))
        assert found is not None
        figures.append(found.residual)
    for stretch in (2.0, 30.0, 1e7):
        matrix = np.array([[stretch, 0.4, 0.0], [0.0, 1.0, 0.0]])
        found = register(rounded(star(5, 6)), rounded(star(5, 6)).transformed(matrix))
        assert found is not None
        figures.append(len(found.u))
    assert_known("match", "affine copies", figures)


def test_which_way_a_nearly_regular_copy_turns_is_known() -> None:
    ways = []
    for off in np.geomspace(1e-8, 1e-4, 25):
        uneven = regular(5)
        uneven[0] *= 1 + off
        found = register(polygon(uneven[::-1]), polygon(uneven[::-1]).transformed(rotation(1.2)))
        ways.append(0.0 if found is None else round(found.turn, 4))
        even = polygon(regular(5)[::-1])
        found = register(even, even.transformed(rotation(np.pi / 5 + off)))
        ways.append(0.0 if found is None else round(found.turn, 3))
    assert_known("match", "nearly regular", ways)


def test_few_shifts_are_refined(monkeypatch: pytest.MonkeyPatch) -> None:
    counts: list[int] = []
    refine = registering._refined

    def counted(*arguments: Any) -> Any:
        counts[-1] += len(arguments[2])
        return refine(*arguments)

    monkeypatch.setattr(registering, "_refined", counted)
    for one in (polygon(regular(50, 0.97)), rounded(star(3, 7)), polygon(star(8)), disc()):
        counts.append(0)
        register(one, one.transformed(rotation(0.3)))
    assert_known("match", "shifts refined", counts)


def test_tables_are_looked_through_in_parts() -> None:
    """Memory is small beside that of a table of all samples by all."""
    points = sample(polygon(star(3))).points
    describe(points)
    tracemalloc.start()
    describe(points)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert_known("match", "memory", [round(peak / 1e5)])


def flag(left: float) -> np.ndarray:
    """A pole with two arms, of which so much is on its left and the rest on its right."""
    right = 5 - left
    above = [[1, 4], [right, 4], [right, 5], [1, 5], [1, 7.5], [1.2 * right, 8]]
    below = [[-1.2 * left, 9], [-1.2 * left, 8], [0, 7.5], [0, 5], [1 - left, 5], [1 - left, 4]]
    return np.array([[0.0, 0], [1, 0], *above, [1.2 * right, 9], *below, [0, 4]])


def footed(left: float) -> np.ndarray:
    """The same with a foot on its right, so that it is uneven however its arms lie."""
    return np.concatenate([[[0.0, 0], [3.2, 0], [3.2, 1.2], [1, 1.2]], flag(left)[2:]])


@pytest.mark.parametrize("made", [flag, footed])
def test_what_faces_the_other_way_is_known(made: Callable[[float], np.ndarray]) -> None:
    """A flag and others that lie more and more on the other side of their poles."""
    one, facing = polygon(made(1.3)), 0
    for left in np.linspace(2.0, 3.9, 39):
        other = polygon(made(left))
        found = Matcher(one, other).match()
        facing += faces_other_way(prepare(one), prepare(other), found)
    assert_known("match", f"facing, {made.__name__}", [float(facing)])


def test_what_is_even_but_for_a_tuft_is_known() -> None:
    even = []
    for corners in (3, 5):
        for tuft in np.linspace(0.05, 0.25, 21):
            one, other = regular(corners), regular(corners, 0.8)
            other[1:3] *= np.array([[1 + tuft], [1 - tuft / 3]])
            found = _Comparison(prepare(polygon(one)), prepare(polygon(other)), np.zeros((0, 2)))
            best = found._found(0.0, found._unlike(), False).best
            even.append(best.candidate.ends is not None)
    assert_known("match", "even but for a tuft", [float(sum(even[:21])), float(sum(even[21:]))])


def test_how_many_places_a_copy_is_looked_at_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    """At once: how often it is looked at again hangs on rounding."""
    looked: set[int] = set()
    points = registering._Whitened.points

    def counted(self: Any, places: Any) -> Any:
        looked.add(places.shape[-1])
        return points(self, places)

    monkeypatch.setattr(registering._Whitened, "points", counted)
    one = polygon(star(8))
    register(one, one.transformed(rotation(0.3)))
    assert_known("match", "places looked at", sorted(looked))
