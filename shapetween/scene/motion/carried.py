"""What keeps to another part while it moves: an area's own outline, and lines' ends on lines."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points
from shapetween.base.ends import End
from shapetween.geometry.bezier import evaluate, signed_area, sub_curves
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack, Leaf
from shapetween.scene.motion.projected import pieces_between
from shapetween.scene.motion.tracks import OfPieces, OfTrack
from shapetween.scene.places import Pieces, Places

__all__ = ["Carried", "Follower", "Following", "Junction", "JunctionConstraint"]

#: How soon a part's own movement counts less the farther it is, as a share of the drawing.
NEAR = 0.004


@dataclass(frozen=True, eq=False)
class Carried(OfPieces):
    """A line that keeps to the outline that it runs along, at both ends of the movement.

    Attributes
    ----------
    pieces : Pieces
        The line's, at both ends.
    anchor : CurveTrack
        Of what it runs along.
    scale : float
        Of the drawing.
    """

    anchor: CurveTrack
    scale: float

    @cached_property
    def _followers(self) -> tuple["Follower", "Follower"]:
        there = self.anchor.curves(np.array([0.0, 1.0]))
        return (
            Follower.of(there[0], self.pieces.source, self.scale),
            Follower.of(there[1], self.pieces.target, self.scale),
        )

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); exactly the ends' own at 0 and 1."""
        anchor = self.anchor.curves(t)
        first, last = (follower.moved(anchor) for follower in self._followers)
        part = t[:, None, None, None]
        result = (1 - part) * first + part * last
        result[:, 1:, 0] = result[:, :-1, 3]
        if self.pieces.closed:
            result[:, 0, 0] = result[:, -1, 3]
        result[t == 0] = self.pieces.source
        result[t == 1] = self.pieces.target
        return np.asarray(result)


@dataclass(frozen=True, eq=False)
class Following(Leaf):
    """A ring that one drawing alone has, and that keeps to the outline that it runs along.

    Attributes
    ----------
    pieces : Pieces
        The ring where it exists, and the outline next to it, cut where either has a joint.
    end : End
        The end at which it exists.
    anchor : CurveTrack
        Of what it runs along.
    """

    pieces: Pieces
    end: End
    anchor: CurveTrack

    @classmethod
    def of(cls, ring: Outline, end: End, anchor: CurveTrack) -> "Following":
        """The ring cut alike with the first ring of what it runs along."""
        home = anchor.curves(np.array([float(end)]))[0]
        outline = Outline(home[: anchor.counts[0]], anchor.closed[0])
        if signed_area(ring.curves) * signed_area(outline.curves) < 0:
            ring = ring.reversed()
        return cls(pieces_between(ring, outline, np.eye(3)), end, anchor)

    @property
    def counts(self) -> tuple[int, ...]:
        """It is one ring."""
        return (len(self.pieces.source),)

    @property
    def closed(self) -> tuple[bool, ...]:
        """It is closed."""
        return (True,)

    @cached_property
    def _parts(self) -> tuple[Index, Floats, Floats]:
        """Which curve of the outline each piece is next to, and from which parameter to which."""
        home = self.anchor.curves(np.array([float(self.end)]))[0][: self.anchor.counts[0]]
        places = Places(Outline(home, self.anchor.closed[0]))
        middles = evaluate(self.pieces.target, np.array([0.5]))[:, 0]
        curve, _ = places.locate(places.nearest(middles))
        ends = []
        for point, joint in ((self.pieces.target[:, 0], 0.0), (self.pieces.target[:, 3], 1.0)):
            found, at = places.locate(places.nearest(point))
            # What lies on a joint may be found on the curve before or after it.
            ends.append(np.where((found == curve) & (at > 0), at, joint))
        return curve, ends[0], ends[1]

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); exactly its own at its end."""
        curve, start, end = self._parts
        whole = self.anchor.curves(t)[:, curve]
        both = (np.tile(at, len(t)) for at in (start, end))
        there = sub_curves(whole.reshape(-1, 4, 2), *both).reshape(whole.shape)
        result = self.pieces.source + (there - self.pieces.target)
        result[:, 1:, 0] = result[:, :-1, 3]
        result[:, 0, 0] = result[:, -1, 3]
        result[t == self.end] = self.pieces.source
        return np.asarray(result)


@dataclass(frozen=True, slots=True, eq=False)
class Follower:
    """Control points that go along with what of an outline is next to each of them.

    Attributes
    ----------
    own : (P, 4, 2) float64
        Where they are at home.
    places : (H, 2) float64
        Places of the outline at home.
    weights : (4 P, H) float64
        What each of those counts for each control point.
    """

    own: Curves
    places: Points
    weights: Floats

    @classmethod
    def of(cls, home: Curves, own: Curves, scale: float) -> "Follower":
        """Followers of an outline's curves (N, 4, 2) at home, in a drawing of a size."""
        places = _places(home[None])[0]
        away = np.linalg.norm(own.reshape(-1, 2)[:, None] - places, axis=-1)
        weights = 1 / (away + NEAR * scale) ** 4
        return cls(own, places, weights / weights.sum(axis=1, keepdims=True))

    def moved(self, curves: Curves) -> Curves:
        """Where they are when the outline is elsewhere, (F, N, 4, 2) to (F, P, 4, 2)."""
        shift = self.weights @ (_places(curves) - self.places)
        return np.asarray(self.own + shift.reshape(len(curves), *self.own.shape))


def _places(curves: Curves) -> Points:
    """Places along moving curves (F, P, 4, 2), four to each, (F, 4 P, 2)."""
    at = np.array([0.0, 0.25, 0.5, 0.75])
    return np.asarray(evaluate(curves, at).reshape(len(curves), -1, 2))


@dataclass(frozen=True, slots=True, eq=False)
class Junction:
    """An end of a line that lies on another part in both drawings.

    Attributes
    ----------
    last : bool
        Which end.
    anchor : CurveTrack
    places : ((int, float), (int, float))
        Curve and parameter of the anchor where it lies at the start and at the end.
    """

    last: bool
    anchor: CurveTrack
    places: tuple[tuple[int, float], tuple[int, float]]

    @classmethod
    def of(cls, line: CurveTrack, last: bool, anchor: CurveTrack) -> "Junction":
        """Where it lies."""
        ends = np.array([0.0, 1.0])
        own = line.curves(ends)
        places = []
        for curves, anchor_curves in zip(own, anchor.curves(ends), strict=True):
            point = curves[-1, 3] if last else curves[0, 0]
            there = Places(Outline(_first_ring(anchor_curves, anchor), anchor.closed[0]))
            curve, t = there.locate(there.nearest(point[None]))
            places.append((int(curve[0]), float(t[0])))
        return cls(last, anchor, (places[0], places[1]))

    def wanted(self, t: Floats, home: Points) -> Points:
        """Where the end is at the times (F,), (F, 2), and at both ends of the movement, (2, 2).

        It goes along what it lies on from one place to the other: across, it would go into it.
        """
        anchors = self.anchor.curves(np.concatenate([[0.0, 1.0], t]))[:, : self.anchor.counts[0]]
        there = Places(Outline(anchors[0], self.anchor.closed[0]))
        shares = [there.share(np.array([k]), np.array([at]))[0] for k, at in self.places]
        way = float(shares[1] - shares[0])
        if self.anchor.closed[0]:
            way -= float(np.round(way))
        curve, at = there.locate(shares[0] + way * t)
        frames = np.arange(len(t))
        along = evaluate(anchors[2 + frames, curve], at[:, None])[:, 0]
        for end, (index, at_end) in enumerate(self.places):
            weight = t if end else 1 - t
            point = evaluate(anchors[end, index], np.array([at_end]))[0]
            along = along + weight[:, None] * (home[end] - point)
        return np.asarray(along)


def _first_ring(curves: Curves, track: CurveTrack) -> Curves:
    return curves[: track.counts[0]]


@dataclass(frozen=True, eq=False)
class JunctionConstraint(OfTrack):
    """A line whose ends follow what they lie on; the pull fades to the other end.

    Its track is one open line.

    Attributes
    ----------
    junctions : tuple of Junction
    """

    junctions: tuple[Junction, ...]

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        curves = self.track.curves(t)
        ends = self.track.curves(np.array([0.0, 1.0]))
        share = np.broadcast_to(
            (np.arange(curves.shape[1])[:, None] + np.linspace(0, 1, 4)) / curves.shape[1],
            curves.shape[1:3],
        )
        result = curves.copy()
        for junction in self.junctions:
            k = (-1, 3) if junction.last else (0, 0)
            pull = junction.wanted(t, ends[:, k[0], k[1]]) - curves[:, k[0], k[1]]
            weight = share if junction.last else 1 - share
            result += pull[:, None, None] * weight[None, :, :, None]
        return result
