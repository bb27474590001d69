"""How a pair of items moves, as it lies in its scenes."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.notices import Notice
from shapetween.base.ranking import comparable
from shapetween.fill.pinned import pinned_rings
from shapetween.fill.regions import regions_of
from shapetween.fill.settings import FillSettings
from shapetween.fill.stroking import outlined
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack
from shapetween.scene.assign import Roles
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.choose import Ends, elastic, tracks_of
from shapetween.scene.motion.holes import hole_tracks
from shapetween.scene.motion.pinned import pinned_pieces
from shapetween.scene.motion.seams import seamed_tracks
from shapetween.scene.motion.tracks import Blend, Mirrored
from shapetween.scene.relations import Scene

__all__ = ["main_pairs", "of_one_kind", "pair_tracks"]

#: Most pairs of a drawing that the outline engine moves, a tenth of a second each: the largest are
#: seen, and what is small bends as well by itself.
MOST_ELASTIC = 2

#: Sum of differences of colours that are one.
COLOUR = 0.05


def pair_tracks(
    k: int,
    a: Scene,
    b: Scene,
    roles: Roles,
    settings: FillSettings,
    names: tuple[str, str],
    pinned: Sequence[int],
    *,
    main: bool,
) -> tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]:
    """Tracks of one pair; of a pair whose mates are a pair too, as the mirror image of those.

    Parameters
    ----------
    k : int
        Which pair.
    a, b : Scene
    roles : Roles
    settings : FillSettings
    names : tuple of str
        What messages call the drawings.
    pinned : sequence of int
        Which of the pins are on this pair.
    main : bool
        Whether it is one of `main_pairs`.
    """
    role = roles.pairs[k]
    ends = replace(_ends(role.first, role.second, a, b), root=main)
    settings = replace(settings, mine=frozenset(pinned))
    if len(pinned):
        if ends.first.filled and ends.second.filled:
            return _pinned_areas(ends, settings, names, pinned)
        settings.claimed.pins.update(pinned)
        pieces = pinned_pieces(ends.first, ends.second, settings.pins[list(pinned)])
        return (Blend(pieces, np.stack([ends.first.centre, ends.second.centre])),), ()
    axis = _mirror(role.first, role.second, a, b, roles)

    def tracks(ends: Ends) -> tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]:
        return tracks_of(ends, settings, names)

    if axis is None:
        return seamed_tracks(ends, tracks) or tracks(ends)
    flips, places = axis
    image = replace(
        ends,
        first=_mirrored(ends.first, flips, places[0]),
        second=_mirrored(ends.second, flips, places[1]),
    )
    image = replace(image, forms=(form_of(image.first), form_of(image.second)))
    found, notices = seamed_tracks(image, tracks) or tracks(image)
    return tuple(Mirrored(track, flips, places) for track in found), notices


def _pinned_areas(
    ends: Ends, settings: FillSettings, names: tuple[str, str], pinned: Sequence[int]
) -> tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]:
    """Tracks of two areas with pins; those on holes leave the outer ring to move as without."""
    pins = settings.pins[list(pinned)]
    on = pinned_rings(ends.first.rings, ends.second.rings, pins)
    if on.outer or not on.holes:
        return elastic(ends, settings, names)
    found, notices = tracks_of(ends, settings, names)
    outer = found[0]
    if not isinstance(outer, Blend):
        return found, notices
    settings.claimed.pins.update(pinned[k] for k in on.rows)
    holes = {pair: pins[list(rows)] for pair, rows in on.holes.items()}
    return (outer, *hole_tracks(ends.first, ends.second, outer, holes)), notices


def main_pairs(a: Scene, b: Scene, roles: Roles) -> list[int]:
    """The pairs that the outline engine is worth its time for: the largest of no simple form."""
    ends = [[role.first for role in roles.pairs], [role.second for role in roles.pairs]]
    sizes = comparable(a.sizes[ends[0]] * b.sizes[ends[1]])
    generic = [
        (-size, k)
        for k, (role, size) in enumerate(zip(roles.pairs, sizes.tolist(), strict=True))
        if a.items[role.first].closed
        and b.items[role.second].closed
        and (a.parents[role.first] < 0 or b.parents[role.second] < 0)
        and not (
            isinstance(a.forms[role.first], RoundedBox)
            and isinstance(b.forms[role.second], RoundedBox)
        )
    ]
    return [k for _, k in sorted(generic)[:MOST_ELASTIC]]


def _ends(first: int, second: int, a: Scene, b: Scene) -> Ends:
    symmetric = -1
    for one in a.axes:
        for other in b.axes:
            own = one.mates[first] == first and other.mates[second] == second
            if symmetric < 0 and one.flips == other.flips and own:
                symmetric = one.flips
    items = of_one_kind(a.items[first], b.items[second])
    forms = [
        form if item is own else form_of(item)
        for item, own, form in zip(
            items, (a.items[first], b.items[second]), (a.forms[first], b.forms[second]), strict=True
        )
    ]
    return Ends(
        items[0],
        items[1],
        (forms[0], forms[1]),
        (a.scale + b.scale) / 2,
        symmetric,
    )


def of_one_kind(first: Item, second: Item) -> tuple[Item, Item]:
    """Two items as they become each other.

    An open line beside an area is the area that its stroke covers, and so is a closed one beside
    an area with holes, which is the frame that it looks like, or beside one of its own colour:
    fill and stroke would be grey in between.
    """
    if first.filled == second.filled:
        return first, second
    alike = np.abs(first.colour - second.colour).sum() < COLOUR
    if not first.filled and (not first.closed or second.holes or alike):
        return _outline_of(first), second
    if not second.filled and (not second.closed or first.holes or alike):
        return first, _outline_of(second)
    return first, second


def _outline_of(line: Item) -> Item:
    """The area that a line's stroke covers."""
    if line.painted is not None:
        # Which side of a closed line is the outer one depends on the way it runs.
        sides = sorted(line.painted.rings, key=lambda ring: -abs(ring.area))
        area = tuple(ring.clockwise() for ring in sides)
        return Item(area if line.closed else area[:1], line.painted.style, line.shape, line.name)
    shape = outlined(Shape(line.rings, line.style, line.name))
    regions, _ = regions_of(shape, line.name)
    return Item((regions[0].outer, *regions[0].holes), shape.style, line.shape, line.name)


def _mirror(
    first: int, second: int, a: Scene, b: Scene, roles: Roles
) -> tuple[int, tuple[float, float]] | None:
    """The axis about which a pair mirrors another pair that is drawn as it is; None without one."""
    pairs = {(role.first, role.second) for role in roles.pairs}
    for one in a.axes:
        for other in b.axes:
            mates = int(one.mates[first]), int(other.mates[second])
            if one.flips != other.flips or min(mates) < 0 or mates not in pairs:
                continue
            # The one that comes first is moved as it is, the other as its mirror image.
            if mates != (first, second) and mates < (first, second):
                return one.flips, (one.place, other.place)
    return None


def _mirrored(item: Item, flips: int, place: float) -> Item:
    matrix = np.eye(2, 3)
    matrix[flips, flips], matrix[flips, 2] = -1.0, 2 * place
    image = item.transformed(matrix)
    if not item.filled:
        return image
    rings = tuple(Outline(ring.curves[::-1, ::-1], ring.closed) for ring in image.rings)
    return replace(image, rings=rings)
