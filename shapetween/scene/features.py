"""What parts of a drawing are: the body, features of a face, wheels.

Seen by how they lie: two alike at one height on either side of a middle, what lies between and
below them, what stands at the foot. It is no more than evidence for who becomes whom.
"""

from dataclasses import dataclass, replace
from enum import IntFlag

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask
from shapetween.scene.forms import RoundedBox
from shapetween.scene.relations import Scene, colours_apart, in_common
from shapetween.scene.sets import REPEATED, Sets

__all__ = ["MOST_ITEMS", "Feature", "Features", "features_of"]

#: Most items of a drawing that is looked at for faces and wheels. Maps and crowds have none.
MOST_ITEMS = 120

#: How much two of a row differ at most: height as a share of their size, logarithm of sizes, sum of
#: colours; and what their pictures, one of them mirrored, have in common at least.
LEVEL, SIZES, COLOURS, LIKE = 0.4, 0.3, 0.2, 0.55

#: How much a winking eye may be smaller than the other, logarithm, if it is of one colour with it.
WINK, WINK_COLOUR = 0.8, 0.06

#: Least and greatest distance of two of a row: as a multiple of their size, and as a share of the
#: width of what they lie on.
APART, WIDE = 0.9, 0.95

#: Greatest distance of a row's middle, and of what lies between, from the middle of the face, as
#: a share of its width.
MIDDLE = 0.13

#: Greatest size of a feature as a share of the face.
SMALL = 0.5

#: Height of a face, from its middle as a share of its height, above which eyes are.
EYES_ABOVE = 0.12

#: Ratio of sides from which on what lies above the eyes is a brow.
LONG = 1.7

#: How far below a face what lies in its middle belongs to it, as a share of its height.
BELOW = 0.3

#: How much lighter than the eyes a muzzle is; mouths are as dark as they.
LIGHTER = 0.15

#: Width of a nose, as a share of the eyes' distance, from which on it is rather a mouth.
NOSE = 0.62

#: What each thing that lies on it makes a body larger by, as a share, and how many count.
CARRIES, MOST_CARRIED = 0.05, 4

#: Least size of the body, as a share of the drawing's diagonal; and that of what is as large, as a
#: share of its own: then there is no body, but several.
BODY, ALONE = 0.2, 0.97

#: Greatest ratio of sizes of a head and the part of it that a face is on. Larger, and a robot's
#: screen makes its body a head; at 1 the muzzle of an ape is its head.
FRONT = 1.7

#: Least size of a head, as a share of the largest item's, to be the body instead. Smaller, and
#: a snowman is his head; larger, and a clown is his hair.
HEADED = 0.5

#: Height from the middle of the drawing, as a share of its height, below which wheels stand; how
#: far they are apart, as a share of its width; and their greatest size, as a share of the drawing.
FOOT, WHEELBASE, WHEEL = 0.15, 0.3, 0.35


class Feature(IntFlag):
    """What a part may be; several where it is one of them."""

    EYE = 1
    BROW = 2
    CHEEK = 4
    EAR = 8
    NOSE = 16
    MOUTH = 32
    MUZZLE = 64
    WHEEL = 128
    HEAD = 256


@dataclass(frozen=True, slots=True, eq=False)
class Features:
    """What the items of a scene are.

    Attributes
    ----------
    kinds : (N,) intp
        Of `Feature`; 0 of what is none.
    sides : (N,) intp
        -1 left, 1 right, of features that are two; 0 of others.
    twins : (N,) intp
        The other one of features that are two; -1 of others.
    body : int
        The largest item; -1 where none is large, or several are as large.
    """

    kinds: Index
    sides: Index
    twins: Index
    body: int


@dataclass(frozen=True, slots=True)
class _Row:
    """Two alike at one height, from left to right, and what they lie on."""

    left: int
    right: int
    anchor: int


def features_of(scene: Scene, repeated: Sets) -> Features:
    """See what the items are that are not repeated as a pattern."""
    count = len(scene.items)
    kinds, sides = np.zeros(count, dtype=np.intp), np.zeros(count, dtype=np.intp)
    found = Features(kinds, sides, np.full(count, -1, dtype=np.intp), _body(scene))
    if count <= MOST_ITEMS:
        sides_of_boxes = np.array([np.ptp(item.box, axis=0) for item in scene.items])
        ancestors = scene.ancestors
        rows = _rows(scene, repeated.counts >= REPEATED, ancestors, found.body)
        for anchor in sorted({row.anchor for row in rows}):
            own = [row for row in rows if row.anchor == anchor]
            _face(scene, anchor, own, ancestors, sides_of_boxes, found)
        _wheels(scene, rows, found)
        heads = np.flatnonzero(kinds == Feature.HEAD)
        if len(heads) == 1 and found.body >= 0:
            head = int(heads[0])
            if scene.sizes[head] > HEADED * scene.sizes[found.body]:
                return replace(found, body=head)
    return found


def _body(scene: Scene) -> int:
    """The largest item, if it is large; what others lie on counts as a little larger."""
    carried = np.bincount(scene.parents[scene.parents >= 0], minlength=len(scene.items))
    sizes = scene.sizes * (1 + CARRIES * np.minimum(carried, MOST_CARRIED))
    sizes = np.where(scene.sheets | (scene.outlined >= 0), 0.0, sizes)
    largest = int(np.argmax(sizes))
    alone = (sizes > ALONE * sizes[largest]).sum() == 1
    return largest if alone and sizes[largest] > BODY * scene.scale else -1


def _rows(scene: Scene, pattern: Mask, ancestors: Mask, body: int) -> list[_Row]:
    """All twos that are alike at one height, and what they lie on."""
    centres, sizes = scene.centres, scene.sizes
    size = np.sqrt(sizes[:, None] * sizes)
    dx = centres[None, :, 0] - centres[:, None, 0]
    dy = np.abs(centres[:, None, 1] - centres[None, :, 1])
    apart = colours_apart(scene.colours, scene.colours)
    ratio = np.abs(np.log(sizes[:, None] / sizes))
    common = in_common(np.flip(scene.pictures, axis=2), scene.pictures)
    alike = (ratio < SIZES) & (apart < COLOURS) & (np.maximum(common, common.T) > LIKE)
    wink = (ratio < WINK) & (apart < WINK_COLOUR)
    near = (dx > APART * size) & (dy < LEVEL * size)
    whole = scene.sheets | (scene.outlined >= 0) | pattern
    near &= (alike | wink) & ~whole[:, None] & ~whole
    rows: list[_Row] = []
    order = sorted(
        np.argwhere(near).tolist(),
        key=lambda ij: (not alike[tuple(ij)], round(dy[tuple(ij)] / scene.scale, 6), ij),
    )
    for i, j in order:
        shared = np.flatnonzero(ancestors[i] & ancestors[j])
        anchor = int(shared[np.argmin(sizes[shared])]) if len(shared) else body
        if anchor < 0 or anchor in (i, j) or size[i, j] > SMALL * sizes[anchor]:
            continue
        if not alike[i, j] and not len(shared):
            continue
        low, high = scene.items[anchor].box
        middle = (centres[i, 0] + centres[j, 0]) / 2
        width = high[0] - low[0]
        off = abs(middle - scene.centres[anchor, 0])
        if off > MIDDLE * width or (len(shared) and dx[i, j] > WIDE * width):
            continue
        rows.append(_Row(i, j, anchor))
    return rows


def _face(
    scene: Scene,
    anchor: int,
    rows: list[_Row],
    ancestors: Mask,
    boxes: Floats,
    found: Features,
) -> None:
    """Write down which parts of a face each is, if it is one."""
    centres = scene.centres
    low, high = scene.items[anchor].box
    width, height = high - low
    below = np.array([0.0, BELOW * height])  # a mouth may be on what its face stands on
    within = (centres > low).all(axis=1) & (centres < high + below).all(axis=1)
    inside = np.flatnonzero(ancestors[:, anchor] | (within & (np.arange(len(within)) > anchor)))
    paired = {k for row in rows for k in (row.left, row.right)}
    between = [
        k
        for k in inside.tolist()
        if k not in paired
        and scene.outlined[k] < 0
        and abs(centres[k, 0] - scene.centres[anchor, 0]) < MIDDLE * width
        and boxes[k, 0] < 0.8 * width
    ]
    eyes = _eyes(scene, anchor, rows, between, boxes, ancestors)
    if eyes is None:
        return
    head = _head(scene, anchor)
    if not found.kinds[head]:
        found.kinds[head] = Feature.HEAD
    level = (centres[eyes.left, 1] + centres[eyes.right, 1]) / 2
    size = float(np.sqrt(scene.sizes[eyes.left] * scene.sizes[eyes.right]))
    _mark(eyes, Feature.EYE, found)
    for row in rows:
        y = float(centres[[row.left, row.right], 1].mean())
        kind = _row_kind(scene, row, y - level, size, height, boxes, ancestors)
        free = not found.kinds[row.left] and not found.kinds[row.right]
        if kind and free:
            _mark(row, kind, found)
    lower = [k for k in between if centres[k, 1] > level + 0.2 * size]
    apart = float(centres[eyes.right, 0] - centres[eyes.left, 0])
    dark = float(scene.colours[[eyes.left, eyes.right], 0].mean())
    light = scene.colours[:, 0] > dark + LIGHTER
    _nose_and_mouth(scene, lower, anchor, apart, light, boxes, found)


def _head(scene: Scene, anchor: int) -> int:
    """What the thing that a face is on is the front of, or that itself."""
    while True:
        parent = int(scene.parents[anchor])
        if parent < 0 or scene.sizes[parent] > FRONT * scene.sizes[anchor]:
            return anchor
        anchor = parent


def _eyes(
    scene: Scene,
    anchor: int,
    rows: list[_Row],
    between: list[int],
    boxes: Floats,
    ancestors: Mask,
) -> _Row | None:
    """The row that stands out most above something in the middle."""
    low, high = scene.items[anchor].box
    best: tuple[float, _Row] | None = None
    for row in rows:
        pair = [row.left, row.right]
        y = float(scene.centres[pair, 1].mean())
        if not ancestors[pair, anchor].all():
            continue
        middle = max((low[1] + high[1]) / 2, scene.centres[anchor, 1])
        if y > middle + EYES_ABOVE * (high[1] - low[1]):
            continue
        if not any(scene.centres[k, 1] > y for k in between):
            continue
        long = float(np.log(boxes[pair, 0] / np.maximum(boxes[pair, 1], 1e-9 * scene.scale)).max())
        apart = float(scene.centres[row.right, 0] - scene.centres[row.left, 0])
        contrast = float(np.abs(scene.colours[pair] - scene.colours[anchor]).sum(axis=1).mean())
        # Ears and cheeks are wider apart, brows longer; both stand out less.
        score = contrast - 0.5 * max(long, 0.0) - 0.8 * apart / float(high[0] - low[0])
        score = round(score, 6)
        if best is None or score > best[0]:
            best = score, row
    return None if best is None else best[1]


def _row_kind(
    scene: Scene,
    row: _Row,
    below: float,
    size: float,
    height: float,
    boxes: Floats,
    ancestors: Mask,
) -> Feature:
    """What a row is that lies so far below the eyes (negative: above), whose size is given."""
    pair = [row.left, row.right]
    own = float(np.sqrt(scene.sizes[row.left] * scene.sizes[row.right]))
    long = float(
        (boxes[pair].max(axis=1) / np.maximum(boxes[pair].min(axis=1), 1e-9 * scene.scale)).min()
    )
    if abs(below) < 0.6 * max(size, own):
        return Feature.EYE
    if below > 0:
        compact = all(scene.items[k].closed for k in pair) and long < 2.5
        return Feature.CHEEK if compact and ancestors[pair, row.anchor].all() else Feature(0)
    wide = boxes[pair, 0].min() > LONG * boxes[pair, 1].min()
    if (wide or not all(scene.items[k].closed for k in pair)) and -below < 0.35 * height:
        return Feature.BROW
    return Feature.EAR


def _nose_and_mouth(
    scene: Scene,
    below: list[int],
    anchor: int,
    apart: float,
    light: Mask,
    boxes: Floats,
    found: Features,
) -> None:
    """Write down what is nose and what mouth of what lies in the middle below the eyes."""
    lightness = scene.colours[:, 0]
    for k in below:
        # A nose on a muzzle is darker than it, teeth and a tongue are lighter than a mouth.
        inner = [j for j in below if scene.parents[j] == k]
        if (
            light[k]
            and boxes[k, 0] > apart
            and any(
                lightness[j] < lightness[k] and scene.sizes[j] < scene.sizes[k] / 1.5 for j in inner
            )
        ):
            found.kinds[k] = Feature.MUZZLE
    small = [
        k
        for k in below
        if not found.kinds[k]
        and scene.sizes[k] < SMALL * scene.sizes[anchor]
        and (scene.parents[k] not in below or found.kinds[scene.parents[k]] == Feature.MUZZLE)
    ]
    small.sort(key=lambda k: (round(float(scene.centres[k, 1]) / scene.scale, 6), k))
    for rank, k in enumerate(small):
        if len(small) == 1:
            found.kinds[k] = Feature.NOSE | Feature.MOUTH
        elif rank == 0 and (boxes[k, 0] < NOSE * apart or found.kinds[scene.parents[k]]):
            found.kinds[k] = Feature.NOSE
        else:
            found.kinds[k] = Feature.MOUTH


def _wheels(scene: Scene, rows: list[_Row], found: Features) -> None:
    """Write down which two discs at the foot are wheels."""
    (left, top), (right, bottom) = scene.box
    for row in rows:
        pair = [row.left, row.right]
        forms = [scene.forms[k] for k in pair]
        if not all(isinstance(form, RoundedBox) and form.round for form in forms):
            continue
        y = float(scene.centres[pair, 1].mean())
        apart = float(scene.centres[row.right, 0] - scene.centres[row.left, 0])
        low = y > (top + bottom) / 2 + FOOT * (bottom - top)
        small = scene.sizes[pair].max() < WHEEL * scene.scale
        if low and small and apart > WHEELBASE * (right - left) and not found.kinds[pair].any():
            _mark(row, Feature.WHEEL, found)


def _mark(row: _Row, kind: Feature, found: Features) -> None:
    found.kinds[[row.left, row.right]] = kind
    found.sides[row.left], found.sides[row.right] = -1, 1
    found.twins[row.left], found.twins[row.right] = row.right, row.left
