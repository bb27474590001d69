"""Parts of a movement as animated paths."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.model.paint import Style
from shapetween.model.part import Part, shown_while
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.animate import animate_seen
from shapetween.svg.write.animate_pattern import add_ends, fills_of, keep_pattern
from shapetween.svg.write.animate_style import animate_style
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import GradientDefs, alpha_text
from shapetween.svg.write.shape import ShapeMotion, add_motion, shape_motion

__all__ = ["PartWriter"]

#: Paint is looked at on every fourth sample: it changes evenly, and slower than shapes.
PAINT_STRIDE = 4

#: A style's times are kept inside these, where it has all it needs on the way (a plain colour on
#: its way to a gradient is a gradient there) and differs from its ends by nothing to be seen.
INSIDE = (1e-6, 1 - 1e-6)

#: What is seen from the start to the end.
ALWAYS = (0.0, 1.0)


class PartWriter:
    """How parts of one leg are written; what is found out about a part is kept.

    Parameters
    ----------
    clock : Clock
    gradients : GradientDefs
        Where to write gradients.
    tolerance : float
        How far points may be off between two keyframes, in user units.
    """

    def __init__(self, clock: Clock, gradients: GradientDefs, tolerance: float) -> None:
        self.clock, self.gradients, self.tolerance = clock, gradients, tolerance
        strided = clock.schedule.strided(PAINT_STRIDE if clock.adaptive else 1)
        #: The clock of paint.
        self.slower = replace(clock, schedule=strided)
        #: Times of the movement at which paint is looked at, (S,).
        self.times = np.clip(strided.time, *INSIDE)
        self._styles: dict[Part, list[Style]] = {}
        self._seen: dict[Part, tuple[float, float]] = {}
        self._motions: dict[Part, ShapeMotion] = {}

    def styles(self, part: Part) -> list[Style]:
        """How a part is painted, at all times that paint is looked at."""
        if part not in self._styles:
            self._styles[part] = [part.style(t) for t in self.times.tolist()]
        return self._styles[part]

    def seen(self, part: Part) -> tuple[float, float]:
        """From when until when anything is seen of a part.

        Always, where time goes back and a part is seen more than once.
        """
        if not self.clock.adaptive:
            return ALWAYS
        if part not in self._seen:
            low, high = shown_while(part)
            outside = (style for style, t in self._timed(part) if not low <= t <= high)
            hidden = all(style.opacity <= 0 for style in outside)
            self._seen[part] = (low, high) if hidden else ALWAYS
        return self._seen[part]

    def motion(self, part: Part) -> ShapeMotion:
        """How the shape of a part moves."""
        if part not in self._motions:
            self._motions[part] = shape_motion(
                part, self.clock, self.gradients.decimals, self.tolerance, self.seen(part)
            )
        return self._motions[part]

    @property
    def looser(self) -> float:
        """How many times farther than the tolerance points of some part may be off."""
        return max((motion.looser for motion in self._motions.values()), default=1.0)

    def add(self, parent: ET.Element, part: Part, name: dict[str, str]) -> list[ET.Element]:
        """Write a part as a path, or as several that take turns where its kind of paint does."""
        motion, slower = self.motion(part), self.slower
        seen, styles = self.seen(part), self.styles(part)
        opacity = self._opacity(part, seen)
        if opacity is not None:
            styles = [replace(style, opacity=opacity) for style in styles]
        add_ends(parent, part, styles, self.times, slower, self.gradients, motion)
        paths = []
        for track in style_tracks(fills_of(part, styles, self.times)):
            path = ET.SubElement(parent, "path", name if track.start == 0 else {})
            animate_style(path, track, slower, self.gradients, self.tolerance)
            keep_pattern(path, track.styles, slower, self.gradients, self.tolerance)
            if opacity is not None:
                animate_seen(path, self.clock, seen, alpha_text(opacity))
            add_motion(path, motion)
            paths.append(path)
        return paths

    def _opacity(self, part: Part, seen: tuple[float, float]) -> float | None:
        """The opacity that a part has all the time that it is seen, if it is not always.

        None if it fades. A pattern is a path of its own, and shares no opacity.
        """
        inside = {style.opacity for style, t in self._timed(part) if seen[0] < t < seen[1]}
        patterned = any(style.pattern is not None for style in self.styles(part))
        return inside.pop() if seen != ALWAYS and len(inside) == 1 and not patterned else None

    def _timed(self, part: Part) -> Sequence[tuple[Style, float]]:
        return list(zip(self.styles(part), self.times.tolist(), strict=True))
