"""What it costs that an item of one drawing becomes an item of the other, term by term.

Every term is a function from two scenes to a table, (N, M). The weights were found on drawings;
halved or doubled, each but the price of leaving alone changes few pairs.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.base.ranking import comparable
from shapetween.scene.evidence import (
    Evidence,
    features_cost,
    mouths_saving,
    named_saving,
    sets_cost,
    sole_saving,
    unique_saving,
)
from shapetween.scene.forms import Blob, Dot, OpenLine, RoundedBox, Segment
from shapetween.scene.likeness import drawn_alike
from shapetween.scene.relations import Scene, in_common

__all__ = [
    "Current",
    "alone",
    "axes_cost",
    "fixed_terms",
    "parents_cost",
    "relations_cost",
    "same_things",
]

#: Weights: way as a share of the drawing, factor e in size and in aspect, a right angle of
#: direction, a right angle of bending, colour, and form.
PLACE, SIZE, ASPECT, DIRECTION, BENDING, COLOUR, FORM = 2.6, 0.45, 0.35, 1.3, 0.4, 1.3, 0.5

#: What it costs to be of another class of forms, to be open or closed, straight and closed, and
#: area or line.
CLASS, OPEN, NEVER, KIND = 0.35, 0.35, 3.0, 1.0

#: What a pair as large as the drawing saves.
LARGE = 0.4

#: What a pair saves that is one thing in two places, and one thing in two sizes. Smaller, and a
#: check becomes the circle that comes round it; larger, and arcs of a signal change their places.
SAME, SCALED = 0.5, 1.2

#: What a pair costs whose parents are not one, and of which only one has a parent.
OTHER_PARENT, ORPHAN = 0.7, 0.35

#: Weight of how the way to others changes; what touching differently adds to it; and how soon
#: others count less the farther they are, as a share of the drawing.
RELATION, TOUCH, NEAR = 1.4, 0.12, 0.08

#: What other forms cost one feature of both drawings, as a share: a mouth may be a line or an area.
LENIENT = 0.4

#: What it costs to go across an axis that both drawings have; and how far from it, as a share of
#: the drawing, something lies on a side.
CROSSING, ASIDE = 0.6, 0.04

#: What each factor e of size costs more beyond that of `TWICE`, a logarithm.
RATIO, TWICE = 0.6, 0.69

#: What counts beside all other pairs, as a share of the drawing: one weak pair cannot overthrow a
#: good one.
DAMPED = 0.4

#: What it costs that one is its own mirror image and the other is not, and what it saves that both
#: are.
MATES, AXIAL = 0.9, 0.25

#: What leaving alone costs at least, and what more if an item is as large as the drawing.
ALONE, ALONE_LARGE = 0.55, 0.5

#: How much longer than wide is long enough to have a direction.
LONG = 2.0

#: Numbers of pairs that relations are taken to, the largest ones; and how many tables of all pairs
#: times that are worth their time. More take longer; fewer know less of where things lie.
LEAST_RELATED, MOST_RELATED, RELATED_ROOM = 10, 40, 1e7


@dataclass(frozen=True, slots=True, eq=False)
class Current:
    """Pairs of a round, that the next one takes parents and relations from.

    Attributes
    ----------
    first, second : (K,) intp
    costs : (K,) float64
    """

    first: Index
    second: Index
    costs: Floats


def fixed_terms(a: Scene, b: Scene, evidence: Evidence) -> dict[str, Floats]:
    """All that does not depend on other pairs, by name."""
    features, shared = features_cost(*evidence.features)
    lenient = np.where(shared, LENIENT, 1.0)
    return {
        "place": PLACE * _place(a, b),
        "size": (1 + lenient) / 2 * SIZE * np.abs(np.log(a.sizes[:, None] / b.sizes)),
        "aspect": lenient * ASPECT * _aspect(a, b),
        "direction": lenient * DIRECTION * _direction(a, b),
        "bending": lenient * BENDING * _bending(a, b),
        "colour": COLOUR * np.minimum(_apart(a.colours, b.colours), 0.8),
        "kind": lenient * _kind(a, b),
        "form": lenient * FORM * (1 - in_common(a.pictures, b.pictures)),
        "large": -LARGE * np.minimum(1.0, 2 * np.minimum(*_both(a, b)) / _scale(a, b)),
        "same": -SAME * same_things(a, b),
        "scaled": -SCALED * drawn_alike(a, b),
        "unique": -unique_saving(a, b),
        "sole": -sole_saving(a, b),
        "mouths": -mouths_saving(a, b, evidence),
        "named": -named_saving(a, b),
        "features": features,
        "sets": sets_cost(evidence),
        "crossing": CROSSING * _crossing(a, b),
        "ratio": (1 + lenient) / 2 * RATIO * _beyond(a, b),
    }


def alone(scene: Scene) -> Floats:
    """What leaving each item alone costs, (N,)."""
    return np.asarray(ALONE + ALONE_LARGE * np.minimum(1.0, 1.6 * scene.sizes / scene.scale))


def _scale(a: Scene, b: Scene) -> float:
    return (a.scale + b.scale) / 2


def _both(a: Scene, b: Scene) -> tuple[Floats, Floats]:
    one, other = np.broadcast_arrays(a.sizes[:, None], b.sizes)
    return one, other


def _apart(one: Floats, other: Floats) -> Floats:
    columns = zip(one.T, other.T, strict=True)
    return np.asarray(np.sqrt(sum((x[:, None] - y) ** 2 for x, y in columns)))


def _place(a: Scene, b: Scene) -> Floats:
    """Way as a share of the drawing; small things count more, what keeps its box's place less."""
    scale = _scale(a, b)
    way = _apart(a.centres, b.centres) / scale
    own = _apart(*((s.centres - s.box.mean(axis=0)) / s.scale for s in (a, b)))
    size = np.sqrt(a.sizes[:, None] * b.sizes)
    weight = np.sqrt(np.clip(0.18 * scale / size, 0.8, 2.0))
    return np.asarray(weight * (way + np.minimum(way, own)) / 2)


def _aspect(a: Scene, b: Scene) -> Floats:
    """Difference of how wide things are, at most 2; straight lines have a direction instead."""
    logs, straight = [], []
    for s in (a, b):
        sides = np.array([np.ptp(i.box, axis=0) + (0 if i.filled else i.width) for i in s.items])
        logs.append(np.log(np.maximum(sides, 1e-3 * s.scale)) @ np.array([1.0, -1.0]))
        straight.append(np.array([isinstance(form, Segment) for form in s.forms]))
    differ = np.minimum(np.abs(logs[0][:, None] - logs[1]), 2.0)
    return np.where(straight[0][:, None] & straight[1], 0.0, differ)


def _directions(scene: Scene) -> Floats:
    """Direction of each item that is long enough to have one, modulo pi; NaN of others."""
    found = np.full(len(scene.items), np.nan)
    for k, (item, form) in enumerate(zip(scene.items, scene.forms, strict=True)):
        if isinstance(form, Segment):
            found[k] = float(np.arctan2(*(form.end - form.start)[::-1]))
        elif isinstance(form, RoundedBox):
            sides = form.sides + (0 if item.filled else item.width)
            if sides.max() > LONG * sides.min():
                found[k] = form.angle + (np.pi / 2 if sides[1] > sides[0] else 0.0)
        elif not isinstance(form, Dot):
            offsets = item.points - item.points.mean(axis=0)
            values, vectors = np.linalg.eigh(offsets.T @ offsets)
            if values[1] > LONG**2 * max(values[0], 1e-12 * values[1]):
                found[k] = float(np.arctan2(vectors[1, 1], vectors[0, 1]))
    return found


def _direction(a: Scene, b: Scene) -> Floats:
    """Angle between directions as a share of a right angle; 0 where one has none."""
    turn = np.abs(_directions(a)[:, None] - _directions(b)) % np.pi
    return np.asarray(np.nan_to_num(np.minimum(turn, np.pi - turn) / (np.pi / 2)))


def _bending(a: Scene, b: Scene) -> Floats:
    """Difference of what open lines turn through, in right angles, at most 2."""
    found = []
    for scene in (a, b):
        row = np.full(len(scene.items), np.nan)
        for k, (item, form) in enumerate(zip(scene.items, scene.forms, strict=True)):
            if isinstance(form, OpenLine | Segment):
                ahead = np.diff(item.points, axis=0) @ np.array([1, 1j])
                turns = np.angle(ahead[1:] * ahead[:-1].conj())
                row[k] = abs(float(turns.sum())) if isinstance(form, OpenLine) else 0.0
        found.append(row)
    differ = np.abs(found[0][:, None] - found[1]) / (np.pi / 2)
    return np.asarray(np.nan_to_num(np.minimum(differ, 2.0)))


def _kind(a: Scene, b: Scene) -> Floats:
    """What other classes of forms cost, open against closed, area against line."""
    classes = [np.array([_class(form) for form in scene.forms]) for scene in (a, b)]
    filled = [np.array([item.filled for item in scene.items]) for scene in (a, b)]
    closed = [np.array([item.closed for item in scene.items]) for scene in (a, b)]
    dots = [np.array([isinstance(form, Dot) for form in s.forms]) for s in (a, b)]
    straight = [np.array([isinstance(form, Segment) for form in s.forms]) for s in (a, b)]
    dotted = dots[0][:, None] | dots[1]
    opened = (closed[0][:, None] != closed[1]) & ~dotted
    never = (straight[0][:, None] & closed[1]) | (closed[0][:, None] & straight[1])
    cost = CLASS * (classes[0][:, None] != classes[1]) + OPEN * opened
    cost = cost + NEVER * (never & ~dotted)
    return np.asarray(cost + KIND * (filled[0][:, None] != filled[1]))


def _class(form: object) -> int:
    kinds = (RoundedBox, Segment, Dot, OpenLine, Blob)
    return next(k for k, kind in enumerate(kinds) if isinstance(form, kind))


def same_things(a: Scene, b: Scene) -> Floats:
    """1 of pairs that are one thing in two places: of one size, form, direction, and paint."""
    same = np.abs(np.log(a.sizes[:, None] / b.sizes)) < 0.05
    same &= in_common(a.pictures, b.pictures) > 0.9
    same &= _apart(a.colours, b.colours) < 0.05
    return same.astype(np.float64)


def _beyond(a: Scene, b: Scene) -> Floats:
    """By how much one of each pair is larger than it should be, a logarithm."""
    return np.asarray(np.maximum(np.abs(np.log(a.sizes[:, None] / b.sizes)) - TWICE, 0.0))


def _crossing(a: Scene, b: Scene) -> Floats:
    """Which pairs lie on other sides of the axes that both drawings have."""
    found = np.zeros((len(a.items), len(b.items)), dtype=bool)
    for one in a.axes:
        for other in b.axes:
            if one.flips == other.flips:
                off = [
                    (s.centres[:, axis.flips] - axis.place) / s.scale
                    for s, axis in ((a, one), (b, other))
                ]
                aside = (np.abs(off[0]) > ASIDE)[:, None] & (np.abs(off[1]) > ASIDE)
                found |= aside & (off[0][:, None] * off[1] < 0)
    return found.astype(np.float64)


def parents_cost(a: Scene, b: Scene, now: Current) -> Floats:
    """What it costs to lie in something that becomes something else."""
    partner = np.full(len(a.items) + 1, -1)  # the last stands for no parent
    partner[now.first] = now.second
    there = partner[a.parents]
    either = (a.parents >= 0)[:, None] & (b.parents >= 0)
    cost = OTHER_PARENT * (either & (there[:, None] != b.parents))
    return np.asarray(cost + ORPHAN * ((a.parents >= 0)[:, None] != (b.parents >= 0)))


def relations_cost(a: Scene, b: Scene, now: Current) -> Floats:
    """What it costs that the way to other pairs changes."""
    sizes = np.sqrt(a.sizes[now.first] * b.sizes[now.second])
    room = int(np.clip(RELATED_ROOM / (len(a.items) * len(b.items)), LEAST_RELATED, MOST_RELATED))
    kept = np.argsort(-comparable(sizes), kind="stable")[:room]
    weights = np.exp(-np.clip(now.costs[kept], -2, 4)) * sizes[kept] / _scale(a, b)
    total = np.zeros((len(a.items), len(b.items)))
    weighed = np.full_like(total, DAMPED)
    change, way = np.zeros_like(total), np.zeros_like(total)  # tables are large, and laid out once
    for i, j, own in zip(now.first[kept], now.second[kept], weights, strict=True):
        ways = [(s.centres - s.centres[k]) / s.scale for s, k in ((a, i), (b, j))]
        np.subtract(ways[0][:, :1], ways[1][:, 0], out=change)
        np.subtract(ways[0][:, 1:], ways[1][:, 1], out=way)
        np.sqrt(np.add(np.square(change, out=change), np.square(way, out=way), out=way), out=change)
        np.add(change, TOUCH, out=change, where=a.touching[:, i][:, None] != b.touching[:, j])
        near = [np.sqrt(own / (NEAR + np.hypot(*way.T))) for way in ways]
        near[0][i] = near[1][j] = 0.0
        weight = np.multiply(near[0][:, None], near[1], out=way)
        weighed += weight
        total += np.multiply(weight, change, out=change)
    return np.asarray(RELATION * total / weighed)


def axes_cost(a: Scene, b: Scene, costs: Floats) -> Floats:
    """The costs with mates going to mates."""
    least: Floats | None = None
    for one in a.axes:
        for other in b.axes:
            if one.flips != other.flips:
                continue
            has = (one.mates >= 0)[:, None] & (other.mates >= 0)
            mean = (costs + costs[one.mates][:, other.mates]) / 2
            own = [axis.mates == np.arange(len(axis.mates)) for axis in (one, other)]
            found = np.where(has, mean, costs)
            found = found + MATES * (has & (own[0][:, None] != own[1]))
            found = found - AXIAL * (own[0][:, None] & own[1])
            least = found if least is None else np.minimum(least, found)
    return costs if least is None else least
