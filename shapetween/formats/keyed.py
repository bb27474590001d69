"""A part as keyframes, for formats whose players know nothing but straight ways between two."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.formats.options import WriteOptions
from shapetween.formats.sampled import Sampled, enough_times, sampled
from shapetween.model.part import Part
from shapetween.timing.easing import Easing, even_times
from shapetween.timing.fitted import fitted_keyframes
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE, looser_keyframes

__all__ = ["Keyed", "keyed"]

#: Curves of all keyframes of a part, before keyframes become fewer by ever looser tolerances; but
#: so many there are. More and players stall on the file.
MOST_WRITTEN, LEAST_KEYFRAMES, LOOSER = 300_000, 9, 1.5


@dataclass(frozen=True, slots=True, eq=False)
class Keyed:
    """Keyframes of one part.

    Attributes
    ----------
    shape : Sampled
        What it has in common at all times.
    clock : (M,) float64
        When each keyframe is, from 0 to 1; one alone if the part stands still.
    curves : (M, N, 4, 2) float64
        Control points, those of lines on their ends; first and last exactly the movement's.
    losses : tuple of str
        What there is to tell of how closely it is told.
    """

    shape: Sampled
    clock: Floats
    curves: Curves
    losses: tuple[str, ...] = ()


def keyed(part: Part, options: WriteOptions, size: float, easing: Easing = np.asarray) -> Keyed:
    """Choose keyframes along a clock.

    Parameters
    ----------
    part : Part
    options : WriteOptions
        Of which `keyframes` is heeded.
    size : float
        The view box's larger side.
    easing : Easing
        From the clock to the movement's time.
    """
    clock = (
        enough_times(part) if options.keyframes == "auto" else even_times(int(options.keyframes))
    )
    shape = sampled(part, easing(clock), size, merged=options.keyframes == "auto")
    points = shape.stack.reshape(len(clock), -1, 2)[:, shape.points]
    if shape.still:
        return Keyed(shape, clock[:1], shape.spread(points[:1]))
    if options.keyframes != "auto":
        return Keyed(shape, clock, shape.spread(points))
    tolerance, looser = KEYFRAME_TOLERANCE * size, 1.0
    knots, values = fitted_keyframes(points, clock, tolerance)
    while len(knots) > max(LEAST_KEYFRAMES, MOST_WRITTEN // max(sum(shape.rings), 1)):
        looser *= LOOSER
        knots, values = fitted_keyframes(points, clock, looser * tolerance)
    losses = (looser_keyframes(looser),) if looser > 1 else ()
    return Keyed(shape, knots, shape.spread(values), losses)
