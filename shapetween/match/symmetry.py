"""Mirror symmetry of an outline: the places where its axes meet it."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points

__all__ = ["Axes", "aligned_axes", "mirror_axes"]

#: Deviation from its mirror image, a mean of squares, up to which an outline is symmetric. Drawings
#: meant to be stay below half of it; those that only look alike on both sides lie far above it.
MOST_DEVIATION = 1e-3

#: Angle, radians, up to which two axes point the same way. Less, and things that lean are not told;
#: more, and what points up would come to point aside.
MOST_TURN = 0.6

#: Axes of the outline that has fewer that are tried. Regular shapes have as many as corners, and
#: few of them are upright.
MOST_AXES = 4

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
        Fractions of the length where the axes meet the outline. The place as far before an end as
        another lies after it is the other's mirror image; the axis' other end is half-way round.
    directions : (K,) float64
        Angles of the way along the axis from the other end, radians.
    """

    ends: Floats
    directions: Floats


def mirror_axes(points: Points) -> Axes:
    """Axes of mirror symmetry of a closed outline.

    Parameters
    ----------
    points : (N, 2) float64
        Even steps of the length, N even, centroid of the area at 0.

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
    before, after = np.roll(deviation, 1), np.roll(deviation, -1)
    twice = np.flatnonzero(
        (deviation < MOST_DEVIATION) & (deviation <= before) & (deviation < after)
    )
    # The least deviation lies between samples: at the vertex of the parabola through three.
    bend = before[twice] - 2 * deviation[twice] + after[twice]
    between = (before[twice] - after[twice]) / (2 * bend)
    half = np.round((twice + between) / (2 * count) / END_STEP) * END_STEP
    ends = np.concatenate([half, half + 0.5])
    places = np.append(z, z[:1])
    end, other = np.interp(np.stack([ends, ends + 0.5]) % 1 * count, np.arange(count + 1), places)
    return Axes(ends % 1, np.angle(end - other))


def aligned_axes(a: Axes, b: Axes, angle: float) -> list[Floats]:
    """Pairs of axes that point the same way once the first outline is turned by an angle.

    Every axis of the outline with fewer of them, with the other's nearest.

    Returns
    -------
    list of (2, 2) float64
        Rows a, b of the fractions of the axes' ends that belong together, a increasing.
    """
    turn = a.directions[:, None] + angle - b.directions
    turn = np.abs((turn + np.pi) % (2 * np.pi) - np.pi)
    rows, columns = len(a.ends), len(b.ends)
    if rows == 0 or columns == 0:
        return []
    if rows <= columns:
        first = np.arange(rows // 2)
        second = turn[first].argmin(axis=1)
    else:
        second = np.arange(columns // 2)
        first = turn[:, second].argmin(axis=0)
    nearest = np.argsort(turn[first, second], kind="stable")[:MOST_AXES]
    pairs = []
    for i, j in zip(first[nearest], second[nearest], strict=True):
        if turn[i, j] < MOST_TURN:
            ends = np.array([[a.ends[i], b.ends[j]], [a.ends[i] + 0.5, b.ends[j] + 0.5]]) % 1
            pairs.append(ends[np.argsort(ends[:, 0])])
    return pairs
