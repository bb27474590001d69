"""Groups of parts in Lottie: compositions of their own, with mattes for masks.

A group that has a mask, or fades with several parts in it, is a composition, which is drawn apart
and laid on what is below as one picture. A mask is another, as the luma matte of the first: what
it shows counts by its brightness, as in SVG; a clip is an alpha matte.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import prod

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.formats.lottie.properties import SIDE, Json, moving, short, transform
from shapetween.formats.plain import PAINT_TIMES, paint_times
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Group, Style
from shapetween.model.part import Part
from shapetween.svg.write.animate_groups import group_tracks, mask_parts, members_of, paths_of
from shapetween.svg.write.groups import Nest, faded_opacity

__all__ = ["Compositions", "Frame", "frame_size", "in_order"]

#: How mattes are told: by what is drawn, or by how bright it is.
ALPHA, LUMA = 1, 3

#: How far an opacity in percent may be off between two keyframes: a step of the 255 of a screen.
OPACITY_TOLERANCE = 100.0 / 255

Draw = Callable[[Part, str, Sequence[Style], Floats], list[Json]]
"""The layers of a part, of that name, with its styles at times of its own, in paint order."""


@dataclass(frozen=True, slots=True)
class Frame:
    """What is the same in all compositions of a leg.

    Attributes
    ----------
    name : str
        What their names begin with.
    length : float
        Frames from the start to the end.
    size : (int, int)
        Pixels.
    """

    name: str
    length: float
    size: tuple[int, int]


def frame_size(box: Box) -> tuple[int, int]:
    """Pixels of the whole, whose larger side is always as long."""
    side = max(box.width, box.height)
    return max(1, round(SIDE * box.width / side)), max(1, round(SIDE * box.height / side))


def in_order(layers: Sequence[Json]) -> list[Json]:
    """Layers in paint order as Lottie has them, from the top one down, with their numbers."""
    return [{**layer, "ind": index} for index, layer in enumerate(reversed(layers), start=1)]


class Compositions:
    """The groups of a movement, opened as its parts come.

    Parameters
    ----------
    movement : Movement
    frame : Frame
    draw : callable
    """

    def __init__(self, movement: Movement, frame: Frame, draw: Draw) -> None:
        self._frame, self._draw = frame, draw
        self._times = _inside(PAINT_TIMES)
        first, last = movement.at(np.array([0.0, 1.0]))
        self._members = members_of(movement.parts, (first.shapes, last.shapes), self._times)
        self._paths = paths_of(self._members)
        self._tracks = group_tracks(self._members)
        counts: dict[object, int] = {}
        for path in self._paths:
            for group in path:
                counts[group.key] = counts.get(group.key, 0) + 1
        self._apart = {
            key
            for key, track in self._tracks.items()
            if track[0].masks
            or (counts[key] > 1 and any(faded_opacity(group) < 1 for group in track))
        }
        self._nest: Nest[list[Json]] | None = None
        self._filled: list[tuple[Json, list[Json]]] = []
        self._losses: list[str] = []

    def add(self, layers: list[Json], index: int, name: str) -> None:
        """Draw a part into layers in paint order, or into the groups it is in, opened there."""
        if self._nest is None:
            self._nest = Nest(layers, self._open)
        part = self._members[index].part
        times = paint_times(part)
        styles = [self._plain(part.style(t)) for t in _inside(times).tolist()]
        self._nest.at(self._paths[index]).extend(self._draw(part, name, styles, times))

    @property
    def assets(self) -> list[Json]:
        """All compositions, when all parts are in them."""
        return [{**asset, "layers": in_order(layers)} for asset, layers in self._filled]

    @property
    def losses(self) -> list[str]:
        """What of the groups is left out."""
        return self._losses

    def _plain(self, style: Style) -> Style:
        """A style without groups, those that have no composition being done by itself."""
        fades = (faded_opacity(g) for g in style.groups if g.key not in self._apart)
        return replace(style, opacity=style.opacity * prod(fades), groups=())

    def _open(self, around: list[Json], group: Group) -> list[Json]:
        """A group's composition, and its mattes, laid into what is around it."""
        if group.key not in self._apart:
            return around
        track = self._tracks[group.key]
        opacity = [faded_opacity(each) for each in track]
        place = around
        for index in reversed(range(len(group.masks))):
            matte, kind = self._matte(track, index)
            shown, inside = self._composition("group", opacity)
            place += [{**shown, "tt": kind}, matte]
            place, opacity = inside, []
        if not group.masks:
            shown, inside = self._composition("group", opacity)
            place.append(shown)
            place = inside
        return place

    def _matte(self, track: Sequence[Group], index: int) -> tuple[Json, int]:
        """A mask as the layer above what it masks, and what of it counts."""
        mask = track[0].masks[index]
        shares = [group.share for group in track]
        layer, layers = self._composition("mask", [])
        inside = layers
        plain = mask.plain and min(shares) == 1
        if min(shares) < 1:  # white where it does nothing
            shown, inside = self._composition("share of a mask", shares)
            layers += [self._sheet("#ffffff"), shown]
            inside.append(self._sheet("#000000"))
        for part in mask_parts(track, index, self._times):
            styles = [part.style(float(t)) for t in self._times]
            if any(style.groups for style in styles):
                self._losses.append("what is done to a mask by others is left out in Lottie")
            styles = [replace(style, groups=()) for style in styles]
            if mask.plain:
                white = Colour(1.0, 1.0, 1.0)
                styles = [replace(each, fill=white, fill_rule="evenodd") for each in styles]
            inside += self._draw(part, "mask", styles, PAINT_TIMES)
        return {**layer, "td": 1}, ALPHA if plain else LUMA

    def _composition(self, what: str, opacity: Sequence[float]) -> tuple[Json, list[Json]]:
        """A layer that shows a new composition, and what goes into that in paint order."""
        name = f"{self._frame.name} {what} {len(self._filled) + 1}"
        layers: list[Json] = []
        self._filled.append(({"id": name}, layers))
        return self._layer(0, what, opacity) | {"refId": name}, layers

    def _sheet(self, colour: str) -> Json:
        """A layer all of one colour."""
        width, height = self._frame.size
        return self._layer(1, "sheet", []) | {"sc": colour, "sw": width, "sh": height}

    def _layer(self, kind: int, name: str, opacity: Sequence[float]) -> Json:
        frame = self._frame
        shown = None
        if opacity:
            clock = frame.length * np.linspace(0.0, 1.0, len(opacity))
            shown = moving(100 * np.array(opacity), clock, OPACITY_TOLERANCE, 2)
        return {
            "ddd": 0,
            "ty": kind,
            "nm": name,
            "sr": 1,
            "ks": transform(opacity=shown),
            "w": frame.size[0],
            "h": frame.size[1],
            "ip": 0,
            "op": short(frame.length + 1, 3),
            "st": 0,
            "bm": 0,
        }


def _inside(times: Floats) -> Floats:
    """Times at which a style has all that it needs on the way."""
    return np.clip(times, 1e-6, 1 - 1e-6)
