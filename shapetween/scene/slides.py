"""Lines that change places: brackets that turn inside out each slide to where their like is.

Each of them looks just as another one does afterwards, and no other way round. Bent into what is
nearest they would be steps and stairs on the way.
"""

import numpy as np

from shapetween.base.arrays import Mask
from shapetween.scene.relations import Scene

__all__ = ["lines_that_slide"]

#: Most lines that are looked at; of more, some pass what they have nothing to do with.
MOST = 6

#: Distance from its like, as a share of the drawing, up to which a line is just that.
JUST = 4e-3

#: Least way, as a share of the drawing, that one of them goes. Smaller, and what only makes room
#: counts as changing places.
FAR = 0.1

#: Straightness from which on a line has no form to keep: the way between its ends beside its
#: length.
STRAIGHT = 0.95


def lines_that_slide(a: Scene, b: Scene) -> list[tuple[int, int]]:
    """Who becomes whom where drawings are the same bent lines at other places; else nobody."""
    count = len(a.items)
    if not 2 <= count <= MOST or len(b.items) != count:
        return []
    if any(item.filled or item.closed for scene in (a, b) for item in scene.items):
        return []
    if any(_straight(scene).any() for scene in (a, b)):
        return []
    scale = (a.scale + b.scale) / 2
    one, other = (np.stack([item.points for item in scene.items]) for scene in (a, b))
    middles = [points.mean(axis=1, keepdims=True) for points in (one, other)]
    ways = [
        np.linalg.norm((one - middles[0])[:, None] - (other - middles[1])[:, ::step], axis=-1).max(
            axis=-1
        )
        for step in (1, -1)
    ]
    alike = np.minimum(*ways) < JUST * scale
    if (alike.sum(axis=0) != 1).any() or (alike.sum(axis=1) != 1).any():
        return []
    apart = np.linalg.norm(middles[0] - middles[1][alike.argmax(axis=1)], axis=-1)
    if apart.min() < FAR * scale:
        return []
    return [(i, int(j)) for i, j in enumerate(alike.argmax(axis=1))]


def _straight(scene: Scene) -> Mask:
    """Which lines are nearly straight, (N,)."""
    ends = np.array([item.points[-1] - item.points[0] for item in scene.items])
    lengths = np.array([item.length for item in scene.items])
    return np.asarray(np.hypot(ends[:, 0], ends[:, 1]) > STRAIGHT * lengths)
