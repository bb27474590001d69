"""How much is to be seen on the way between two drawings that is in neither of them."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from shapetween.base.arrays import Index
from shapetween.model.part import CurveTrack
from shapetween.scene.assign import Role, Roles
from shapetween.scene.motion.turning import total_turning
from shapetween.scene.relations import Scene, in_common

__all__ = [
    "MANY_HOLES",
    "floods",
    "holes_apart",
    "intricacy",
    "recoloured",
    "tears",
    "waviest",
    "waviness",
]

#: Least size, as a share of the drawing, of what is looked at. Smaller, and a hundred dots weigh
#: more than what they are on; larger, and the limbs of an animal are not seen.
SEEN = 0.1

#: Unlikeness of pictures from which on a pair counts fully: what stays as it is may be as intricate
#: as it likes. Smaller, and a face that stays counts; larger, and gears become suns unnoticed.
CHANGED = 0.1

#: Turning, in whole turns, that counts at most: of two outlines that turn more nobody follows any
#: corner. Larger, and one drawn by tracing outweighs all else; at 1 all outlines are discs.
MOST_TURNS = 3.0

#: All of it that counts at most. Larger, and a wolf of twenty shades leaves for a fox; at 1 a
#: drawing of many intricate parts counts no more than a star.
MOST_INTRICATE = 1.7

#: Holes of one area, and unlikeness of pictures, from which on holes are run over. Fewer holes, and
#: a ring leaves for an eye to come; a smaller one, and a bin leaves for a box.
MANY_HOLES, HOLED = 2, 0.42

#: Turning beyond both ends that counts at most. Larger, and a limb that swings outweighs all else;
#: smaller, and what tears counts as what bulges.
MOST_WAVES = 0.2

#: Turning beyond both ends, in whole turns, from which on one area with holes is torn that becomes
#: one other. Smaller, and an eight leaves for a B to come; larger, and a Q melts into a nine.
TORN = 0.3

#: Sum of differences by which colours of pairs differ in the mean from which on they change.
#: Smaller, and a shade darker is a change; larger, and a grey rabbit is a brown bear at once.
RECOLOURED = 0.12

#: Times at which that is looked at, the ends first and last. Fewer about the middle, and what is a
#: lump for a moment passes.
LOOKED = np.array([0.0, 0.25, 0.4, 0.5, 0.6, 0.75, 1.0])

#: How many times as much is painted half-way as in either drawing if holes close before others
#: open, from which on that is a blot. Smaller, and a disc with a list leaves for one with a cross;
#: larger, and the panes of a window close before they open elsewhere.
FLOODED = 1.4


def floods(half_way: float, ends: Sequence[float]) -> bool:
    """Whether so much more is painted half-way than at either end that it is a blot."""
    return bool(round(half_way / max(ends), 6) > FLOODED)


def intricacy(a: Scene, b: Scene, roles: Roles) -> float:
    """How much the outlines turn of what becomes something else, in turns as large as the drawing.

    The more corners there are, the fewer of them have a counterpart.
    """
    total = 0.0
    for role, share in _seen(a, b, roles):
        i, j = role.first, role.second
        turns = max(
            total_turning(item.outer.curves, closed=item.closed)
            for item in (a.items[i], b.items[j])
        )
        total += share * min(turns, MOST_TURNS) * min(1.0, _unlike(a, b, i, j) / CHANGED)
    return min(total, MOST_INTRICATE)


def holes_apart(a: Scene, b: Scene, roles: Roles) -> bool:
    """Whether the largest pair is one of unlike areas, one of them with several holes.

    A truck's windows would swim through the basket of a cart.
    """
    pairs = [(-round(share, 6), role.first, role.second) for role, share in _seen(a, b, roles)]
    if not pairs:
        return False
    _, i, j = min(pairs)
    items = a.items[i], b.items[j]
    if not all(item.filled for item in items) or max(len(i.holes) for i in items) < MANY_HOLES:
        return False
    return round(_unlike(a, b, i, j), 6) > HOLED


def _unlike(a: Scene, b: Scene, i: int, j: int) -> float:
    """How unlike the pictures of two items are."""
    return 1 - float(in_common(a.pictures[i][None], b.pictures[j][None])[0, 0])


def waviness(
    a: Scene, b: Scene, roles: Roles, tracks: Mapping[int, Sequence[CurveTrack]]
) -> dict[int, float]:
    """By how much each pair's outline turns more on its way than at both ends, by pair.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
    tracks : mapping of int to sequence of CurveTrack
        By pair.
    """
    found = {}
    places = {(role.first, role.second): k for k, role in enumerate(roles.pairs)}
    for role, share in _seen(a, b, roles):
        k = places[role.first, role.second]
        if any(i.filled and i.cut for i in (a.items[role.first], b.items[role.second])):
            continue  # a cell is cut straight, and of what it comes from or goes into anyway
        found[k] = min(max(share * _waves(tracks[k][0]), 0.0), MOST_WAVES)
    return found


def tears(track: CurveTrack) -> bool:
    """Whether an outline turns so much more on its way than at its ends that it is torn."""
    return round(_waves(track), 6) > TORN


def _waves(track: CurveTrack) -> float:
    """By how much an outline turns more on its way than at both ends, in whole turns."""
    curves = track.curves(LOOKED)[:, : track.counts[0]]
    turns = [total_turning(line, closed=track.closed[0]) for line in curves]
    return max(turns[1:-1]) - max(turns[0], turns[-1])


def waviest(waves: Mapping[int, float]) -> int:
    """The pair whose outline turns most beyond its ends, of what `waviness` finds."""
    return max(waves, key=lambda k: (round(waves[k], 9), -k))


def recoloured(a: Scene, b: Scene, firsts: Index, seconds: Index) -> bool:
    """Whether pairs change their colours in the mean, by size."""
    if not len(firsts):
        return False
    weights = np.minimum(a.sizes[firsts] / a.scale, b.sizes[seconds] / b.scale)
    apart = np.abs(a.colours[firsts] - b.colours[seconds]).sum(axis=1)
    return bool(np.round(np.average(apart, weights=weights), 6) > RECOLOURED)


def _seen(a: Scene, b: Scene, roles: Roles) -> Iterator[tuple[Role, float]]:
    """Pairs that are large enough, and their sizes as shares of the drawing."""
    for role in roles.pairs:
        i, j = role.first, role.second
        share = min(a.sizes[i] / a.scale, b.sizes[j] / b.scale)
        if not a.sheets[i] and np.round(share, 9) >= SEEN:
            yield role, float(share)
