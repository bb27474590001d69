"""Whether what lies on a thing that stands still is exchanged although that thing stays.

The sign on a folder becomes the sign on another folder only where both drawn alone would: else one
would melt into the other while all about them stands still.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from shapetween.base.arrays import Mask
from shapetween.model.part import CurveTrack
from shapetween.scene.assign import Role, Roles
from shapetween.scene.disturbance import waviness
from shapetween.scene.doubtful import CERTAIN, nothing_corresponds
from shapetween.scene.exchange import too_different
from shapetween.scene.faces import have_faces
from shapetween.scene.hosts import lies_on, stands_still
from shapetween.scene.relations import Scene, perceive

__all__ = ["contents_apart"]

#: Cost of a pair below which it is one thing in one place, which stays. Larger, and a digit on a
#: calendar becomes the hole of a guitar; smaller, and the shine of a case leaves to come again.
SURE = -1.0


def contents_apart(
    a: Scene, b: Scene, roles: Roles, tracks: Mapping[int, Sequence[CurveTrack]]
) -> set[int]:
    """Indices of the pairs to give up since all that lies on something is to be exchanged.

    What is alike in place stands still, whatever else lies there.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
    tracks : mapping of int to sequence of CurveTrack
        By pair.
    """
    found: set[int] = set()
    if not any(role.reason == "matched" for role in roles.pairs):
        return found
    scale = (a.scale + b.scale) / 2
    same = [role for role in roles.pairs if role.reason == "alike" or round(role.cost, 6) < SURE]
    stays = (
        np.isin(np.arange(len(a.items)), [role.first for role in same]),
        np.isin(np.arange(len(b.items)), [role.second for role in same]),
    )
    has_face = have_faces(a, b)
    for role in roles.pairs:
        i, j = role.first, role.second
        one, other = a.items[i], b.items[j]
        if a.sheets[i] or not (one.closed and other.closed):
            continue
        if not stands_still(one.box, other.box, scale) or (has_face[0][i] and has_face[1][j]):
            continue
        on_one = lies_on(a, i) & ~stays[0]
        if not on_one.any():
            continue
        on_other = lies_on(b, j) & ~stays[1]
        if on_other.any():
            found |= _apart((a, b), (i, j), (on_one, on_other), roles, tracks)
    return found


def _apart(
    scenes: tuple[Scene, Scene],
    hosts: tuple[int, int],
    on_it: tuple[Mask, Mask],
    roles: Roles,
    tracks: Mapping[int, Sequence[CurveTrack]],
) -> set[int]:
    """The pairs among what lies on one thing, if that is as different as whole drawings are."""
    own = [np.flatnonzero(side).tolist() for side in on_it]
    among = {
        k
        for k, role in enumerate(roles.pairs)
        if role.reason == "matched" and on_it[0][role.first] and on_it[1][role.second]
    }
    if not among:
        return set()
    one, other = (
        perceive([scene.items[k] for k in mine], scene.items[host].box)
        for scene, mine, host in zip(scenes, own, hosts, strict=True)
    )
    pairs = [roles.pairs[k] for k in sorted(among)]
    within = Roles(
        tuple(
            Role(own[0].index(role.first), own[1].index(role.second), role.cost, role.reason)
            for role in pairs
        ),
        tuple(n for n, k in enumerate(own[0]) if k not in {role.first for role in pairs}),
        tuple(n for n, k in enumerate(own[1]) if k not in {role.second for role in pairs}),
    )
    if len(own[0]) == len(own[1]) == 1:
        certain = round(pairs[0].cost, 6) < CERTAIN
        apart = not certain and nothing_corresponds(one.items[0], other.items[0])
    else:
        behind = np.zeros(len(own[0]), dtype=bool), np.zeros(len(own[1]), dtype=bool)
        waves = waviness(one, other, within, {n: tracks[k] for n, k in enumerate(sorted(among))})
        apart = too_different(one, other, within, behind, waves)
    return among if apart else set()
