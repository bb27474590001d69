"""Edges that are straight at both ends stay straight on the way."""

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.geometry.linearmaps import as_complex
from shapetween.outline.body import Carried, Nodes
from shapetween.outline.pushing import pushed

__all__ = ["straightened"]

#: Distance from its chord up to which an edge is straight, as a share of its length. Larger
#: flattens round sides; smaller leaves what was drawn by hand to bend.
FLAT = 4e-3

#: Least bend worth taking out, in the same unit. Smaller costs time for what nobody sees.
SEEN = 4e-3

#: Least way from one node of an edge to the next, as a share of what it is where all of them move
#: evenly along it. None, and rounding lets what is in one place cross itself; much more moves nodes
#: that keep their order.
LEAST_STEP = 0.1


def straightened(body: Carried) -> Carried:
    """The body with straight edges kept straight, unless it then crosses where it did not."""
    motion = body.path
    if not isinstance(motion, KeyedMotion) or any(ring.coarse for ring in body.nodes.rings):
        return body
    edges = _edges(body.nodes)
    if not edges:
        return body
    nodes = as_complex(motion.nodes(np.linspace(0, 1, CHECKED_TIMES)))
    pushes = np.zeros_like(nodes)
    bent = 0.0
    for edge in edges:
        chord = nodes[:, edge[-1:]] - nodes[:, edge[:1]]
        length = np.abs(chord)
        way = chord / np.where(length > 0, length, 1.0)
        place = (nodes[:, edge] - nodes[:, edge[:1]]) * way.conj()
        bent = max(bent, float((np.abs(place.imag) / np.where(length > 0, length, np.inf)).max()))
        pushes[:, edge[1:-1]] = ((_in_order(place.real) - place) * way)[:, 1:-1]
    if bent < SEEN:
        return body
    pushes[[0, -1]] = 0.0
    found = pushed(body, motion, pushes)
    return found if found.crossing <= body.crossing else body


def _in_order(along: Floats) -> Floats:
    """Places of an edge's nodes along it (F, N), drawn to even motion until each is past the last.

    On one line, what goes back lies on what it went over, and rounding says whether it crosses it.
    """
    lengths = along[:, -1:]
    shares = along[[0, -1]] / lengths[[0, -1]]
    t = np.linspace(0, 1, len(along))[:, None]
    even = ((1 - t) * shares[0] + t * shares[1]) * lengths
    steps, even_steps = np.diff(along), np.diff(even)
    lack = LEAST_STEP * even_steps - steps
    drawn = np.max(lack / np.where(lack > 0, even_steps - steps, np.inf), initial=0.0)
    return np.asarray(along + drawn * (even - along))


def _edges(nodes: Nodes) -> list[Index]:
    """Nodes of each edge of three or more that is straight at both ends, in order."""
    found = []
    for ring, chosen, part in zip(nodes.rings, nodes.chosen, nodes.parts, strict=True):
        ends = [as_complex(points) for points in (ring.samples.source, ring.samples.target)]
        count, total = len(chosen), len(ends[0])
        spans = np.concatenate([chosen, chosen + total, chosen[:1] + 2 * total])

        def straight(
            first: int, last: int, spans: Index = spans, ends: list[Complex] = ends
        ) -> bool:
            at = np.arange(spans[first], spans[last] + 1) % len(ends[0])
            return all(_is_straight(points[at]) for points in ends)

        # From a corner on, so that no edge is cut in two.
        corner = next((k for k in range(count) if not straight(k, k + 2)), None)
        if corner is None:
            continue
        first = corner + 1
        while first < corner + 1 + count:
            last = first + 1
            while last < corner + 1 + count and straight(first, last + 1):
                last += 1
            if last > first + 1:
                found.append(part.start + np.arange(first, last + 1) % count)
            first = last
    return found


def _is_straight(points: Complex) -> bool:
    """Whether points lie along the chord from the first to the last, one after the other."""
    chord = points[-1] - points[0]
    length = float(np.abs(chord))
    if length == 0:
        return False
    offset = (points - points[0]) * (chord.conjugate() / length)
    along: Floats = offset.real
    return bool(np.abs(offset.imag).max() <= FLAT * length and (np.diff(along) >= 0).all())
