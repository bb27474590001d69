"""Paint order between two drawings' own.

What keeps its place among the others stays in one layer. A pair that must pass another one that it
touches is painted twice, and the upper copy fades.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.scene.assign import Roles
from shapetween.scene.relations import Scene
from shapetween.scene.unmatched.presence import smooth_step

__all__ = ["Layer", "layers_of"]

#: When what must pass another thing is seen to: soon after it has begun, or both are seen through
#: each other; not at once, or it jumps.
PASSES = (0.44, 0.56)


@dataclass(frozen=True, slots=True)
class Layer:
    """One painted thing.

    Attributes
    ----------
    pair : int or None
        Index of the pair.
    disappearing, appearing : int or None
        An item without a partner.
    shown : {"always", "first", "last"}
        Whether a copy is seen always, or fades out or in half way.
    """

    pair: int | None = None
    disappearing: int | None = None
    appearing: int | None = None
    shown: str = "always"


def layers_of(a: Scene, b: Scene, roles: Roles) -> list[Layer]:
    """What is painted, from below to above."""
    pairs = sorted(range(len(roles.pairs)), key=lambda k: roles.pairs[k].first)
    kept = _heaviest(
        [roles.pairs[k].second for k in pairs],
        [float(a.sizes[roles.pairs[k].first]) for k in pairs],
    )
    staying = [pairs[k] for k in kept]
    crossing = [k for k in pairs if k not in set(staying)]
    # Places among those that stay, in either drawing's order.
    placed: list[tuple[float, int, int, Layer]] = []
    for rank, k in enumerate(staying):
        placed.append((float(rank), 0, 0, Layer(pair=k)))

    def place(item: int, second: bool) -> float:
        below = [
            rank
            for rank, k in enumerate(staying)
            if (roles.pairs[k].second if second else roles.pairs[k].first) < item
        ]
        return (max(below) if below else -1) + 0.5

    for k in crossing:
        one = place(roles.pairs[k].first, False)
        other = place(roles.pairs[k].second, True)
        first, second = roles.pairs[k].first, roles.pairs[k].second
        passed = [
            roles.pairs[m] for m in staying[int(min(one, other) + 0.5) : int(max(one, other) + 0.5)]
        ]
        touches = any(a.touching[first, p.first] or b.touching[second, p.second] for p in passed)
        if not touches:
            placed.append((one, 1, first, Layer(pair=k)))
            continue
        placed.append((one, 1, first, Layer(pair=k, shown="first" if one > other else "always")))
        placed.append((other, 1, second, Layer(pair=k, shown="last" if other > one else "always")))
    placed += [(place(k, False), 1, k, Layer(disappearing=k)) for k in roles.disappearing]
    placed += [(place(k, True), 2, k, Layer(appearing=k)) for k in roles.appearing]
    placed.sort(key=lambda entry: entry[:3])
    return [layer for *_, layer in placed]


def _heaviest(values: Sequence[int], weights: Sequence[float]) -> list[int]:
    """Indices of the heaviest increasing subsequence."""
    best: list[float] = []
    before: list[int] = []
    for k, value in enumerate(values):
        options = [(best[i], i) for i in range(k) if values[i] < value]
        top = max(options, default=(0.0, -1))
        best.append(top[0] + weights[k])
        before.append(top[1])
    if not best:
        return []
    k = max(range(len(best)), key=lambda i: best[i])
    found = []
    while k >= 0:
        found.append(k)
        k = before[k]
    return found[::-1]


def share_shown(layer: Layer, t: float) -> float:
    """How much of a layer is seen at one time."""
    low, high = PASSES
    late = float(smooth_step(np.array([(t - low) / (high - low)]))[0])
    return late if layer.shown == "last" else 1 - late
