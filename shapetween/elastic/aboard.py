"""Drawn paths that ride on a drawing's movement: pairs of shapes, and shapes without a partner."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from shapetween.attach.planes import Plane
from shapetween.attach.riders import Leaver, Rider, Tip
from shapetween.attach.ties import Tied
from shapetween.base.arrays import Affine, Curves, Floats, Mask
from shapetween.deform.check import crossing_frames
from shapetween.geometry.bezier import curve_lengths
from shapetween.model.blend import blend
from shapetween.model.gradients import has_gradient, moved_style
from shapetween.model.movement import Part
from shapetween.model.paint import Style
from shapetween.model.whole import MOTION_TIMES, WholeMotion

__all__ = ["LonePart", "RidingPart", "ShownPart", "unrepeated"]

#: Share of its whole length at which a line that grows from its end has its full width. Earlier,
#: and a round cap flashes up; later, and the line grows like a wedge.
FULL_WIDTH = 0.25


AnyRider: TypeAlias = Rider | Leaver | Tip | Tied
"""Rings that ride."""


class _Ridden:
    """What a part is whose rings ride, one rider after another."""

    __slots__ = ()

    riders: tuple[AnyRider, ...]
    closed: tuple[bool, ...]

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(n for rider in self.riders for n in rider.counts)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return np.concatenate([rider.curves(t) for rider in self.riders], axis=1)

    def crossing(self, t: Floats) -> Mask:
        """At which times (F,) a closed ring that bounds an area crosses itself."""
        if not self._bounds_area:
            return np.zeros(len(t), dtype=bool)
        return crossing_frames(self.curves(t), self.rings, self.closed)

    @property
    def _bounds_area(self) -> bool:
        raise NotImplementedError


@dataclass(frozen=True, slots=True, eq=False)
class RidingPart(_Ridden):
    """A shape that becomes another while both ride.

    Attributes
    ----------
    name : str
    styles : (Style, Style)
    riders : tuple of Rider, Leaver or Tied
        Rings that become each other, and pieces and holes that open and close.
    closed : tuple of bool
        Which of the rings are closed.
    plane : Plane
        What it rides on.
    motion : WholeMotion or None
        What gradients follow.
    """

    name: str
    styles: tuple[Style, Style]
    riders: tuple[AnyRider, ...]
    closed: tuple[bool, ...]
    plane: Plane
    motion: WholeMotion | None = None

    @classmethod
    def of(
        cls,
        name: str,
        styles: tuple[Style, Style],
        riders: tuple[Rider | Leaver, ...],
        closed: tuple[bool, ...],
        plane: Plane,
    ) -> "RidingPart":
        """A part whose gradients follow its riders."""
        motion = None
        if any(map(has_gradient, styles)):
            curves = np.concatenate([rider.curves(MOTION_TIMES) for rider in riders], axis=1)
            motion = WholeMotion.of(curves.mean(axis=2), curve_lengths(curves[0]))
        return cls(name, styles, riders, closed, plane, motion)

    @property
    def _bounds_area(self) -> bool:
        return any(style.fill is not None for style in self.styles)

    def style(self, t: float) -> Style:
        """Paint at one time."""
        return blend(*self.styles, t, self.motion)


@dataclass(frozen=True, slots=True, eq=False)
class LonePart(_Ridden):
    """A shape without a partner: areas open from their middles, lines grow from their ends.

    Attributes
    ----------
    name : str
    whole : Style
        Its paint where it is whole.
    riders : tuple of Leaver, Tip or Tied
    closed : tuple of bool
        Which of the rings are closed.
    arrives : bool
        Whether it is whole at the end; else at the start.
    plane : Plane
        What it rides on.
    fades : bool
        Whether it keeps its size and fades instead.
    """

    name: str
    whole: Style
    riders: tuple[AnyRider, ...]
    closed: tuple[bool, ...]
    arrives: bool
    plane: Plane
    fades: bool = False

    @property
    def _bounds_area(self) -> bool:
        return self.whole.fill is not None

    def style(self, t: float) -> Style:
        """Paint at one time; gradients shrink and a stroke thins out with the shape."""
        size = t if self.arrives else 1 - t
        if size == 1:
            return self.whole
        style = self.whole
        if has_gradient(style):
            style = moved_style(style, self._similarity(t))
        if self.fades:
            return replace(style, opacity=style.opacity * size)
        stroke = style.stroke
        if stroke is None:
            return style
        grows = not all(isinstance(rider, Leaver) for rider in self.riders)
        share = min(1.0, size / FULL_WIDTH) if grows else size
        dashes = tuple(d * share for d in stroke.dashes) if share > 0 else ()
        return replace(style, stroke=replace(stroke, width=stroke.width * share, dashes=dashes))

    def _similarity(self, t: float) -> Affine:
        """The similarity that best takes the whole shape to its place at a time, (2, 3)."""
        ends = self.curves(np.array([t, float(self.arrives)])).reshape(2, -1, 2)
        now, home = ends @ np.array([1, 1j])
        offsets = home - home.mean()
        spread = (np.abs(offsets) ** 2).sum()
        ratio = (np.conj(offsets) @ (now - now.mean())) / spread if spread > 0 else 0j
        shift = now.mean() - ratio * home.mean()
        return np.array(
            [[ratio.real, -ratio.imag, shift.real], [ratio.imag, ratio.real, shift.imag]]
        )


@dataclass(frozen=True, slots=True, eq=False)
class ShownPart:
    """A part that is painted for some of the time only; another of its kind takes over.

    Attributes
    ----------
    part : Part
    shown : (float, float)
        From when until when; at the end of that time it is not shown any more, but for time 1.
    """

    part: Part
    shown: tuple[float, float]

    @property
    def name(self) -> str:
        """Name of the part where it is shown first."""
        return self.part.name if self.shown[0] == 0 else ""

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return self.part.rings

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return self.part.closed

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return self.part.curves(t)

    def style(self, t: float) -> Style:
        """Paint at one time; none while it is not shown."""
        start, end = self.shown
        if start <= t < end or t == end == 1:
            return self.part.style(t)
        hidden = self.part.style(t)
        return Style(fill=None, fill_rule=hidden.fill_rule, groups=hidden.groups)


def unrepeated(parts: Sequence[Part]) -> list[Part]:
    """The parts themselves, each once, also those shown in two places."""
    shown = (part.part if isinstance(part, ShownPart) else part for part in parts)
    return list({id(part): part for part in shown}.values())
