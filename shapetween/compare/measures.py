"""Figures of a movement, at a moment and as a whole; all of the filled shapes that have a partner.

None of them depends on units. Distortion at a moment is measured against the nearer of the two
ends, so that what the drawings themselves ask for is not held against a method: it is what a
method adds. It is that of the inside, which homographies or affine maps carry.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.compare.formulas import conformal_distortion, straightness
from shapetween.compare.skeleton import Skeleton
from shapetween.compare.variants import Variant
from shapetween.geometry.bezier import flatten
from shapetween.geometry.polygon import polygon_area
from shapetween.outline.body import Carried

__all__ = ["COLUMNS", "TIMES", "Column", "Figures", "measure"]

#: Times at which a movement is measured; the halves, thirds, quarters and tenths among them.
TIMES = np.linspace(0.0, 1.0, 61)

#: Chords a curve is measured with.
CHORDS = 6

#: Largest distortion that is counted: a face that folds has no bound, and would hide all others.
MOST_DISTORTED = 20.0

#: Share of the inside that may be worse than what stands for the worst.
WORST_SHARE = 0.01


@dataclass(frozen=True, slots=True)
class Column:
    """One figure of a whole movement.

    Attributes
    ----------
    key : str
    title, meaning : str
        For people.
    unit : {"%", ""}
        Shares are shown in percent.
    judged : bool
        Whether less is better.
    """

    key: str
    title: str
    meaning: str
    unit: str
    judged: bool = True


COLUMNS = (
    Column(
        "self_crossing",
        "Self-crossing",
        "Share of the way on which a drawn outline crosses itself or another of its shape.",
        "%",
    ),
    Column(
        "turned_over",
        "Turned over",
        "Largest share of the inside that is inverted at any moment.",
        "%",
    ),
    Column(
        "distortion",
        "Distortion",
        "Mean ratio of stretches, less one, over the inside and the way, against the nearer end. "
        "The guarded movement is measured on its own, finer faces, which show more of it.",
        "",
    ),
    Column(
        "worst_distortion",
        "Worst place",
        "The same where and when it is worst, but for a hundredth of the inside.",
        "",
    ),
    Column(
        "area_off",
        "Area off path",
        "Largest distance of the area from its straight path, as a share of the larger end.",
        "%",
    ),
    Column(
        "perimeter_off",
        "Perimeter off path",
        "Largest distance of the perimeter from its straight path, likewise.",
        "%",
    ),
    Column(
        "travel",
        "Travel",
        "Mean length of the way of the outline's points, in diagonals of the shapes.",
        "",
        judged=False,
    ),
    Column(
        "jerk",
        "Unevenness",
        "Mean size of the second derivative of the outline's points by time, in diagonals.",
        "",
        judged=False,
    ),
)


@dataclass(frozen=True, slots=True, eq=False)
class Figures:
    """What was measured of one movement.

    Attributes
    ----------
    area, perimeter : (F,) float64
        At `TIMES`, as shares of the larger end's.
    distortion : (F,) float64
        Mean over the inside of the ratio of stretches, less one.
    crossing : (F,) bool
    whole : mapping of str to float
        By the keys of `COLUMNS`.
    """

    area: Floats
    perimeter: Floats
    distortion: Floats
    crossing: Mask
    whole: dict[str, float]

    def to_json(self) -> dict[str, Any]:
        """Plain values, rounded to what they are worth."""
        return {
            **{key: round(value, 6) for key, value in self.whole.items()},
            "over_time": {
                "area": self.area.round(5).tolist(),
                "perimeter": self.perimeter.round(5).tolist(),
                "distortion": self.distortion.round(5).tolist(),
                "self_crossing": self.crossing.tolist(),
            },
        }


def measure(variant: Variant) -> Figures:
    """Measure a variant that has a movement."""
    rings = [ring for body in variant.bodies for ring in _polygons(body)]
    ends = np.concatenate([ring[[0, -1]].reshape(-1, 2) for ring in rings])
    diagonal = float(np.linalg.norm(np.ptp(ends, axis=0)))
    area = np.sum([polygon_area(ring) for ring in rings], axis=0)
    sides = [np.linalg.norm(np.roll(ring, -1, axis=1) - ring, axis=-1) for ring in rings]
    perimeter = np.sum([side.sum(axis=1) for side in sides], axis=0)
    area, perimeter = (path / path[[0, -1]].max() for path in (area, perimeter))
    crossing = np.zeros(len(TIMES), dtype=bool)
    for body in variant.bodies:
        crossing |= ~body.nodes.simple(TIMES, body.path.vertices(TIMES))
    crossing[[0, -1]] = False  # there the drawings are themselves, whatever they do
    distortion, worst, turned = _distortion(variant.skeletons)

    # Each point stands for half of both sides at it, as long as they are at the two ends.
    weights = [side[[0, -1]].mean(axis=0) for side in sides]
    weight = np.concatenate([(w + np.roll(w, 1)) / 2 for w in weights])
    points = np.concatenate(rings, axis=1)
    step = 1.0 / (len(TIMES) - 1)
    ways = np.linalg.norm(np.diff(points, axis=0), axis=-1).sum(axis=0)
    bends = np.linalg.norm(np.diff(points, n=2, axis=0), axis=-1).mean(axis=0) / step**2
    whole = {
        "self_crossing": float(crossing[1:-1].mean()),
        "turned_over": float(turned.max()),
        "distortion": float(distortion.mean()),
        "worst_distortion": float(worst.max()),
        "area_off": straightness(area, TIMES),
        "perimeter_off": straightness(perimeter, TIMES),
        "travel": float(np.average(ways, weights=weight)) / diagonal,
        "jerk": float(np.average(bends, weights=weight)) / diagonal,
    }
    return Figures(area, perimeter, distortion, crossing, whole)


def _polygons(body: Carried) -> list[Floats]:
    """Every ring of a body at `TIMES`, (F, M, 2); holes run the other way."""
    points = flatten(body.curves(TIMES), CHORDS)
    cuts = np.cumsum(np.array(body.counts) * CHORDS)[:-1]
    return np.split(points, cuts, axis=1)


def _distortion(skeletons: Sequence[Skeleton]) -> tuple[Floats, Floats, Floats]:
    """Mean and worst distortion, and the share inverted, at `TIMES`, each (F,)."""
    parts = [skeleton.jacobians(TIMES) for skeleton in skeletons]
    forward = np.concatenate([jacobian for jacobian, _ in parts], axis=1)
    before = np.concatenate([areas for _, areas in parts])
    last = forward[-1]
    growth = np.linalg.det(last)
    after = before * np.abs(growth)
    valid = np.abs(growth) > 0
    back = np.linalg.inv(np.where(valid[:, None, None], last, np.eye(2)))
    measured = []
    for jacobian, areas in ((forward, before), (forward @ back, after * valid)):
        ratio = conformal_distortion(jacobian)
        turned = np.isinf(ratio)
        excess = np.minimum(ratio - 1, MOST_DISTORTED)
        share = areas / areas.sum()
        measured.append((excess @ share, _quantile(excess, share), turned @ share))
    means = np.stack([mean for mean, _, _ in measured])
    nearer = means.argmin(axis=0)
    worst, turned = (
        np.stack([m[k] for m in measured])[nearer, np.arange(len(TIMES))] for k in (1, 2)
    )
    return means.min(axis=0), worst, turned


def _quantile(values: Floats, share: Floats) -> Floats:
    """What all but `WORST_SHARE` of the inside keep below, (F,)."""
    order = np.argsort(values, axis=1)
    reached = np.cumsum(share[order], axis=1)
    place = (reached < 1 - WORST_SHARE).sum(axis=1).clip(max=values.shape[1] - 1)
    return np.asarray(np.take_along_axis(values, order, axis=1)[np.arange(len(values)), place])
