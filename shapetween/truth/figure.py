"""Shapes that bend: an articulated figure, a strip that unrolls; shapes that are mapped as a whole.

Joint angles change at an even rate, so what really happens in between is known.
"""

from collections.abc import Callable, Iterator

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.polygon import corner_sines
from shapetween.geometry.rotation import rotations
from shapetween.mesh.pair import MeshPair
from shapetween.truth.case import TIMES, Case

__all__ = ["SCENES"]

#: Least corner sine of a face at both ends.
LEAST_SINE = 0.12

#: Largest angle of a joint either way, degrees. A bar at a joint stands at half of it.
LIMIT = 80.0

# The trunk: shoulders, armpits, neck and hips.
_TRUNK = np.array(
    [
        [-0.30, -1.00], [-0.10, -1.00], [0.10, -1.00], [0.30, -1.00],
        [-0.30, -0.75], [-0.10, -0.75], [0.10, -0.75], [0.30, -0.75],
        [-0.25, 0.00], [0.00, 0.05], [0.25, 0.00],
    ]
)  # fmt: skip
_TRUNK_QUADS = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [4, 5, 9, 8], [6, 7, 10, 9]]
_TRUNK_TRIANGLES = [[5, 6, 9]]
#: Root of each limb, right end of its bar first as it leaves, and the direction it leaves in.
_ROOTS = [
    ((0, 4), (-1.0, 0.0)),
    ((7, 3), (1.0, 0.0)),
    ((8, 9), (0.0, 1.0)),
    ((9, 10), (0.0, 1.0)),
    ((2, 1), (0.0, -1.0)),
]
#: Steps along a limb from its root; at the first and third of them is a joint.
_ARM, _LEG, _HEAD = (0.14, 0.22, 0.20, 0.20, 0.18), (0.14, 0.28, 0.26, 0.26, 0.24), (0.10, 0.3)
_STEPS = [_ARM, _ARM, _LEG, _LEG, _HEAD]
_WIDTHS = [0.085, 0.085, 0.10, 0.10, 0.14]
"""Half widths of the limbs."""


def _chain(root: Points, leaving: Points, steps: Floats, angles: Floats, width: float) -> Points:
    """Bars of a limb, (F, n, 2, 2): its right and left ends.

    Parameters
    ----------
    root : (2,) float64
        Middle of the first bar, which is not among the result.
    leaving : (2,) float64
        Unit direction of the first step.
    steps : (n,) float64
    angles : (F, n) float64
        How far the limb bends at the end of each step; the bar there stands half way.
    width : float
        Half the length of a bar.
    """
    before = np.cumsum(angles, axis=1) - angles
    turn = rotations(before) @ leaving
    middles = root + np.cumsum(steps[:, None] * turn, axis=1)
    across = rotations(before + angles / 2 + np.pi / 2) @ leaving
    return np.stack([middles + width * across, middles - width * across], axis=2)


def _figure_faces() -> tuple[Index, Index]:
    quads = list(_TRUNK_QUADS)
    count = len(_TRUNK)
    for (bar, _), steps in zip(_ROOTS, _STEPS, strict=True):
        for _ in steps:
            quads.append([bar[0], bar[1], count + 1, count])
            bar, count = (count, count + 1), count + 2
    return np.array(quads), np.array(_TRUNK_TRIANGLES)


def _figure(joints: Floats) -> Points:
    """Vertices of the figure, (F, V, 2), for joint angles (F, 5 limbs, 2), radians."""
    parts = [np.broadcast_to(_TRUNK, (len(joints), *_TRUNK.shape))]
    for limb, ((bar, leaving), steps, width) in enumerate(
        zip(_ROOTS, _STEPS, _WIDTHS, strict=True)
    ):
        angles = np.zeros((len(joints), len(steps)))
        angles[:, 0] = joints[:, limb, 0]
        if len(steps) > 2:
            angles[:, 2] = joints[:, limb, 1]
        root = _TRUNK[list(bar)].mean(axis=0)
        bars = _chain(root, np.array(leaving), np.array(steps), angles, width)
        parts.append(bars.reshape(len(joints), -1, 2))
    return np.concatenate(parts, axis=1)


def _between(first: Floats, last: Floats) -> Floats:
    """Even steps at 0, `TIMES` and 1."""
    t = np.concatenate([[0.0], TIMES, [1.0]]).reshape(-1, *[1] * first.ndim)
    return np.asarray((1 - t) * first + t * last)


def _figures(family: str, degrees: tuple[float, ...]) -> Callable[..., Iterator[Case]]:
    """Figures whose joints change by up to each of some angles in turn."""
    quads, triangles = _figure_faces()

    def scenes(rng: np.random.Generator) -> Iterator[Case]:
        made = 0
        while True:
            change = degrees[made % len(degrees)] * rng.uniform(0.5, 1.0, (5, 2))
            change[rng.integers(5), rng.integers(2)] = degrees[made % len(degrees)]
            change *= rng.choice([-1, 1], (5, 2))
            change[4] *= 0.3  # a head nods less
            room = LIMIT - np.abs(change) / 2
            middle = rng.uniform(-1, 1, (5, 2)) * room
            ends = np.deg2rad(np.stack([middle - change / 2, middle + change / 2]))
            vertices = _figure(_between(*ends))
            sines = [corner_sines(vertices[[0, -1]][:, faces]) for faces in (quads, triangles)]
            if min(s.min() for s in sines) < LEAST_SINE:
                continue
            made += 1
            pair = MeshPair(vertices[0], vertices[-1], quads, triangles)
            yield Case(family, pair, vertices[1:-1], free=True)

    return scenes


def _strips(rng: np.random.Generator) -> Iterator[Case]:
    """Strips that curl up, past half a turn."""
    while True:
        count = int(rng.integers(16, 25))
        total = np.deg2rad(rng.uniform(200, 330)) * rng.choice([-1, 1])
        bends = rng.uniform(0.6, 1.4, count)
        bends *= total / bends.sum()
        start = rng.uniform(-0.2, 0.2) * bends
        angles = _between(start, bends)
        bars = _chain(
            np.zeros(2), np.array([1.0, 0.0]), np.full(count, 1.0), angles, rng.uniform(0.5, 1.2)
        )
        vertices = bars.reshape(len(bars), -1, 2)
        first = 2 * np.arange(count - 1)
        quads = np.stack([first + 1, first + 3, first + 2, first], axis=1)
        pair = MeshPair(vertices[0], vertices[-1], quads)
        yield Case("strip past half a turn", pair, vertices[1:-1], free=True)


def _mapped(family: str, uneven: float) -> Callable[..., Iterator[Case]]:
    """A grid turned and scaled, and stretched by up to `uneven`; its centre goes straight."""

    def scenes(rng: np.random.Generator) -> Iterator[Case]:
        x, y = np.meshgrid(np.arange(5.0), np.arange(4.0))
        source = np.stack([x.ravel(), y.ravel()], axis=1)
        source = source - source.mean(axis=0)
        first = (np.arange(3)[:, None] * 5 + np.arange(4)).ravel()
        quads = np.stack([first, first + 1, first + 6, first + 5], axis=1)
        t = np.concatenate([[0.0], TIMES, [1.0]])
        while True:
            angle = rng.uniform(-3.0, 3.0)
            way = rotations(np.array(rng.uniform(0, np.pi)))
            sizes = rng.uniform(0.5, 2.0) * np.exp(uneven * np.array([1.0, -1.0]))
            stretch = way @ np.diag(sizes) @ way.T
            linear = _between(np.eye(2), stretch)
            shift = rng.uniform(-3, 3, 2)
            vertices = source @ np.swapaxes(rotations(t * angle) @ linear, 1, 2)
            vertices = vertices + t[:, None, None] * shift
            yield Case(family, MeshPair(vertices[0], vertices[-1], quads), vertices[1:-1])

    return scenes


SCENES: dict[str, Callable[[np.random.Generator], Iterator[Case]]] = {
    "figure, joints 15 to 60": _figures("figure, joints 15 to 60", (15, 30, 45, 60)),
    "figure, joints 75 to 150": _figures("figure, joints 75 to 150", (75, 90, 120, 150)),
    "strip past half a turn": _strips,
    "similarity": _mapped("similarity", 0.0),
    "affine map": _mapped("affine map", 0.4),
}
"""Endless generators of scenes by family."""
