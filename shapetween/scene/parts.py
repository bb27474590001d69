"""Drawn paths of a scene: pairs that become each other."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.fill.parts import FilledPart
from shapetween.geometry.bezier import curve_lengths
from shapetween.model.blend import blend
from shapetween.model.gradients import has_gradient
from shapetween.model.paint import Style
from shapetween.model.whole import MOTION_TIMES, WholeMotion
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Frame, Track
from shapetween.scene.order import Layer, share_shown
from shapetween.scene.presence import LonePart
from shapetween.scene.strokes import StrokedLonePart

__all__ = ["PairPart", "ScenePart", "joined_parts", "pair_part"]


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

    @property
    def areas(self) -> tuple[FilledPart, ...]:
        """What of it the outline engine moves by meshes; nothing where a frame carries it."""
        if self.frame is not None:
            return ()
        return tuple(area for track in self.tracks for area in track.areas)

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


def pair_part(
    one: Item, other: Item, tracks: tuple[Track, ...], frame: Frame | None, layer: Layer
) -> PairPart:
    """The part of a pair.

    Parameters
    ----------
    one, other : Item
        As they become each other.
    tracks : tuple of Track
    frame : Frame or None
        What the whole drawing moves in.
    layer : Layer
    """
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
