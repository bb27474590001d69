"""Drawings that are one with a slash through it, but for which all was drawn anew.

Icons that are crossed out are often not the same outlines with a gap in them: what is left is drawn
a little thinner, shifted, or simpler. Then nothing of them coincides to the last digit, and still
a person sees one thing that stands still. Before the tip of the slash the first one is shown, and
behind it the second one.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from shapetween.model.part import CurveTrack
from shapetween.scene.items import Item
from shapetween.scene.kept.appearing import HalfPlaneClip, extent_along
from shapetween.scene.kept.bars import Bar, bar_of
from shapetween.scene.kept.pieces import drawn_rings

if TYPE_CHECKING:
    import shapely

__all__ = ["crossed_tracks"]

#: Half the width, as a share of the drawing, up to which a difference is drawing anew. Larger, and
#: thin slashes are lost; smaller, and what is drawn anew is seen as something else.
SLIVER = 5e-3

#: Least length of a slash, as a share of the drawing.
LONG = 0.55

#: Least ratio of its sides that a piece of a slash has. Smaller, and any blot begins one.
PIECE = 1.6

#: Share of a slash that may be missing in the drawing that has it, and least share of it that the
#: other one has not.
MISSING, NEW = 0.06, 0.25

#: Share of both that may differ away from the slash, and that one piece of it may take. Larger, and
#: one thing is wiped into another, or a tick is cut to slivers that comes as a gap is filled;
#: smaller, and an eye that is drawn thinner where it is crossed out leaves.
ELSEWHERE, THING = 0.06, 0.025

#: Least share of the drawing without the slash that lies away from it. Larger, and a pen that its
#: slash lies along is wiped nowhere; smaller, and a J is an I crossed out by its stem.
LEFT = 0.3

#: How far the second drawing reaches over the line, as a share of the drawing, so that no seam is
#: seen there.
OVER = 2e-3


def crossed_tracks(
    sides: tuple[Sequence[Item], Sequence[Item]], scale: float
) -> tuple[CurveTrack, ...] | None:
    """Tracks of both drawings of which one is the other one with a slash through it.

    The rule nonzero shows them, for they overlap along the line.

    Parameters
    ----------
    sides : (sequence of Item, sequence of Item)
        All there is, of one colour.
    scale : float
        Size of the drawing.

    Returns
    -------
    tuple of CurveTrack or None
        The first drawing's and the second one's; None of other drawings.
    """
    import shapely

    drawn = [shapely.union_all([item.drawn for item in side]) for side in sides]
    differences = [_thick(drawn[k].difference(drawn[1 - k]), scale) for k in (0, 1)]
    for comes in (True, False):
        bar = _slash(differences[int(comes)], drawn[int(comes)], comes, scale)
        if bar is None:
            continue
        elsewhere = shapely.union_all(differences).difference(bar.around)
        whole = shapely.union_all(drawn).area
        largest = max((part.area for part in shapely.get_parts(elsewhere).tolist()), default=0.0)
        if elsewhere.area > ELSEWHERE * whole or largest > THING * whole:
            continue
        plain = drawn[1 - int(comes)]
        if plain.difference(bar.around).area < LEFT * plain.area:
            continue
        return _clipped(sides, bar, scale)
    return None


def _thick(area: "shapely.Geometry", scale: float) -> "shapely.Geometry":
    """The pieces of an area that are no slivers."""
    import shapely

    parts = [
        part
        for part in shapely.get_parts(area).tolist()
        if not part.buffer(-SLIVER * scale).is_empty
    ]
    return shapely.union_all(parts)


def _slash(
    difference: "shapely.Geometry", drawn: "shapely.Geometry", comes: bool, scale: float
) -> Bar | None:
    """The slash that some pieces of what only one drawing has are parts of."""
    import shapely

    pieces = shapely.get_parts(difference).tolist()
    for piece in sorted(pieces, key=lambda p: -round(p.area / scale**2, 9)):
        own = bar_of(piece, comes, slender=PIECE)
        if own is None:
            continue
        line = [own.centre - 2 * scale * own.ahead, own.centre + 2 * scale * own.ahead]
        strip = shapely.LineString(line).buffer(own.half * 1.15, cap_style="flat")
        along = [other for other in pieces if strip.contains(other)]
        hull = shapely.union_all(along).convex_hull
        bar = bar_of(hull, comes)
        if bar is None or bar.length < LONG * scale:
            continue
        missing = hull.difference(drawn).area
        if missing < MISSING * hull.area and difference.intersection(hull).area > NEW * hull.area:
            return bar
    return None


def _clipped(
    sides: tuple[Sequence[Item], Sequence[Item]], bar: Bar, scale: float
) -> tuple[CurveTrack, ...]:
    rings = [tuple(drawn_rings(side)) for side in sides]
    reaches = [extent_along(own, bar.ahead) for own in rings]
    low, high = min(low for low, _ in reaches), max(high for _, high in reaches)
    over = OVER * scale
    ends = (low, high) if bar.comes else (high, low)
    shift = over if bar.comes else -over
    return (
        HalfPlaneClip(rings[0], bar.ahead, (ends[0], ends[1] + shift), behind=not bar.comes),
        HalfPlaneClip(rings[1], bar.ahead, (ends[0], ends[1] + shift), behind=bar.comes),
    )
