"""One outline in as few curves as draw it: what an editor cut up or rounded off is put together.

How a path was cut into commands then makes no difference to how it moves.
"""

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Curves, Index
from shapetween.geometry.bezier import line_curves, sub_curves
from shapetween.geometry.polygon import cross
from shapetween.model.outline import Outline

__all__ = ["tidy"]

ArrayT = TypeVar("ArrayT", bound=NDArray[Any])

#: Extent of a curve, as a share of the outline's, up to which it is left out and its ends joined.
#: Closing lines over the last rounded digit are of this size; larger would move what is drawn by
#: more than the last digit that is printed.
TINY = 2e-5

#: Distance, as a share of the outline's extent, by which a joined curve may miss the two that it
#: stands for.
SAME_CURVE = 1e-6

#: Length, as a share of the outline's extent, up to which a line that runs back along the one
#: before it is taken for rounding. It encloses nothing, and makes the outline touch itself.
STEP_BACK = 2e-3


def tidy(outline: Outline) -> Outline:
    """The same closed outline without curves of no extent and steps back, cut curves joined again.

    Parameters
    ----------
    outline : Outline
        Closed.
    """
    low, high = outline.box
    size = float(np.max(high - low))
    # Joined first: a curve that goes takes with it what its neighbours were cut from.
    curves = _without_cuts(outline.curves, SAME_CURVE * size)
    kept = _without_steps_back(curves, SAME_CURVE * size, STEP_BACK * size)
    kept = _without_points(kept, TINY * size)
    return Outline(curves if kept is curves else _without_cuts(kept, SAME_CURVE * size))


def _without_cuts(curves: Curves, tolerance: float) -> Curves:
    while len(curves) > 2:
        places, joined = _joined(curves, tolerance)
        taken = _apart(places.tolist(), len(curves))
        if not taken:
            break
        curves = curves.copy()
        curves[taken] = joined[np.searchsorted(places, taken)]
        curves = np.delete(curves, (np.array(taken) + 1) % len(curves), axis=0)
    return curves


def _apart(indices: list[int], count: int) -> list[int]:
    """Indices of which no two are neighbours on a cycle of `count`, the first ones kept."""
    kept: list[int] = []
    for k in indices:
        if (kept and k - kept[-1] < 2) or (kept and k == count - 1 and kept[0] == 0):
            continue
        kept.append(k)
    return kept


def _without_points(curves: Curves, tiny: float) -> Curves:
    extent = np.ptp(curves, axis=1).max(axis=1)
    keep = extent > tiny
    if keep.all() or keep.sum() < 2:
        return curves
    curves = curves[keep]
    shift = np.roll(curves[:, 3], 1, axis=0) - curves[:, 0]
    # All of a curve follows its start, so that a line stays one.
    curves = curves + np.linspace(1.0, 0.0, 4)[:, None] * shift[:, None]
    curves[:, 0] = np.roll(curves[:, 3], 1, axis=0)
    return curves


def _without_steps_back(curves: Curves, tolerance: float, most: float) -> Curves:
    """Two lines of which the second runs back along the first, one of them short, are one."""
    while len(curves) > 3:
        chord = curves[:, 3] - curves[:, 0]
        length = np.linalg.norm(chord, axis=1)
        off = np.abs(cross(curves[:, 1:3] - curves[:, :1], chord[:, None])).max(axis=1)
        line = off <= tolerance * length
        after = _rolled(chord)
        longer = np.maximum(length, _rolled(length))
        back = line & _rolled(line) & ((chord * after).sum(axis=1) < 0)
        back &= np.abs(cross(chord, after)) <= tolerance * longer
        back &= np.minimum(length, _rolled(length)) <= most
        taken = _apart(np.flatnonzero(back).tolist(), len(curves))
        if not taken:
            break
        following = (np.array(taken) + 1) % len(curves)
        curves = curves.copy()
        curves[taken] = line_curves(curves[taken, 0], curves[following, 3])
        curves = np.delete(curves, following, axis=0)
    return curves


def _rolled(values: ArrayT) -> ArrayT:
    """What follows each; what ``np.roll`` does, in a fifth of its time."""
    return np.concatenate([values[1:], values[:1]])  # type: ignore[return-value]


def _joined(curves: Curves, tolerance: float) -> tuple[Index, Curves]:
    """Which curves are the first part of a curve that the next one is the rest of; those curves.

    A cubic cut at t has handles on both sides of the cut in the ratio t to 1 - t.
    """
    after = _rolled(curves)
    reaching, leaving = curves[:, 3] - curves[:, 2], after[:, 1] - after[:, 0]
    handle = np.linalg.norm(reaching, axis=1)
    total = handle + np.linalg.norm(leaving, axis=1)
    # Both handles lie on one line, to within what the joined curve may miss.
    smooth = np.flatnonzero(np.abs(cross(reaching, leaving)) <= 4 * tolerance * total)
    if not len(smooth):
        return smooth, curves[:0]
    curves, after, handle, total = curves[smooth], after[smooth], handle[smooth], total[smooth]
    share = np.clip(handle / np.where(total > 0, total, 1.0), TINY / 2, 1 - TINY / 2)
    first, last = share[:, None], 1 - share[:, None]
    joined = np.stack(
        [
            curves[:, 0],
            curves[:, 0] + (curves[:, 1] - curves[:, 0]) / first,
            after[:, 3] + (after[:, 2] - after[:, 3]) / last,
            after[:, 3],
        ],
        axis=1,
    )
    zero, one = np.zeros(len(share)), np.ones(len(share))
    missed = np.abs(sub_curves(joined, zero, share) - curves).max(axis=(1, 2))
    missed = np.maximum(missed, np.abs(sub_curves(joined, share, one) - after).max(axis=(1, 2)))
    good = missed <= tolerance
    return smooth[good], joined[good]
