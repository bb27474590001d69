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
from shapetween.geometry.bezier import flatten
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


def faired(body: Carried) -> Carried:
    """The body with fair outlines, unless more crosses then."""
    motion, nodes = body.path, body.nodes
    if not isinstance(motion, KeyedMotion) or not any(map(_changes, nodes.rings)):
        return body
    t = np.linspace(0, 1, CHECKED_TIMES)
    vertices = motion.vertices(t)
    pushes = np.zeros((len(t), len(nodes.ends[0])), dtype=np.complex128)
    for k, (ring, part) in enumerate(zip(nodes.rings, nodes.parts, strict=True)):
        if _changes(ring):
            w = ring.samples.w[nodes.chosen[k]]
            fair = _Ring.of(nodes.carriers[k], w)
            pushes[:, part] = fair.nodes(vertices[:, part], t) - as_complex(vertices[:, part])
    pushes[[0, -1]] = 0.0
    found = pushed(body, motion, pushes)
    return found if found.crossing <= body.crossing else body


def _changes(ring: RingMatch) -> bool:
    """Whether the shape of a ring changes by more than an affine map; coarse ones are left."""
    return not ring.coarse and ring.matching.affine is None


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """One end of a ring.

    Attributes
    ----------
    steps : (PLACES,) complex128
        From each even place to the next.
    around : (PLACES,) complex128
        The same in the large.
    beyond : (n,) complex128
        From the even place before each node to the node.
    """

    steps: Complex
    around: Complex
    beyond: Complex


@dataclass(frozen=True, slots=True, eq=False)
class _Ring:
    """One ring at even places of its common parameter, and its nodes among them.

    Attributes
    ----------
    carrier : Carrier
    first, last : (PLACES,) intp
        Chords' ends before and behind each even place.
    share : (PLACES,) float64
        How far the place is from the one to the other.
    ends : (_End, _End)
    place : (n,) intp
        The even place before each node.
    rest : (n,) float64
        How far the node is from there to the next even place.
    """

    carrier: Carrier
    first: Index
    last: Index
    share: Floats
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
        last = (first + 1) % len(chords)
        place = np.floor(w * PLACES).astype(np.intp)
        at = np.searchsorted(starts, w)
        ends = []
        for curves in (carrier.pieces.source, carrier.pieces.target):
            points = _at(curves, first, last, share)
            steps = _steps(points)
            ends.append(
                _End(steps, _in_the_large(steps), as_complex(curves[at, 0]) - points[place])
            )
        return cls(carrier, first, last, share, (ends[0], ends[1]), place, w * PLACES - place)

    def nodes(self, nodes: Points, t: Floats) -> Complex:
        """Where nodes that the mesh puts at (F, n, 2) go at the times (F,), (F, n)."""
        moving = _at(self.carrier.curves(nodes, t), self.first, self.last, self.share)
        around = _in_the_large(_steps(moving))
        turns = [
            weight[:, None] * _unit(around * end.around.conj())
            for end, weight in zip(self.ends, (1 - t, t), strict=True)
        ]
        both = list(zip(self.ends, turns, strict=True))
        parts = np.stack([turn * end.steps for end, turn in both])
        step, wanted = parts.sum(axis=0), np.abs(parts).sum(axis=0)
        short, least = np.abs(step), NO_STEP * wanted.max()
        grown = np.where(short > least, wanted / np.maximum(short, least), 1.0) ** RESTORED
        path = _closed(grown * step)
        beyond = np.stack([turn[:, self.place] * end.beyond for end, turn in both]).sum(axis=0)
        mesh = _in_the_large(moving - path)
        mesh = mesh[:, self.place] + self.rest * _steps(mesh)[:, self.place]
        return np.asarray(mesh + path[:, self.place] + grown[:, self.place] * beyond)


def _at(curves: Curves, first: Index, last: Index, share: Floats) -> Complex:
    """Points of curves (..., P, 4, 2) at even places, (..., PLACES)."""
    points = as_complex(flatten(curves, CHORDS))
    return np.asarray((1 - share) * points[..., first] + share * points[..., last])


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
    return np.asarray(np.where(size > 0, vectors, 1.0) / np.where(size > 0, size, 1.0))


def _in_the_large(values: Complex) -> Complex:
    """Values at even places without waves shorter than the scale, (..., PLACES)."""
    waves = 2 * np.pi * np.fft.fftfreq(PLACES, 1 / PLACES)
    return np.asarray(np.fft.ifft(np.fft.fft(values) / (1 + (SCALE * waves) ** POWER)))
