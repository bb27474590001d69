"""One body cut into areas that share borders, as a map is: each border moves once, for both sides.

Each area alone would be moved by its own corners or mesh, and neighbours would come apart between
the ends.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack, Leaf
from shapetween.scene.assign import Roles
from shapetween.scene.items import Item
from shapetween.scene.kept.shared_arcs import snapped
from shapetween.scene.motion.bend_knots import along_knots
from shapetween.scene.motion.tracks import Blend, OfTrack, Shared
from shapetween.scene.places import Pieces, Places, cut_alike, run_of
from shapetween.scene.relations import Scene

__all__ = ["MOST", "Bordered", "bordered_areas", "bordered_tracks"]

#: Distance within which two areas' borders are one, as a share of the drawing. Larger, and what is
#: drawn at either end is seen to differ from the drawing; smaller, and rounding parts them.
REACH = 5e-4

#: Most areas that are looked at; more take longer than it is worth.
MOST = 24

#: Least share of all that is filled that the areas must be. Less, and parts of a face that touch
#: are held to be one body.
WHOLE = 0.9

#: Length of a run between two borders, as a multiple of that distance, that is none. Smaller, and
#: three areas do not meet in one point; larger, and short outer edges are lost.
NOTHING = 4.0

#: Turn, radians, of a track from which on its area turns by itself. Smaller, and a facet that tips
#: a little parts from its neighbours; larger, and what turns is flattened on the way.
TURNS = 0.3


@dataclass(frozen=True, eq=False)
class Bordered(Leaf):
    """A ring of runs that neighbours share.

    Attributes
    ----------
    runs : tuple of (Blend, bool)
        Open lines, and whether each is run backwards.
    """

    runs: tuple[tuple[Blend, bool], ...]

    @property
    def counts(self) -> tuple[int, ...]:
        """It is one ring."""
        return (sum(run.counts[0] for run, _ in self.runs),)

    @property
    def closed(self) -> tuple[bool, ...]:
        """It is closed."""
        return (True,)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        parts = []
        for run, backwards in self.runs:
            own = run.curves(t)
            parts.append(own[:, ::-1, ::-1] if backwards else own)
        result = np.concatenate(parts, axis=1)
        # Where three areas meet, their borders do so within the distance that makes them one.
        result[:, 1:, 0] = result[:, :-1, 3]
        result[:, 0, 0] = result[:, -1, 3]
        return np.asarray(result)


def bordered_areas(a: Scene, b: Scene, roles: Roles) -> list[int]:
    """Pairs of areas that may share their borders."""
    return [k for k, role in enumerate(roles.pairs) if _plain(role.first, role.second, a, b)]


def bordered_tracks(
    a: Scene, b: Scene, roles: Roles, tracks: Mapping[int, Sequence[CurveTrack]]
) -> dict[int, tuple[CurveTrack, ...]]:
    """Tracks of pairs of areas that share their borders at both ends, by pair.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
    tracks : mapping of int to sequence of CurveTrack
        As each pair would move by itself.

    Returns
    -------
    dict of int to tuple of CurveTrack
        Empty unless all that is filled is one body of such areas, each of which meets the same
        neighbours in the same order at both ends.
    """
    areas = bordered_areas(a, b, roles)
    if not 2 <= len(areas) <= MOST or any(_turns(tracks[k]) for k in areas):
        return {}
    ends = [
        [scene.items[getattr(roles.pairs[k], side)] for k in areas]
        for scene, side in ((a, "first"), (b, "second"))
    ]
    for scene, items in zip((a, b), ends, strict=True):
        rest = [item for k, item in enumerate(scene.items) if item.filled and not scene.sheets[k]]
        if sum(item.area for item in items) < WHOLE * sum(item.area for item in rest):
            return {}
    places = [[Places(item.outer.clockwise()) for item in items] for items in ends]
    reaches = [REACH * scene.scale for scene in (a, b)]
    borders = [
        _borders(items, own, reach) for items, own, reach in zip(ends, places, reaches, strict=True)
    ]
    if set(borders[0]) != set(borders[1]) or not _is_one(len(areas), borders[0]):
        return {}
    shared: dict[tuple[int, int], Blend] = {}
    found: dict[int, tuple[CurveTrack, ...]] = {}
    for n, k in enumerate(areas):
        around = [
            _around(n, own[n], met, reach)
            for own, met, reach in zip(places, borders, reaches, strict=True)
        ]
        turned = _turned_alike(around[0], around[1])
        if turned is None:
            return {}
        runs = []
        for one, other in zip(around[0], turned, strict=True):
            key = (min(n, one.beside), max(n, one.beside))
            if one.beside >= 0 and key in shared:
                runs.append((shared[key], True))
                continue
            line = _line(run_of(places[0][n], *one.span), run_of(places[1][n], *other.span))
            if one.beside >= 0:
                shared[key] = line
            runs.append((line, False))
        found[k] = (Bordered(tuple(runs)),)
    return found


@dataclass(frozen=True, slots=True)
class _Run:
    """A part of a ring.

    Attributes
    ----------
    beside : int
        The neighbour that it borders on, -1 if on none.
    span : (float, float)
        Shares of the ring.
    """

    beside: int
    span: tuple[float, float]


def _plain(first: int, second: int, a: Scene, b: Scene) -> bool:
    """Whether two areas are of one ring each, and no sheets."""
    pair = (a.items[first], b.items[second])
    return not a.sheets[first] and all(i.filled and i.closed and not i.holes for i in pair)


def _turns(tracks: Sequence[CurveTrack]) -> bool:
    own = [track.track if isinstance(track, OfTrack | Shared) else track for track in tracks]
    return any(isinstance(track, Blend) and abs(track.turn) > TURNS for track in own)


def _borders(
    items: Sequence[Item], places: Sequence[Places], reach: float
) -> dict[tuple[int, int], tuple[tuple[float, float], tuple[float, float]]]:
    """Where areas run along each other: on the ring of either; more than once is never."""
    import shapely

    found = {}
    shapes = np.array([item.enclosed for item in items], dtype=object)
    rows, columns = shapely.STRtree(shapes).query(shapes, predicate="dwithin", distance=reach)
    for i, j in sorted(zip(rows.tolist(), columns.tolist(), strict=True)):
        if i >= j:
            continue
        back = places[j].outline.reversed()
        arcs = snapped([places[i].outline], [back], reach).arcs
        if len(arcs) == 1:
            low, high = arcs[0].other
            found[i, j] = arcs[0].own, (1.0 - high, 1.0 - low)
        elif arcs:
            found[i, j] = (0.0, 0.0), (0.0, 0.0)
    return found


def _is_one(count: int, borders: Mapping[tuple[int, int], object]) -> bool:
    """Whether borders join all areas."""
    joined = {0}
    for _ in range(count):
        joined |= {j for pair in borders for j in pair if joined & set(pair)}
    return len(joined) == count


def _around(
    n: int,
    places: Places,
    borders: Mapping[tuple[int, int], tuple[tuple[float, float], tuple[float, float]]],
    reach: float,
) -> list[_Run]:
    """The runs of a ring, in order, what borders on nothing among them."""
    met = sorted(
        (spans[pair.index(n)][0] % 1.0, pair[1 - pair.index(n)], spans[pair.index(n)])
        for pair, spans in borders.items()
        if n in pair
    )
    runs = []
    for k, (start, beside, span) in enumerate(met):
        end = start + span[1] - span[0]
        following = met[(k + 1) % len(met)][0] + (k + 1 == len(met))
        gone = (following - end) * places.length
        if gone > NOTHING * reach:
            runs += [_Run(beside, (start, end)), _Run(-1, (end % 1.0, end % 1.0 + following - end))]
        else:
            runs.append(_Run(beside, (start, end)))
    return runs


def _turned_alike(first: Sequence[_Run], second: Sequence[_Run]) -> list[_Run] | None:
    """The second one's runs from where the first one's begin; None if others follow each other."""
    if len(first) != len(second) or any(
        run.span[1] - run.span[0] <= 0 for run in (*first, *second)
    ):
        return None
    for k in range(len(second)):
        turned = [*second[k:], *second[:k]]
        if all(one.beside == other.beside for one, other in zip(first, turned, strict=True)):
            return turned
    return None


def _line(first: Outline, second: Outline) -> Blend:
    places = Places(first), Places(second)
    pieces = cut_alike(*places, *along_knots(*places)[:2])
    return Blend(Pieces(pieces.source, pieces.target, False), np.zeros((2, 2)))
