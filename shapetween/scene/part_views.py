"""What a picture of a scene shows: who becomes whom, and what stays alone."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import IDENTITY, compose, mapped, mean_scale
from shapetween.scene.items import Item
from shapetween.scene.movement import SceneMovement
from shapetween.svg.write.part_panels import Drawn, PartView

__all__ = ["part_views"]


def part_views(scene: SceneMovement, back: Affine) -> tuple[PartView, ...]:
    """All pairs, then what goes alone, then what comes alone.

    Parameters
    ----------
    scene : SceneMovement
    back : (2, 3) float64
        From the units that it moves in, which are the first drawing's, to the second one's own.
    """
    first, second = (one.items for one in scene.scenes)
    if scene.frame is not None:
        back = compose(back, scene.frame.forth)
    roles = scene.roles
    pairs = [
        PartView(
            _drawn(first, role.first),
            _drawn(second, role.second, back),
            role.cost,
            role.reason,
        )
        for role in roles.pairs
    ]
    going = zip(roles.disappearing, roles.disappearing_costs, strict=True)
    coming = zip(roles.appearing, roles.appearing_costs, strict=True)
    return (
        *pairs,
        *(PartView(_drawn(first, k), None, cost, "alone") for k, cost in going),
        *(PartView(None, _drawn(second, k, back), cost, "alone") for k, cost in coming),
    )


def _drawn(items: Sequence[Item], k: int, matrix: Affine = IDENTITY) -> Drawn:
    """An item as the picture shows it, mapped; its number stands where it is seen."""
    import shapely

    item = items[k]
    covers = [one.drawn for one in items[k + 1 :] if one.drawn.intersects(item.drawn)]
    seen = item.drawn.difference(shapely.union_all(covers))
    place = (item.drawn if seen.is_empty else seen).point_on_surface()
    label = np.asarray(item.points[len(item.points) // 2])
    if item.filled and not place.is_empty:
        label = np.array([place.x, place.y])
    rings = tuple(ring.transformed(matrix) for ring in item.rings)
    width = 0.0 if item.filled else mean_scale(matrix) * item.width
    return Drawn(k, item.shape + 1, item.name, rings, width, mapped(label, matrix))
