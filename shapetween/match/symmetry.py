"""Mirror symmetry of an outline: the places where its axes meet it."""

import math
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Points

__all__ = ["MOST_AXES", "Axes", "aligned_ends", "mirror_axes", "turns_onto"]

#: Deviation from its mirror image, a mean of squares, as a share of that about any line, up to
#: which an outline is symmetric, or meant to be but for a fold or a lock of hair. Larger takes a
#: lopsided thing for an even one; of nine corners at random one in ten has a tenth.
MOST_DEVIATION = 0.035

#: The same of an outline that has no axis by that, where the other is even to the eye, which is the
#: other figure: it is even but for a flame or a tuft on one side. Larger takes letters for even;
#: smaller tells a lamp from a lamp that burns.
NEARLY, TO_THE_EYE = 0.08, 0.003

#: Deviation up to which an outline is a disc, the mirror image of itself about any line through its
#: centre. Larger takes the corners off a polygon of ten sides; smaller gives a disc of four cubics
#: the axes that these have.
ROUND = 1e-4

#: How unevenly the axes' ends may lie round an outline, as a share of the even step, for its
#: sectors to be alike. More takes two axes that happen to be found for those of a regular shape.
UNEVEN = 0.1

#: Angle, radians, up to which two axes point the same way. Less, and things that lean are not told;
#: more, and what points up would come to point aside.
MOST_TURN = 0.6

#: Angle, radians, up to which two axes are drawn the same way; then no others that lean are tried.
#: Less, and what is drawn by hand is not; more, and things that lean are straightened up.
ALIGNED = 0.02

#: Axes of the outline that has fewer that are tried. Regular shapes have as many as corners, and
#: few of them are upright.
MOST_AXES = 4

#: Ends of an axis, from either of which it is given.
AXIS_ENDS = 2

#: Step to which the ends of an axis are rounded, as a share of the length. They come from small
#: differences of sums, with 1e-10 of noise. Larger, and mirror images are off by what can be seen;
#: smaller, and the noise decides how an outline is cut.
END_STEP = 2.0**-26


@dataclass(frozen=True, slots=True, eq=False)
class Axes:
    """Axes of mirror symmetry, each given once from either end.

    Attributes
    ----------
    ends : (K,) float64
        Fractions of the length where the axes meet the outline, increasing. The place as far before
        an end as another lies after it is the other's mirror image; the axis' other end is half-way
        round.
    directions : (K,) float64
        Angles of the way along the axis from the other end, radians.
    around : (N + 1,) float64 or None
        Of a disc, to which every line through its centre is an axis: the angles at which its
        samples lie, increasing over one turn. It has no other ends.
    deviations : (K,) float64, optional
        From its mirror image, as shares of that about any line; all even to the eye if left out.
    """

    ends: Floats
    directions: Floats
    around: Floats | None = None
    deviations: Floats | None = None

    @property
    def present(self) -> bool:
        """Whether there are any."""
        return self.around is not None or len(self.ends) > 0

    @property
    def even(self) -> bool:
        """Whether the outline is symmetric, or meant to be."""
        return self.around is not None or bool((self._deviations <= MOST_DEVIATION).any())

    def beside(self, other: "Axes") -> "Axes":
        """Those that count where the other outline has some axes."""
        to_the_eye = other.around is not None or (other._deviations <= TO_THE_EYE).any()
        most = NEARLY if to_the_eye and not self.even else MOST_DEVIATION
        kept = self._deviations <= most
        return Axes(self.ends[kept], self.directions[kept], self.around, self._deviations[kept])

    @property
    def _deviations(self) -> Floats:
        return np.zeros(len(self.ends)) if self.deviations is None else self.deviations

    def towards(self, directions: Floats) -> Floats:
        """Fractions of a disc's length in some directions."""
        assert self.around is not None
        turn = 2 * np.pi
        angle = self.around[0] + (directions - self.around[0]) % turn
        count = len(self.around) - 1
        places = np.interp(angle, self.around, np.arange(count + 1) / count)
        return np.asarray(np.round(places / END_STEP) * END_STEP % 1)


def mirror_axes(points: Points) -> Axes:
    """Axes of mirror symmetry of a closed outline.

    Parameters
    ----------
    points : (N, 2) float64
        Even steps of the length, clockwise as drawn, N even, centroid of the area at 0.

    Notes
    -----
    With points z as complex numbers, the mirror image about an axis of direction w is w^2 conj(z).
    Read backwards from place c it lies nearest z for w^2 along the sum of z[c - k] z[k] over k, and
    by as much as the sum's modulus falls short of the sum of |z|^2. All sums together are z's
    circular convolution with itself.
    """
    count = len(points)
    z = points @ [1, 1j]
    sums = np.fft.ifft(np.fft.fft(z) ** 2)
    deviation = 1 - np.abs(sums) / (np.abs(z) ** 2).sum()
    if deviation.max() < ROUND:
        around = np.unwrap(np.angle(np.append(z, z[0])))
        return Axes(np.zeros(0), np.zeros(0), around)
    before, after = np.roll(deviation, 1), np.roll(deviation, -1)
    twice = np.flatnonzero(
        (deviation < NEARLY * deviation.mean()) & (deviation <= before) & (deviation < after)
    )
    # The least deviation lies between samples: at the vertex of the parabola through three.
    bend = before[twice] - 2 * deviation[twice] + after[twice]
    between = (before[twice] - after[twice]) / (2 * bend)
    half = np.round((twice + between) / (2 * count) / END_STEP) * END_STEP % 0.5
    ends = np.concatenate([half, half + 0.5])
    order = np.argsort(ends)
    ends, own = ends[order], np.tile(deviation[twice] / deviation.mean(), 2)[order]
    places = np.append(z, z[:1])
    end, other = np.interp(np.stack([ends, ends + 0.5]) % 1 * count, np.arange(count + 1), places)
    # A tuft moves the ends; all of the outline says more.
    way = np.angle(sums[twice] + between * (sums[(twice + 1) % count] - sums[twice - 1]) / 2) / 2
    way = np.tile(way, 2)[order]
    return Axes(
        ends, np.where(np.cos(way - np.angle(end - other)) > 0, way, way + np.pi), None, own
    )


def aligned_ends(a: Axes, b: Axes, angle: float) -> list[Floats]:
    """Axes that point the same way once the first outline is turned by an angle.

    For every axis of the outline with fewer of them, with the other's nearest: the ends of all axes
    that both have in common when these two are one.

    Returns
    -------
    list of (2 g, 2) float64
        Rows a, b of the fractions of the ends that belong together, each increasing over one turn.
    """
    a, b = a.beside(b), b.beside(a)
    if a.around is not None and b.around is None and len(b.ends):
        return [np.column_stack(_over_one_turn(a.towards(b.directions - angle), b.ends))]
    if b.around is not None and a.around is None and len(a.ends):
        return [np.column_stack(_over_one_turn(a.ends, b.towards(a.directions + angle)))]
    turn = a.directions[:, None] + angle - b.directions
    turn = np.abs((turn + np.pi) % (2 * np.pi) - np.pi)
    rows, columns = len(a.ends), len(b.ends)
    if rows == 0 or columns == 0:
        return []
    if rows <= columns:
        first = np.arange(rows // 2)
        second = _nearest(turn[first])
    else:
        second = np.arange(columns // 2)
        first = _nearest(turn[:, second].T)
    common = math.gcd(rows, columns) if _regular(a) and _regular(b) else 2
    best = np.argsort(np.round(turn[first, second], 9), kind="stable")[:MOST_AXES]
    least = turn[first, second].min()
    most = ALIGNED if least < ALIGNED else MOST_TURN
    found: list[Floats] = []
    for i, j in zip(first[best].tolist(), second[best].tolist(), strict=True):
        if turn[i, j] >= most:
            continue
        step = np.arange(common)
        at = (i + step * (rows // common)) % rows, (j + step * (columns // common)) % columns
        ends = np.column_stack(_over_one_turn(a.ends[at[0]], b.ends[at[1]]))
        if not any(_same(ends, other) for other in found):
            found.append(ends)
    return found


def turns_onto(a: Axes, b: Axes) -> list[float]:
    """Angles that lay the axis of one outline onto the other's, where each has just one.

    Of several axes some always point nearly the same way.
    """
    a, b = a.beside(b), b.beside(a)
    if len(a.directions) != AXIS_ENDS or len(b.directions) != AXIS_ENDS:
        return []
    turns = b.directions - a.directions[0]
    return sorted(((turns + np.pi) % (2 * np.pi) - np.pi).tolist(), key=abs)


def _nearest(turn: Floats) -> Index:
    """Column of the least of each row, of equal ones the first; rounding has no say."""
    return np.asarray(np.round(turn, 9).argmin(axis=1))


def _regular(axes: Axes) -> bool:
    """Whether the sectors between the axes are alike."""
    count = len(axes.ends)
    gaps = np.diff(axes.ends, append=axes.ends[:1] + 1)
    return bool((np.abs(gaps * count - 1) < UNEVEN).all())


def _over_one_turn(first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Both from the least of the first on, increasing."""
    start = int(first.argmin())
    first, second = np.roll(first, -start), np.roll(second, -start)
    second = second[0] + (second - second[0]) % 1
    return first, second


def _same(first: Floats, second: Floats) -> bool:
    """Whether two sets of ends are one."""
    if len(first) != len(second):
        return False
    gap = first - second
    return bool((np.abs(gap - np.round(gap)) < 1e-9).all())
