"""Boards of two drawings that are each other's images in perspective, and what moves them.

The board of a game, a calendar on a wall, the faces of dice: quads with what is drawn on them. All
of a board goes over by the homographies of one quad, boards that share corners as one mesh of
quads: the method's own movement, aligned.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.geometry.homography import (
    apply_homography,
    corner_weights,
    homogeneous_weights,
    quad_homographies,
)
from shapetween.interpolate.methods import tween
from shapetween.mesh.pair import MeshPair
from shapetween.scene.boards.quads import corners_of
from shapetween.scene.items import Item
from shapetween.scene.kept.areas import KeptArea
from shapetween.scene.motion.projected import MovingQuads, Projected, pieces_between

__all__ = ["boards_between"]

#: Most quads of a drawing, the largest, that are looked at as boards at once. With fewer, a tile
#: that is no board hides one; more cost time with their square.
MOST_BOARDS = 8

#: Most items of a drawing, the largest, by which it is told which board becomes which. With fewer,
#: boards are told apart by what both have; more take seconds.
MOST_ITEMS = 60

#: Distance of the boxes of two items on a board, as a share of its extent, and of their outlines,
#: as a share of their own and the board's. Smaller, and what is drawn by hand is on no board;
#: larger, and things that merely lie alike on two boards are one.
BOXES, OUTLINES = 0.02, (0.08, 0.004)

#: Difference of two items' colours, and opacities, that are one.
COLOUR = 0.15

#: Fewest items that are a board without one quad round them: three may lie so by chance.
FEWEST = 4

#: Least share of what lies on both boards that must be on both. Smaller, and two tables become each
#: other with all that is on them; larger, and a piece that is moved hides the board.
SHARED = 0.6

#: Turn of a side, radians, or change of its length, as a share, from which on a board is seen in
#: perspective or turned. A board that is only moved and scaled needs no quad to move by.
TURNED = 0.02

#: Distance of two corners, as a share of the drawing, that are one.
ONE = 0.01


@dataclass(frozen=True, slots=True, eq=False)
class _Board:
    """A board of both drawings.

    Attributes
    ----------
    source, target : (4, 2) float64
        The quad that it moves by.
    pairs : list of (int, int)
        Items of both drawings that are each other's images.
    """

    source: Points
    target: Points
    pairs: list[tuple[int, int]]

    @property
    def matrix(self) -> Floats:
        """The homography from the first to the second."""
        return quad_homographies(self.source, self.target)


def boards_between(
    first: Sequence[Item], second: Sequence[Item], method: str
) -> tuple[KeptArea, ...]:
    """Find boards that go over into each other in perspective, with all that is on them.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order and one frame.
    method : str
        How quads move.
    """
    sides = first, second
    if min(map(len, sides)) < 2:
        return ()
    quads = [{k: c for k, i in enumerate(s) if (c := corners_of(i)) is not None} for s in sides]
    found: list[_Board] = []
    left = [set(range(len(side))) for side in sides]
    while True:
        board = _board(sides, quads, left)
        if board is None:
            break
        found.append(board)
        for own, taken in zip(left, zip(*board.pairs, strict=True), strict=True):
            own.difference_update(taken)
    if not any(map(_turns, found)):
        return ()
    moving = _moving(found, method, max(item.extent for item in first))
    return tuple(
        _area(first[i], second[j], moving, k, board.matrix)
        for k, board in enumerate(found)
        for i, j in board.pairs
    )


def _board(
    sides: tuple[Sequence[Item], Sequence[Item]],
    quads: list[dict[int, Points]],
    left: list[set[int]],
) -> _Board | None:
    """The board with most on it, turned least."""
    ranked = [
        [k for _, k in sorted((-round(side[k].area, 9), k) for k in own)]
        for own, side in zip(left, sides, strict=True)
    ]
    bases = [[k for k in r if k in q][:MOST_BOARDS] for r, q in zip(ranked, quads, strict=True)]
    if not (bases[0] and bases[1]):
        return None
    looked = _Looked.of(sides, (ranked[0][:MOST_ITEMS], ranked[1][:MOST_ITEMS]))
    best: tuple[int, float] | None = None
    ends: tuple[Points, Points] | None = None
    for i in bases[0]:
        for j in bases[1]:
            source, corners = quads[0][i], quads[1][j]
            for shift in range(4):
                target = np.roll(corners, -shift, axis=0)
                if corner_weights(source, target).min() <= 0:
                    continue
                count = looked.count(quad_homographies(source, target), sides[1][j].extent)
                rank = -count, round(abs(_turn(source, target)), 6)
                if best is None or rank < best:
                    best, ends = rank, (source, target)
    if ends is None:
        return None
    extent = float(np.ptp(ends[1], axis=0).max())
    matrix = quad_homographies(*ends)
    both = sorted(left[0]), sorted(left[1])
    pairs = [
        (both[0][i], both[1][j])
        for i, j in _Looked.of(sides, both).pairs(matrix, extent)
        if _like(sides[0][both[0][i]], sides[1][both[1][j]], matrix, extent)
    ]
    return _checked(sides, both, ends, pairs)


def _checked(
    sides: tuple[Sequence[Item], Sequence[Item]],
    both: tuple[list[int], list[int]],
    ends: tuple[Points, Points],
    pairs: list[tuple[int, int]],
) -> _Board | None:
    """A board with the quad that it moves by; None if too little of two boards is on both."""
    if len(pairs) < 2:
        return None
    inside = [_on(side, own, q) for side, own, q in zip(sides, both, ends, strict=True)]
    if all(i in inside[0] and j in inside[1] for i, j in pairs):
        enough = len(pairs) >= SHARED * max(map(len, inside))
        return _Board(*ends, pairs) if enough else None
    if len(pairs) < FEWEST:
        return None
    points = np.concatenate([sides[0][i].chords for i, _ in pairs])
    (x0, y0), (x1, y1) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    source = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    matrix = quad_homographies(*ends)
    if homogeneous_weights(matrix, source).min() <= 0:
        return None
    return _Board(source, apply_homography(matrix, source), pairs)


def _on(side: Sequence[Item], own: Sequence[int], corners: Points) -> set[int]:
    """Which items lie on a quad, itself among them."""
    import shapely

    reach = BOXES * float(np.ptp(corners, axis=0).max())
    base = shapely.Polygon(corners).buffer(reach)
    return {k for k in own if base.covers(side[k].drawn)}


@dataclass(frozen=True, slots=True, eq=False)
class _Looked:
    """What of two drawings is compared under many homographies.

    Attributes
    ----------
    chords : (N, 2) float64
        Of all items of the first one.
    starts : (A,) intp
        Where each item's begin.
    boxes : (B, 2, 2) float64
        Of the second one's items.
    may : (A, B) bool
        Which items are of one kind and colour.
    """

    chords: Points
    starts: Index
    boxes: Floats
    may: Mask

    @classmethod
    def of(
        cls, sides: tuple[Sequence[Item], Sequence[Item]], both: tuple[list[int], list[int]]
    ) -> "_Looked":
        items = [[side[k] for k in own] for side, own in zip(sides, both, strict=True)]
        counts = [len(item.chords) for item in items[0]]
        colours = [np.array([item.colour for item in own]) for own in items]
        kinds = [np.array([(i.filled, i.closed, len(i.rings)) for i in own]) for own in items]
        may = np.abs(colours[0][:, None] - colours[1]).sum(axis=-1) < COLOUR
        may &= (kinds[0][:, None] == kinds[1]).all(axis=-1)
        return cls(
            np.concatenate([item.chords for item in items[0]]),
            np.cumsum([0, *counts[:-1]]),
            np.array([item.box for item in items[1]]),
            may,
        )

    def _apart(self, matrix: Floats) -> Floats:
        """How far the boxes of images are from those of the second drawing, (A, B)."""
        weights = homogeneous_weights(matrix, self.chords)
        images = apply_homography(matrix, self.chords)
        low = np.minimum.reduceat(images, self.starts)
        high = np.maximum.reduceat(images, self.starts)
        boxes = np.stack([low, high], axis=1)
        apart = np.abs(boxes[:, None] - self.boxes).max(axis=(-1, -2))
        # What goes past infinity is nowhere.
        apart[np.minimum.reduceat(weights, self.starts) <= 0] = np.inf
        return np.where(self.may, apart, np.inf)

    def count(self, matrix: Floats, extent: float) -> int:
        """How many items have one that their image may be."""
        near = self._apart(matrix) <= BOXES * extent
        return int(min(near.any(axis=1).sum(), near.any(axis=0).sum()))

    def pairs(self, matrix: Floats, extent: float) -> list[tuple[int, int]]:
        """Items and those nearest to their images, one to one."""
        apart = np.round(self._apart(matrix) / extent, 9)
        far = apart > BOXES
        rows, columns = cheapest_pairs(np.where(far, 1.0 + len(apart), apart))
        return [
            (i, j) for i, j in zip(rows.tolist(), columns.tolist(), strict=True) if not far[i, j]
        ]


def _like(one: Item, other: Item, matrix: Floats, extent: float) -> bool:
    """Whether an item's image is another one."""
    import shapely

    image = shapely.LineString(apply_homography(matrix, one.chords))
    own, boards = OUTLINES
    reach = own * other.extent + boards * extent
    return bool(image.hausdorff_distance(shapely.LineString(other.chords)) <= reach)


def _turn(source: Points, target: Points) -> float:
    """By how much a quad turns on the whole, radians."""
    one, other = (q - q.mean(axis=0) for q in (source, target))
    cross = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return float(np.arctan2(cross.sum(), (one * other).sum()))


def _turns(board: _Board) -> bool:
    """Whether some side of a board turns, or becomes longer than the one across."""
    sides = [np.roll(q, -1, axis=0) - q for q in (board.source, board.target)]
    lengths = [np.linalg.norm(own, axis=1) for own in sides]
    angles = np.arctan2(
        sides[0][:, 0] * sides[1][:, 1] - sides[0][:, 1] * sides[1][:, 0],
        (sides[0] * sides[1]).sum(axis=1),
    )
    growth = np.log(lengths[1] / lengths[0])
    return bool(np.abs(angles).max() > TURNED or np.abs(growth[:2] - growth[2:]).max() > TURNED)


def _moving(boards: Sequence[_Board], method: str, scale: float) -> MovingQuads:
    """The movement of all boards' quads, those corners one that are one in both drawings."""
    corners = np.concatenate(
        [np.concatenate([board.source, board.target], axis=1) for board in boards]
    )
    same = np.abs(corners[:, None] - corners).max(axis=-1) < ONE * scale
    used, faces = np.unique(same.argmax(axis=1), return_inverse=True)
    pair = MeshPair(corners[used, :2], corners[used, 2:], faces.reshape(-1, 4))
    return MovingQuads(tween(pair, method), pair.source[pair.quads], pair.quads)


def _area(one: Item, other: Item, moving: MovingQuads, k: int, matrix: Floats) -> KeptArea:
    """What moves two items of a board, each ring to the one that its image is."""
    rings = list(other.rings)
    tracks = []
    for n, ring in enumerate(one.rings):
        image = apply_homography(matrix, ring.curves[:, 0]).mean(axis=0)
        # Holes may be listed in any order.
        away = [float(np.abs(r.curves[:, 0].mean(axis=0) - image).sum()) for r in rings]
        nearest = rings.pop(0 if n == 0 else int(np.argmin(np.round(away, 9))))
        ends = (ring, nearest) if n == 0 else (ring.reversed(), nearest.reversed())
        tracks.append(Projected(pieces_between(*ends, matrix), moving, k))
    return KeptArea(one, other, tuple(tracks))
