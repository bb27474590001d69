"""Even movements that follow one another, put together where a point goes on as it did."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

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
    for point in np.flatnonzero(terms[even].any(axis=(0, 2))).tolist():
        ways = _gathered(terms[even, point], allowed / 2)
        first = 0
        while first < len(even):
            last = _as_far_as_even(windows, ways, first, allowed)
            whole = ways[first : last + 1].sum(axis=0)
            if whole.any():
                window = windows[first][0], windows[last][1]
                found.setdefault(window, np.zeros(terms.shape[1:], np.int64))[point] += whole
            first = last + 1
    rest = [k for k in range(len(easings)) if k not in even]
    if len(found) + len(rest) >= len(easings):
        return tuple(easings), terms
    every = [(Eased(LINEAR, window), term) for window, term in found.items()]
    every += [(easings[k], terms[k]) for k in rest]
    every.sort(key=lambda one: one[0].window)
    return tuple(easing for easing, _ in every), np.stack([term for _, term in every])


def _gathered(ways: Grid, little: float) -> Grid:
    """Ways (M, 2) of which those that are little are part of the next that is not, or the last."""
    ways = ways.copy()
    large = np.flatnonzero(np.hypot(*ways.T) > little).tolist()
    if large:
        for k in range(len(ways)):
            if k not in large:
                to = next((n for n in large if n > k), large[-1])
                ways[to] += ways[k]
                ways[k] = 0
    return ways


def _as_far_as_even(
    windows: Sequence[tuple[float, float]], ways: Grid, first: int, allowed: float
) -> int:
    """The last of windows from one on through which a point goes evenly."""
    last = first
    while last + 1 < len(windows) and windows[last][1] == windows[last + 1][0]:
        times = np.array([window[1] for window in windows[first : last + 2]]) - windows[first][0]
        places = np.cumsum(ways[first : last + 2], axis=0)
        away = places - (times / times[-1])[:, None] * places[-1]
        if np.hypot(*away.T).max() > allowed:
            break
        last += 1
    return last
