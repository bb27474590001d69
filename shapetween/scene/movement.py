"""The movement between two drawings as scenes of parts."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice, distinct
from shapetween.fill.morph import morph_fill
from shapetween.fill.parts import FilledPart
from shapetween.fill.regions import regions_of
from shapetween.fill.settings import FillSettings
from shapetween.fill.stroking import outlined
from shapetween.geometry.bezier import curve_lengths
from shapetween.model.blend import blend
from shapetween.model.drawing import Shape
from shapetween.model.gradients import has_gradient
from shapetween.model.movement import Part
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.model.whole import MOTION_TIMES, WholeMotion
from shapetween.scene.assign import Roles, assign
from shapetween.scene.cuts import cut_alike_items
from shapetween.scene.forms import form_of
from shapetween.scene.items import Item
from shapetween.scene.keeping import kept_to
from shapetween.scene.leaving import leaving_part
from shapetween.scene.motion.choose import Ends, tracks_of
from shapetween.scene.motion.tracks import Elastic, Frame, Mirrored, Shared, Track
from shapetween.scene.order import Layer, layers_of, share_shown
from shapetween.scene.presence import LonePart
from shapetween.scene.relations import Scene, perceive
from shapetween.scene.sets import paired_sets
from shapetween.scene.strokes import StrokedLonePart, as_painted
from shapetween.scene.whole import frame_between, moved_items

__all__ = ["PairPart", "SceneMovement", "move_scene"]


@dataclass(frozen=True, eq=False)
class PairPart:
    """An item that becomes another one.

    Attributes
    ----------
    name : str
    styles : (Style, Style)
    tracks : tuple of Track
        Its outer ring's or its line's, and its holes'.
    frame : Frame or None
        What the whole drawing moves in.
    end : (N, 4, 2) float64 or None
        What is drawn at last, where a frame carries it.
    layer : Layer
    motion : WholeMotion or None
        What gradients follow.
    piece : (int, int) or None
        Of what area it is a piece: whether the second drawing's, and which of its shapes.
    """

    name: str
    styles: tuple[Style, Style]
    tracks: tuple[Track, ...]
    frame: Frame | None
    layer: Layer
    motion: WholeMotion | None = None
    piece: tuple[int, int] | None = None

    def goes_on_in(self, other: "PairPart") -> bool:
        """Whether another part is a piece of the same area."""
        return (
            self.piece is not None
            and self.piece == other.piece
            and self.styles == other.styles
            and self.layer.shown == other.layer.shown
        )

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(n for track in self.tracks for n in track.counts)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return tuple(c for track in self.tracks for c in track.closed)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return framed(self.tracks, self.frame, t)

    def style(self, t: float) -> Style:
        """Paint at one time."""
        style = blend(*self.styles, t, self.motion)
        if self.piece is not None:  # pieces run all one way, and may cover each other
            style = replace(style, fill_rule="nonzero")
        if self.layer.shown == "always":
            return style
        return replace(style, opacity=style.opacity * float(share_shown(self.layer, t)))


ScenePart: TypeAlias = PairPart | LonePart | StrokedLonePart
"""One drawn path of a scene."""


def joined_parts(parts: Iterable[ScenePart]) -> list[ScenePart]:
    """Parts with those put in one path that are pieces of one area, or seams would be seen.

    Where two areas abut, what is behind them shines through, but not within one path.
    """
    joined: list[ScenePart] = []
    for part in parts:
        last = joined[-1] if joined else None
        if isinstance(part, PairPart) and isinstance(last, PairPart) and last.goes_on_in(part):
            joined[-1] = replace(last, tracks=last.tracks + part.tracks)
        else:
            joined.append(part)
    return joined


def framed(tracks: Sequence[Track], frame: Frame | None, t: Floats) -> Curves:
    """Curves of several rings, in the frame of the whole drawing."""
    curves = np.concatenate([track.curves(t) for track in tracks], axis=1)
    return curves if frame is None else frame.carried(curves, t)


@dataclass(frozen=True, eq=False)
class SceneMovement:
    """What moves, and how that was found.

    Attributes
    ----------
    parts : tuple of Part
        In paint order.
    scenes : (Scene, Scene)
        The second one as it is in the frame.
    roles : Roles
    notices : tuple of Notice
    tracks : dict of int to tuple of Track
        By pair.
    settings : FillSettings
    frame : Frame or None
    """

    parts: tuple[Part, ...]
    scenes: tuple[Scene, Scene]
    roles: Roles
    notices: tuple[Notice, ...]
    tracks: dict[int, tuple[Track, ...]]
    settings: FillSettings
    frame: Frame | None

    @cached_property
    def meshed(self) -> tuple[FilledPart, ...]:
        """Every pair of areas as the outline engine would move it, in the order of their roles."""
        settings = replace(self.settings, pins=np.zeros((0, 4)), used_pins=set(), meshed=True)
        found = []
        for k, role in enumerate(self.roles.pairs):
            one = self.scenes[0].items[role.first]
            other = self.scenes[1].items[role.second]
            if not (one.filled and other.filled):
                continue
            tracks = [getattr(track, "track", track) for track in self.tracks[k]]
            own = [track.part for track in tracks if isinstance(track, Elastic)]
            if own and self.frame is None:
                found += own
                continue
            if self.frame is not None:
                forth = self.frame.forth
                other = other.replaced(tuple(ring.transformed(forth) for ring in other.rings))
            try:
                shapes = one.as_shape, other.as_shape
                found.append(morph_fill(*shapes, settings, ("", ""), alone=False)[0])
            except OutlineError:
                continue
        return tuple(found)


def move_scene(
    first: Sequence[Item],
    second: Sequence[Item],
    views: tuple[Points, Points],
    given: Sequence[tuple[int, int]],
    settings: FillSettings,
    names: tuple[str, str],
) -> SceneMovement:
    """The movement between two drawings' items.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order and one frame.
    views : ((2, 2) float64, (2, 2) float64)
        What is shown of each drawing, as least and greatest corners.
    given : sequence of (int, int)
        Shapes that become each other because the user says so, or by their names.
    settings : FillSettings
    names : tuple of str
        What messages call the drawings.
    """
    with settings.observe("perceive"):
        a, b = perceive(first, views[0]), perceive(second, views[1])
        frame = frame_between(a, b)
        if frame is not None:
            b = perceive(moved_items(b, frame), views[1])
    with settings.observe("match"):
        cut = cut_alike_items(a, b, views)
        a, b = cut.scenes
        settled, barred = _settled(a, b, given)
        settled += [pair for pair in cut.given if not barred[pair]]
        settled = settled or [pair for pair in paired_sets(a, b) if not barred[pair]]
        roles = assign(a, b, settled, barred)
    said: list[Notice] = []
    with settings.observe("move"):
        tracks: dict[int, tuple[Track, ...]] = {}
        for k in _largest_first(a, roles):
            found, more = _tracks(k, a, b, roles, settings, names)
            tracks[k] = tuple(Shared(track) for track in kept_to(k, found, a, b, roles, tracks))
            said += more
        hosts = (
            {role.first: tracks[k] for k, role in enumerate(roles.pairs)},
            {role.second: tracks[k] for k, role in enumerate(roles.pairs)},
        )
        parts: list[Part] = []
        named: set[str] = set()
        for part in joined_parts(
            _part(layer, a, b, roles, tracks, hosts, frame) for layer in layers_of(a, b, roles)
        ):
            parts.append(part if part.name not in named else replace(part, name=""))
            named.add(part.name)
    return SceneMovement(tuple(parts), (a, b), roles, distinct(said), tracks, settings, frame)


def _settled(
    a: Scene, b: Scene, given: Sequence[tuple[int, int]]
) -> tuple[list[tuple[int, int]], Mask]:
    """Pairs of items that pairs of shapes settle, and what they bar."""
    shapes = [np.array([item.shape for item in scene.items]) for scene in (a, b)]
    barred = np.zeros((len(a.items), len(b.items)), dtype=bool)
    pairs = []
    for first, second in given:
        own = [np.flatnonzero(side == k) for side, k in zip(shapes, (first, second), strict=True)]
        barred |= (shapes[0] == first)[:, None] != (shapes[1] == second)
        if len(own[0]) == len(own[1]) == 1:
            pairs.append((int(own[0][0]), int(own[1][0])))
    return pairs, barred


def _largest_first(a: Scene, roles: Roles) -> list[int]:
    """Pairs so that what others keep to comes before them."""
    first = [role.first for role in roles.pairs]
    return sorted(
        range(len(first)),
        key=lambda k: (a.outlined[first[k]] >= 0, -round(float(a.sizes[first[k]]), 6), first[k]),
    )


def _tracks(
    k: int,
    a: Scene,
    b: Scene,
    roles: Roles,
    settings: FillSettings,
    names: tuple[str, str],
) -> tuple[tuple[Track, ...], tuple[Notice, ...]]:
    """Tracks of one pair; of a pair whose mates are a pair too, as the mirror image of those."""
    role = roles.pairs[k]
    ends = _ends(role.first, role.second, a, b, roles)
    axis = _mirror(role.first, role.second, a, b, roles)
    if axis is None:
        return tracks_of(ends, settings, names)
    flips, places = axis
    image = replace(
        ends,
        first=_mirrored(ends.first, flips, places[0]),
        second=_mirrored(ends.second, flips, places[1]),
    )
    image = replace(image, forms=(form_of(image.first), form_of(image.second)))
    found, said = tracks_of(image, settings, names)
    return tuple(Mirrored(track, flips, places) for track in found), said


def _ends(first: int, second: int, a: Scene, b: Scene, roles: Roles) -> Ends:
    symmetric = -1
    for one in a.axes:
        for other in b.axes:
            own = one.mates[first] == first and other.mates[second] == second
            if symmetric < 0 and one.flips == other.flips and own:
                symmetric = one.flips
    root = bool(a.parents[first] < 0 or b.parents[second] < 0)
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
        root,
    )


def of_one_kind(first: Item, second: Item) -> tuple[Item, Item]:
    """Two items as they become each other: an open line beside an area is its outline."""
    if first.filled == second.filled:
        return first, second
    if not first.filled and not first.closed:
        return _outline_of(first), second
    if not second.filled and not second.closed:
        return first, _outline_of(second)
    return first, second


def _outline_of(line: Item) -> Item:
    """The area that a line's stroke covers."""
    if line.painted is not None:
        area = line.painted.rings
        return Item(area[:1], line.painted.style, line.shape, line.name)
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


def _part(
    layer: Layer,
    a: Scene,
    b: Scene,
    roles: Roles,
    tracks: dict[int, tuple[Track, ...]],
    hosts: tuple[dict[int, tuple[Track, ...]], dict[int, tuple[Track, ...]]],
    frame: Frame | None,
) -> ScenePart:
    if layer.pair is not None:
        role = roles.pairs[layer.pair]
        one, other = of_one_kind(a.items[role.first], b.items[role.second])
        one, other, found = as_painted(one, other, tracks[layer.pair])
        return _pair_part(one, other, found, frame, layer)
    if layer.leaver is not None:
        return leaving_part(layer.leaver, a, hosts[0], False, frame)
    assert layer.comer is not None
    return leaving_part(layer.comer, b, hosts[1], True, frame)


def _pair_part(
    one: Item, other: Item, tracks: tuple[Track, ...], frame: Frame | None, layer: Layer
) -> PairPart:
    styles = one.style, other.style
    if frame is not None:
        styles = styles[0], _restyled(styles[1], frame)
    motion = None
    if any(map(has_gradient, styles)):
        curves = framed(tracks, frame, MOTION_TIMES)
        motion = WholeMotion.of(curves.mean(axis=2), curve_lengths(curves[0]))
    name = one.name or other.name
    piece = None
    if one.filled and other.filled:
        piece = next(((k, i.shape) for k, i in enumerate((one, other)) if i.cut), None)
    return PairPart(name, styles, tracks, frame, layer, motion, piece)


def _restyled(style: Style, frame: Frame) -> Style:
    """A style of the frame as it is at last, in the second drawing's own place."""
    from shapetween.scene.whole import moved_paint

    return moved_paint(style, frame.forth, frame.growth)
