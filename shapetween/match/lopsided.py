"""Axis onto axis where one outline is even and the other one is so but for something on one side.

A hook, a chain or a cut on one side shifts all that follows along the outline, so that the outline
read backwards lies nowhere near its mirror image. What the eye sees is the area, and most of that
is where its mirror image is.
"""

import numpy as np

from shapetween.base.arrays import Complex, Floats
from shapetween.geometry.circlemap import turn
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.match.candidate import Halves
from shapetween.match.costs import Prepared
from shapetween.match.dynamic import priced_path
from shapetween.match.scale import rounded
from shapetween.match.symmetry import MOST_AXES, Axes

__all__ = ["lopsided_ends", "nearly_even_about"]

#: Share of its area that an outline has in common with its mirror image from which on it is even
#: but for something on one side. Less takes what faces aside for even; more leaves a bishop's cut
#: or an umbrella's handle to draw all of it aslant.
COMMON = 0.86

#: Angle, radians, of the line about which it must not be so as well: what is even about any line is
#: round or a wheel, and has teeth on both sides. Nearer to the axis, and nothing is even about one
#: line alone; an eighth of a turn on, and a square is even about both.
ANOTHER_WAY = np.pi / 8

#: Lines across the axis on which areas are compared, and steps of the longer side along them.
#: Fewer miss thin things; more cost time.
LINES, STEPS = 96, 192

#: Steps of either side in which they are compared. Fewer match a corner with the place beside its
#: mirror image; more cost time with the square.
HALF_STEPS = 96

#: Grain of places in roots of the area. Finer, and rounding decides which step a place is in.
GRAIN = 2.0**-20


def lopsided_ends(a: Prepared, b: Prepared) -> list[tuple[Floats, Halves]]:
    """Ends of an even outline's axes, and of the lines that lie so in one that is nearly even.

    Parameters
    ----------
    a, b : Prepared

    Returns
    -------
    ends : (2, 2) float64
        Rows a, b of fractions of the ends that belong together, each increasing over one turn.
    halves : Halves
        How the two sides of the one that is nearly even belong together.
    """
    axes = a.axes.beside(b.axes), b.axes.beside(a.axes)
    known = [side.present for side in axes]
    if known[0] == known[1]:
        return []
    if known[0]:
        return [(ends, (None, half)) for ends, half in _ends(axes[0], b)]
    return [(ends[:, ::-1], (half, None)) for ends, half in _ends(axes[1], a)]


def _ends(axes: Axes, other: Prepared) -> list[tuple[Floats, Floats]]:
    found = []
    half = len(axes.ends) // 2
    # Of many axes those that the eye sees first: upright ones, and level ones.
    aslant = np.round(np.abs(np.sin(2 * axes.directions[:half])), 6)
    for k in np.argsort(aslant, kind="stable")[:MOST_AXES].tolist():
        way = float(axes.directions[k])
        aside = nearly_even_about(other, way)
        if aside is not None:
            first, last = _meets(other, way, aside)
            last += last < first
            known = np.array([[axes.ends[k], first], [axes.ends[k + half], last]])
            found.append((known, _halves(other, way, first, last)))
    return found


def nearly_even_about(prepared: Prepared, way: float) -> float | None:
    """How far to the side of the centroid a line lies about which an outline is nearly even.

    Parameters
    ----------
    prepared : Prepared
    way : float
        Angle of the line, radians.

    Returns
    -------
    float or None
        In roots of the area; None if there is no such line, or if there is one in any direction.
    """
    aside, common = _halved(prepared, way)
    if common < COMMON or _halved(prepared, way + ANOTHER_WAY)[1] >= COMMON:
        return None
    return aside


def _halved(prepared: Prepared, way: float) -> tuple[float, float]:
    """How far aside the line in a direction lies that halves most of an outline's area.

    Returns
    -------
    aside : float
        In roots of the area.
    common : float
        Share of the area that lies where the mirror image about that line lies.
    """
    z = as_complex(np.round(as_points(_along(prepared, way)) / GRAIN) * GRAIN)
    low, high = float(z.real.min()), float(z.real.max())
    levels = low + (high - low) * (np.arange(LINES) + 0.5) / LINES
    after = np.roll(z, -1)
    row, edge = np.nonzero((z.real <= levels[:, None]) != (after.real <= levels[:, None]))
    share = (levels[row] - z.real[edge]) / (after.real - z.real)[edge]
    y = np.round((z.imag[edge] + share * (after.imag - z.imag)[edge]) / GRAIN) * GRAIN
    least, most = np.full(LINES, np.inf), np.full(LINES, -np.inf)
    np.minimum.at(least, row, y)
    np.maximum.at(most, row, y)
    middle = (least + most) / 2
    order = np.argsort(middle, kind="stable")
    weight = np.cumsum((most - least)[order])
    aside = float(middle[order][np.searchsorted(weight, weight[-1] / 2)])
    reach = max(float(most.max()) - aside, aside - float(least.min()))
    step = np.clip(np.ceil((y - aside + reach) / (2 * reach) * STEPS), 0, STEPS - 1)
    inside = np.zeros((LINES, STEPS), dtype=np.intp)
    np.add.at(inside, (row, step.astype(np.intp)), 1)
    inside = np.cumsum(inside, axis=1) % 2
    return aside, float((inside * inside[:, ::-1]).sum() / inside.sum())


def _along(prepared: Prepared, way: float) -> Complex:
    """Samples of an outline, turned so that a direction is that of the real axis."""
    return np.asarray(as_complex(prepared.samples.points) * np.exp(-1j * way))


def _meets(prepared: Prepared, way: float, aside: float) -> tuple[float, float]:
    """Fractions of the length at which a line leaves the outline at last and comes in at first."""
    z = _along(prepared, way)
    off, after = z.imag - aside, np.roll(z, -1)
    cut = np.flatnonzero((off <= 0) != (np.roll(off, -1) <= 0))
    share = off[cut] / (off[cut] - np.roll(off, -1)[cut])
    along = z.real[cut] + share * (after.real - z.real)[cut]
    place = (cut + share) / len(z)
    return float(place[along.argmax()]), float(place[along.argmin()])


def _halves(prepared: Prepared, way: float, first: float, last: float) -> Floats:
    """Which places of both sides belong together, (2, K), shares from the first end to the last."""
    share = np.linspace(0.0, 1.0, HALF_STEPS + 1)
    sides = first + share * (last - first), first + 1 - share * (first + 1 - last)
    samples = prepared.samples
    here, there = (as_complex(samples.arcs.point(turn(samples.start + at))) for at in sides)
    image = here[0] + np.exp(2j * way) * (there - here[0]).conj()
    far = np.abs(here[:, None] - image) / samples.size
    path = priced_path(rounded(far), np.zeros_like(far))
    assert path is not None
    return np.stack([share[path.rows], share[path.columns]])
