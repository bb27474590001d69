"""Even movements that follow one another, put together where a point goes on as it did."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Index
from shapetween.timing.easing import LINEAR
from shapetween.timing.windows import Eased

__all__ = ["together"]

Grid = NDArray[np.int64]


def together(
    easings: Sequence[Eased], terms: Grid, allowed: float
) -> tuple[tuple[Eased, ...], Grid]:
    """Displacements over windows in a row, those that go on evenly as one over all of theirs.

    Parameters
    ----------
    easings : sequence of Eased
        M of them, by when they set off.
    terms : (M, K, 2) int64
    allowed : float
        How far a point may be off between two windows, in the terms' steps.

    Returns
    -------
    easings : tuple of Eased
        As they were, where that makes no fewer.
    terms : (L, K, 2) int64
    """
    even = [k for k, easing in enumerate(easings) if easing.handles == LINEAR]
    windows = [easings[k].window for k in even]
    found: dict[tuple[float, float], Grid] = {}
    moving = np.flatnonzero(terms[even].any(axis=(0, 2)))
    ways = _gathered(terms[even][:, moving], allowed / 2)
    starts = np.zeros(len(moving), np.intp)
    for first in range(len(even)):
        here = np.flatnonzero(starts == first)
        last = _as_far_as_even(windows, ways[:, here], first, allowed)
        starts[here] = last + 1
        for end in np.unique(last).tolist():
            those = here[last == end]
            whole = ways[first : end + 1, those].sum(axis=0)
            if whole.any():
                window = windows[first][0], windows[end][1]
                term = found.setdefault(window, np.zeros(terms.shape[1:], np.int64))
                term[moving[those]] += whole
    rest = [k for k in range(len(easings)) if k not in even]
    if len(found) + len(rest) >= len(easings):
        return tuple(easings), terms
    every = [(Eased(LINEAR, window), term) for window, term in found.items()]
    every += [(easings[k], terms[k]) for k in rest]
    every.sort(key=lambda one: one[0].window)
    return tuple(easing for easing, _ in every), np.stack([term for _, term in every])


def _gathered(ways: Grid, little: float) -> Grid:
    """Ways (M, P, 2) of which little ones are part of the next that is not, or the last."""
    large = np.hypot(ways[..., 0], ways[..., 1]) > little
    numbers = np.arange(len(ways))[:, None]
    later = np.minimum.accumulate(np.where(large, numbers, len(ways))[::-1])[::-1]
    last = np.where(large, numbers, -1).max(axis=0, initial=-1)
    to = np.where(later < len(ways), later, last)
    to = np.where(last < 0, numbers, to)
    gathered = np.zeros_like(ways)
    np.add.at(gathered, (to, np.arange(ways.shape[1])), ways)
    return gathered


def _as_far_as_even(
    windows: Sequence[tuple[float, float]], ways: Grid, first: int, allowed: float
) -> Index:
    """For each point the last of windows from one on through which it goes evenly, (P,)."""
    found = np.full(ways.shape[1], first)
    going = np.arange(ways.shape[1])
    for last in range(first, len(windows) - 1):
        if windows[last][1] != windows[last + 1][0] or not len(going):
            break
        times = np.array([window[1] for window in windows[first : last + 2]]) - windows[first][0]
        places = np.cumsum(ways[first : last + 2, going], axis=0)
        away = places - (times / times[-1])[:, None, None] * places[-1]
        going = going[np.hypot(away[..., 0], away[..., 1]).max(axis=0) <= allowed]
        found[going] = last + 1
    return found
