"""Closed lines that would be torn open to become open ones."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Mask
from shapetween.scene.forms import Dot
from shapetween.scene.items import Item
from shapetween.scene.places import Places
from shapetween.scene.relations import Scene

__all__ = ["closes", "folds", "opens", "torn"]

#: Greatest distance of an open line's ends, as a share of its length, for a ring to open there.
#: Larger, and cups unzip to become waves; smaller, and rings with a mouth are left alone.
MOUTH = 0.33

#: Greatest distance, as a share of the drawing, of a line that lies along a ring, so that the rest
#: of the ring may open. Larger, and what is torn is not near; smaller, and a cloud does not open
#: for its rain.
ALONG = 0.08

#: How near a line's ends are to a ring that folds flat onto it, and how near to the ends of the
#: ring's own length, as shares of the drawing. Larger, and whatever is closed collapses into
#: whatever is open; smaller, and an eye does not close.
NEAR = 0.1

#: Greatest length of a line that a ring folds flat onto, beside the distance of its ends. Larger,
#: and a box collapses into three of its sides.
FLAT = 1.35


def torn(a: Scene, b: Scene) -> Mask:
    """Pairs of a closed and an open line that no movement keeps whole, (N, M)."""
    found = np.zeros((len(a.items), len(b.items)), dtype=bool)
    scale = (a.scale + b.scale) / 2
    for one, other, pairs in ((a, b, found), (b, a, found.T)):
        rings = [
            k
            for k, item in enumerate(one.items)
            if item.closed and not item.filled and not isinstance(one.forms[k], Dot)
        ]
        if not rings:
            continue
        boxes = np.array([one.items[k].box for k in rings])
        for j, line in enumerate(other.items):
            if line.filled or line.closed or isinstance(other.forms[j], Dot):
                continue
            if mouth(line) <= MOUTH:
                continue
            pairs[rings, j] = True
            ends = line.outer.curves[[0, -1], [0, 3]]
            off = np.maximum(boxes[:, :1] - ends, ends - boxes[:, 1:]).max(axis=(1, 2))
            for n in np.flatnonzero(off < max(NEAR, ALONG) * scale).tolist():
                pairs[rings[n], j] = not closes(one.items[rings[n]], line, scale)
    return found


def opens(
    one: Sequence[Item], other: Sequence[Item], lines: tuple[Sequence[Item], Sequence[Item]]
) -> bool:
    """Whether one area would be torn open to become one other, both moving as lines.

    A D would be that becomes a P.
    """
    if not all(len(side) == 1 for side in (one, other, *lines)):
        return False
    if not (one[0].filled and other[0].filled) or any(side[0].filled for side in lines):
        return False
    first, second = lines[0][0], lines[1][0]
    scale = (first.extent + second.extent) / 2
    return first.closed != second.closed and not closes(first, second, scale)


def mouth(line: Item) -> float:
    """Distance of an open line's ends, as a share of its length."""
    ends = line.outer.curves[[0, -1], [0, 3]]
    return float(np.linalg.norm(ends[1] - ends[0])) / max(line.length, 1e-12)


def closes(one: Item, other: Item, scale: float) -> bool:
    """Whether of a closed and an open line one comes to lie on the other with little way."""
    if one.filled or other.filled or one.closed == other.closed:
        return False
    ring, line = (one, other) if one.closed else (other, one)
    return _along(ring, line, scale) or folds(ring, line, scale)


def _along(ring: Item, line: Item, scale: float) -> bool:
    """Whether a line lies along a ring everywhere, and along most of it."""
    places = Places(ring.outer)
    away = np.linalg.norm(places.point(places.nearest(line.points)) - line.points, axis=1)
    return bool(away.max() < ALONG * scale and line.length > ring.length / 2)


def folds(ring: Item, line: Item, scale: float) -> bool:
    """Whether a ring may become a line by closing as an eye does, both its sides coming together.

    Its two places next to the line's ends are as far apart as it is long, the line is nearly
    straight, and there and back it looks the same, with its round ends and corners.
    """
    if ring.painted is not None or line.painted is not None:
        return False
    stroke = line.style.stroke
    if stroke is None or stroke.dashes or not stroke.cap == stroke.join == "round":
        return False
    ends = line.outer.curves[[0, -1], [0, 3]]
    way = ends[1] - ends[0]
    length = float(np.linalg.norm(way))
    if line.length > FLAT * length:
        return False
    places = Places(ring.outer)
    corners = places.point(places.nearest(ends))
    if float(np.linalg.norm(corners - ends, axis=1).max()) > NEAR * scale:
        return False
    across = ring.points @ way / length
    own = corners @ way / length
    return bool(max(own[0] - across.min(), across.max() - own[1]) <= NEAR * scale)
