"""A movement that is found again in a blink each time a pin moves.

Outlines, features and whatever else pins do not change are kept from one time to the next. Where
parts of the outline go is the very matching of the full result; how they get there is rougher:
straight, or in an ambient mesh that no quads lead and nobody checks.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.base.errors import MeshError, OptionError, OutlineError
from shapetween.deform.check import simple_frames
from shapetween.deform.deformation import Deformation
from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.motion import AmbientMotion
from shapetween.deform.schedule import STIFFNESS_SCHEDULE
from shapetween.match.matcher import Matcher
from shapetween.model.arclength import ArcLength
from shapetween.outline.body import Carried, Nodes, RingMatch
from shapetween.outline.matched import MatchedOutlines
from shapetween.outline.nodes import outline_nodes
from shapetween.outline.unfold import MOST_NODES, SPAN, TOLERANCES

__all__ = ["Level", "Previews"]

Level = Literal["line", "plane"]

#: Distance of a pin from the outline that it may belong to, as a share of that one's size.
PIN_REACH = 0.05

#: Matched samples of an outline. With fewer, nodes miss its corners; more take longer.
SAMPLES = 256


@dataclass(frozen=True, eq=False)
class _Outer:
    """An outer ring and what pins do not change of it."""

    ring: RingMatch

    @cached_property
    def matcher(self) -> Matcher:
        """Kept for all matchings to come."""
        return Matcher(self.ring.source, self.ring.target)

    @cached_property
    def lengths(self) -> tuple[ArcLength, ArcLength]:
        """Of both ends."""
        return ArcLength(self.ring.source), ArcLength(self.ring.target)

    @cached_property
    def sizes(self) -> Floats:
        """Of both ends, (2,)."""
        ends = self.ring.source, self.ring.target
        return np.array([np.linalg.norm(np.ptp(end.box, axis=0)) for end in ends])

    def places(self, pins: Points) -> tuple[Floats, Floats]:
        """Places of pins on both ends, (K, 2), and how far off they are, in sizes, (K,)."""
        found = [
            length.nearest(points)
            for length, points in zip(self.lengths, (pins[:, :2], pins[:, 2:]), strict=True)
        ]
        off = np.stack([distance for _, distance in found], axis=1) / self.sizes
        return np.stack([place for place, _ in found], axis=1), off.max(axis=1, initial=0.0)

    def matched(self, places: Floats) -> RingMatch:
        """The ring with pins at places."""
        matching = self.matcher.match(places)
        exact = matching.affine is not None
        outlines = MatchedOutlines(
            *self.lengths, matching.u, matching.v, anchors=places, exact=exact
        )
        samples = outlines.samples(SAMPLES)
        first = int(np.linalg.norm(samples.source - samples.source[0], axis=1).argmax())
        kept = np.unique([0, first])
        return replace(
            self.ring, matching=matching, outlines=outlines, samples=samples, kept=kept, pair=None
        )


@dataclass(frozen=True, slots=True, eq=False)
class Previews:
    """Bodies that are moved again and again by other pins.

    Attributes
    ----------
    bodies : tuple of Carried
        As they move without any pin.
    """

    bodies: tuple[Carried, ...]
    _outers: dict[tuple[int, int], _Outer]

    @classmethod
    def of(cls, bodies: Sequence[Carried]) -> "Previews | None":
        """Made ready; None where outlines are of so many curves that coarse shapes are matched."""
        rings = {(b, r): ring for b, body in enumerate(bodies) for r, ring in _rings(body)}
        if any(ring.coarse for ring in rings.values()):
            return None
        outers = {key: _Outer(ring) for key, ring in rings.items() if not ring.hole}
        return cls(tuple(bodies), outers)

    def moved(self, pins: Points, level: Level) -> tuple[Carried, ...]:
        """All bodies with these pins; those without any as they were.

        Parameters
        ----------
        pins : (K, 4) float64
            In the movement's frame.
        level : {"line", "plane"}
            Whether nodes go straight, or in an ambient mesh.

        Raises
        ------
        OptionError
            If a pin is on no outline, or not in the order of the others.
        """
        mine = self._assigned(pins)
        found = []
        for b, body in enumerate(self.bodies):
            if all(own != b for own, _ in mine):
                found.append(body)
                continue
            rings = [
                self._outers[b, r].matched(mine[b, r]) if (b, r) in mine else ring
                for r, ring in _rings(body)
            ]
            found.append(_carried(tuple(rings), level))
        return tuple(found)

    def _assigned(self, pins: Points) -> dict[tuple[int, int], Floats]:
        """Places of pins on the outer rings that they are on."""
        keys = list(self._outers)
        if not len(pins):
            return {}
        found = [self._outers[key].places(pins) for key in keys]
        off = np.stack([far for _, far in found])
        nearest = off.argmin(axis=0)
        if (off.min(axis=0) > PIN_REACH).any():
            raise OptionError("pin: does not lie on two outlines that become each other")
        return {
            key: found[k][0][nearest == k] for k, key in enumerate(keys) if (nearest == k).any()
        }


def _rings(body: Carried) -> list[tuple[int, RingMatch]]:
    return list(enumerate(body.nodes.rings))


def _carried(rings: tuple[RingMatch, ...], level: Level) -> Carried:
    nodes = Nodes(rings, tuple(_chosen(ring) for ring in rings))
    path = _in_mesh(nodes) if level == "plane" else None
    return Carried(nodes, path or _Straight(nodes.ends), 0, 0, False, f"preview: {level}", 0.0)


def _chosen(ring: RingMatch) -> Index:
    samples = ring.samples
    return outline_nodes(
        samples.source, samples.target, ring.kept, tolerance=TOLERANCES[0], span=SPAN
    )


def _in_mesh(nodes: Nodes) -> Deformation | None:
    """The nodes as an ambient mesh moves them, or None where there is none to be had quickly."""
    sizes = tuple(len(k) for k in nodes.chosen)
    if sum(sizes) > MOST_NODES or not simple_frames(np.stack(nodes.ends), sizes).all():
        return None
    loops = [
        np.arange(part.start, part.stop)[:: -1 if ring.hole else 1]
        for ring, part in zip(nodes.rings, nodes.parts, strict=True)
    ]
    try:
        mesh = ambient_mesh(*nodes.ends, loops, refine=False)
    except (MeshError, OutlineError):
        return None
    return AmbientMotion.prepare(mesh, STIFFNESS_SCHEDULE[0])


@dataclass(frozen=True, slots=True, eq=False)
class _Straight:
    """Nodes that go straight."""

    ends: tuple[Points, Points]

    @property
    def mesh(self) -> None:
        """Nothing else can be bound to it."""

    def vertices(self, t: Floats) -> Points:
        """All of them at the times (F,), (F, n, 2)."""
        time = t[:, None, None]
        return np.asarray((1 - time) * self.ends[0] + time * self.ends[1])
