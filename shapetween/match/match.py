"""The best matchings of two outlines: the frames they are compared in, and the choice."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.match.band import band_path
from shapetween.match.correspondence import Confidence, Correspondence
from shapetween.match.costs import (
    Cells,
    Prepared,
    all_cells,
    intrinsic_cost,
    likeness_of_vertices,
    looks,
    stations,
    upright_cost,
)
from shapetween.match.dynamic import Paths, cyclic_paths
from shapetween.match.layout import Layout, layout_of, mirrored_layout
from shapetween.match.symmetry import aligned_axes

__all__ = ["best_matching"]

#: Stations a matching is chosen with. Fewer lose fingers; more cost time with the cube and match no
#: better.
STATIONS = 64

#: Stations a chosen matching is refined with, and how far it may move, as a share of them.
FINE_STATIONS, BAND = 192, 0.04

#: Least angle, radians, between the upright frame and one worth trying beside it.
MIN_TURN = 0.25

#: Least mean distance, as a share of the length, between two matchings that are different ones.
DISTINCT = 0.03

#: Drawings are meant upright: a turned frame must match this much better than the upright one.
#: Higher turns trees upside down; lower leaves upright what is the same but drawn another way, as
#: a plane that flies up and one that flies to the side.
FRAME_RATIO = 0.73

#: The same for symmetric outlines whose axes point the same way as drawn. Higher turns a spoon
#: upside down to become a screwdriver; lower leaves upright even an arrow that becomes one the
#: other way.
STANDING_RATIO = 0.35

#: Reward of a salient vertex that meets its like, as a share of what all stations cost at a cost of
#: 1. Less, and a limb counts by its length alone, or its tip comes to lie beside the other's; more,
#: and what lies between is not listened to.
VERTEX_REWARD = 2.8 / STATIONS

#: Symmetric outlines are meant to stay so: the matching that keeps them symmetric may cost this
#: many times the cheapest. Less, and one side of a thing moves unlike the other; more, and a heart
#: is laid on its side to become a C.
SYMMETRY_RATIO = 1.25

#: Matchings kept of each frame.
PER_FRAME = 3

#: Lead over the runner-up, as a share of the cost, that makes a matching sure; and the least one
#: with which it is more than unsure, however alike the outlines are.
CLEAR_LEAD, LEAST_LEAD = 0.3, 0.05

#: Cost up to which outlines are so alike that their matching is sure, and likely. On hand-matched
#: pairs 3 % of the landmarks of sure matchings were wrong, 20 % of likely, 28 % of unsure ones.
SURE_COST, LIKELY_COST = 0.7, 0.95

#: How far along the outline a pin is felt, as a share of the length: about half a limb. There the
#: look of the limb itself counts, not where it is.
PIN_REACH = 0.12


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A matching found in one frame.

    Attributes
    ----------
    a, b : (K,) float64
        Knots, as fractions of both lengths from the canonical starts, over one turn.
    cost : float
    turn : float
        The frame: the angle the first outline was turned by.
    axis : (2, 2) float64 or None
        Rows a, b of the two ends of the axis of symmetry, where the matching is symmetric.
    """

    a: Floats
    b: Floats
    cost: float
    turn: float
    axis: Floats | None = None


def best_matching(a: Prepared, b: Prepared, pins: Floats) -> Correspondence:
    """The best matching of two outlines that are no affine images of one another.

    Parameters
    ----------
    a, b : Prepared
        Source and target.
    pins : (K, 2) float64
        Fractions along source and target that are to be matched, in cyclic order.
    """
    pins = pins - [a.samples.start, b.samples.start]
    pins = pins - np.floor(pins)
    if _comes_second(a, b):
        return _ordered_matching(b, a, pins[:, ::-1]).inverse()
    return _ordered_matching(a, b, pins)


def _comes_second(a: Prepared, b: Prepared) -> bool:
    """Whether the outlines are to be exchanged, so that both orders give one matching.

    Geometry decides: the first clear difference in length, then in the samples.
    """
    gaps = np.append(
        a.samples.arcs.length / a.samples.size - b.samples.arcs.length / b.samples.size,
        (a.samples.points - b.samples.points).ravel(),
    )
    clear = np.flatnonzero(np.abs(gaps) > 1e-6)
    return bool(len(clear) and gaps[clear[0]] > 0)


def _ordered_matching(a: Prepared, b: Prepared, pins: Floats) -> Correspondence:
    pins = pins[np.argsort(pins[:, 0])]
    layout = layout_of(a, b, pins, STATIONS)
    cells = all_cells(len(layout.a), len(layout.b))
    intrinsic = intrinsic_cost(stations(a, layout.a), stations(b, layout.b), cells)
    paths = cyclic_paths(intrinsic, np.zeros_like(intrinsic), layout.fixed, layout.starts)
    turn = _turn_between(a, b, _distinct(paths, layout, 1, 0.0)[0])
    # Rewards not earned count as costs, so that the costs of two frames have a ratio.
    unrewarded = VERTEX_REWARD * len(a.vertices.index)
    ranked: list[tuple[float, Candidate]] = []
    ratio = FRAME_RATIO
    worths = {0.0: _worth_of_vertices(a, b, 0.0)}
    if abs(turn) >= MIN_TURN:
        worths[turn] = _worth_of_vertices(a, b, turn)
    for angle, worth in worths.items():
        cost = _cost(a, b, layout, angle, pins, cells)
        paths = cyclic_paths(cost, _rewards(worth, layout), layout.fixed, layout.starts)
        handicap = 1.0 if angle == 0 else 1 / ratio
        found = _distinct(paths, layout, PER_FRAME, angle)
        ranked += [((c.cost + unrewarded) * handicap, c) for c in found]
        if len(pins) == 0:
            even = _symmetric_matchings(a, b, angle, worth)
            ranked += [((c.cost + unrewarded) * handicap / SYMMETRY_RATIO, c) for c in even]
            if angle == 0 and even:
                ratio = STANDING_RATIO
    ranked.sort(key=lambda entry: entry[0])
    costs = [cost for cost, _ in ranked] + [np.inf]
    chosen = ranked[0][1]
    ranked[0] = costs[0], _refined(a, b, chosen, worths[chosen.turn], pins)
    made = [_finished(a, b, candidate, cost) for cost, candidate in ranked]
    best = made[0]
    return Correspondence(
        u=best.u,
        v=best.v,
        cost=costs[0],
        runner_up=costs[1],
        confidence=_confidence(costs[0], costs[1]),
        turn=best.turn,
        others=tuple(made[1:]),
    )


def _symmetric_matchings(a: Prepared, b: Prepared, angle: float, worth: Floats) -> list[Candidate]:
    """The best matchings of two symmetric outlines that match axis with axis, in one frame."""
    found = []
    cells = all_cells(STATIONS, STATIONS)
    for axis in aligned_axes(a.axes, b.axes, angle):
        layout = mirrored_layout(a, b, axis, STATIONS)
        cost = _even_cost(a, b, layout, angle, cells)
        paths = cyclic_paths(cost, _even_rewards(worth, layout), layout.fixed, layout.starts)
        found += [_even(c, axis) for c in _distinct(paths, layout, 1, angle)]
    return found


def _refined_symmetric(
    a: Prepared, b: Prepared, candidate: Candidate, worth: Floats, axis: Floats
) -> Candidate:
    """The symmetric matching found again with more stations, near where it was."""
    layout = mirrored_layout(a, b, axis, FINE_STATIONS)
    image = np.ix_(layout.image, layout.image)
    near = _away(candidate, layout) <= BAND
    near |= near[image]
    rows, columns = np.nonzero(near)
    cells = rows, columns
    cost = _even_cost(a, b, layout, candidate.turn, cells)
    reward = _even_rewards(worth, layout)[near]
    path = band_path(cells, cost, reward, layout.fixed, len(layout.a))
    if path is None:
        return candidate
    knots = _around(layout)
    return _even(replace(candidate, a=knots[0][path[0]], b=knots[1][path[1]]), axis)


def _even_cost(a: Prepared, b: Prepared, layout: Layout, angle: float, cells: Cells) -> Floats:
    """Costs of pairs of stations of a mirrored layout, a pair's the same as its mirror image's."""
    first, second = looks(stations(a, layout.a).turned(angle)), looks(stations(b, layout.b))
    images = layout.image[cells[0]], layout.image[cells[1]]
    return (upright_cost(first, second, cells) + upright_cost(first, second, images)) / 2


def _even_rewards(worth: Floats, layout: Layout) -> Floats:
    reward = _rewards(worth, layout)
    return np.maximum(reward, reward[np.ix_(layout.image, layout.image)])


def _even(candidate: Candidate, axis: Floats) -> Candidate:
    """The matching with its first half, mirrored, for its second."""
    half = int(np.abs(candidate.a - candidate.a[0] - 0.5).argmin())
    a, b = (
        np.concatenate([at[: half + 1], 2 * at[half] - at[:half][::-1]])
        for at in (candidate.a, candidate.b)
    )
    return replace(candidate, a=a, b=b, axis=axis)


def _confidence(cost: float, runner_up: float) -> Confidence:
    """How likely the matching is the one meant, by its cost and its lead."""
    lead = runner_up - cost
    if lead > CLEAR_LEAD * cost:
        return "sure"
    if lead < LEAST_LEAD * cost or cost > LIKELY_COST:
        return "unsure"
    return "sure" if cost < SURE_COST else "likely"


def _cost(
    a: Prepared, b: Prepared, layout: Layout, angle: float, pins: Floats, cells: Cells
) -> Floats:
    """Costs of pairs of stations in one frame."""
    first, second = stations(a, layout.a), stations(b, layout.b)
    cost = upright_cost(looks(first.turned(angle)), looks(second), cells)
    if len(pins) == 0:
        return cost
    sway, astray = _pull(layout, pins, cells)
    pulled = (intrinsic_cost(first, second, cells) + astray) / 2
    return sway * pulled + (1 - sway) * cost


def _pull(layout: Layout, pins: Floats, cells: Cells) -> tuple[Floats, Floats]:
    """How much each pair of stations is under the sway of a pin, and how far it strays from it.

    Both from 0 to 1. A pair strays when its stations are not equally far along both outlines from
    the pin.
    """
    a, b = layout.a[:, None] - pins[:, 0], layout.b[:, None] - pins[:, 1]
    a, b = (a - np.round(a)) / PIN_REACH, (b - np.round(b)) / PIN_REACH
    near = np.maximum(1 - np.minimum(np.abs(a)[cells[0]], np.abs(b)[cells[1]]), 0.0)
    astray = np.minimum(np.abs(a[cells[0]] - b[cells[1]]), 1.0)
    strongest = near.argmax(axis=-1)[..., None]
    return (
        np.take_along_axis(near, strongest, axis=-1)[..., 0],
        np.take_along_axis(astray, strongest, axis=-1)[..., 0],
    )


def _worth_of_vertices(a: Prepared, b: Prepared, angle: float) -> Floats:
    """What matching salient vertices is worth in one frame, (K, K): weight times likeness."""
    count = len(a.samples.points)
    first, second = (stations(p, p.vertices.index / count) for p in (a, b))
    weight = (a.vertices.weight[:, None] + b.vertices.weight) / 2
    alike = a.vertices.convex[:, None] == b.vertices.convex
    return np.asarray(weight * alike * likeness_of_vertices(first.turned(angle), second))


def _rewards(worth: Floats, layout: Layout) -> Floats:
    """What a path earns in each cell by matching salient vertices, (n, n)."""
    reward = np.zeros((len(layout.a), len(layout.b)))
    earned = VERTEX_REWARD * len(layout.a) * worth
    np.maximum.at(reward, (layout.a_vertices[:, None], layout.b_vertices[None]), earned)
    return reward


def _turn_between(a: Prepared, b: Prepared, candidate: Candidate) -> float:
    """Angle of the rotation that takes the first's matched points nearest the second's."""
    za, zb = (stations(p, k).points @ [1, 1j] for p, k in ((a, candidate.a), (b, candidate.b)))
    return float(np.angle((zb * za.conj()).sum()))


def _distinct(paths: Paths, layout: Layout, count: int, turn: float) -> list[Candidate]:
    """The cheapest paths that are different matchings, at most `count`."""
    kept: list[Candidate] = []
    around_a, around_b = _around(layout)
    for which in np.argsort(paths.costs, kind="stable"):
        if not np.isfinite(paths.costs[which]):
            break
        rows, columns = paths.trace(int(which))
        candidate = Candidate(
            a=around_a[rows],
            b=around_b[columns + paths.starts[which]],
            cost=float(paths.costs[which]),
            turn=turn,
        )
        if all(_apart(candidate, other) > DISTINCT for other in kept):
            kept.append(candidate)
            if len(kept) == count:
                break
    return kept


def _around(layout: Layout) -> tuple[Floats, Floats]:
    """Places of the stations once round the first outline, and twice round the second."""
    once = np.append(layout.a, layout.a[0] + 1)
    return once, np.concatenate([layout.b, layout.b + 1, layout.b[:1] + 2])


def _apart(first: Candidate, second: Candidate) -> float:
    """Mean distance of two matchings, as a share of the second outline's length."""
    gap = first.b - _follow(second.a, second.b, first.a)
    steps = np.diff(first.a)
    away = np.abs(gap - np.round(gap))
    return float((steps * (away[1:] + away[:-1]) / 2).sum())


def _follow(knots: Floats, values: Floats, at: Floats) -> Floats:
    """Linear between knots over one turn, continued beyond it."""
    whole = np.floor(at - knots[0])
    return np.asarray(np.interp(at - whole, knots, values) + whole)


def _refined(
    a: Prepared, b: Prepared, candidate: Candidate, worth: Floats, pins: Floats
) -> Candidate:
    """The matching found again with more stations, near where it was.

    Near along either outline: a tip beside its like may cross a stretch that the candidate passed
    in one step.

    Without pins, the first pass keeps one knot; the second is cut open half-way round, so that
    this knot moves as well.
    """
    best = candidate
    if candidate.axis is not None:
        return _refined_symmetric(a, b, candidate, worth, candidate.axis)
    for cut in (0.0,) if len(pins) else (0.0, 0.5):
        middle = best.a[0] + cut
        kept = np.array([[middle, _follow(best.a, best.b, np.array([middle]))[0]]])
        layout = layout_of(a, b, pins if len(pins) else kept, FINE_STATIONS)
        near = _away(best, layout) <= BAND
        rows, columns = np.nonzero(near)
        cost = _cost(a, b, layout, candidate.turn, pins, (rows, columns))
        reward = _rewards(worth, layout)[near]
        path = band_path((rows, columns), cost, reward, layout.fixed, len(layout.a))
        if path is None:
            break
        knots = _around(layout)
        best = replace(best, a=knots[0][path[0]], b=knots[1][path[1]])
    return best


def _away(candidate: Candidate, layout: Layout) -> Floats:
    """How far every pair of stations is from the matching, along the nearer outline, (n, n)."""
    across = _follow(candidate.a, candidate.b, layout.a)[:, None] - layout.b
    along = layout.a[:, None] - _follow(candidate.b, candidate.a, layout.b)
    return np.minimum(np.abs(across - np.round(across)), np.abs(along - np.round(along)))


def _finished(a: Prepared, b: Prepared, candidate: Candidate, cost: float) -> Correspondence:
    """The candidate in the outlines' own fractions."""
    u, v = a.samples.start + candidate.a, b.samples.start + candidate.b
    u[-1], v[-1] = u[0] + 1, v[0] + 1
    return Correspondence(u, v, cost, np.inf, "unsure", candidate.turn)
