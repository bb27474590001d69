"""Drawings that are one with a slash through it, but for which all was drawn anew.

Icons that are crossed out are often not the same outlines with a gap in them: what is left is drawn
a little thinner, shifted, or simpler. Then nothing of them coincides to the last digit, and still
a person sees one thing that stands still. Before the tip of the slash the first one is shown, and
behind it the second one.
"""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Points
from shapetween.model.part import CurveTrack
from shapetween.scene.items import Item
from shapetween.scene.kept.appearing import HalfPlaneClip, extent_along
from shapetween.scene.kept.bars import OBLIQUE, Bar
from shapetween.scene.kept.pieces import drawn_rings

if TYPE_CHECKING:
    import shapely

__all__ = ["crossed_tracks"]

#: Half the width, as a share of the drawing, up to which a difference is drawing anew. Larger, and
#: thin slashes are lost; smaller, and what is drawn anew is seen as something else.
SLIVER = 5e-3

#: How far what is drawn anew is from where it was, as a share of the drawing. Less, and a thin
#: outline that is drawn a little narrower is another one; more, and thin walls change places.
NEAR = 0.01

#: Least length of a slash, as a share of the drawing.
LONG = 0.55

#: Widths of slashes, as shares of the drawing. More of the least, and the slash of a thin line
#: icon is none; more of the greatest, and a wide band that comes is drawn along its length.
THIN, WIDE = 0.01, 0.15

#: Shortest edge of a slash, as a share of the drawing. Longer, and a slash that much crosses is not
#: seen; shorter, and every curve of a round corner is looked at.
SHORT = 0.02

#: Sine of the angle between edges of one bar, and how far apart those on one side of it may be, as
#: a share of the drawing. Less, and a slash drawn by hand is none; more, and it runs on into edges
#: of what it crosses.
PARALLEL, ONE_LINE = 0.02, 0.006

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
    near = [area.buffer(NEAR * scale) for area in drawn]
    differences = [_thick(drawn[k].difference(near[1 - k]), scale) for k in (0, 1)]
    changed = shapely.union_all(differences)
    whole = shapely.union_all(drawn).area
    for comes in (True, False):
        plain = drawn[not comes]
        for bar in _slashes(sides[comes], drawn[comes], plain, comes, scale):
            elsewhere = changed.difference(bar.around)
            parts = shapely.get_parts(elsewhere).tolist()
            largest = max((part.area for part in parts), default=0.0)
            if elsewhere.area > ELSEWHERE * whole or largest > THING * whole:
                continue
            if plain.difference(bar.around).area >= LEFT * plain.area:
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


def _slashes(
    side: Sequence[Item],
    drawn: "shapely.Geometry",
    other: "shapely.Geometry",
    comes: bool,
    scale: float,
) -> Iterator[Bar]:
    """What may be the slash that one drawing has and the other one has not, longest first.

    Parameters
    ----------
    side : sequence of Item
        What has it.
    drawn, other : shapely geometry
        All that is drawn there, and in the other drawing.
    comes : bool
        Whether the second drawing has it.
    scale : float
    """
    import shapely

    for bar in _bars(side, comes, scale):
        ends = bar.centre + np.array([[-0.5], [0.5]]) * bar.length * bar.ahead
        area = shapely.LineString(ends).buffer(bar.half, cap_style="flat")
        missing = area.difference(drawn).area
        new = area.difference(other).area - missing
        if missing < MISSING * area.area and new > NEW * area.area:
            yield bar


def _bars(side: Sequence[Item], comes: bool, scale: float) -> list[Bar]:
    """Long oblique bars that have straight edges of a drawing's outlines on both sides.

    The longest one comes first. What the bar runs through may part its edges.
    """
    edges = _long_chords(side, scale)
    starts, ways = edges[:, 0], edges[:, 1] - edges[:, 0]
    units = ways / np.hypot(ways[:, 0], ways[:, 1])[:, None]
    found: dict[tuple[float, ...], Bar] = {}
    for start, unit in zip(starts, units, strict=True):
        if np.abs(unit).min() <= OBLIQUE:
            continue
        ahead = unit if unit[1] > 0 else -unit
        normal = np.array([-ahead[1], ahead[0]])
        alike = np.abs(units @ normal) < PARALLEL
        aside = (starts - start) @ normal / scale
        reach = edges @ ahead
        for width in np.unique(np.round(aside[alike & (aside > THIN) & (aside < WIDE)], 3)):
            own = alike & ((np.abs(aside) < ONE_LINE) | (np.abs(aside - width) < ONE_LINE))
            low, high = float(reach[own].min()), float(reach[own].max())
            if high - low < LONG * scale:
                continue
            half = float(width * scale / 2)
            centre = (start @ normal + half) * normal + (low + high) / 2 * ahead
            bar = Bar(centre, ahead, half, high - low, comes)
            key = -bar.length / scale, *(centre / scale), width
            found.setdefault(tuple(round(float(value), 3) for value in key), bar)
    return [found[key] for key in sorted(found)]


def _long_chords(side: Sequence[Item], scale: float) -> Points:
    """Ends of the curves of a drawing's outlines that may be edges of a slash, (N, 2, 2).

    Bent ones need not be told: what is beside their chords is not drawn, or is drawn outside.
    """
    curves = np.concatenate([ring.curves for item in side for ring in item.rings])
    ways = curves[:, 3] - curves[:, 0]
    return np.asarray(curves[np.hypot(ways[:, 0], ways[:, 1]) > SHORT * scale][:, [0, 3]])


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
