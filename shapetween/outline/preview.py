"""A movement that is found again in a blink each time a pin moves.

Outlines, features and whatever else pins do not change are kept from one time to the next. Where
parts of the outline go is the very matching of the full result; how they get there is rougher:
straight, or in an ambient mesh that no quads lead and nobody checks.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.base.errors import MeshError, OutlineError
from shapetween.deform.check import simple_frames
from shapetween.deform.deformation import Deformation
from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.motion import AmbientMotion
from shapetween.deform.schedule import STIFFNESS_SCHEDULE
from shapetween.geometry.rotation import rotations
from shapetween.match.matcher import Matcher
from shapetween.match.pins import REACH
from shapetween.model.arclength import ArcLength, arc_length
from shapetween.outline.body import Carried, Nodes, RingMatch
from shapetween.outline.carry import affine_between
from shapetween.outline.matching import unmeshed, upright_of
from shapetween.outline.nodes import outline_nodes
from shapetween.outline.unfold import MOST_NODES, SPAN, TOLERANCES

__all__ = ["Effort", "Previews", "previewed_body"]

Effort = Literal["line", "plane", "full"]
"""How much is done for a movement. The matching is the same each time. "line": nodes go straight;
"plane": in an ambient mesh that no quads lead and nobody checks; "full": as it is saved."""

#: Ends of pins whose places are kept, of a ring. More are of drags long past; fewer than a leg has
#: pins, and each step of a drag looks for all of them anew.
MOST_KNOWN = 1000


@dataclass(frozen=True, eq=False)
class _Kept:
    """A ring and what pins do not change of it."""

    ring: RingMatch
    turned: float
    sizes: tuple[float, float]
    _known: dict[tuple[int, float, float], tuple[float, float]] = field(default_factory=dict)

    @cached_property
    def matcher(self) -> Matcher:
        """Kept for all matchings to come; a hole turns with its outer ring first."""
        turn = np.column_stack([rotations(np.asarray(self.turned)), np.zeros(2)])
        source = self.ring.source.transformed(turn) if self.ring.hole else self.ring.source
        return Matcher(source, self.ring.target)

    @cached_property
    def lengths(self) -> tuple[ArcLength, ArcLength]:
        """Of both ends."""
        return arc_length(self.ring.source), arc_length(self.ring.target)

    def places(self, pins: Points) -> tuple[Floats, Floats]:
        """Places of pins on both ends, (K, 2), and how far off those are, in sizes, (K, 2)."""
        rows = pins.tolist()
        ends = [[self._nearest(k, row[2 * k], row[2 * k + 1]) for k in (0, 1)] for row in rows]
        found = np.array(ends).reshape(-1, 2, 2)
        return found[..., 0], found[..., 1]

    def _nearest(self, side: int, x: float, y: float) -> tuple[float, float]:
        """Place and distance of one end of a pin; of what is dragged only one end is new."""
        key = side, x, y
        if key not in self._known:
            place, distance = self.lengths[side].nearest(np.array([[x, y]]))
            if len(self._known) >= MOST_KNOWN:
                self._known.clear()
            self._known[key] = float(place[0]), float(distance[0]) / self.sizes[side]
        return self._known[key]

    def matched(self, places: Floats) -> RingMatch:
        """The ring with pins at places."""
        matching = self.matcher.match(places)
        if self.ring.upright:
            matching = upright_of(matching)
        both = {"hole": self.ring.hole, "upright": self.ring.upright}
        return unmeshed(self.lengths, matching, places, **both)


@dataclass(frozen=True, slots=True, eq=False)
class Previews:
    """Bodies that are moved again and again by other pins.

    Attributes
    ----------
    bodies : tuple of Carried
        As they move with other pins, or without any.
    pinned : frozenset of (int, int)
        Body and ring of the outlines that those pins are on.
    """

    bodies: tuple[Carried, ...]
    pinned: frozenset[tuple[int, int]]
    _rings: dict[tuple[int, int], _Kept]

    @classmethod
    def of(cls, bodies: Sequence[Carried], pins: Points) -> "Previews | None":
        """Made ready, of bodies that move with pins (K, 4).

        None where outlines are of so many curves that coarse shapes are matched, or a pin is on
        none.
        """
        rings = {(b, r): ring for b, body in enumerate(bodies) for r, ring in _rings(body)}
        if any(ring.coarse for ring in rings.values()):
            return None
        kept = {}
        for key, ring in rings.items():
            if not ring.hole:  # each stands before its holes
                turned = float(affine_between(ring.samples.source, ring.samples.target)[0])
                ends = ring.source, ring.target
                sizes = [float(np.linalg.norm(np.ptp(end.box, axis=0))) for end in ends]
            kept[key] = _Kept(ring, turned, (sizes[0], sizes[1]))
        mine = _assigned(kept, pins)
        return None if mine is None else cls(tuple(bodies), frozenset(mine), kept)

    def moved(self, pins: Points, level: Effort) -> tuple[Carried, ...] | None:
        """All bodies with these pins, those without any as they were.

        None if pins are not on the very outlines that they were on: what an outline does without
        them is not known.

        Parameters
        ----------
        pins : (K, 4) float64
            In the movement's frame.
        level : {"line", "plane"}

        Raises
        ------
        OptionError
            If a pin is not in the order of the others.
        """
        mine = _assigned(self._rings, pins)
        if mine is None or frozenset(mine) != self.pinned:
            return None
        found = []
        for b, body in enumerate(self.bodies):
            if all(own != b for own, _ in mine):
                found.append(body)
                continue
            rings = [
                self._rings[b, r].matched(mine[b, r]) if (b, r) in mine else ring
                for r, ring in _rings(body)
            ]
            found.append(previewed_body(tuple(rings), level))
        return tuple(found)


def _assigned(
    rings: Mapping[tuple[int, int], _Kept], pins: Points
) -> dict[tuple[int, int], Floats] | None:
    """Places of pins on the rings that they are on; None if one is on none."""
    keys = list(rings)
    if not len(pins):
        return {}
    found = [rings[key].places(pins) for key in keys]
    off = np.stack([far for _, far in found])
    sums = np.where((off <= REACH).all(axis=2), off.sum(axis=2), np.inf)
    nearest = sums.argmin(axis=0)
    if not np.isfinite(sums.min(axis=0)).all():
        return None
    return {key: found[k][0][nearest == k] for k, key in enumerate(keys) if (nearest == k).any()}


def _rings(body: Carried) -> list[tuple[int, RingMatch]]:
    return list(enumerate(body.nodes.rings))


def previewed_body(rings: Sequence[RingMatch], level: Effort) -> Carried:
    """Matched rings as they are seen to move before the full result is there.

    Parameters
    ----------
    rings : sequence of RingMatch
        Outer rings, each before its holes.
    level : {"line", "plane"}
    """
    nodes = Nodes(tuple(rings), tuple(_chosen(ring) for ring in rings))
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
