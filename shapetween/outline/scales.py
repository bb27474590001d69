"""Two matched outlines at one scale: what is left of them without finer detail, and whose that is.

Outlines are read at even places of their common parameter and smoothed along it.
"""

from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Complex, Floats

__all__ = ["PLACES", "Pair", "at_scale", "smoothed", "way"]

Pair: TypeAlias = tuple[Complex, Complex]
"""Values at matched places of source and target."""

#: Even places at which outlines are read. Fewer miss the tips of spines; more cost time.
PLACES = 1024

#: Over how many scales both outlines' detail is compared. Less tells a bump from the same one a
#: little further on; more takes what one has for what the other has elsewhere.
BESIDE = 1.5

#: Amount of detail, in roots of the area, that makes no difference. Less, and what is straight in
#: both has detail by rounding; more leaves small teeth.
NOTHING = 0.002


def at_scale(ends: Pair, scale: float) -> tuple[Pair, tuple[Floats, Floats]]:
    """Outlines without detail of a scale, and what share of that the other has nothing like.

    Parameters
    ----------
    ends : pair of (PLACES,) complex128
        In roots of their areas.
    scale : float
        Width of a Gaussian, as a share of the outline; about a sixth of the length of the limb
        that it takes away.

    Returns
    -------
    left : pair of (PLACES,) complex128
    shares : pair of (PLACES,) float64
        Of the detail of each, from 0, where the other has as much, to 1.
    """
    left = smoothed(ends[0], scale), smoothed(ends[1], scale)
    amounts = []
    for points, plain in zip(ends, left, strict=True):
        along = way(plain)
        size = np.abs(along)
        # What lies along the outline is no detail but how fast it is gone along.
        across = ((points - plain) * along.conj()).imag / np.where(size > 0, size, 1.0)
        square = smoothed(across * across, BESIDE * scale).real
        amounts.append(NOTHING + np.sqrt(np.maximum(square, 0.0)))
    return left, (
        np.maximum(1 - amounts[1] / amounts[0], 0.0),
        np.maximum(1 - amounts[0] / amounts[1], 0.0),
    )


def smoothed(values: Complex | Floats, width: float) -> Complex:
    """Values at even places of a circle under a Gaussian."""
    waves = 2 * np.pi * np.fft.fftfreq(len(values), 1 / len(values))
    return np.asarray(np.fft.ifft(np.fft.fft(values) * np.exp(-((waves * width) ** 2) / 2)))


def way(points: Complex) -> Complex:
    """From the place before to the one after each."""
    return np.asarray(np.roll(points, -1) - np.roll(points, 1))
