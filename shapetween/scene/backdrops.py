"""What everything lies on in both drawings: cards, plates and frames that stay where they are."""

import numpy as np

from shapetween.scene.assign import Roles
from shapetween.scene.faces import FACIAL, features_of_both
from shapetween.scene.forms import RoundedBox
from shapetween.scene.relations import Scene

__all__ = ["backdrops", "one_is_a_face"]

#: Greatest way, as a share of the drawing, and logarithm of sizes, of what stays. Larger, and a
#: panel that moves is taken for a card; smaller, and cards drawn anew are not known.
WAY, SIZES = 0.06, 0.2

#: Share of all other things, by size, that lie on it. Above, and a card is none whose picture
#: looks over its edge; below, and the larger half of a drawing is a card.
COVERED = 0.9


def backdrops(a: Scene, b: Scene, roles: Roles) -> tuple[int, ...]:
    """Indices of the pairs that everything else lies on.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
    """
    scale = (a.scale + b.scale) / 2
    kinds = [features.kinds & FACIAL for features in features_of_both(a, b)]
    found = []
    for k, role in enumerate(roles.pairs):
        i, j = role.first, role.second
        if not (isinstance(a.forms[i], RoundedBox) and isinstance(b.forms[j], RoundedBox)):
            continue
        away = float(np.linalg.norm(a.centres[i] - b.centres[j]))
        if away > WAY * scale or abs(np.log(a.sizes[i] / b.sizes[j])) > SIZES:
            continue
        ends = ((a, i), (b, j))
        # Of two faces the head is no card: they look another way when what is on it moves.
        face = all(
            own[scene.parents == head].any() for own, (scene, head) in zip(kinds, ends, strict=True)
        )
        if all(_is_below_all(*end) for end in ends) and not face:
            found.append(k)
    return tuple(found)


def _is_below_all(scene: Scene, card: int) -> bool:
    others = ~(scene.sheets | (scene.outlined == card))
    others[card] = False
    whole = float(scene.sizes[others].sum())
    lying = float(scene.sizes[others & scene.ancestors[:, card]].sum())
    return whole > 0 and lying > COVERED * whole


def one_is_a_face(a: Scene, b: Scene, first: int, second: int) -> bool:
    """Whether one of two things has a face on it, and there is none in all the other drawing."""
    ends = (a, first), (b, second)
    kinds = [features.kinds & FACIAL for features in features_of_both(a, b)]
    on_it = [
        bool(own[scene.ancestors[:, k]].any()) for own, (scene, k) in zip(kinds, ends, strict=True)
    ]
    return on_it[0] != on_it[1] and not all(own.any() for own in kinds)
