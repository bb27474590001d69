"""Parting strands of moving outlines that cross on the way: only what touches is moved, and little.

From the last time at which the outlines are simple on, every place keeps to the side of its
neighbours that it was on, a step at a time, pushed as by contacts [MHHR07]_. What was pushed eases
back once the strands have passed.

.. [MHHR07] M. Mueller, B. Heidelberger, M. Hennix, J. Ratcliff, *Position based dynamics*, JVCIR
   18(2), 2007.
"""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index, Mask
from shapetween.deform.check import simple_frames
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.geometry.bezier import flatten
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.outline.body import Carried, Nodes
from shapetween.outline.pushing import pushed

__all__ = ["parted"]

#: Chords that a curve is looked at with. Fewer miss where curves between nodes touch; more cost
#: time with the square.
CHORDS = 4

#: Places on outlines past which nothing is parted: it would take seconds.
MOST_PLACES = 2000

#: Distance up to which places are neighbours that keep their sides, as a share of the drawing's
#: longer side. Smaller, and what moves fast passes through unseen; larger costs time.
REACH = 0.05

#: Depth from which on a place beyond a chord has not come through it, in the same unit. Smaller,
#: and what has crossed by much stays so; larger pushes places that are on no side of it.
DEEPEST = 0.025

#: Distance that strands keep, in the same unit: a pixel at 1000. Smaller, and they cross between
#: two times; larger moves more than was wrong.
CLEAR = 1e-3

#: The same as a share of the way between them along the outline, so that tips stay sharp, and the
#: least such way, as a share of the outline, of places that can be two strands.
SHARE_OF_WAY, LEAST_WAY = 0.1, 0.002

#: Sweeps of pushing at most at one time, and after how many the neighbours are found anew.
SWEEPS, FOUND_ANEW = 60, 10

#: Overrelaxation of a sweep. Larger oscillates; smaller takes more sweeps.
RELAXATION = 1.2

#: Least share of its own push that moves a place; shared with all it hangs on, some would move far.
LEAST_OWN = 0.2

#: What is left of a push a time later where nothing touches. More is still off long after; less
#: lets strands snap apart and back.
EASED = 0.9

#: Push that is none, as a share of the drawing's longer side.
NO_PUSH = 1e-5

#: Passes of (1, 2, 1) / 4 over the pushes in time, the smoothest that stays simple. Fewer show as a
#: jolt.
SMOOTHINGS = (8, 2)


@dataclass(frozen=True, slots=True, eq=False)
class _Places:
    """Places on the drawn outlines, each between two nodes.

    Attributes
    ----------
    following : (S,) intp
        The next place of the same ring.
    before, after : (S,) intp
        Nodes on both sides.
    share : (S,) float64
        How far from the one to the other it is.
    ring : (S,) intp
    along : (S,) float64
        Way from the ring's start to it.
    around : (S,) float64
        Length of its ring.
    """

    following: Index
    before: Index
    after: Index
    share: Floats
    ring: Index
    along: Floats
    around: Floats

    def moved(self, pushes: Complex) -> Complex:
        """How far all places move with the pushes of the nodes, (S,)."""
        return np.asarray((1 - self.share) * pushes[self.before] + self.share * pushes[self.after])

    def weights(self, at: Index) -> tuple[Index, Floats]:
        """Nodes that some places hang on, and by how much, (2, P) each."""
        share = self.share[at]
        return np.stack([self.before[at], self.after[at]]), np.stack([1 - share, share])


def parted(body: Carried) -> Carried | None:
    """The body with its strands parted where they cross; None if it cannot be done.

    Parameters
    ----------
    body : Carried
        Its outlines are simple at both ends.
    """
    motion, nodes = body.path, body.nodes
    if not isinstance(motion, KeyedMotion) or CHORDS * sum(body.counts) > MOST_PLACES:
        return None
    t = np.linspace(0, 1, CHECKED_TIMES)
    vertices = motion.vertices(t)
    simple = nodes.simple(t, vertices)
    simple[[0, -1]] = True  # the drawings themselves, whatever they do
    if simple.all():
        return None
    curves = nodes.curves(vertices, t)
    shown = np.stack([as_complex(flatten(frame, CHORDS)) for frame in curves])
    lengths = np.abs(np.diff(shown[[0, -1]])).sum(axis=1)
    backwards = bool(lengths[0] > lengths[1])  # so that the way back is the same
    step = -1 if backwards else 1
    places = _places(nodes, body.counts, shown)
    found = _pushes(shown[::step], ~simple[::step], places, len(nodes.ends[0]))
    if found is None:
        return None
    pushes = found[::step]
    for smoothing in SMOOTHINGS:
        smooth = pushes.copy()
        for _ in range(smoothing):
            smooth[1:-1] = (smooth[:-2] + 2 * smooth[1:-1] + smooth[2:]) / 4
        moved = pushed(body, motion, smooth)
        if not moved.crossing:
            return replace(moved, parted=True)
    return None


def _places(nodes: Nodes, counts: tuple[int, ...], shown: Complex) -> _Places:
    """The places that are shown, (F, S), ring after ring."""
    found = []
    first = 0
    for k, (count, part) in enumerate(zip(counts, nodes.parts, strict=True)):
        ring = shown[:, first : first + CHORDS * count]
        ways = np.abs(np.roll(ring, -1, axis=1) - ring).mean(axis=0)
        along = np.cumsum(ways) - ways
        # Every node is where a curve starts; holes run the other way.
        own = as_complex(nodes.ends[0][part])
        at = CHORDS * np.abs(ring[0, ::CHORDS] - own[:, None]).argmin(axis=1)
        order = np.argsort(at, kind="stable")
        around = float(ways.sum())
        stops = np.append(along[at[order]], along[at[order[0]]] + around)
        unrolled = np.where(along < stops[0], along + around, along)
        span = np.searchsorted(stops, unrolled, side="right") - 1
        span = np.minimum(span, len(order) - 1)
        every = np.arange(ring.shape[1])
        found.append(
            (
                first + (every + 1) % len(every),
                part.start + order[span],
                part.start + order[(span + 1) % len(order)],
                (unrolled - stops[span]) / (stops[span + 1] - stops[span]),
                np.full(len(every), k),
                along,
                np.full(len(every), around),
            )
        )
        first += ring.shape[1]
    return _Places(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _pushes(shown: Complex, crossing: Mask, places: _Places, nodes: int) -> Complex | None:
    """How far each node is to move at every time, (F, N), nothing at both ends.

    None where strands stay crossed however they are pushed; what comes after would be for nothing.
    """
    found = np.zeros((len(shown), nodes), dtype=np.complex128)
    size = max(float(np.ptp(shown.real[0])), float(np.ptp(shown.imag[0])))
    bad = np.flatnonzero(crossing)
    sizes = tuple(np.bincount(places.ring).tolist())
    valid, push = shown[bad[0] - 1], found[0]
    for k in range(int(bad[0]), len(shown) - 1):
        if k > bad[-1] and np.abs(push).max() < NO_PUSH * size:
            break
        push = _without_contacts(shown[k], EASED * push, valid, places, size)
        found[k], valid = push, shown[k] + places.moved(push)
        if not simple_frames(as_points(valid)[None], sizes).all():
            return None
    return found


def _without_contacts(
    shown: Complex, push: Complex, valid: Complex, places: _Places, size: float
) -> Complex:
    """The nodes pushed until every place is on the side that it was on a time before."""
    for sweep in range(SWEEPS):
        here = shown + places.moved(push)
        if sweep % FOUND_ANEW == 0:
            pairs = _neighbours(here, valid, places, size)
        step = _step(here, pairs, places, len(push))
        if step is None:
            break
        push = push + RELAXATION * step
    return push


@dataclass(frozen=True, slots=True, eq=False)
class _Pairs:
    """Places and chords near them: which, on which side, and how far they are to stay away.

    What lacks more than the deepest does not touch.
    """

    place: Index
    chord: Index
    side: Floats
    clear: Floats
    deepest: float


def _neighbours(here: Complex, valid: Complex, places: _Places, size: float) -> _Pairs:
    end = places.following
    middle, half = (here[end] + here) / 2, np.abs(here[end] - here) / 2
    place, chord = np.nonzero(np.abs(here[:, None] - middle) < REACH * size + half)
    same = places.ring[place] == places.ring[chord]
    ways = [np.abs(places.along[place] - places.along[at]) for at in (chord, end[chord])]
    around = places.around[place]
    way = np.minimum.reduce([*ways, *(around - way for way in ways)])
    apart = ~same | (way > LEAST_WAY * around)
    place, chord, way, same = place[apart], chord[apart], way[apart], same[apart]
    along = valid[end[chord]] - valid[chord]
    side = np.sign((along.conj() * (valid[place] - valid[chord])).imag)
    clear = np.where(same, np.minimum(SHARE_OF_WAY * way, CLEAR * size), CLEAR * size)
    return _Pairs(place, chord, side, clear, DEEPEST * size)


def _step(here: Complex, pairs: _Pairs, places: _Places, nodes: int) -> Complex | None:
    """One sweep's mean push of each node; None where nothing touches."""
    end = places.following[pairs.chord]
    along = here[end] - here[pairs.chord]
    length = np.maximum(np.abs(along), np.finfo(float).tiny)
    offset = here[pairs.place] - here[pairs.chord]
    share = (along.conj() * offset).real / length**2
    lack = pairs.clear - pairs.side * (along.conj() * offset).imag / length
    # What is far beyond a chord has come round its end, not through it.
    touching = (share >= 0) & (share <= 1) & (lack > 0) & (lack < pairs.deepest)
    if not touching.any():
        return None
    share, lack = share[touching], lack[touching]
    normal = 1j * along[touching] / length[touching] * pairs.side[touching]
    which, weight = (
        np.concatenate(part)
        for part in zip(
            *(
                (nodes_, factor * weights)
                for at, factor in (
                    (pairs.place[touching], np.ones_like(share)),
                    (pairs.chord[touching], share - 1),
                    (end[touching], -share),
                )
                for nodes_, weights in [places.weights(at)]
            ),
            strict=True,
        )
    )
    own = np.maximum((weight**2).sum(axis=0), LEAST_OWN)
    moves = (weight * (lack / own * normal)).ravel()
    at = which.ravel()
    number = np.maximum(np.bincount(at, np.abs(weight.ravel()) > 0, nodes), 1)
    sums = [np.bincount(at, part, nodes) for part in (moves.real, moves.imag)]
    return np.asarray((sums[0] + 1j * sums[1]) / number)
