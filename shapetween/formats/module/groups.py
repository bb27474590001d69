"""Groups of parts as elements for a script to set: masks, filters, blending, opacity.

A nest is ``[groups, members]``: each group ``[group around it, node, definitions]``, -1 where there
is none, in the order in which they are opened; and for each part of the movement the group that it
is in. Nodes are those of `shapetween.formats.module.styles`; what is in a group goes into the
innermost element of its node.
"""

from typing import Any

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.formats.module.styles import moving_node
from shapetween.model.movement import Movement
from shapetween.model.paint import Group
from shapetween.svg.write.animate_groups import group_tracks, members_of, paths_of
from shapetween.svg.write.groups import Nest
from shapetween.svg.write.plain_elements import group_elements

__all__ = ["nest"]


def nest(movement: Movement, times: Floats, decimals: int, tolerance: float) -> list[Any]:
    """The groups of a movement, and which of them each part is in; both empty if there are none.

    Parameters
    ----------
    movement : Movement
    times : (S,) float64
        At which groups are looked at; the first and the last are taken from inside.
    decimals : int
        For lengths.
    tolerance : float
        How far lengths may be off between two keyframes, in user units.
    """
    first, last = movement.at(np.array([0.0, 1.0]))
    inside = np.clip(times, 1e-6, 1 - 1e-6)
    members = members_of(movement.parts, (first.shapes, last.shapes), inside)
    tracks = group_tracks(members)
    if not tracks:
        return [[], []]
    opened: list[list[Any]] = []

    def add(around: int, group: Group) -> int:
        track = tracks[group.key]
        fades = any(each.share < 1 for each in track)
        samples = [group_elements(each, movement.box, decimals, fades=fades) for each in track]
        nodes = [
            moving_node([sample[k] for sample in samples], times, tolerance)
            for k in range(len(samples[0]))
        ]
        opened.append([around, *nodes])
        return len(opened) - 1

    inner = Nest(-1, add)
    places = [inner.at(path) for path in paths_of(members)]
    return [opened, places]
