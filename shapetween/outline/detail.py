"""Two outlines of thousands of curves read as one: their coarse shapes matched, the rest between.

Between two matched places each outline wanders along the chord that joins them, back and forth.
Where one of them wanders back, the other one stands still. Then, seen along a chord, every blend of
the two keeps the order of both: bays close and open as small copies of themselves, and detail that
moves with its chord crosses no other detail of the same chord.
"""

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.geometry.circlemap import turn
from shapetween.geometry.polygon import cross
from shapetween.mesh.simple import touching_sides
from shapetween.outline.coarse import Coarse
from shapetween.outline.matched import MatchedOutlines, Pieces, Samples, cut_curves

__all__ = ["DetailedOutlines"]

#: Share of a chord that all between its ends keeps from them, so that a bay at a node is not taken
#: for the node.
AT_NODE = 1e-6

#: Times that nodes are added where the polygons of the nodes touch themselves, and places looked at
#: for a new one. Each round halves what is left of it, about.
ROUNDS, LOOKS = 12, 64

#: Steps of a place that are less than a curve can be cut at.
SAME_PLACE = 1e-7


class DetailedOutlines:
    """A correspondence of coarse outlines carried over to all of their curves.

    Parameters
    ----------
    source, target : Coarse
    u, v : (K,) float64
        Matched fractions of the polygons' lengths, as in `MatchedOutlines`.
    """

    def __init__(self, source: Coarse, target: Coarse, u: Floats, v: Floats) -> None:
        self.source, self.target = source, target
        joints = MatchedOutlines(source.lengths, target.lengths, u, v).joints
        self._nodes = self._simple(
            np.stack([joints[0], source.lifted(joints[1]), target.lifted(joints[2])])
        )

    def _simple(self, nodes: Floats) -> Floats:
        """Nodes with others between them until their polygons are simple, or no more help.

        Parameters
        ----------
        nodes : (3, N) float64
            Common parameter and both places.
        """
        sides = self.source, self.target
        turns = np.array([1.0, *(len(side.outline.curves) for side in sides)])
        for _ in range(ROUNDS):
            rough = np.stack(
                [
                    touching_sides(side.points(places))
                    for side, places in zip(sides, nodes[1:], strict=True)
                ]
            )
            bad = np.flatnonzero(rough.any(axis=0))
            if not len(bad):
                break
            start, end = nodes[:, bad], np.roll(nodes, -1, axis=1)[:, bad]
            end = end + turns[:, None] * (end <= start)
            which = np.where(rough[0, bad], 0, 1)
            shares = [
                _farthest(sides[k], float(first[1 + k]), float(last[1 + k]))
                for k, first, last in zip(which.tolist(), start.T, end.T, strict=True)
            ]
            added = (start + np.array(shares) * (end - start)) % turns[:, None]
            nodes = np.concatenate([nodes, added], axis=1)
            nodes = nodes[:, np.argsort(nodes[0])]
        return nodes

    def samples(self) -> Samples:
        """All matched corners."""
        w, first, second = self._nodes
        return Samples(
            w, self.source.points(first), self.target.points(second), np.ones(len(w), dtype=bool)
        )

    def cut(self, w: Floats) -> Pieces:
        """Both outlines cut at all joints; the parameters `w` are among the samples'."""
        assert np.isin(w, self._nodes[0]).all()
        counts = len(self.source.outline.curves), len(self.target.outline.curves)
        spans = []
        for start, end in zip(self._nodes.T, np.roll(self._nodes, -1, axis=1).T, strict=True):
            width = end[0] - start[0] + (end[0] <= start[0])
            steps = [
                _steps(side, first, last + count * (last <= first))
                for side, count, first, last in zip(
                    (self.source, self.target), counts, start[1:], end[1:], strict=True
                )
            ]
            share, first, second = _merged(*steps[0], *steps[1])
            spans.append(np.stack([start[0] + width * share, first, second]))
        rows = np.concatenate(spans, axis=1)
        rows = rows[:, np.argsort(turn(rows[0]), kind="stable")]
        places = [_split(row, count) for row, count in zip(rows[1:], counts, strict=True)]
        still = [(np.roll(p, -1, axis=1) == p).all(axis=0) for p in places]
        keep = ~(still[0] & still[1])
        return Pieces(
            turn(rows[0, keep]),
            cut_curves(self.source.outline.curves, places[0][:, keep]),
            cut_curves(self.target.outline.curves, places[1][:, keep]),
        )


def _farthest(side: Coarse, first: float, last: float) -> float:
    """How far from one place to another the outline is farthest off the chord, from 0 to 1."""
    shares = np.arange(1, LOOKS) / LOOKS
    points = side.points(np.concatenate([[first], first + shares * (last - first), [last]]))
    offset = points - points[0]
    away = np.abs(cross(offset[-1], offset[1:-1]))
    return float(shares[away.argmax()])


def _steps(side: Coarse, first: float, last: float) -> tuple[Floats, Floats]:
    """How an outline goes along the chord from one place to another.

    Returns
    -------
    share, place : (K,) float64
        Neither ever falls. Between two joints that part all before from all behind them the
        outline wanders; it is given no part of the chord then, but the middle of what it covers.
    """
    places = np.concatenate([[first], side.joints(first, last), [last]])
    points = side.points(places)
    along = _along(points)
    ahead = np.maximum.accumulate(along)
    parting = np.flatnonzero(ahead <= np.minimum.accumulate(along[::-1])[::-1])
    wide = np.flatnonzero(np.diff(parting) > 1)
    begin, end = parting[wide], parting[wide + 1]
    middle = (along[begin] + along[end]) / 2
    inner = np.setdiff1d(np.arange(len(places)), parting)
    share = np.concatenate([along[parting], middle[np.searchsorted(end, inner)], middle, middle])
    share = np.clip(share, AT_NODE, 1 - AT_NODE)
    share[0], share[len(parting) - 1] = 0.0, 1.0
    joint = np.concatenate([parting, inner, begin, end])
    order = np.lexsort((share, joint))
    return share[order], places[joint[order]]


def _along(points: Points) -> Floats:
    """How far along the chord from the first to the last of them points are, from 0 to 1."""
    chord = points[-1] - points[0]
    square = float(chord @ chord)
    if not square > 0:
        return np.linspace(0.0, 1.0, len(points))
    along = np.clip((points - points[0]) @ chord / square, 0.0, 1.0)
    along[-1] = 1.0
    return np.asarray(along)


def _merged(
    share_a: Floats, place_a: Floats, share_b: Floats, place_b: Floats
) -> tuple[Floats, Floats, Floats]:
    """Both outlines' steps in one order: share and both places at each step but the last."""
    share = np.concatenate([share_a, share_b])
    first = np.concatenate([place_a, _reached(share_b, share_a, place_a, "right")])
    second = np.concatenate([_reached(share_a, share_b, place_b, "left"), place_b])
    order = np.lexsort((second, first, share))
    share, first, second = share[order], first[order], second[order]
    moved = (np.diff(first) > SAME_PLACE) | (np.diff(second) > SAME_PLACE)
    keep = np.append(True, moved) & (share < 1)
    return share[keep], first[keep], second[keep]


def _reached(at: Floats, share: Floats, place: Floats, side: str) -> Floats:
    """Places reached at shares of the chord, before or after what happens at that very share."""
    if side == "left":
        after = np.searchsorted(share, at, side="left")
        before = np.maximum(after - 1, 0)
        exact = share[after] == at
        here = after
    else:
        before = np.searchsorted(share, at, side="right") - 1
        after = np.minimum(before + 1, len(share) - 1)
        exact = share[before] == at
        here = before
    gap = share[after] - share[before]
    part = (at - share[before]) / np.where(gap > 0, gap, 1.0)
    between = place[before] + part * (place[after] - place[before])
    return np.where(exact, place[here], between)


def _split(places: Floats, count: int) -> Floats:
    """Curve and parameter of places, (2, N); just before a joint counts as on it."""
    near = np.round(places)
    places = np.where(np.abs(places - near) < SAME_PLACE, near, places)
    curve = np.floor(places)
    return np.stack([curve % count, places - curve])
