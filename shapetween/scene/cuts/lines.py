"""Lines that lie on longer ones of the other drawing, which are cut where the shorter ones end."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.base.ranking import comparable
from shapetween.model.paint import Gradient
from shapetween.scene.asked import Group
from shapetween.scene.cuts.division import Division, Found, piece_of
from shapetween.scene.forms import is_straight
from shapetween.scene.items import Item
from shapetween.scene.motion.knots import kinks_of
from shapetween.scene.places import Places, run_of
from shapetween.scene.relations import Scene

__all__ = ["opaque", "parted_lines", "shared_lines"]

#: Distance of a line from the one that it lies on, as a share of the drawing, and difference of
#: their lengths there.
ON, LENGTH = 0.02, 0.1

#: Least share of a line that its pieces take together, and that those take which end at its ends
#: and corners. Smaller, and lines break where another one just crosses them; larger, and the stem
#: of a bell that is drawn with its dome leaves it.
SHARED, AT_CORNERS = 0.3, 0.12

#: Share of a line that a rest next to a piece takes and is left to it.
REST = 0.02

#: Least length, as a share of the drawing, of what two lines have in common, how near they are
#: there, and samples by which that is found. Shorter, and lines that cross break; wider, and a lid
#: is cut from its box.
LONG, NEARLY_ON, FINE = 0.3, 0.008, 129

#: Most pairs of lines that are looked at, a millisecond each.
MOST = 400

#: Least share of one of two such lines that lies on the other drawing's lines. Smaller, and a
#: folder breaks that opens; at 1 a wall that is cut short by a heart is none.
THERE = 0.85

#: Samples of a line that lie on the other.
SAMPLED = 33


def shared_lines(whole: Scene, parts: Scene, groups: Sequence[Group] = ()) -> Found:
    """Lines of a scene on which lines of another one lie, cut so; what is asked for stays whole."""
    kept = {k for one, _ in groups for k in one}
    found: Found = {}
    taken: set[int] = set()
    numbers = [k for k, item in enumerate(parts.items) if not item.filled and not item.closed]
    if not numbers:
        return found
    lines = _Lines.of(parts.items, numbers)
    sampled: dict[int, Points] = {}
    scale = (whole.scale + parts.scale) / 2
    order = np.argsort(-comparable([item.length for item in whole.items]), kind="stable").tolist()
    for k in order:
        item = whole.items[k]
        if item.filled or item.shape in kept or not opaque(item):
            continue
        near = [j for j in lines.near(item, scale) if j not in taken]
        if not near:
            continue
        places = Places(item.outer)
        spans = []
        for j in near:
            line = parts.items[j]
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


def parted_lines(whole: Scene, parts: Scene, groups: Sequence[Group] = ()) -> Found | None:
    """Lines of a scene that lie on another one's for a while, cut where they part from it.

    None where there are too many pairs to look at.
    """
    kept = {k for one, _ in groups for k in one}
    scale = (whole.scale + parts.scale) / 2
    found: Found = {}
    there = _share_there(whole, parts, scale), _share_there(parts, whole, scale)
    if not max(there[0].max(), there[1].max()) > THERE:
        return found
    pairs = _longer_pairs(whole, parts, scale)
    pairs &= np.maximum(there[0][:, None], there[1]) > THERE
    if pairs.sum() > MOST:
        return None
    for k in np.flatnonzero(pairs.any(axis=1)).tolist():
        item = whole.items[k]
        if item.shape in kept or not opaque(item):
            continue
        places = Places(item.outer)
        spans = []
        for j in np.flatnonzero(pairs[k]).tolist():
            line = parts.items[j]
            if not opaque(line) or not _painted_alike(line, item):
                continue
            span = _common_run(places, Places(line.outer), scale)
            if span is not None:
                spans.append((*span, j))
        spans = _apart(sorted(spans), item.closed)
        if spans:
            pieces = [
                piece_of(item, run_of(places, start, end))
                for start, end, _ in _with_rests(spans, item.closed)
            ]
            if len(pieces) > 1 or item.closed:
                found[k] = Division(pieces, [])
    return found


def _longer_pairs(whole: Scene, parts: Scene, scale: float) -> Mask:
    """Pairs of lines whose boxes have so much in common that the lines may, (N, M)."""
    boxes = [np.array([item.box for item in s.items]) for s in (whole, parts)]
    low = np.maximum(boxes[0][:, None, 0], boxes[1][:, 0])
    high = np.minimum(boxes[0][:, None, 1], boxes[1][:, 1])
    long = [
        np.array([not item.filled and item.length >= LONG * scale for item in s.items])
        for s in (whole, parts)
    ]
    shared = np.linalg.norm(np.maximum(high - low, 0.0), axis=-1)
    shared[(high - low < -NEARLY_ON * scale).any(axis=-1)] = 0.0
    # A run that is bent has less of a box than its length.
    return np.asarray(long[0][:, None] & long[1] & (shared > LONG / 4 * scale))


def _share_there(scene: Scene, other: Scene, scale: float) -> Floats:
    """Share of each line that lies on another drawing's lines, (N,); 0 of areas."""
    import shapely

    lines = [item for item in other.items if not item.filled]
    if not lines:
        return np.zeros(len(scene.items))
    tree = shapely.STRtree([shapely.LineString(item.chords) for item in lines])
    points = shapely.points(np.concatenate([item.points for item in scene.items]))
    near, _ = tree.query(points, predicate="dwithin", distance=NEARLY_ON * scale)
    on = np.zeros(len(points), dtype=bool)
    on[near] = True
    shares = on.reshape(len(scene.items), -1).mean(axis=1)
    return np.where([item.filled for item in scene.items], 0.0, shares)


def _common_run(places: Places, line: Places, scale: float) -> tuple[float, float] | None:
    """Where a line lies on another one for the longest while and then leaves it; None if nowhere.

    Neither lies on the other one all along.
    """
    closed = line.outline.closed
    own = np.linspace(0.0, 1.0, FINE, endpoint=not closed)
    shares = places.nearest(line.point(own))
    on = np.linalg.norm(places.point(shares) - line.point(own), axis=1) < NEARLY_ON * scale
    if on.all() or not on.any():
        return None
    if closed:  # it begins where it is off the other one
        first = int(np.flatnonzero(~on)[0])
        on, shares = np.roll(on, -first), np.roll(shares, -first)
    steps = np.diff(shares)
    if places.outline.closed:
        steps = (steps + 0.5) % 1.0 - 0.5
    even = np.abs(steps) * places.length * (FINE - 1) / line.length
    ahead = np.sign(steps) * (np.abs(even - 1) < LENGTH) * (on[1:] & on[:-1])
    runs = np.split(np.arange(len(ahead)), np.flatnonzero(np.diff(ahead)) + 1)
    runs = [run for run in runs if ahead[run[0]] != 0]
    if not runs:
        return None
    best = max(runs, key=lambda run: (len(run), -run[0]))
    length = float(np.abs(steps[best]).sum())
    if length * places.length < LONG * scale or length > 1 - REST:
        return None
    start, end = float(shares[best[0]]), float(shares[best[0]] + steps[best].sum())
    low = min(start, end)
    return low - np.floor(low), low - np.floor(low) + length


def _painted_alike(line: Item, item: Item) -> bool:
    """Whether two lines are of one weight and colour."""
    return bool(
        abs(line.width - item.width) <= 0.2 * item.width
        and (np.abs(line.colour - item.colour) <= 0.05).all()
    )


def opaque(item: Item) -> bool:
    """Whether an item is seen as a plain stroke that hides what is behind it."""
    stroke = item.style.stroke
    if stroke is None or stroke.dashes or item.painted is not None:
        return False
    alpha = 1.0 if isinstance(stroke.paint, Gradient) else stroke.paint.alpha
    return alpha * item.style.opacity > 0.999


@dataclass(frozen=True, slots=True, eq=False)
class _Lines:
    """Numbers of open lines among a scene's items, and what tells which may lie on another one."""

    numbers: Index
    lengths: Floats
    widths: Floats
    colours: Floats
    boxes: Floats

    @classmethod
    def of(cls, items: Sequence[Item], numbers: list[int]) -> "_Lines":
        """Of the items of some numbers."""
        lines = [items[k] for k in numbers]
        return cls(
            np.array(numbers, np.intp),
            np.array([line.length for line in lines]),
            np.array([line.width for line in lines]),
            np.array([line.colour for line in lines]),
            np.array([line.box for line in lines]),
        )

    def near(self, item: Item, scale: float) -> list[int]:
        """Numbers of those that are painted like an item, no longer and within its box."""
        fits = self.lengths <= (1 + LENGTH) * item.length
        fits &= abs(self.widths - item.width) <= 0.2 * item.width
        fits &= (np.abs(self.colours - item.colour) <= 0.05).all(axis=1)
        fits &= (self.boxes[:, 0] >= item.box[0] - ON * scale).all(axis=1)
        fits &= (self.boxes[:, 1] <= item.box[1] + ON * scale).all(axis=1)
        return [int(k) for k in self.numbers[fits]]


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
    """Spans that do not overlap, the longest first; nor does a tiny one lie within another."""
    kept: list[tuple[float, float, int]] = []
    for start, end, j in sorted(spans, key=lambda s: (round(s[0] - s[1], 6), s)):
        shifts = (-1.0, 0.0, 1.0) if closed else (0.0,)
        clear = all(
            min(end, e + shift) - max(start, s + shift) < min(REST, (end - start) / 2)
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
