"""Lines that were written in several pieces: where two ends meet in one direction, they are one."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Curves, Points
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


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """An end of a line: which item, whether its last point, where, and the direction outwards."""

    item: int
    last: bool
    point: Points
    outward: Points


def joined_lines(items: Sequence[Item]) -> tuple[Item, ...]:
    """The items with lines put together that go on in each other, in one style.

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
    for _, i, j in sorted(found):
        one_end, other_end = (ends[i].item, ends[i].last), (ends[j].item, ends[j].last)
        if one_end not in links and other_end not in links:
            links[one_end], links[other_end] = other_end, one_end
    return links


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
