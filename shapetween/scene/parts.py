"""Drawn paths of a scene: pairs that become each other."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from shapetween.geometry.bezier import curve_lengths
from shapetween.model.gradients import has_gradient
from shapetween.model.paint import Style
from shapetween.model.part import BlendedPaint, CurveTrack, Part
from shapetween.model.whole import MOTION_TIMES, WholeMotion
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Frame, Framed
from shapetween.scene.paint_order import Layer, share_shown

__all__ = ["PairPaint", "joined_parts", "pair_part"]


@dataclass(frozen=True, slots=True, eq=False)
class PairPaint:
    """The paint of an item that becomes another one.

    Attributes
    ----------
    blended : BlendedPaint
    layer : Layer
        When it is shown.
    piece : (int, int) or None
        Of what area it is a piece: whether the second drawing's, and which of its shapes.
    """

    blended: BlendedPaint
    layer: Layer
    piece: tuple[int, int] | None

    def at(self, t: float) -> Style:
        """How it is painted at one time."""
        style = self.blended.at(t)
        if self.piece is not None:  # pieces run all one way, and may cover each other
            style = replace(style, fill_rule="nonzero")
        if self.layer.shown == "always":
            return style
        return replace(style, opacity=style.opacity * float(share_shown(self.layer, t)))

    def same_area(self, other: "PairPaint") -> bool:
        """Whether another paint is that of a piece of the same area."""
        return (
            self.piece is not None
            and self.piece == other.piece
            and self.blended.styles == other.blended.styles
            and self.layer.shown == other.layer.shown
        )


def joined_parts(parts: Iterable[tuple[Part, PairPaint | None]]) -> list[Part]:
    """Parts with those put in one path that are pieces of one area, or seams would be seen.

    Where two areas abut, what is behind them shines through, but not within one path.

    Parameters
    ----------
    parts : iterable of (Part, PairPaint or None)
        With the paint of those that are pairs.
    """
    joined: list[Part] = []
    before: PairPaint | None = None
    for part, paint in parts:
        if paint is not None and before is not None and before.same_area(paint):
            joined[-1] = replace(joined[-1], tracks=joined[-1].tracks + part.tracks)
        else:
            joined.append(part)
            before = paint
    return joined


def pair_part(
    one: Item, other: Item, tracks: tuple[CurveTrack, ...], frame: Frame | None, layer: Layer
) -> tuple[Part, PairPaint]:
    """The part of a pair, and its paint.

    Parameters
    ----------
    one, other : Item
        As they become each other.
    tracks : tuple of CurveTrack
    frame : Frame or None
        What the whole drawing moves in.
    layer : Layer
    """
    styles = one.style, other.style
    if frame is not None:
        styles = styles[0], _restyled(styles[1], frame)
        tracks = tuple(Framed(track, frame) for track in tracks)
    motion = None
    if any(map(has_gradient, styles)):
        curves = np.concatenate([track.curves(MOTION_TIMES) for track in tracks], axis=1)
        motion = WholeMotion.of(curves.mean(axis=2), curve_lengths(curves[0]))
    name = one.name or other.name
    piece = None
    if one.filled and other.filled:
        piece = next(((k, i.shape) for k, i in enumerate((one, other)) if i.cut), None)
    paint = PairPaint(BlendedPaint(styles, motion), layer, piece)
    return Part(name, tracks, paint), paint


def _restyled(style: Style, frame: Frame) -> Style:
    """A style of the frame as it is at last, in the second drawing's own place."""
    from shapetween.scene.whole import moved_paint

    return moved_paint(style, frame.forth, frame.growth)
