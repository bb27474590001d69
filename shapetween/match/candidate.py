"""A matching found in one frame, and how far two of them are apart."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.match.correspondence import Correspondence
from shapetween.match.layout import Layout

__all__ = [
    "DISTINCT",
    "PLACES",
    "Candidate",
    "Halves",
    "agrees",
    "apart",
    "around",
    "away",
    "distinct",
    "follow",
    "near",
]

#: Least mean distance, as a share of the length, between two matchings that are different ones.
#: Less, and the alternatives offered look alike; more, and one limb that goes elsewhere is missed.
DISTINCT = 0.03

#: Even places at which knots are compared with a matching, and the bends of two outlines. Fewer
#: step over limbs and corners.
PLACES = 512


Halves: TypeAlias = tuple[Floats | None, Floats | None]
"""Of each outline that is even but for something on one side: which places of both sides belong
together, (2, K) shares of their lengths, neither ever falling; of one that is even None."""


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A matching found in one frame.

    Attributes
    ----------
    a, b : (K,) float64
        Knots, as fractions of both lengths from the canonical starts, over one turn.
    cost : float
    turn : float
        The frame: the angle the first outline was turned by.
    ends : (2 g, 2) float64 or None
        Rows a, b of the ends of the axes of symmetry that it keeps, where it keeps any.
    halves : Halves
        How both sides belong together of an outline that is nearly even about its axis.
    """

    a: Floats
    b: Floats
    cost: float
    turn: float
    ends: Floats | None = None
    halves: Halves = (None, None)


def distinct(
    candidates: Iterable[Candidate], count: int, known: Iterable[Candidate] = ()
) -> list[Candidate]:
    """The first candidates that are different matchings, also from known ones; at most `count`."""
    kept: list[Candidate] = []
    others = list(known)
    for candidate in candidates:
        if len(kept) == count:
            break
        if not any(near(candidate, other) for other in others):
            kept.append(candidate)
            others.append(candidate)
    return kept


def apart(first: Correspondence, second: Correspondence) -> float:
    """Mean distance of two matchings, as a share of the target's length."""
    return _gap(first.u, first.v, follow(second.u, second.v, first.u))


def agrees(u: Floats, v: Floats, found: Correspondence, most: float = DISTINCT) -> bool:
    """Whether two closed outlines' knots are no other matching than a given one.

    Parameters
    ----------
    u, v : (K,) float64
        Shares of the lengths over one turn, neither ever decreasing.
    found : Correspondence
    most : float
        Mean distance, as a share of the length, up to which they are one.
    """
    knots = (u - u[0] + v - v[0]) / 2
    even = np.arange(PLACES) / PLACES
    a, b = np.interp(even, knots, u), np.interp(even, knots, v)
    # Along the nearer outline: where an arc of one comes from a point the other stands still.
    across, along = b - follow(found.u, found.v, a), a - follow(found.v, found.u, b)
    gaps = np.minimum(np.abs(across - np.round(across)), np.abs(along - np.round(along)))
    return bool(gaps.mean() <= most)


def near(first: Candidate, second: Candidate) -> bool:
    """Whether two candidates are one matching."""
    return _gap(first.a, first.b, follow(second.a, second.b, first.a)) <= DISTINCT


def _gap(at: Floats, first: Floats, second: Floats) -> float:
    """Mean distance on the circle of two functions known at places over one turn."""
    gap = first - second
    far = np.abs(gap - np.round(gap))
    return float((np.diff(at) * (far[1:] + far[:-1]) / 2).sum())


def follow(knots: Floats, values: Floats, at: Floats) -> Floats:
    """Linear between knots over one turn, continued beyond it."""
    whole = np.floor(at - knots[0])
    return np.asarray(np.interp(at - whole, knots, values) + whole)


def away(candidate: Candidate, a: Floats, b: Floats) -> Floats:
    """How far every pair of places is from the matching, along the nearer outline, (n, m)."""
    across = follow(candidate.a, candidate.b, a)[:, None] - b
    along = a[:, None] - follow(candidate.b, candidate.a, b)
    return np.minimum(np.abs(across - np.round(across)), np.abs(along - np.round(along)))


def around(layout: Layout) -> tuple[Floats, Floats]:
    """Places of the samples once round the first outline, and twice round the second."""
    once = np.append(layout.a, layout.a[0] + 1)
    return once, np.concatenate([layout.b, layout.b + 1, layout.b[:1] + 2])
