"""Where the samples are set that a matching is made of."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.match.costs import Prepared

__all__ = ["Layout", "layout_of"]

#: How many of the second outline's samples are skipped between those the first one's first may be
#: matched with.
EVERY = 2


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """Samples on both outlines; pinned ones are fixed to one another.

    Attributes
    ----------
    a, b : (n,) float64
        Places, fractions of the lengths from the canonical starts, increasing.
    a_vertices, b_vertices : (K,) intp
        The samples of the salient vertices.
    fixed : (k,) intp
        Pinned samples, the same on both.
    starts : (S,) intp
        Samples of the second that the first one's sample 0 may be matched with.
    """

    a: Floats
    b: Floats
    a_vertices: Index
    b_vertices: Index
    fixed: Index
    starts: Index


def layout_of(a: Prepared, b: Prepared, pins: Floats, count: int) -> Layout:
    """Samples at even steps of the measure, moved onto the nearest vertices and pins."""
    fixed, at_a, at_b = _spaced(a.measures(pins[:, 0]), b.measures(pins[:, 1]), count)
    starts = np.arange(0, 1 if len(pins) else count, EVERY)
    places_a, stations_a = _onto_vertices(a, at_a, fixed)
    places_b, stations_b = _onto_vertices(b, at_b, fixed)
    return Layout(places_a, places_b, stations_a, stations_b, fixed, starts)


def _spaced(a: Floats, b: Floats, count: int) -> tuple[Index, Floats, Floats]:
    """Samples at even steps between pins, as many on both: pinned ones, measures of all."""
    if len(a) == 0:
        even = np.arange(count) / count
        return np.zeros(0, dtype=np.intp), even, even
    ends_a, ends_b = np.append(a, a[0] + 1), np.append(b, b[0] + 1)
    ends_b[1:] += np.cumsum(np.diff(ends_b) < 0)
    ends_b[-1] = ends_b[0] + 1
    share = (np.diff(ends_a) + np.diff(ends_b)) / 2
    steps = np.maximum(np.round(share * count).astype(np.intp), 2)
    knots = np.concatenate([[0], np.cumsum(steps)])
    at = np.arange(knots[-1])
    return knots[:-1], np.interp(at, knots, ends_a), np.interp(at, knots, ends_b)


def _onto_vertices(prepared: Prepared, at: Floats, fixed: Index) -> tuple[Floats, Index]:
    """Places of samples, those nearest the salient vertices moved there, and which these are."""
    places = prepared.places(at)
    vertex = prepared.vertices.index / len(prepared.samples.points)
    measure = prepared.measures(vertex)
    gap = measure[:, None] - at
    gap = gap - np.round(gap)
    nearest = np.abs(gap).argmin(axis=1)
    free = ~np.isin(nearest, fixed)
    moved = prepared.places(at[nearest] + gap[np.arange(len(vertex)), nearest])
    places[nearest[free]] = moved[free]
    return places, nearest
