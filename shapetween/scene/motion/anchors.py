"""Corners that two outlines have in common, where they are more than chance."""

from shapetween.base.arrays import Floats
from shapetween.match.candidate import agrees
from shapetween.match.costs import prepare
from shapetween.scene.doubtful import own_matching
from shapetween.scene.items import Item
from shapetween.scene.motion.knots import anchored_knots
from shapetween.scene.places import Places

__all__ = ["anchors"]

#: Mean distance, as a share of the length, from the matching that keeps both sides alike, up to
#: which corners in common say the same. More, and a candy's corners that a bat has too on one side
#: draw it aslant; less, and collars change otherwise than by their own corners.
SAME_MATCHING = 0.006


def anchors(first: Item, second: Item, same: float) -> tuple[Floats, Floats] | None:
    """Knots of two outlines that have corners in common, which stay; None of others.

    On a coarse grid some corners of any two drawings coincide. Those of two symmetric outlines do
    by chance where the outlines' own matching, which keeps both sides alike, goes elsewhere.

    Parameters
    ----------
    first, second : Item
        Closed.
    same : float
        Distance of two corners that are one.
    """
    source, target = first.outer.clockwise(), second.outer.clockwise()
    knots = anchored_knots(Places(source), Places(target), same)
    if knots is None or not all(prepare(outline).axes.even for outline in (source, target)):
        return knots
    found = own_matching(source, target)
    kept = found is None or not found.even or agrees(*knots, found, SAME_MATCHING)
    return knots if kept else None
