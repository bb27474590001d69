"""Areas of which nobody could say what of one outline becomes what of the other."""

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Mask
from shapetween.base.errors import OutlineError
from shapetween.match import Matcher
from shapetween.match.correspondence import Correspondence
from shapetween.match.frames import MIN_TURN
from shapetween.model.outline import Outline
from shapetween.model.remembered import by_curves
from shapetween.outline.matching import upright_of
from shapetween.scene.assign import Roles
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.turning import total_turning
from shapetween.scene.relations import Scene, colours_apart, in_common, pictures
from shapetween.scene.sets import components

if TYPE_CHECKING:
    import shapely

__all__ = [
    "CERTAIN",
    "CONVEX",
    "filling",
    "hopeless_pairs",
    "nothing_corresponds",
    "only_turns",
    "own_matching",
    "share_of_hull",
]

#: Share of its hull from which on what an outline encloses counts as convex. At 1 rounding makes a
#: disc concave; smaller, and letters are taken for discs.
CONVEX = 0.95

#: What an outline's own matching may be doubted, so many times the unlikeness of the outlines
#: beyond `UNLIKE` counting with it. Of 60 pairs of solid icons judged by eye as they moved none
#: beyond was ready, of those below most were. Smaller, and a sun leaves for a moon to come; larger,
#: and an hourglass melts into a skull.
DOUBTFUL, COUNTS, UNLIKE = 0.8, 2.0, 0.4

#: What a pair of parts may cost, its doubt counting with it, before it is given up. Smaller, and
#: eyes leave for others to come; larger, and a cow's horn becomes the shade of a pig's ear.
HOPELESS = 2.5

#: Cost of a pair that is certain however doubtful its matching is. Larger, and more matchings are
#: looked for in vain; smaller, and one of two ears may tear.
CERTAIN = 0.3

#: Sum of differences of colours up to which touching areas are one body. Larger, and a shade is a
#: piece of what it lies beside; smaller, and a cloud drawn in two whites is two.
ONE_PAINT = 0.02

#: Likeness of outlines that are one, drawn anew, however they are matched. Larger, and a folder
#: leaves for an open one to come.
SAME = 0.7

#: Turning, in whole turns, of what a disc may become however unlike it is: a crescent has less
#: than two. Larger, and hands grow out of discs; smaller, and a sun leaves for a moon to come.
SIMPLE = 2.0


#: Pairs of outlines of which the matching is kept: as many as stages ask about in turn.
KEPT = 16


@by_curves(KEPT)
def own_matching(source: Outline, target: Outline) -> Correspondence | None:
    """The matching of two outlines, both clockwise, by themselves; None of degenerate ones."""
    try:
        return Matcher(source, target).match()
    except OutlineError:
        return None


def hopeless_pairs(a: Scene, b: Scene, roles: Roles) -> set[int]:
    """Indices of the pairs of parts that have little reason to be pairs, and would tear.

    Never the largest one, which is asked about with the drawings as wholes; with one of two mates
    the other.
    """
    share = [min(a.sizes[r.first] / a.scale, b.sizes[r.second] / b.scale) for r in roles.pairs]
    main = int(np.round(share, 9).argmax()) if share else -1
    found: set[int] = set()
    for k, role in enumerate(roles.pairs):
        if k == main or role.reason != "matched" or role.cost < CERTAIN:
            continue
        doubt = _unlike_doubt(a.items[role.first], b.items[role.second])
        if doubt is not None and round(role.cost + doubt, 6) > HOPELESS:
            found.add(k)
    pieces = _piece_of_alone(a, roles.disappearing), _piece_of_alone(b, roles.appearing)
    for k, role in enumerate(roles.pairs):
        piece = pieces[0][role.first] or pieces[1][role.second]
        if piece and k != main and role.reason == "matched":
            found.add(k)
    places = {(role.first, role.second): k for k, role in enumerate(roles.pairs)}
    for k in tuple(found):
        first, second = roles.pairs[k].first, roles.pairs[k].second
        for one in a.axes:
            for other in b.axes:
                mates = int(one.mates[first]), int(other.mates[second])
                if mates in places and roles.pairs[places[mates]].reason == "matched":
                    found.add(places[mates])
    for (first, second), k in places.items():
        whole = places.get((int(a.outlined[first]), int(b.outlined[second])))
        if whole in found:
            found.add(k)
    return found


def _piece_of_alone(scene: Scene, unmatched: Collection[int]) -> Mask:
    """Which items are pieces of a body, of one paint and touching, whose largest piece is alone.

    Two of a cloud's discs would go elsewhere while the rest of it shrinks.
    """
    filled = np.array([item.filled for item in scene.items])
    one = scene.touching & (colours_apart(scene.colours, scene.colours) < ONE_PAINT)
    one &= filled[:, None] & filled & (scene.parents[:, None] == scene.parents)
    labels = components(one | np.eye(len(one), dtype=bool))
    largest = np.zeros(len(labels))
    np.maximum.at(largest, labels, scene.sizes)
    whole = [labels[k] for k in unmatched if scene.sizes[k] == largest[labels[k]]]
    return np.isin(labels, whole)


def _unlike_doubt(one: Item, other: Item) -> float | None:
    """How doubtful the matching of two areas is, how unlike they are counting with it.

    None of areas that become each other well however they are matched.
    """
    if not (one.filled and other.filled):
        return None
    if isinstance(form_of(one), RoundedBox) and isinstance(form_of(other), RoundedBox):
        return None
    if _grows_from_disc(one, other) or _grows_from_disc(other, one):
        return None
    seen = pictures([item.replaced(item.rings[:1]) for item in (one, other)])
    unlike = 1 - float(in_common(seen[:1], seen[1:])[0, 0])
    if unlike < 1 - SAME:
        return None
    found = own_matching(one.outer.clockwise(), other.outer.clockwise())
    return None if found is None else found.doubt + COUNTS * (unlike - UNLIKE)


def nothing_corresponds(one: Item, other: Item) -> bool:
    """Whether two areas are too unlike, and their matching too doubtful, to become each other.

    A disc becomes a crescent.
    """
    doubt = _unlike_doubt(one, other)
    return doubt is not None and round(doubt, 6) > DOUBTFUL


def only_turns(one: Item, other: Item) -> bool:
    """Whether two areas' own matching has nothing to offer but a turn that neither asks for.

    An envelope whose corner is cut off becomes one that lacks another corner.
    """
    found = own_matching(one.outer.clockwise(), other.outer.clockwise())
    if found is None or found.affine is not None:
        return False
    return abs(upright_of(found).turn) > MIN_TURN


def _grows_from_disc(one: Item, other: Item) -> bool:
    """Whether one area is a disc, of which no place must go anywhere, and the other is simple."""
    form = form_of(one)
    round_one = isinstance(form, RoundedBox) and form.round
    return round_one and total_turning(other.outer.curves) < SIMPLE


def filling(item: Item) -> float:
    """Share of its hull that what an item encloses fills."""
    return share_of_hull(item.enclosed)


def share_of_hull(area: "shapely.Geometry") -> float:
    """Share of its hull that an area fills."""
    import shapely

    hull = shapely.convex_hull(area).area
    return float(area.area / hull) if hull > 0 else 1.0
