"""Tracks: where a ring's curves are through time."""

from abc import abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Affine, Curves, Floats, Points
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.geometry.rotation import rotations
from shapetween.model.part import Area, Change, CurveTrack, Leaf
from shapetween.outline.carry import Joints
from shapetween.scene.places import Pieces

__all__ = ["Blend", "Frame", "Framed", "InTurn", "Mirrored", "OfPieces", "OfTrack", "Shared"]

#: Least width of a card that turns over, as a share of its own: it is seen on its edge, not gone.
EDGE = 0.08

#: Width of such a card that is none. Smaller, and rounding, so the unit, says which side is seen.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class OfPieces(Leaf):
    """One ring or line made of pieces that become each other."""

    pieces: Pieces

    @property
    def counts(self) -> tuple[int, ...]:
        """It is one ring."""
        return (len(self.pieces.source),)

    @property
    def closed(self) -> tuple[bool, ...]:
        """As its pieces are."""
        return (self.pieces.closed,)


@dataclass(frozen=True, eq=False)
class Blend(OfPieces):
    """One ring or line whose curves go straight to their counterparts, in a frame that turns.

    Attributes
    ----------
    pieces : Pieces
    centres : (2, 2) float64
        Where the frame is at both ends.
    turn : float
        By how much it turns, radians.

    Notes
    -----
    Of two rectangles, cut at their corners, it is the paper's movement of a mesh of one quad: the
    turn is that of the polar decomposition, the stretch goes evenly, R(t turn)((1 - t) I + t S).
    Of two rounded boxes, cut where sides and corners meet, it blends sides and radii evenly.
    """

    centres: Points
    turn: float = 0.0

    @cached_property
    def _joints(self) -> Joints:
        return Joints.of(*self._local, closed=self.pieces.closed)

    @cached_property
    def _local(self) -> tuple[Curves, Curves]:
        """Both ends in the frame."""
        back = rotations(np.asarray(-self.turn))
        target = (self.pieces.target - self.centres[1]) @ back.T
        return self.pieces.source - self.centres[0], np.asarray(target)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); exactly the ends' own at 0 and 1."""
        if t.size and ((t == 0) | (t == 1)).all():
            return np.stack([self.pieces.target if at == 1 else self.pieces.source for at in t])
        part = t[:, None, None, None]
        source, target = self._local
        local = as_complex((1 - part) * source + part * target)
        self._joints.smooth(local, t)
        turned = local * np.exp(1j * self.turn * t)[:, None, None]
        centre = (1 - t)[:, None] * self.centres[0] + t[:, None] * self.centres[1]
        result = as_points(turned) + centre[:, None, None]
        result[t == 0] = self.pieces.source
        result[t == 1] = self.pieces.target
        return np.asarray(result)


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """A frame that a whole drawing moves in: it turns and stretches evenly about a moving centre.

    Or it turns over about an axis, as a card does: a scale along the other axis goes through zero.

    Attributes
    ----------
    centres : (2, 2) float64
        Of both drawings.
    turn : float
        Radians.
    stretch : (2, 2) float64
        Symmetric, positive definite but along an axis that turns over; what is left of the map
        when the turn is taken from it.
    over : int
        The coordinate that turns over: 0 for x, 1 for y, -1 for none.
    """

    centres: Points
    turn: float
    stretch: Floats
    over: int = -1

    @property
    def growth(self) -> float:
        """By how much lengths grow, on the whole."""
        return float(np.sqrt(np.abs(np.linalg.det(self.stretch))))

    @property
    def linear(self) -> Floats:
        """The map at the end but for its shift, (2, 2)."""
        return np.asarray(rotations(np.asarray(self.turn)) @ self.stretch)

    def carried(self, points: Points, t: Floats) -> Points:
        """Points (F, ..., 2) of the frame at the times (F,)."""
        time = t[:, None, None]
        stretch = (1 - time) * np.eye(2) + time * self.stretch
        if self.over >= 0:
            scale = stretch[:, self.over, self.over]
            # Half-way it may be 0, whose sign is rounding's.
            thin = np.where(scale < -ROUNDING, -EDGE, EDGE)
            stretch[:, self.over, self.over] = np.where(np.abs(scale) < EDGE, thin, scale)
        linear = rotations(t * self.turn) @ stretch
        centre = (1 - t)[:, None] * self.centres[0] + t[:, None] * self.centres[1]
        flat = (points - self.centres[0]).reshape(len(t), -1, 2)
        moved = flat @ np.swapaxes(linear, 1, 2) + centre[:, None]
        return np.asarray(moved.reshape(points.shape))

    @property
    def forth(self) -> Affine:
        """The map from the first drawing to the second, (2, 3)."""
        linear = self.linear
        return np.column_stack([linear, self.centres[1] - linear @ self.centres[0]])

    @property
    def back(self) -> Affine:
        """The map from the second drawing to where it is in the frame, (2, 3)."""
        linear = np.linalg.inv(self.linear)
        return np.column_stack([linear, self.centres[0] - linear @ self.centres[1]])


@dataclass(frozen=True, eq=False)
class OfTrack:
    """What a track becomes that is moved in another way besides.

    Attributes
    ----------
    track : CurveTrack
    """

    track: CurveTrack

    @property
    def counts(self) -> tuple[int, ...]:
        """As many as the track's."""
        return self.track.counts

    @property
    def closed(self) -> tuple[bool, ...]:
        """As the track's."""
        return self.track.closed

    @property
    def areas(self) -> tuple[Area, ...]:
        """None: what meshes move is moved on."""
        return ()

    @abstractmethod
    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""

    def following(self, change: Change) -> CurveTrack:
        """The same of the track changed, itself changed."""
        return change(replace(self, track=self.track.following(change)))


@dataclass(frozen=True, eq=False)
class Framed(OfTrack):
    """A track in the frame of the whole drawing.

    Attributes
    ----------
    frame : Frame
    """

    frame: Frame

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2); the track's own at 0."""
        own = self.track.curves(t)
        result = self.frame.carried(own, t)
        result[t == 0] = own[t == 0]
        return result


@dataclass(frozen=True, eq=False)
class Mirrored(OfTrack):
    """The mirror image of a track, about an axis that moves evenly.

    Attributes
    ----------
    flips : int
        0 about an upright axis, 1 about a level one.
    places : (float, float)
        Where the axis is at both ends.
    """

    flips: int
    places: tuple[float, float]

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        result = self.track.curves(t).copy()
        axis = (1 - t) * self.places[0] + t * self.places[1]
        result[..., self.flips] = 2 * axis[:, None, None] - result[..., self.flips]
        # A mirror image runs the other way round.
        last = np.cumsum(self.counts)
        for end, count, closed in zip(last, self.counts, self.closed, strict=True):
            if closed:
                result[:, end - count : end] = result[:, end - count : end][:, ::-1, ::-1]
        return result


class Shared:
    """A track that several ask for the same times, and that is computed once for them.

    Parameters
    ----------
    track : CurveTrack
    """

    def __init__(self, track: CurveTrack) -> None:
        self.track = track
        self.counts, self.closed, self.areas = track.counts, track.closed, track.areas
        self._known: tuple[bytes, Curves] | None = None

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        key = t.tobytes()
        if self._known is None or self._known[0] != key:
            found = self.track.curves(t)
            found.setflags(write=False)
            self._known = key, found
        return self._known[1]

    def following(self, change: Change) -> CurveTrack:
        """The same of the track changed, itself changed."""
        return change(Shared(self.track.following(change)))


@dataclass(frozen=True, eq=False)
class InTurn(OfTrack):
    """A track that runs in the first or the second half of the time.

    Attributes
    ----------
    first : bool
        Whether in the first one.
    """

    first: bool

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return self.track.curves(np.clip(2 * t if self.first else 2 * t - 1, 0.0, 1.0))
