"""Where points lie beside a line: how far along it, how far off, round which corner or end.

The contour of a stroke, what its outline follows, is counted through in zones of length one. Those
of an open line of N curves are, clockwise as drawn: the left walls of its curves and the joins
between them, the cap at its end, the right walls and joins back to the start, the cap there; 4 N in
all. A closed line has two contours, left walls and joins forward and right ones backward, 2 N each.
Left and right are as seen along the line with y down.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points, row_sums
from shapetween.geometry.bezier import derivatives, end_tangents, evaluate
from shapetween.geometry.polygon import cross

__all__ = ["CAP", "JOIN", "SMOOTH", "WALL", "Places", "StrokeFrame", "Zones"]

#: Kinds of zones.
WALL, JOIN, CAP = 0, 1, 2

#: Chords of a curve that nearest places are looked for on, before they are refined.
CHORDS = 16

#: Turn, radians, below which a joint is smooth and has no join of its own.
SMOOTH = np.deg2rad(2.0)

#: Greatest turn that inner corners follow exactly; sharper ones would run out along the line.
SHARPEST = np.deg2rad(120.0)

#: Least share of its length that is left of a curve's inner wall between two corners.
LEAST_WALL = 0.1


@dataclass(frozen=True, slots=True)
class Zones:
    """How the zones of a contour are counted.

    Attributes
    ----------
    count : int
        Curves of the line.
    closed : bool
    """

    count: int
    closed: bool

    @property
    def total(self) -> int:
        """Zones of one contour."""
        return 2 * self.count if self.closed else 4 * self.count

    def wall(self, curve: Index, side: Index) -> Index:
        """Zone of a curve's wall, on the left (-1) or right (1) side."""
        back = 2 * (self.count - 1 - curve) + (0 if self.closed else 2 * self.count)
        return np.where(side < 0, 2 * curve, back)

    def join(self, node: Index, side: Index) -> Index:
        """Zone of the join before a curve."""
        ahead = (2 * node - 1) % (2 * self.count)
        back = 2 * (self.count - 1 - node) + 1 + (0 if self.closed else 2 * self.count)
        return np.where(side < 0, ahead, back)

    def of(self, zone: int, side: int = -1) -> tuple[int, int, int]:
        """Kind of a zone; its curve, or for a join the curve after it; and its side.

        A cap's side is 1 at the line's end, -1 at its start.

        Parameters
        ----------
        zone : int
        side : {-1, 1}
            Of a closed line's contour.
        """
        n = self.count
        if not self.closed:
            if zone in (2 * n - 1, 4 * n - 1):
                return (CAP, n - 1, 1) if zone == 2 * n - 1 else (CAP, 0, -1)
            side = -1 if zone < 2 * n else 1
            zone -= 0 if side < 0 else 2 * n
        if side < 0:
            return (WALL, zone // 2, side) if zone % 2 == 0 else (JOIN, (zone + 1) // 2 % n, side)
        return (WALL, n - 1 - zone // 2, side) if zone % 2 == 0 else (JOIN, n - 1 - zone // 2, side)


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """Points beside a line.

    Attributes
    ----------
    contour : (M,) float64
        Place on the contour: its zone and how far in it.
    side : (M,) intp
        Which side of the line, -1 or 1.
    """

    contour: Floats
    side: Index


@dataclass(frozen=True, eq=False)
class StrokeFrame:
    """Directions along a line at one time or at several.

    Attributes
    ----------
    curves : (..., N, 4, 2) float64
    closed : bool
    """

    curves: Curves
    closed: bool

    @property
    def zones(self) -> Zones:
        """How its contour is counted."""
        return Zones(self.curves.shape[-3], self.closed)

    @cached_property
    def turns(self) -> Floats:
        """Turn before each curve, radians, (..., N); 0 at an open line's start."""
        leaving, reaching = end_tangents(self.curves)
        before = np.roll(reaching, 1, axis=-2)
        turn = np.arctan2(cross(before, leaving), (before * leaving).sum(-1))
        if not self.closed:
            turn[..., 0] = 0.0
        return np.asarray(turn)

    @cached_property
    def lengths(self) -> Floats:
        """Length of each curve, roughly, (..., N)."""
        points = evaluate(self.curves, np.linspace(0, 1, CHORDS + 1))
        return np.asarray(np.linalg.norm(np.diff(points, axis=-2), axis=-1).sum(-1))

    def shears(self, side: Floats) -> tuple[Floats, Floats]:
        """How far walls reach beyond their curves' ends per distance off the line, (..., N) each.

        They are tangents of half the turns, on the inner side of corners, and 0 on the outer.
        """
        turn = self.turns
        after = np.roll(turn, -1, axis=-1)

        def shear(angle: Floats) -> Floats:
            inner = (angle * side > 0) & (np.abs(angle) > SMOOTH)
            return np.where(inner, np.tan(np.clip(angle, -SHARPEST, SHARPEST) / 2), 0.0)

        return shear(turn), -shear(after)

    def frames(self, curve: Index, t: Floats) -> tuple[Points, Points, Points, Floats, Floats]:
        """Points, unit tangents, normals, speed and curvature at parameters of curves.

        Parameters
        ----------
        curve : (M,) intp
        t : (..., M) float64

        Returns
        -------
        points, tangents, normals : (..., M, 2) float64
            A normal points to the right as seen along the line with y down.
        speed, curvature : (..., M) float64
        """
        own = self.curves[..., curve, :, :]
        at = np.broadcast_to(np.asarray(t), own.shape[:-2])[..., None]
        points = evaluate(own, at)[..., 0, :]
        velocity = derivatives(own, at)[..., 0, :]
        leaving, reaching = end_tangents(own)
        speed = np.hypot(velocity[..., 0], velocity[..., 1])
        size = np.abs(np.diff(own, axis=-2)).max(axis=(-2, -1))
        still = speed <= 1e-9 * size
        ends = np.where((at < 0.5), leaving, reaching)
        tangent = np.where(
            still[..., None], ends, velocity / np.where(still, 1.0, speed)[..., None]
        )
        second = 6 * (
            (1 - at) * (own[..., 2, :] - 2 * own[..., 1, :] + own[..., 0, :])
            + at * (own[..., 3, :] - 2 * own[..., 2, :] + own[..., 1, :])
        )
        bend = cross(velocity, second) / np.where(still, np.inf, speed) ** 3
        normal = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
        return points, tangent, normal, speed, bend

    def locate(self, points: Points) -> Places:
        """Where points (M, 2) lie on the contour of a line at one time."""
        zones = self.zones
        curve, t = self._nearest(points)
        foot, tangent, normal, _, _ = self.frames(curve, t)
        off = points - foot
        along, aside = (off * tangent).sum(-1), (off * normal).sum(-1)
        side = np.where(aside < 0, -1, 1)
        n = zones.count
        turn = self.turns
        # The node at which the foot stands still, and whether it is a corner seen from outside.
        at_start, at_end = t <= 0.0, t >= 1.0
        node = np.where(at_end, (curve + 1) % n, curve)
        ends_here = (not self.closed) & ((at_end & (curve == n - 1)) | (at_start & (curve == 0)))
        outside = (at_start | at_end) & ~ends_here & (np.abs(turn[node]) > SMOOTH)
        side = np.where(outside, -np.sign(turn[node]).astype(np.intp), side)
        wall = self._on_wall(curve, side, t, aside)
        contour = zones.wall(curve, side) + np.where(side < 0, wall, 1 - wall)
        if outside.any():
            share = self._turned(node, off)
            joins = zones.join(node, side) + np.where(side < 0, share, 1 - share)
            contour = np.where(outside, joins, contour)
        tail = ends_here & at_end & (along >= 0)
        head = ends_here & at_start & (along <= 0)
        angle = np.arctan2(aside, np.abs(along)) / np.pi
        contour = np.where(tail, 2 * n - 1 + angle + 0.5, contour)
        contour = np.where(head, 4 * n - 1 + 0.5 - angle, contour)
        return Places(np.asarray(contour, dtype=np.float64), side.astype(np.intp))

    def beside(self, points: Points, curve: Index, side: Index) -> tuple[Floats, Floats]:
        """Places of points (M, 2) on given curves' walls, and their distances off the line."""
        t = np.linspace(0.0, 1.0, CHORDS + 1)
        away = evaluate(self.curves[curve], t) - points[:, None]
        s = t[np.argmin((away**2).sum(-1), axis=1)]
        s = self._closer(curve, s, points)
        foot, _, normal, _, _ = self.frames(curve, s)
        aside = ((points - foot) * normal).sum(-1)
        return self._on_wall(curve, side, s, aside), np.asarray(aside)

    def _on_wall(self, curve: Index, side: Index, t: Floats, aside: Floats) -> Floats:
        """Places between the mitre lines of corners, from feet on the line."""
        start, end = self._sheared(side, curve)
        length = np.maximum(self.lengths[curve], 1e-300)
        span = np.maximum(length + aside * (end - start), LEAST_WALL * length)
        return np.asarray(np.clip((t * length - aside * start) / span, 0.0, 1.0))

    def _closer(self, curve: Index, t: Floats, points: Points) -> Floats:
        """Parameters nearest to points, by Newton's steps from near ones."""
        own = self.curves[curve]
        for _ in range(3):
            off = evaluate(own, t[:, None])[:, 0] - points
            velocity = derivatives(own, t[:, None])[:, 0]
            size = (velocity**2).sum(-1)
            t = np.clip(t - (off * velocity).sum(-1) / np.where(size > 0, size, 1.0), 0.0, 1.0)
        return np.asarray(np.where(t < 1e-7, 0.0, np.where(t > 1 - 1e-7, 1.0, t)))

    def _sheared(self, side: Index, curve: Index) -> tuple[Floats, Floats]:
        """Shears at both ends of the curves that points on one side or the other belong to."""
        left, right = self._both_shears
        return (
            np.where(side < 0, left[0][curve], right[0][curve]),
            np.where(side < 0, left[1][curve], right[1][curve]),
        )

    @cached_property
    def _both_shears(self) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
        """Shears on either side."""
        n = self.zones.count
        return self.shears(np.full(n, -1.0)), self.shears(np.full(n, 1.0))

    def _turned(self, node: Index, off: Points) -> Floats:
        """Share of the turn at a corner that a direction away from it has been through."""
        before = np.roll(end_tangents(self.curves)[1], 1, axis=0)[node]
        turn = self.turns[node]
        outward = np.stack([-before[:, 1], before[:, 0]], axis=-1) * -np.sign(turn)[:, None]
        angle = np.arctan2(cross(outward, off), (outward * off).sum(-1))
        return np.asarray(np.clip(angle / np.where(turn == 0, 1.0, turn), 0.0, 1.0))

    def _nearest(self, points: Points) -> tuple[Index, Floats]:
        """Curve and parameter nearest to each point."""
        t = np.arange(CHORDS) / CHORDS
        chords = evaluate(self.curves, t)
        ends = np.concatenate([chords[:, 1:], self.curves[:, 3:]], axis=1)
        start, step = chords.reshape(-1, 2), (ends - chords).reshape(-1, 2)
        size = row_sums(step**2)
        x, y = (points[:, None, k] - start[:, k] for k in (0, 1))
        part = x * step[:, 0] + y * step[:, 1]
        part = np.clip(part / np.where(size > 0, size, 1.0), 0.0, 1.0)
        x, y = x - part * step[:, 0], y - part * step[:, 1]
        distance = x**2 + y**2
        # Of places equally near, as at the two sides of a joint, the first.
        least = distance.min(axis=1, keepdims=True)
        scale = float(np.ptp(self.curves.reshape(-1, 2), axis=0).max()) ** 2
        best = np.argmax(distance <= least + 1e-12 * scale, axis=1)
        curve = best // CHORDS
        s = (best % CHORDS + part[np.arange(len(points)), best]) / CHORDS
        return curve.astype(np.intp), self._closer(curve, s, points)
