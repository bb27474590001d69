"""How drawings that are exchanged go and come: what of them stays, when, and to which place."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Points
from shapetween.scene.assign import Role, Roles
from shapetween.scene.disturbance import floods
from shapetween.scene.exchange import Behind, in_lines
from shapetween.scene.forms import RoundedBox
from shapetween.scene.relations import Scene, drawn_box
from shapetween.scene.unmatched.going import Going
from shapetween.scene.unmatched.presence import Leaving

__all__ = ["exchange_goings", "exchange_roles"]

#: Greatest way, as a share of the drawing, and ratio of sizes of what stays although the drawings
#: are exchanged: the ground that both stand on.
GROUND_WAY, GROUND_SIZES = 0.12, 2.0

#: Greatest difference of colours of the ground.
GROUND_COLOUR = 0.15

#: Opacity from which on a thing below all else is ground. More see-through, and it is the shadow of
#: what stands there: it would stay as a plank below what shrinks.
GROUND_OPACITY = 0.5

#: When the first drawing goes, and when the second comes: it shrinks to nothing first, before half
#: of the time, so that no frame half-way is blank. Of 14 pairs of icons that three saw blindly
#: two found all ready so, one 13. Overlapping, both are a lump in the middle; where one
#: leaps at some size to be the other, a cut is seen; apart, nothing is seen for a while.
GOES, COMES = (0.0, 0.44), (0.44, 1.0)

#: Power of size by which lines thin. At 1 they are pale when small; at 0 what is close clots.
THINS = 0.6


def exchange_roles(
    a: Scene, b: Scene, roles: Roles, cut: tuple[Scene, Scene], behind: Behind
) -> Roles:
    """Roles of drawings that are exchanged: all is alone but what is behind or below it.

    Parameters
    ----------
    a, b : Scene
        As drawn.
    roles : Roles
        Who would become whom.
    cut : (Scene, Scene)
        What those are the roles of: with items that are cut into several.
    behind : (mask, mask)
        What `behind_both` finds in those.
    """
    places = [{id(item): k for k, item in enumerate(scene.items)} for scene in (a, b)]
    staying = []
    for role in roles.pairs:
        first = places[0].get(id(cut[0].items[role.first]))
        second = places[1].get(id(cut[1].items[role.second]))
        if first is None or second is None:
            continue
        if (behind[0][role.first] and behind[1][role.second]) or _is_ground(first, second, a, b):
            staying.append(Role(first, second, role.cost, role.reason))
    ends = {role.first for role in staying}, {role.second for role in staying}
    disappearing, appearing = (
        tuple(k for k in range(len(scene.items)) if k not in own)
        for scene, own in zip((a, b), ends, strict=True)
    )
    return Roles(
        tuple(staying),
        disappearing,
        appearing,
        (np.inf,) * len(disappearing),
        (np.inf,) * len(appearing),
    )


def exchange_goings(a: Scene, b: Scene, roles: Roles) -> tuple[dict[int, Going], dict[int, Going]]:
    """How the items of a drawing that is exchanged go together, and those of the other come.

    They shrink to one place, midway between the middles of both, or on the ground where one stays.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
        What `exchange_roles` gives.
    """
    ends = (a, roles.disappearing, GOES), (b, roles.appearing, COMES)
    place = np.mean([_foot(scene, unmatched) for scene, unmatched, _ in ends], axis=0)
    thins = THINS if in_lines(a, b) else 1.0
    sheet = Going(Leaving((0.0, 1.0), fades=True))
    one, other = (
        {
            k: sheet if scene.sheets[k] else Going(Leaving(window, place, thins=thins))
            for k in unmatched
        }
        for scene, unmatched, window in ends
    )
    return one, other


def _foot(scene: Scene, unmatched: Sequence[int]) -> Points:
    """The middle of what goes or comes, (2,), or its foot where something below it stays."""
    alone = np.zeros(len(scene.items), dtype=bool)
    alone[list(unmatched)] = True
    box = drawn_box(scene.items, scene.sheets | ~alone)
    place = box.mean(axis=0)
    stays = [scene.items[k].box[0, 1] for k in np.flatnonzero(~alone & ~scene.sheets)]
    if stays and min(stays) > place[1]:
        place[1] = box[1, 1]
    return np.asarray(place)


def _is_ground(i: int, j: int, a: Scene, b: Scene) -> bool:
    """Whether a pair is the ground: a disc or box below all else, near by."""
    forms = a.forms[i], b.forms[j]
    if not all(isinstance(form, RoundedBox) for form in forms):
        return False
    ground = a.items[i], b.items[j]
    if max(len(item.holes) for item in ground) > 1 and floods(
        min(item.enclosed.area for item in ground), [item.area for item in ground]
    ):
        return False  # all that is open in it would close before it opens
    scale = (a.scale + b.scale) / 2
    grounds = all(
        scene.parents[k] < 0 and scene.items[k].centre[1] >= _lowest(scene, k)
        for scene, k in ((a, i), (b, j))
    )
    return bool(
        grounds
        and min(a.colours[i, 3], b.colours[j, 3]) > GROUND_OPACITY
        and np.linalg.norm(a.centres[i] - b.centres[j]) < GROUND_WAY * scale
        and abs(np.log(a.sizes[i] / b.sizes[j])) < np.log(GROUND_SIZES)
        and np.abs(a.colours[i] - b.colours[j]).sum() < GROUND_COLOUR
    )


def _lowest(scene: Scene, ground: int) -> float:
    """The lowest middle of all other things of a drawing."""
    return max(
        (
            float(item.centre[1])
            for k, item in enumerate(scene.items)
            if k != ground and not scene.sheets[k]
        ),
        default=-np.inf,
    )
