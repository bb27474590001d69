"""Open lines that become others by turning along their length, as a spring unrolls.

Where a line lies on nothing that moves, or turns far from it, going straight from place to place
would crush it. Here directions and lengths change evenly along the line instead, as in [SGWM93]_,
and the line is put together from them.

.. [SGWM93] T. Sederberg, P. Gao, G. Wang, H. Mu, *2-D shape blending: an intrinsic solution to the
   vertex path problem*, SIGGRAPH 1993.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.attach.nearby import Parts, cut_alike, cut_open
from shapetween.base.arrays import Complex, Curves, Floats
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline

__all__ = ["Turns", "matched_along", "overturned"]

#: Turn, in radians, past which a part of a line that goes straight loses a third of its length;
#: and share of the line that may turn so far.
FAR, MUCH = np.pi / 2, 0.1

#: Stations two lines are compared at, and places where a ring is cut open to be compared.
STATIONS, CUTS = 64, 32

#: What turning the whole costs beside turning one part against the next, and what lying apart does,
#: as a share of the size.
WHOLE, APART = 0.1, 1.0


#: How much larger than drawn a line may get as it unrolls. Larger, and it leaves the picture;
#: smaller, and it shrinks.
WIDER = 1.1


@dataclass(frozen=True, slots=True, eq=False)
class Turns:
    """By how much each part of a line turns on its way to another line.

    Attributes
    ----------
    angles : (P, 3) float64
        Of the direction in which each curve leaves, its chord's, and that in which it arrives;
        radians, continuous along the line.
    """

    angles: Floats

    @classmethod
    def of(cls, source: Curves, target: Curves) -> "Turns":
        """The turns between the parts (P, 4, 2) of two lines, least as a whole."""
        start, end = _ways(source), _ways(target)
        angles = np.unwrap(np.angle(end * np.conj(start)).ravel()).reshape(start.shape)
        weights = np.abs(start) + np.abs(end)
        middle = float((angles * weights).sum() / weights.sum())
        return cls(angles - 2 * np.pi * round(middle / (2 * np.pi)))

    def between(self, start: Curves, end: Curves, share: Floats) -> Curves:
        """Curves so far on the way from some (F, P, 4, 2) to others, (F, P, 4, 2).

        Parameters
        ----------
        start, end : (F, P, 4, 2) float64
            The two lines, each as it is at these times.
        share : (F,) float64
        """
        one, other = _ways(start), _ways(end)
        part = share[:, None, None]
        turns = self.angles + np.angle(other * np.conj(one) * np.exp(-1j * self.angles))
        unit = one / np.where(np.abs(one) > 0, np.abs(one), 1.0)
        sizes = np.abs(_steps(start)), np.abs(_steps(end))
        ways = unit * np.exp(1j * part * turns) * ((1 - part) * sizes[0] + part * sizes[1])
        last = np.cumsum(ways[..., 1], axis=1)
        first = last - ways[..., 1]
        curves = np.stack([first, first + ways[..., 0], last - ways[..., 2], last], axis=-1)
        return _within(as_points(curves), start, end, share)


def _steps(curves: Curves) -> Complex:
    """From start to first handle, from start to end, and from last handle to end, (..., P, 3)."""
    points = as_complex(curves)
    return np.asarray(points[..., [1, 3, 3]] - points[..., [0, 0, 2]])


def _ways(curves: Curves) -> Complex:
    """The same steps, with those of no length along the chord; what has no chord goes right."""
    steps = _steps(curves)
    chords = np.where(steps[..., 1:2] == 0, 1.0, steps[..., 1:2])
    return np.where(steps == 0, chords, steps)


def _within(curves: Curves, start: Curves, end: Curves, share: Floats) -> Curves:
    """Curves moved to the middle between where two others are, and no more than a little larger."""
    boxes = [
        np.stack([c.min(axis=(1, 2)), c.max(axis=(1, 2))], axis=1) for c in (curves, start, end)
    ]
    middles = [box.mean(axis=1)[:, None, None] for box in boxes]
    sizes = [np.linalg.norm(box[:, 1] - box[:, 0], axis=1) for box in boxes]
    part = share[:, None, None, None]
    allowed = WIDER * ((1 - share) * sizes[1] + share * sizes[2])
    scale = np.minimum(1.0, allowed / np.where(sizes[0] > 0, sizes[0], 1.0))[:, None, None, None]
    centre = (1 - part) * middles[1] + part * middles[2]
    return np.asarray(centre + scale * (curves - middles[0]))


def overturned(source: Curves, target: Curves) -> bool:
    """Whether much of a line turns so far on its way to another that going straight crushes it."""
    turns = np.abs(Turns.of(source, target).angles[:, 1])
    lengths = np.linalg.norm(source[:, 3] - source[:, 0], axis=1)
    lengths = lengths + np.linalg.norm(target[:, 3] - target[:, 0], axis=1)
    return float(lengths[turns > FAR].sum()) > MUCH * float(lengths.sum())


def matched_along(source: Outline, target: Outline) -> Parts:
    """Two lines, one of them open at least, matched evenly along their lengths.

    Which end becomes which, and where a ring is cut open, are chosen so that parts turn least
    against each other.
    """
    places = ArcLength(source), ArcLength(target)
    loop = next((k for k in (0, 1) if places[k].outline.closed), None)
    along = (np.arange(STATIONS) + 0.5) / STATIONS
    best: tuple[float, float, bool] | None = None
    for cut in np.arange(CUTS) / CUTS if loop is not None else np.zeros(1):
        for back in (False, True):
            sides = []
            for k, place in enumerate(places):
                at = along[::-1] if back and k else along
                shifted = at + cut if k == loop else at
                ahead = as_complex(place.tangent(shifted))
                sides.append((-ahead if back and k else ahead, as_complex(place.point(shifted))))
            cost = _cost(*sides)
            if best is None or cost < best[0]:
                best = cost, float(cut), back
    assert best is not None
    _, cut, back = best
    if loop is not None:
        opened = ArcLength(cut_open(places[loop], cut))
        places = (opened, places[1]) if loop == 0 else (places[0], opened)
    if back:
        places = places[0], ArcLength(places[1].outline.reversed())
    ends = np.array([0.0, 1.0])
    return cut_alike(places, ends, ends)


def _cost(first: tuple[Complex, Complex], second: tuple[Complex, Complex]) -> float:
    """How much the parts of two lines, given by directions and places (N,), turn and move."""
    angles = np.unwrap(np.angle(second[0] * np.conj(first[0])))
    bending = float(np.abs(np.diff(angles)).sum())
    whole = abs(float(angles.mean() - 2 * np.pi * round(float(angles.mean()) / (2 * np.pi))))
    size = max(float(np.abs(p - p.mean()).max()) for _, p in (first, second)) or 1.0
    away = float(np.abs(first[1] - second[1]).mean()) / size
    return bending + WHOLE * whole + APART * away
