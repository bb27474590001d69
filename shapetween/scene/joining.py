"""Lines that were written in several pieces: what goes on straight, and both legs of an arrow."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.fill.naming import is_given
from shapetween.geometry.bezier import end_tangents
from shapetween.model.outline import Outline
from shapetween.scene.items import Item

__all__ = ["joined_lines"]

#: Distance of two ends, as a share of the width, that meet. Larger, and joining them would move
#: what is drawn by more than the last printed digit.
MEET = 1e-3

#: Cosine of the angle within which two lines go on as one.
STRAIGHT = np.cos(np.deg2rad(12.0))

#: Greatest angle between a leg of an arrow and its shaft, radians, and difference of two legs'
#: angles, as cosines, and of their lengths, as a share. Larger, and crossroads are arrows.
LEG, EVEN = np.cos(np.deg2rad(75.0)), 0.02


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """An end of a line: which item, whether its last point, where, and the direction outwards."""

    item: int
    last: bool
    point: Points
    outward: Points


def joined_lines(items: Sequence[Item]) -> tuple[Item, ...]:
    """The items with lines put together that go on in each other, in one style, or are a head.

    Parameters
    ----------
    items : sequence of Item
        In paint order; a joined line stands where its first piece does.
    """
    ends = [end for k, item in enumerate(items) for end in _ends(k, item)]
    links = _links(ends, items)
    if not links:
        return tuple(items)
    seen: set[int] = set()
    result: list[Item] = []
    for k, item in enumerate(items):
        if k in seen:
            continue
        chain, closed = _chain(k, links)
        seen |= {index for index, _ in chain}
        result.append(item if len(chain) == 1 and not closed else _put(chain, closed, items))
    return tuple(result)


def _ends(k: int, item: Item) -> list[_End]:
    stroke = item.style.stroke
    if item.filled or item.closed or stroke is None or stroke.dashes:
        return []
    if item.length <= stroke.width * 0.1:
        return []
    leaving, reaching = end_tangents(item.outer.curves[[0, -1]])
    return [
        _End(k, False, item.outer.curves[0, 0], -leaving[0]),
        _End(k, True, item.outer.curves[-1, 3], reaching[1]),
    ]


def _links(ends: list[_End], items: Sequence[Item]) -> dict[tuple[int, bool], tuple[int, bool]]:
    """Which end goes on in which, both ways; the straightest first."""
    if len(ends) < 2:
        return {}
    points = np.array([end.point for end in ends])
    away = np.linalg.norm(points[:, None] - points, axis=-1)
    ahead = np.array([end.outward for end in ends])
    straight = -(ahead @ ahead.T)
    found: list[tuple[float, int, int]] = []
    for i, j in np.argwhere(np.triu(straight >= STRAIGHT, 1)).tolist():
        one, other = items[ends[i].item], items[ends[j].item]
        if away[i, j] > MEET * one.width or one.style != other.style:
            continue
        if ends[i].item == ends[j].item or _kept_apart(one, other):
            continue
        found.append((-round(float(straight[i, j]), 6), i, j))
    links: dict[tuple[int, bool], tuple[int, bool]] = {}
    for _, i, j in sorted(found) + _heads(ends, away, straight, items):
        one_end, other_end = (ends[i].item, ends[i].last), (ends[j].item, ends[j].last)
        if one_end not in links and other_end not in links:
            links[one_end], links[other_end] = other_end, one_end
    return links


def _heads(
    ends: list[_End], away: Floats, straight: Floats, items: Sequence[Item]
) -> list[tuple[float, int, int]]:
    """Ends at which the two legs of an arrow's head meet on its shaft, of corners that are round.

    Whether a head is written as one line or as two never counts.
    """
    widths = np.array([items[end.item].width for end in ends])
    meets = away <= MEET * widths
    found = []
    for k in np.flatnonzero(meets.sum(axis=1) == 3).tolist():
        i, j = (n for n in np.flatnonzero(meets[k]).tolist() if n != k)
        one, other, shaft = (items[ends[n].item] for n in (i, j, k))
        stroke = one.style.stroke
        if stroke is None or not stroke.cap == stroke.join == "round":
            continue
        if not one.style == other.style == shaft.style or _kept_apart(one, other):
            continue
        if (
            len({ends[n].item for n in (i, j, k)}) < 3
            or max(len(one.outer.curves), len(other.outer.curves)) > 1
        ):
            continue
        legs = -straight[k, [i, j]]
        even = abs(legs[0] - legs[1]) < EVEN and abs(one.length - other.length) < EVEN * one.length
        if even and legs.min() > LEG and straight[i, j] > -1 + EVEN:
            found.append((0.0, i, j))
    return found


def _kept_apart(one: Item, other: Item) -> bool:
    """Whether somebody gave two lines names of their own."""
    named = [item.name for item in (one, other) if item.name and is_given(item.name)]
    return len(named) > 0 and one.shape != other.shape


def _chain(
    start: int, links: dict[tuple[int, bool], tuple[int, bool]]
) -> tuple[list[tuple[int, bool]], bool]:
    """Lines in the order they are run through, and whether each is run forwards."""
    first, forwards = start, True
    while (first, not forwards) in links:  # back to the beginning
        before, last = links[first, not forwards]
        first, forwards = before, last
        if first == start:
            break
    chain = [(first, forwards)]
    at, ahead = first, forwards
    while (at, ahead) in links:
        after, last = links[at, ahead]
        if after == first:
            return chain, True
        at, ahead = after, not last
        chain.append((at, ahead))
    return chain, False


def _put(chain: list[tuple[int, bool]], closed: bool, items: Sequence[Item]) -> Item:
    runs: list[Curves] = []
    for index, forwards in chain:
        outer = items[index].outer
        runs.append((outer if forwards else outer.reversed()).curves)
    curves = np.concatenate(runs).copy()
    curves[1:, 0] = curves[:-1, 3]
    if closed:
        curves[-1, 3] = curves[0, 0]
    first = items[min(index for index, _ in chain)]
    return replace(first, rings=(Outline(curves, closed),))
