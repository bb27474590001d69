"""Places on an outline by arc length: what a matching counts in, and back to curve parameters.

A place is a fraction of the whole length from the outline's start, so it does not depend on
units, nor on how the curve was cut into commands.
"""

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Complex, Curves, Floats, Index, Points, row_lengths
from shapetween.base.errors import OutlineError
from shapetween.geometry.bezier import bernstein, combined, sub_curves
from shapetween.geometry.linearmaps import as_complex, as_points, squared
from shapetween.model.outline import Outline
from shapetween.model.remembered import by_curves

__all__ = ["ArcLength", "arc_length"]

Located: TypeAlias = tuple[Index, Floats]
"""Curve indices and the parameters on those curves, of equal shapes."""

#: Gauss-Legendre nodes on a piece of a curve. With fewer, smooth curves need many pieces; with
#: more, every step of the inversion costs more.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)

#: Share of the whole length by which a piece may differ from its two halves before it is halved.
#: Larger and hooks are misjudged; smaller and rounding alone asks for more pieces.
PIECE_ERROR = 1e-12

#: Most halvings of one curve. A cusp needs as many as it takes for its piece to have no length.
MAX_HALVINGS = 24

#: Steps of the safeguarded Newton iterations; they stop early, so this only bounds bad cases.
MAX_STEPS = 60

#: Share of the whole length to which a place is found; smaller is below what the sums can tell.
PLACE_ERROR = 2e-15

#: Parts of a piece in which the nearest point is looked for; each is taken to hold one nearest
#: point at most, so fewer could miss the nearer of two, and more cost time.
NEAREST_PARTS = 8

#: Outlines whose lengths are kept. With fewer a drawing's outlines are measured anew by each stage
#: that asks; more would keep memory for drawings that are done.
KEPT = 32


class ArcLength:
    """The arc length of an outline, tabulated once and asked for many places.

    Fractions run from 0 at the outline's start to 1 at its end; of a closed outline they are
    taken modulo 1, of an open one they are clipped. All methods take arrays of any shape.

    Parameters
    ----------
    outline : Outline

    Attributes
    ----------
    outline : Outline
    length : float
        In user units, to 1e-10 of itself.
    joints : (N,) float64
        Fraction at which each curve starts.

    Raises
    ------
    OutlineError
        If the outline has no length.
    """

    def __init__(self, outline: Outline) -> None:
        self.outline = outline
        curves = outline.curves
        # Handles relative to the start, so that a place far from the origin costs no digits.
        self._steps = 3 * np.diff(curves, axis=1)
        self._piece_curve, self._piece_start, self._piece_end, lengths = self._pieces()
        total = np.concatenate([[0.0], np.cumsum(lengths)])
        self.length = float(total[-1])
        if not self.length > 0:
            raise OutlineError("an outline is a single point; it needs a length")
        self._bounds = total / self.length
        self._first_piece = np.searchsorted(self._piece_curve, np.arange(len(curves)))
        self.joints = self._bounds[self._first_piece]
        self.joints.setflags(write=False)

    def point(self, fraction: ArrayLike) -> Points:
        """Points at fractions of the length, (..., 2)."""
        return self._at(*self.locate(fraction))

    def tangent(self, fraction: ArrayLike) -> Points:
        """Directions of travel at fractions of the length, (..., 2).

        Unit vectors; zero only at the very point of a cusp, where there is no direction.
        """
        return self._heading(*self.locate(fraction))

    def point_and_tangent(self, fraction: ArrayLike) -> tuple[Points, Points]:
        """What `point` and `tangent` say, found at once."""
        curve, t = self.locate(fraction)
        return self._at(curve, t), self._heading(curve, t)

    def locate(self, fraction: ArrayLike) -> Located:
        """Curve and parameter at fractions of the length.

        A joint belongs to the curve that starts there, parameter 0; curves of no length are
        never answered.
        """
        s = np.asarray(fraction, dtype=np.float64)
        s = s - np.floor(s) if self.outline.closed else np.clip(s, 0.0, 1.0)
        wanted = s.reshape(-1)
        ends = self._bounds[1:]
        last = int(np.searchsorted(ends, 1.0))  # the last piece with a length
        piece = np.minimum(np.searchsorted(ends, wanted, side="right"), last)
        t = self._invert(piece, (wanted - self._bounds[piece]) * self.length)
        return self._piece_curve[piece].reshape(s.shape), t.reshape(s.shape)

    def fraction(self, curve: ArrayLike, t: ArrayLike) -> Floats:
        """Fraction of the length at parameters of curves, in [0, 1]."""
        index, parameter = np.broadcast_arrays(
            np.asarray(curve, dtype=np.intp), np.asarray(t, dtype=np.float64)
        )
        # Pieces are sorted by curve and then by parameter, so their sum is one sorted key.
        key = self._piece_curve + self._piece_start
        piece = np.searchsorted(key, index + parameter, side="right") - 1
        # Parameter 1 of a curve belongs to its own last piece, not to the next curve's first.
        count = len(self.outline.curves)
        limit = np.append(self._first_piece, len(key))[np.minimum(index + 1, count)] - 1
        piece = np.minimum(piece, limit)
        low = self._piece_start[piece]
        part = _lengths(self._steps[index], low, parameter)
        return np.asarray(self._bounds[piece] + part / self.length)

    def nearest(self, points: ArrayLike) -> tuple[Floats, Floats]:
        """Places on the outline nearest to points.

        Parameters
        ----------
        points : (..., 2) array_like
            In user units.

        Returns
        -------
        fraction, distance : (...) float64
            Distances in user units. Of several nearest places the first one counts.
        """
        p = np.asarray(points, dtype=np.float64)
        flat = p.reshape(-1, 2)
        cuts = np.linspace(self._piece_start, self._piece_end, NEAREST_PARTS + 1, axis=1)
        part_curve = np.repeat(self._piece_curve, NEAREST_PARTS)
        start, end = cuts[:, :-1].ravel(), cuts[:, 1:].ravel()
        parts = sub_curves(self.outline.curves[part_curve], start, end)
        reach = row_lengths(flat[:, None] - parts[:, 0]).min(axis=1)
        reach = np.minimum(reach, row_lengths(flat - parts[-1, 3]))
        # Only a part whose box comes as near as the nearest cut can hold the nearest point.
        low, high = parts.min(axis=1), parts.max(axis=1)
        gap = np.maximum(np.maximum(low - flat[:, None], flat[:, None] - high), 0.0)
        # A whisker more, lest rounding shut out the very part.
        who, part = np.nonzero(row_lengths(gap) <= reach[:, None] * (1 + 1e-9))
        curve, target = part_curve[part], flat[who]
        lowest, highest = start[part], end[part]
        middle = (lowest + highest) / 2
        t = self._closest(curve, target, middle, lowest, highest)
        distance = row_lengths(self._at(curve, t) - target)
        order = np.lexsort((t, curve, distance, who))
        chosen = order[np.searchsorted(who[order], np.arange(len(flat)))]
        fraction = self.fraction(curve[chosen], t[chosen])
        return fraction.reshape(p.shape[:-1]), distance[chosen].reshape(p.shape[:-1])

    def _at(self, curve: Index, t: Floats) -> Points:
        """Points at parameters of curves, (..., 2)."""
        return combined(bernstein(t)[..., None, :], self.outline.curves[curve])[..., 0, :]

    def _heading(self, curve: Index, t: Floats) -> Points:
        """Directions of travel at parameters of curves, (..., 2)."""
        velocity = _velocity(self._steps[curve], t)
        speed = row_lengths(velocity)[..., None]
        return np.asarray(velocity / np.where(speed > 0, speed, 1.0))

    def _pieces(self) -> tuple[Index, Floats, Floats, Floats]:
        """Curves cut until Gauss-Legendre integrates every piece: curve, start, end, length."""
        curve = np.arange(len(self._steps))
        low, high = np.zeros(len(curve)), np.ones(len(curve))
        scale = float(np.linalg.norm(self._steps, axis=-1).sum())
        done: list[tuple[Index, Floats, Floats, Floats]] = []
        for halving in range(MAX_HALVINGS + 1):
            middle = (low + high) / 2
            steps = self._steps[curve]
            whole = _lengths(steps, low, high)
            halves = _lengths(steps, low, middle) + _lengths(steps, middle, high)
            good = np.abs(whole - halves) <= PIECE_ERROR * scale
            if halving == MAX_HALVINGS:
                good[:] = True
            done.append((curve[good], low[good], high[good], halves[good]))
            rough = ~good
            if not rough.any():
                break
            curve = np.tile(curve[rough], 2)
            low, high = (
                np.concatenate([low[rough], middle[rough]]),
                np.concatenate([middle[rough], high[rough]]),
            )
        index, start, end, length = (np.concatenate(column) for column in zip(*done, strict=True))
        order = np.lexsort((start, index))
        return index[order], start[order], end[order], length[order]

    def _invert(self, piece: Index, wanted: Floats) -> Floats:
        """Parameter within each piece at which the length from its start is `wanted`."""
        low, high = self._piece_start[piece], self._piece_end[piece]
        begin = low
        steps = self._steps[self._piece_curve[piece]]
        size = np.diff(self._bounds)[piece] * self.length
        share = np.where(size > 0, wanted / np.where(size > 0, size, 1.0), 0.0)
        t: Floats = low + (high - low) * np.clip(share, 0.0, 1.0)
        left = np.arange(len(t))  # places not found yet: soon they are few
        for _ in range(MAX_STEPS):
            here, speeds = t[left], steps[left]
            excess = _lengths(speeds, begin[left], here) - wanted[left]
            low, high = np.where(excess < 0, here, low), np.where(excess > 0, here, high)
            rest = (np.abs(excess) > PLACE_ERROR * self.length) & (low != high)
            if not rest.any():
                break
            left, here, excess = left[rest], here[rest], excess[rest]
            low, high = low[rest], high[rest]
            speed = row_lengths(_velocity(speeds[rest], here))
            step = here - excess / np.where(speed > 0, speed, np.inf)
            inside = (step >= low) & (step <= high)
            t[left] = np.where(inside, step, (low + high) / 2)
        return t

    def _closest(
        self, curve: Index, target: Points, start: Floats, low: Floats, high: Floats
    ) -> Floats:
        """Parameter nearest to `target` on each curve between `low` and `high`."""
        steps = self._steps[curve]
        t = start
        for _ in range(MAX_STEPS):
            offset = self._at(curve, t) - target
            velocity = _velocity(steps, t)
            slope = (offset * velocity).sum(-1)
            bend = (velocity**2).sum(-1) + (offset * _acceleration(steps, t)).sum(-1)
            low, high = np.where(slope < 0, t, low), np.where(slope > 0, t, high)
            convex = bend > 0
            step = t - slope / np.where(convex, bend, 1.0)
            inside = convex & (step >= low) & (step <= high)
            following = np.where(inside, step, (low + high) / 2)
            following = np.where(slope == 0, t, following)
            if (np.abs(following - t) <= PLACE_ERROR).all():
                break
            t = following
        return t


@by_curves(KEPT)
def arc_length(outline: Outline) -> ArcLength:
    """The arc length of an outline, which every stage that asks for it shares.

    Raises
    ------
    OutlineError
        If the outline has no length.
    """
    return ArcLength(outline)


def _velocity(steps: Points, t: Floats) -> Points:
    """First derivative, for (..., 3, 2) steps at (...) parameters."""
    return as_points(_speeding(as_complex(steps), t))


def _speeding(steps: Complex, t: Floats) -> Complex:
    """First derivative as complex numbers, for (..., 3) steps at (...) parameters."""
    s = 1 - t
    return np.asarray(s * (s * steps[..., 0] + 2 * t * steps[..., 1]) + t * t * steps[..., 2])


def _acceleration(steps: Points, t: Floats) -> Points:
    """Second derivative, for (..., 3, 2) steps at (...) parameters."""
    bends = 2 * np.diff(steps, axis=-2)
    weight = t[..., None]
    return np.asarray((1 - weight) * bends[..., 0, :] + weight * bends[..., 1, :])


def _lengths(steps: Curves, low: Floats, high: Floats) -> Floats:
    """Length of each curve between two parameters; negative where ``low > high``."""
    t = low[..., None] + (high - low)[..., None] * (NODES + 1) / 2
    speed = np.sqrt(squared(_speeding(as_complex(steps)[..., None, :], t)))
    return np.asarray((speed * WEIGHTS).sum(-1) * (high - low) / 2)
