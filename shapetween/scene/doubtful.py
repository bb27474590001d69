"""Areas of which nobody could say what of one outline becomes what of the other."""

from typing import TYPE_CHECKING

from shapetween.base.errors import OutlineError
from shapetween.match import Matcher
from shapetween.match.correspondence import Correspondence
from shapetween.model.outline import Outline
from shapetween.model.remembered import by_curves
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.turning import total_turning
from shapetween.scene.relations import in_common, pictures

if TYPE_CHECKING:
    import shapely

__all__ = ["CONVEX", "filling", "nothing_corresponds", "own_matching", "share_of_hull"]

#: Share of its hull from which on what an outline encloses counts as convex. At 1 rounding makes a
#: disc concave; smaller, and letters are taken for discs.
CONVEX = 0.95

#: What an outline's own matching may be doubted, so many times the unlikeness of the outlines
#: beyond `UNLIKE` counting with it. Of 60 pairs of solid icons judged by eye as they moved none
#: beyond was ready, of those below most were. Smaller, and a sun leaves for a moon to come; larger,
#: and an hourglass melts into a skull.
DOUBTFUL, COUNTS, UNLIKE = 0.8, 2.0, 0.4

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


def nothing_corresponds(one: Item, other: Item) -> bool:
    """Whether two areas are too unlike, and their matching too doubtful, to become each other.

    A disc becomes a crescent.
    """
    if not (one.filled and other.filled):
        return False
    if _grows_from_disc(one, other) or _grows_from_disc(other, one):
        return False
    seen = pictures([item.replaced(item.rings[:1]) for item in (one, other)])
    unlike = 1 - float(in_common(seen[:1], seen[1:])[0, 0])
    if unlike < 1 - SAME:
        return False
    found = own_matching(one.outer.clockwise(), other.outer.clockwise())
    if found is None:
        return False
    return round(found.doubt + COUNTS * (unlike - UNLIKE), 6) > DOUBTFUL


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
