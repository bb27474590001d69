"""Pins on the rings of two pieces: on their outer outlines, or on holes that become each other."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OptionError
from shapetween.match.pins import REACH
from shapetween.model.arclength import arc_length
from shapetween.model.outline import Outline

__all__ = ["PinnedRings", "pinned_rings"]

#: Two distances that differ by less, as a share of the piece's size, are the same.
TIE = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class PinnedRings:
    """Pins of two pieces, by the rings that they are on.

    Attributes
    ----------
    outer : tuple of int
        Rows of the pins on both outer rings.
    holes : dict of (int, int) to tuple of int
        Rows of the pins on a hole of either piece, by the holes.
    """

    outer: tuple[int, ...]
    holes: dict[tuple[int, int], tuple[int, ...]]

    @property
    def rows(self) -> tuple[int, ...]:
        """All pins that are on some pair of rings."""
        return (*self.outer, *(k for rows in self.holes.values() for k in rows))

    def of_rows(self, rows: Sequence[int]) -> "PinnedRings":
        """The same by what rows of another table they are."""
        holes = {pair: tuple(rows[k] for k in own) for pair, own in self.holes.items()}
        return PinnedRings(tuple(rows[k] for k in self.outer), holes)


def pinned_rings(first: Sequence[Outline], second: Sequence[Outline], pins: Points) -> PinnedRings:
    """The rings that pins are on: of all that may become each other the nearest at both ends.

    Parameters
    ----------
    first, second : sequence of Outline
        Of either piece the outer ring, then its holes.
    pins : (K, 4) float64
        In the movement's frame.

    Raises
    ------
    OptionError
        If pins make two holes of one.
    """
    if not len(pins):
        return PinnedRings((), {})
    away = [_away(rings, ends) for rings, ends in ((first, pins[:, :2]), (second, pins[:, 2:]))]
    sums = away[0][:, None] + away[1]
    sums[0, 1:] = sums[1:, 0] = np.inf  # an outer ring becomes no hole
    outer: list[int] = []
    holes: dict[tuple[int, int], list[int]] = {}
    for k, costs in enumerate(np.moveaxis(sums, -1, 0)):
        least = float(costs.min())
        if not np.isfinite(least):
            continue
        i, j = (int(x) for x in np.argwhere(costs <= least + TIE)[0])
        if i == 0:
            outer.append(k)
            continue
        pair = i - 1, j - 1
        for known in holes:
            if pair != known and (pair[0] == known[0] or pair[1] == known[1]):
                raise OptionError(
                    f"pin {':'.join(f'{x:g},{y:g}' for x, y in pins[k].reshape(2, 2))}: another pin"
                    " makes that hole a different one"
                )
        holes.setdefault(pair, []).append(k)
    return PinnedRings(tuple(outer), {pair: tuple(rows) for pair, rows in holes.items()})


def _away(rings: Sequence[Outline], points: Points) -> Floats:
    """Distance of points from rings in sizes of the outer one, (R, K); too far is infinite."""
    size = float(np.linalg.norm(np.ptp(rings[0].box, axis=0)))
    found = np.stack([arc_length(ring).nearest(points)[1] for ring in rings]) / size
    return np.where(found <= REACH, found, np.inf)
