"""What a limb without a partner becomes: the place that it stands on, and not the way round it.

A matching tells which limbs belong together. Between those, length goes to length, so that the long
way round a spine becomes a long stretch of a straight side: the spine widens to a tooth while it
goes. Here stretches are shared out anew by how far on each gets without its detail: next to nothing
along the sides of a spine, which so withdraws into its own root.
"""

import numpy as np

from shapetween.base.arrays import Complex, Floats
from shapetween.geometry.circlemap import turn
from shapetween.geometry.linearmaps import as_complex
from shapetween.model.arclength import ArcLength
from shapetween.outline.matched import kinks_of
from shapetween.outline.scales import PLACES, at_scale, smoothed, way

__all__ = ["settled"]

#: Scale of what is taken for detail, as a share of the outline. Smaller leaves long spines to
#: widen; larger takes legs for detail.
SCALE = 0.02

#: Scale of the ground that limbs stand on, and over what progress is told, shares of the outline.
#: Ground of a smaller scale climbs limbs; one of a larger cuts across bends, which then are drawn
#: together; told more closely, progress leaps at every corner.
GROUND, SMOOTH = 0.05, 0.004

#: In how many scales' reach stretches are shared out. Less, and long spines widen; more moves what
#: lies beside them away from its like.
REACH = 2.0

#: Least progress, as a share of the mean. Less, and all of a limb becomes one point, which no mesh
#: takes well; more widens it.
LEAST = 0.1

#: Least step between two places, as a share of an even one.
LEAST_STEP = 1e-3

#: How far a place may move, in the common parameter, which says more than lengths: where one of the
#: outlines goes far the other hardly moves. Farther, and limbs leave what they were matched with;
#: less, and long spines widen.
FARTHEST = 0.015

#: Detail, in roots of the area, that has a tip, the share of it from which on the other outline has
#: nothing like it, and how far apart tips are, as a share of the outline. A tip stays with what it
#: was matched with. More of either, and tips wander; less, and every notch beside a limb holds to
#: its place, which then widens. Nearer, and roots of limbs count as tips.
TIP, OWN, APART = 0.02, 0.5, 0.06

#: Turn of a corner, radians, from which on the place matched with it stays. More cuts corners off;
#: less holds on to every bend of a hand-drawn line.
CORNER = 0.4


def settled(source: ArcLength, target: ArcLength, u: Floats, v: Floats) -> tuple[Floats, Floats]:
    """A matching with detail on the one outline alone drawn together on the other.

    Parameters
    ----------
    source, target : ArcLength
    u, v : (K,) float64
        Matched fractions of the lengths, strictly increasing over one turn.

    Returns
    -------
    u, v : (M,) float64
        Corners, and tips of limbs, are matched with what they were.
    """
    knots = (u - u[0] + v - v[0]) / 2
    even = np.arange(PLACES + 1) / PLACES
    at = np.interp(even, knots, u), np.interp(even, knots, v)
    points = [
        as_complex(side.point(turn(places[:-1]))) / np.sqrt(abs(side.outline.area))
        for side, places in zip((source, target), at, strict=True)
    ]
    plain, shares = at_scale((points[0], points[1]), SCALE)
    tips = [_tips(*side) for side in zip(points, plain, shares, strict=True)]
    progress = [_progress(z) for z in points]
    first = _shared_out(at[0], shares[1], progress[1])
    second = _shared_out(at[1], shares[0], progress[0])
    stay = [_corners(side, places) for side, places in zip((source, target), at, strict=True)]
    return (
        _held(at[0], first, np.union1d(stay[0], tips[1])),
        _held(at[1], second, np.union1d(stay[1], tips[0])),
    )


def _progress(points: Complex) -> Floats:
    """By how much each step gets on along the ground, (PLACES,)."""
    steps, ground = way(points), way(smoothed(points, GROUND))
    size = np.abs(ground)
    along = (steps * ground.conj()).real / np.where(size > 0, size, 1.0)
    return np.asarray(np.maximum(smoothed(along, SMOOTH).real, LEAST * np.abs(steps).mean()))


def _tips(points: Complex, plain: Complex, share: Floats) -> Floats:
    """Where, in steps, detail that the other has nothing like reaches farthest, increasing."""
    along = way(plain)
    size = np.abs(along)
    away = np.abs(((points - plain) * along.conj()).imag) / np.where(size > 0, size, 1.0)
    near = int(APART * len(points))
    beside = np.concatenate([away[-near:], away, away[:near]])
    around = np.lib.stride_tricks.sliding_window_view(beside, 2 * near + 1).max(axis=1)
    at = np.flatnonzero((away == around) & (away > TIP) & (share > OWN))
    before, after = away[at - 1], away[(at + 1) % len(points)]
    bend = before - 2 * away[at] + after
    between = (before - after) / np.where(bend < 0, 2 * bend, np.inf)
    return np.asarray(np.sort((at + between) % len(points)))


def _shared_out(at: Floats, share: Floats, progress: Floats) -> Floats:
    """Steps of one outline, (PLACES,), where the other has detail by that one's progress."""
    steps = np.diff(at)
    room = share * progress
    reach = smoothed(room, REACH * SCALE).real
    given = smoothed(share * steps / np.maximum(reach, np.finfo(float).tiny), REACH * SCALE).real
    return np.maximum((1 - share) * steps + room * given, LEAST_STEP / PLACES)


def _corners(side: ArcLength, at: Floats) -> Floats:
    """Where, in steps, the corners of an outline lie among places of it, increasing."""
    corners = side.joints[np.abs(kinks_of(side)) > CORNER]
    corners = np.sort(at[0] + turn(corners - at[0]))
    return np.asarray(np.interp(corners, at, np.arange(len(at))))


def _held(at: Floats, steps: Floats, corners: Floats) -> Floats:
    """Places after new steps, (PLACES + 1,), those between two corners together as before."""
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    if len(corners):
        index = np.arange(len(at))
        known, held = np.interp(corners, index, walked), np.interp(corners, index, at)
        known = np.concatenate([known[-1:] - walked[-1], known, known[:1] + walked[-1]])
        held = np.concatenate([held[-1:] - 1, held, held[:1] + 1])
        places = np.interp(walked, known, held)
    else:
        places = walked / walked[-1]
        places = places + (at - places).mean()
    even = np.arange(len(at)) / (len(at) - 1)
    around = np.concatenate([even[:-1] - 1, even, even[1:] + 1])
    there = np.concatenate([at[:-1] - 1, at, at[1:] + 1])
    moved = np.interp(places, there, around) - even
    places = np.interp(even + FARTHEST * np.tanh(moved / FARTHEST), around, there)
    places[-1] = places[0] + 1
    return np.asarray(places)
