"""What the page shows of a movement: which shapes became which, and which points of lines."""

from typing import Any, TypeAlias

import numpy as np

from shapetween.api import Morph
from shapetween.base.arrays import Affine, Points
from shapetween.geometry.affine import mapped
from shapetween.geometry.bezier import evaluate

__all__ = ["Ring", "line_rings", "shape_pairs"]

Ring: TypeAlias = tuple[str, bool, bool, Points, Points]
"""Name, whether it is a hole, whether it is closed, and matched points of both drawings."""

#: Points that a ring is shown by, about: enough for the eye and the hand.
POINTS = 256

#: Most rings whose points are shown; of a drawing of hundreds of parts none can be told apart.
MOST_RINGS = 60


def line_rings(leg: Morph, first: Affine, second: Affine) -> list[Ring]:
    """Matched points of what moves in another way than outlines do: lines, simple forms.

    Parameters
    ----------
    leg : Morph
    first, second : (2, 3) float64
        From the movement's frame to each drawing's own units.
    """
    found: list[Ring] = []
    for part in leg.prepared.movement.parts:
        if part.only is not None or part.areas or len(found) >= MOST_RINGS:
            continue
        ends = part.curves(np.array([0.0, 1.0]))
        start = 0
        for count, closed in zip(part.rings, part.closed, strict=True):
            steps = max(2, POINTS // count)
            points = evaluate(ends[:, start : start + count], np.arange(steps) / steps)
            flat = points.reshape(2, -1, 2)
            if not closed:
                flat = np.concatenate([flat, ends[:, start + count - 1 : start + count, 3]], axis=1)
            a, b = mapped(flat[0], first), mapped(flat[1], second)
            if np.ptp(a, axis=0).any() and np.ptp(b, axis=0).any():
                found.append((part.name, False, bool(closed), a, b))
            start += count
    return found


def shape_pairs(leg: Morph) -> list[dict[str, Any]]:
    """Shapes of both drawings, counted from 1, that become each other; 0 stands for none."""
    scene = leg.prepared.scene
    if scene is None:
        return [{"a": 1, "b": 1}]
    a, b = (half.items for half in scene.scenes)
    found = [(a[role.first].shape + 1, b[role.second].shape + 1) for role in scene.roles.pairs]
    found += [(a[k].shape + 1, 0) for k in scene.roles.disappearing]
    found += [(0, b[k].shape + 1) for k in scene.roles.appearing]
    return [{"a": one, "b": other} for one, other in dict.fromkeys(found)]
