"""Fairing: nodes follow the mesh in the large, and what lies between both outlines in the small.

Every quad moves in its own way, so what is straight or round at both ends gets waves from quad to
quad, and a silhouette's outline is all that is seen of it. Below a scale the outlines themselves
say better where to go: every step along them is the mean of both ends' steps, each turned as what
surrounds it is turned [XZWB05]_. Above that scale the mesh says where to go, as it keeps limbs
long and apart.

.. [XZWB05] D. Xu, H. Zhang, Q. Wang, H. Bao, *Poisson shape interpolation*, SPM 2005.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Complex, Curves, Floats, Index, Points
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.geometry.bezier import bernstein
from shapetween.geometry.linearmaps import as_complex
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.carry import Carrier
from shapetween.outline.pushing import pushed
from shapetween.outline.scales import PLACES

__all__ = ["faired"]

#: Chords that a curve is read with. Fewer lose bends, which waves are then taken for; more cost
#: time.
CHORDS = 8

#: Scale, as a share of the outline, below which nodes go where the mean of both outlines is.
#: Smaller leaves waves; larger moves the two sides of a limb each in its own way.
SCALE = 0.03

#: Power of a wave's length, against that of the scale, with which the mesh takes over. Lower mixes
#: both ways of going at all lengths; higher rings beside corners.
POWER = 4

#: How much of the length that steps in different directions lose in their mean is given back, as a
#: power. Less, and limbs shrink half-way; all, and where the steps are opposite nodes leap.
RESTORED = 0.7

#: Length of a mean step, as a share of the longest one, that has no direction.
NO_STEP = 1e-9

#: Frames that are worked on at once. Fewer cost calls; more are fetched from memory again and
#: again.
FRAMES_AT_ONCE = 24


def faired(body: Carried) -> Carried:
    """The body with fair outlines, unless more crosses then."""
    motion, nodes = body.path, body.nodes
    if not isinstance(motion, KeyedMotion) or not any(map(_changes, nodes.rings)):
        return body
    t = np.linspace(0, 1, CHECKED_TIMES)
    places = motion.nodes(t)
    pushes = np.zeros((len(t), len(nodes.ends[0])), dtype=np.complex128)
    for k, (ring, part) in enumerate(zip(nodes.rings, nodes.parts, strict=True)):
        if _changes(ring):
            w = ring.samples.w[nodes.chosen[k]]
            fair = _Ring.of(nodes.carriers[k], w)
            pushes[:, part] = fair.nodes(places[:, part], t) - as_complex(places[:, part])
    pushes[[0, -1]] = 0.0
    found = pushed(body, motion, pushes)
    return found if found.crossing <= body.crossing else body


def _changes(ring: RingMatch) -> bool:
    """Whether the shape of a ring changes by more than an affine map; coarse ones are left."""
    return not ring.coarse and ring.matching.affine is None


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """One end of a ring, each step as its surroundings see it that go in the direction of 1.

    Attributes
    ----------
    steps : (PLACES,) complex128
        From each even place to the next.
    lengths : (PLACES,) float64
        Of the steps.
    beyond : (n,) complex128
        From the even place before each node to the node.
    """

    steps: Complex
    lengths: Floats
    beyond: Complex


@dataclass(frozen=True, slots=True, eq=False)
class _Ring:
    """One ring at even places of its common parameter, and its nodes among them.

    Attributes
    ----------
    carrier : Carrier
    curve : (PLACES,) intp
        Which curve each even place lies on.
    weights : (4, PLACES) float64
        Of that curve's control points, at a place on one of its chords.
    ends : (_End, _End)
    place : (n,) intp
        The even place before each node.
    rest : (n,) float64
        How far the node is from there to the next even place.
    """

    carrier: Carrier
    curve: Index
    weights: Floats
    ends: tuple[_End, _End]
    place: Index
    rest: Floats

    @classmethod
    def of(cls, carrier: Carrier, w: Floats) -> "_Ring":
        """Of a ring with nodes at the parameters `w`."""
        starts = carrier.pieces.w
        width = np.diff(starts, append=starts[:1] + 1)[:, None]
        chords = (starts[:, None] + width * np.arange(CHORDS) / CHORDS).ravel()
        even = chords[0] + (np.arange(PLACES) / PLACES - chords[0]) % 1.0
        first = np.searchsorted(chords, even, side="right") - 1
        length = np.diff(chords, append=chords[:1] + 1)[first]
        share = (even - chords[first]) / np.where(length > 0, length, 1.0)
        curve, chord = np.divmod(first, CHORDS)
        weights = bernstein(np.arange(CHORDS + 1) / CHORDS, axis=0)
        weights = (1 - share) * weights[:, chord] + share * weights[:, chord + 1]
        place = np.floor(w * PLACES).astype(np.intp)
        at = np.searchsorted(starts, w)
        ends = []
        for curves in (carrier.pieces.source, carrier.pieces.target):
            points = _at(curves, curve, weights)
            steps = _steps(points)
            back = _unit(_in_the_large(steps)).conj()
            beyond = as_complex(curves[at, 0]) - points[place]
            ends.append(_End(back * steps, np.abs(steps), back[place] * beyond))
        return cls(carrier, curve, weights, (ends[0], ends[1]), place, w * PLACES - place)

    def nodes(self, nodes: Points, t: Floats) -> Complex:
        """Where nodes that the mesh puts at (F, n, 2) go at the times (F,), (F, n)."""
        curves = self.carrier.curves(nodes, t)
        few = np.array_split(np.arange(len(t)), -(-len(t) // FRAMES_AT_ONCE))
        return np.concatenate([self._nodes(curves[some], t[some, None]) for some in few])

    def _nodes(self, curves: Curves, late: Floats) -> Complex:
        """The same of curves (F, P, 4, 2) at the times (F, 1)."""
        moving = _at(curves, self.curve, self.weights)
        large = _in_the_large(moving)
        turn = _unit(_steps(large))
        one, other = self.ends
        mean = (1 - late) * one.steps + late * other.steps
        wanted = (1 - late) * one.lengths + late * other.lengths
        least = NO_STEP * max(one.lengths.max(), other.lengths.max())
        short = np.abs(mean)
        turn *= np.where(short > least, wanted / np.maximum(short, least), 1.0) ** RESTORED
        path = _closed(turn * mean)
        mesh = large - _in_the_large(path)
        following = mesh[:, (self.place + 1) % PLACES]
        mesh = mesh[:, self.place]
        mesh += self.rest * (following - mesh)
        beyond = (1 - late) * one.beyond + late * other.beyond
        return np.asarray(mesh + path[:, self.place] + turn[:, self.place] * beyond)


def _at(curves: Curves, curve: Index, weights: Floats) -> Complex:
    """Points of curves (..., P, 4, 2) at even places, (..., PLACES)."""
    control = as_complex(curves)
    points = weights[0] * control[..., curve, 0]
    for k in range(1, 4):
        points += weights[k] * control[..., curve, k]
    return np.asarray(points)


def _steps(points: Complex) -> Complex:
    """From each place to the next, (..., PLACES)."""
    return np.asarray(np.roll(points, -1, axis=-1) - points)


def _closed(steps: Complex) -> Complex:
    """The closed path of such steps (F, PLACES) as nearly as may be, from the origin."""
    steps = steps - steps.mean(axis=1, keepdims=True)
    return np.asarray(np.cumsum(steps, axis=1) - steps)


def _unit(vectors: Complex) -> Complex:
    """Vectors of length 1 in the same direction; 1 where there is none."""
    size = np.abs(vectors)
    none = size < np.finfo(np.float64).tiny
    if none.any():
        vectors, size = np.where(none, 1.0, vectors), np.where(none, 1.0, size)
    return np.asarray(vectors * (1 / size))


def _in_the_large(values: Complex) -> Complex:
    """Values at even places without waves shorter than the scale, (..., PLACES)."""
    waves = 2 * np.pi * np.fft.fftfreq(PLACES, 1 / PLACES)
    found = np.fft.fft(values)
    found *= 1 / (1 + (SCALE * waves) ** POWER)
    return np.asarray(np.fft.ifft(found, out=found))
