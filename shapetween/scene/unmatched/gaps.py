"""When a line is cut open: as the tip of the line that runs through the gap passes."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from shapetween.base.ends import End
from shapetween.scene.forms import Segment
from shapetween.scene.places import Places
from shapetween.scene.unmatched.going import Going, Side
from shapetween.scene.unmatched.presence import BOTH

__all__ = ["timed_gaps"]

#: Half of the way along the line that runs through a gap, as a share of the gap's length, on which
#: the gap opens. Smaller, and it opens with a jerk; larger, and long before the tip is there.
AHEAD = 0.75

#: How much sooner a gap begins to open than what comes into it grows, and how long it takes.
SOONER, TAKES = 0.2, 0.4


def timed_gaps(
    side: Side, other: Side, found: dict[int, Going], theirs: Mapping[int, Going]
) -> None:
    """Let the gaps of one drawing's lines open or close with what comes or goes in the other.

    Parameters
    ----------
    side, other : Side
    found : dict of int to Going
        Of the lines' drawing; that of each gap is put right in its place.
    theirs : mapping of int to Going
        Of the other drawing.
    """
    import shapely

    for k, going in found.items():
        item = side.scene.items[k]
        if not item.cut or item.filled or going.leaving.kept is None:
            continue
        crossing = [
            j
            for j in theirs
            if not other.scene.sheets[j]
            and shapely.distance(other.scene.items[j].drawn, item.drawn) <= 0
        ]
        if not crossing:
            continue
        middle = Places(item.outer).point(np.array([0.5]))
        spot = shapely.Point(middle[0])
        near = {j: shapely.distance(other.scene.items[j].drawn, spot) for j in crossing}
        j = min(near, key=lambda j: (round(near[j] / other.scene.scale, 9), j))
        found[k] = _with(k, going, j, side, other, theirs[j])


def _with(k: int, going: Going, j: int, side: Side, other: Side, theirs: Going) -> Going:
    """A gap that opens or closes with what comes or goes through it.

    A tick that is drawn in it has no tip that cuts it open, and waits for it.
    """
    item, line = side.scene.items[k], other.scene.items[j]
    leaving, kept = going.leaving, theirs.leaving.kept
    slash = isinstance(other.scene.forms[j], Segment)
    if line.filled or kept is None or isinstance(kept, tuple) or not slash:
        low, high = theirs.leaving.window
        if other.end is End.TARGET:
            window = low - SOONER, low - SOONER + TAKES
        else:
            window = high + SOONER - TAKES, high + SOONER
        return replace(going, leaving=replace(leaving, window=window))
    gap, through = Places(item.outer), Places(line.outer)
    shares = np.linspace(0.0, 1.0, 33)
    points = gap.point(shares)
    nearest = through.nearest(points)
    away = np.linalg.norm(through.point(nearest) - points, axis=1)
    best = int(np.round(away / side.scene.scale, 9).argmin())
    passed = float(nearest[best])
    ahead = AHEAD * item.length / line.length
    times = []
    for share in (passed - ahead, passed + ahead):
        share = min(max(share, 0.0), 1.0)
        reach = (kept - share) / kept if share < kept else (share - kept) / max(1 - kept, 1e-9)
        times.append(theirs.leaving.time(1 - reach, other.end))
    window = min(times), max(times)
    if window[1] - window[0] < 0.05:
        window = max(window[0] - 0.05, 0.0), min(window[1] + 0.05, 1.0)
    cut = going.cut
    if leaving.kept == BOTH:
        cut = float(np.clip(shares[best], 0.25, 0.75))
    return replace(going, leaving=replace(leaving, window=window, steady=True), cut=cut)
