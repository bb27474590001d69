"""Lines that lie on longer ones of the other drawing, which are cut where the shorter ones end."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ranking import comparable
from shapetween.model.paint import Gradient
from shapetween.scene.asked import Group
from shapetween.scene.cuts.division import Division, Found, piece_of
from shapetween.scene.forms import is_straight
from shapetween.scene.items import Item
from shapetween.scene.motion.knots import kinks_of
from shapetween.scene.places import Places, run_of
from shapetween.scene.relations import Scene

__all__ = ["opaque", "shared_lines"]

#: Distance of a line from the one that it lies on, as a share of the drawing, and difference of
#: their lengths there.
ON, LENGTH = 0.02, 0.1

#: Least share of a line that its pieces take together, and that those take which end at its ends
#: and corners. Smaller, and lines break where another one just crosses them; larger, and the stem
#: of a bell that is drawn with its dome leaves it.
SHARED, AT_CORNERS = 0.3, 0.12

#: Share of a line that a rest next to a piece takes and is left to it.
REST = 0.02

#: Samples of a line that lie on the other.
SAMPLED = 33


def shared_lines(whole: Scene, parts: Scene, groups: Sequence[Group] = ()) -> Found:
    """Lines of a scene on which lines of another one lie, cut so; what is asked for stays whole."""
    kept = {k for one, _ in groups for k in one}
    found: Found = {}
    taken: set[int] = set()
    lines = [(k, item) for k, item in enumerate(parts.items) if not item.filled and not item.closed]
    if not lines:
        return found
    sampled: dict[int, Points] = {}
    scale = (whole.scale + parts.scale) / 2
    order = np.argsort(-comparable([item.length for item in whole.items]), kind="stable").tolist()
    for k in order:
        item = whole.items[k]
        if item.filled or item.shape in kept or not opaque(item):
            continue
        near = [(j, line) for j, line in lines if j not in taken and _near(line, item, scale)]
        if not near:
            continue
        places = Places(item.outer)
        spans = []
        for j, line in near:
            if j not in sampled:
                sampled[j] = Places(line.outer).point(np.linspace(0.0, 1.0, SAMPLED))
            span = _span(places, line, sampled[j], scale)
            if span is not None:
                spans.append((*span, j))
        spans = _apart(sorted(spans), item.closed)
        total = sum(end - start for start, end, _ in spans)
        if not spans or total < (AT_CORNERS if _at_corners(places, spans) else SHARED):
            continue
        if len(spans) == 1 and not item.closed and total > 1 - REST:
            continue
        if len(spans) == 1 and _shortens(item, spans[0]):
            continue
        found[k] = _divided(item, places, spans)
        taken |= {j for *_, j in spans}
    return found


def opaque(item: Item) -> bool:
    """Whether an item is seen as a plain stroke that hides what is behind it."""
    stroke = item.style.stroke
    if stroke is None or stroke.dashes or item.painted is not None:
        return False
    alpha = 1.0 if isinstance(stroke.paint, Gradient) else stroke.paint.alpha
    return alpha * item.style.opacity > 0.999


def _near(line: Item, item: Item, scale: float) -> bool:
    """Whether a line is painted like another one, no longer and within its box."""
    if line.length > (1 + LENGTH) * item.length:
        return False
    if abs(line.width - item.width) > 0.2 * item.width:
        return False
    if (np.abs(line.colour - item.colour) > 0.05).any():
        return False
    low, high = item.box - ON * scale, item.box + ON * scale
    return not ((line.box[0] < low[0]).any() or (line.box[1] > high[1]).any())


def _span(places: Places, line: Item, points: Points, scale: float) -> tuple[float, float] | None:
    """Where on an outline a line lies by its samples, as increasing shares; None if nowhere."""
    shares = places.nearest(points)
    away = np.linalg.norm(places.point(shares) - points, axis=1)
    if away.max() > ON * scale:
        return None
    if places.outline.closed:
        shares = np.unwrap(shares, period=1.0)
    steps = np.diff(shares)
    if steps.sum() < 0:
        shares, steps = shares[::-1], -steps[::-1]
    length = float(shares[-1] - shares[0])
    if (steps < -0.25 / SAMPLED).any() or length <= 0:
        return None
    if abs(length * places.length / max(line.length, 1e-12) - 1) > LENGTH:
        return None
    start = float(shares[0] - np.floor(shares[0]))
    return start, start + min(length, 1.0)


def _shortens(item: Item, span: tuple[float, float, int]) -> bool:
    """Whether a straight line only gets shorter at both its ends, with nothing cut out of it."""
    start, end, _ = span
    return start > REST and end < 1 - REST and is_straight(item.outer)


def _at_corners(places: Places, spans: list[tuple[float, float, int]]) -> bool:
    """Whether spans of a line start and end at its ends and corners alone."""
    corners = np.append(kinks_of(places)[0], [] if places.outline.closed else [0.0, 1.0])
    cuts = np.array([share for start, end, _ in spans for share in (start, end)])
    if places.outline.closed:
        cuts = cuts % 1.0
    return bool((np.abs(cuts[:, None] - corners).min(axis=1, initial=1.0) < REST).all())


def _apart(spans: list[tuple[float, float, int]], closed: bool) -> list[tuple[float, float, int]]:
    """Spans that do not overlap, the longest first."""
    kept: list[tuple[float, float, int]] = []
    for start, end, j in sorted(spans, key=lambda s: (round(s[0] - s[1], 6), s)):
        shifts = (-1.0, 0.0, 1.0) if closed else (0.0,)
        clear = all(
            min(end, e + shift) - max(start, s + shift) < REST
            for s, e, _ in kept
            for shift in shifts
        )
        if clear:
            kept.append((start, end, j))
    return sorted(kept)


def _divided(item: Item, places: Places, spans: list[tuple[float, float, int]]) -> Division:
    pieces: list[Item] = []
    pairs: list[tuple[Item, int]] = []
    cuts = _with_rests(spans, item.closed)
    for start, end, j in cuts:
        piece = piece_of(item, run_of(places, start, end))
        pieces.append(piece)
        if j >= 0:
            pairs.append((piece, j))
    return Division(pieces, pairs)


def _with_rests(
    spans: list[tuple[float, float, int]], closed: bool
) -> list[tuple[float, float, int]]:
    """Spans and the gaps between them (-1), in order; tiny gaps go to their neighbours."""
    low = spans[0][0] if closed else 0.0
    high = low + 1.0 if closed else 1.0
    result: list[tuple[float, float, int]] = []
    at = low
    for start, end, j in spans:
        if start - at > REST:
            result.append((at, start, -1))
            at = start
        result.append((at, end, j))
        at = end
    if high - at > REST:
        result.append((at, high, -1))
    else:
        start, _, j = result[-1]
        result[-1] = (start, high, j)
    return result
