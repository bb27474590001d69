"""Faces of which one drawing alone shows that they are some: one winks, one wears dark glasses.

Where the other drawing has a face on the same head, what lies there in its place is its like.
"""

import numpy as np

from shapetween.base.arrays import Mask, Points
from shapetween.scene.features import Feature, Features, features_of
from shapetween.scene.forms import RoundedBox
from shapetween.scene.hosts import lies_on, stands_still
from shapetween.scene.relations import Scene, colours_apart
from shapetween.scene.sets import sets_of

__all__ = ["FACIAL", "faces", "features_of_both", "have_faces"]

#: What lies on a face.
FACIAL = Feature.EYE | Feature.BROW | Feature.NOSE | Feature.MOUTH

#: Greatest sum of differences of colours of two heads that are one. Larger, and a clock is the face
#: of a tomato; smaller, and who blushes has another head.
ONE_HEAD = 0.2

#: Greatest way of an eye and of a mouth from where the other face has it, as a share of the width
#: of the head. Larger, and a tear is a mouth; smaller, and eyes cast down are none.
EYE_WAY, MOUTH_WAY = 0.3, 0.35

#: Greatest ratio of sizes, as a logarithm, of an eye and that of the other face, and of mouths.
#: Larger, and dark glasses are an eye; smaller, and a mouth does not open.
EYE_SIZES, MOUTH_SIZES = 0.7, 1.0

#: Greatest sum of differences of colours of a feature and that of the other face. Larger, and a
#: tear is a mouth; smaller, and faces drawn by two hands have nothing in common.
ONE_INK = 0.3

#: How far below the middle of a head mouths are, as a share of its height. Smaller, and a sign in
#: the middle is a mouth; larger, and the mouth of one who looks up is none.
LOW = 0.04

#: How much less far two alike at one height count as eyes than two that are neither. At 1 the
#: snoring beside a sleeping face is its eye.
ROW = 0.5


def features_of_both(a: Scene, b: Scene) -> tuple[Features, Features]:
    """What the items of two drawings are, one face known by the other.

    Parameters
    ----------
    a, b : Scene
        In one frame.
    """
    one, other = features_of(a, sets_of(a)), features_of(b, sets_of(b))
    for (known, scene), (found, beside) in (((one, a), (other, b)), ((other, b), (one, a))):
        if (known.kinds & Feature.EYE).any() and not (found.kinds & FACIAL).any():
            _known_by(known, scene, found, beside)
    return one, other


def have_faces(a: Scene, b: Scene) -> tuple[Mask, Mask]:
    """Which items of two drawings have features of a face on them, (N,) and (M,)."""
    one, other = features_of_both(a, b)
    return faces(a, one), faces(b, other)


def faces(scene: Scene, features: Features) -> Mask:
    """Which items have features of a face on them, (N,)."""
    import shapely

    middles = shapely.points(scene.centres[(features.kinds & FACIAL) > 0])
    return np.array([bool(shapely.contains(i.enclosed, middles).any()) for i in scene.items])


def _known_by(known: Features, scene: Scene, found: Features, beside: Scene) -> None:
    """Write down the features of the face that stands where another one does."""
    heads = np.flatnonzero(known.kinds == Feature.HEAD)
    if len(heads) != 1:
        return
    head = int(heads[0])
    own = _same_head(scene, head, beside)
    if own is None:
        return
    on_it = lies_on(beside, own) & (beside.outlined < 0)
    eyes = [
        int(np.flatnonzero(known.kinds * (known.sides == side) == Feature.EYE)[0])
        for side in (-1, 1)
    ]
    left, right = _eyes(scene, eyes, on_it, beside, own)
    if left is not None and right is not None:
        found.kinds[[left, right]] = Feature.EYE
        found.sides[[left, right]] = -1, 1
        found.twins[[left, right]] = right, left
    mouths = np.flatnonzero(known.kinds & Feature.MOUTH)
    if len(mouths):
        low, high = beside.items[own].box[:, 1]
        below = beside.centres[:, 1] > (low + high) / 2 + LOW * (high - low)
        free = on_it & (found.kinds == 0) & below
        ways = _ways(scene, int(mouths[-1]), free, beside, own, MOUTH_WAY, MOUTH_SIZES)
        if np.isfinite(ways).any():
            found.kinds[ways.argmin()] = Feature.MOUTH
    if (found.kinds & FACIAL).any():
        found.kinds[own] = Feature.HEAD


def _same_head(scene: Scene, head: int, beside: Scene) -> int | None:
    """The item of another drawing that stands where a head does, in its colour."""
    if not isinstance(scene.forms[head], RoundedBox):
        return None
    near = colours_apart(scene.colours[[head]], beside.colours)[0] < ONE_HEAD
    scale = (scene.scale + beside.scale) / 2
    for k in np.flatnonzero(near & ~beside.sheets).tolist():
        same = isinstance(beside.forms[k], RoundedBox) and beside.items[k].filled
        if same and stands_still(scene.items[head].box, beside.items[k].box, scale):
            return int(k)
    return None


def _eyes(
    scene: Scene, eyes: list[int], on_it: Mask, beside: Scene, head: int
) -> tuple[int | None, int | None]:
    """Which two on a head are where the other face has its eyes; two alike rather than others."""
    middle = float(beside.items[head].box[:, 0].mean())
    sides = beside.centres[:, 0] < middle, beside.centres[:, 0] > middle
    left, right = (
        _ways(scene, eye, on_it & side, beside, head, EYE_WAY, EYE_SIZES)
        for eye, side in zip(eyes, sides, strict=True)
    )
    sums = left[:, None] + right
    sizes = np.abs(np.log(beside.sizes[:, None] / beside.sizes))
    level = np.abs(beside.centres[:, None, 1] - beside.centres[:, 1])
    row = (sizes < ROW) & (level < ROW * np.minimum(beside.sizes[:, None], beside.sizes))
    sums = np.where(row, ROW * sums, sums)
    if not np.isfinite(sums).any():
        return None, None
    i, j = np.unravel_index(np.round(sums, 6).argmin(), sums.shape)
    return int(i), int(j)


def _ways(
    scene: Scene, feature: int, may: Mask, beside: Scene, head: int, most: float, sizes: float
) -> Points:
    """How far each item is from a feature of the other face, as a share of the head's width."""
    width = float(np.ptp(beside.items[head].box[:, 0]))
    ways = np.linalg.norm(beside.centres - scene.centres[feature], axis=1) / width
    may = may & (ways < most)
    may &= np.abs(np.log(beside.sizes / scene.sizes[feature])) < sizes
    may &= colours_apart(scene.colours[[feature]], beside.colours)[0] < ONE_INK
    return np.where(may, np.round(ways, 6), np.inf)
