"""Places the user says must meet, found on the outlines and checked."""

import numpy as np

from shapetween.base.arrays import Floats, Points, frozen
from shapetween.base.errors import OptionError
from shapetween.match.costs import Cells
from shapetween.match.layout import Layout
from shapetween.model.arclength import arc_length
from shapetween.model.outline import Outline

__all__ = ["REACH", "pinned_places", "places_in_order", "pull_of"]

#: Farthest a pin may lie from its outline, as a share of the outline's diagonal: a click beside
#: the line is meant, one elsewhere is a mistake.
REACH = 0.05

#: Pins nearer than this along an outline, as a share of its length, are on one spot.
SAME_PLACE = 1e-6

#: How far along the outline a pin is felt, as a share of the length: about half a limb. There the
#: look of the limb itself counts, not where it is.
PIN_REACH = 0.12


def pinned_places(source: Outline, target: Outline, pins: Points | None) -> Floats:
    """Pins as fractions along both outlines.

    Parameters
    ----------
    source, target : Outline
    pins : (K, 4) float64 or None
        Rows ax, ay, bx, by: a point of the source and one of the target, each in the outline's
        own unit.

    Returns
    -------
    (K, 2) float64
        Fractions of the two lengths of the outlines' nearest points.

    Raises
    ------
    OptionError
        If a pin is off its outline, or does not follow the others in order round both.
    """
    if pins is None or len(pins) == 0:
        return np.zeros((0, 2))
    rows = frozen(pins, np.float64, ndim=2)
    if rows.shape[1] != 4:
        raise OptionError(f"a pin has four numbers, AX,AY:BX,BY, not {rows.shape[1]}")
    places = []
    for name, outline, points in (("source", source, rows[:, :2]), ("target", target, rows[:, 2:])):
        place, distance = arc_length(outline).nearest(points)
        reach = REACH * float(np.linalg.norm(np.ptp(outline.box, axis=0)))
        off = np.flatnonzero(distance > reach)
        if off.size:
            k = int(off[0])
            raise OptionError(
                f"pin {_named(rows[k])} is {distance[k]:.4g} off the {name} outline;"
                f" at most {reach:.4g} is taken as on it"
            )
        places.append(place % 1.0)
    return _ordered(np.stack(places, axis=1), rows)


def places_in_order(pins: Floats) -> Floats:
    """Pins given as places, checked as `pinned_places` does.

    Parameters
    ----------
    pins : (K, 2) float64
        Fractions of the two lengths, of any turn.

    Returns
    -------
    (K, 2) float64
        From 0 to 1.
    """
    return _ordered(pins % 1.0, pins)


def _ordered(found: Floats, named: Floats) -> Floats:
    """The places, if each fits in with those before it; else it is told by its own numbers."""
    for k in range(1, len(found)):
        if not _in_order(found[: k + 1]):
            raise OptionError(
                f"pin {_named(named[k])} is out of order: round both outlines the pins must"
                " follow one another alike, no two on one spot"
            )
    return found


def _in_order(places: Floats) -> bool:
    """Whether the places go round both outlines in the same order, each its own."""
    order = np.argsort(places[:, 0])
    gaps = np.diff(places[order], axis=0, append=places[order[:1]])
    gaps = gaps - np.floor(gaps)
    apart = (gaps > SAME_PLACE) & (gaps < 1 - SAME_PLACE)
    return bool(apart.all() and np.allclose(gaps.sum(axis=0), 1.0))


def _named(pin: Floats) -> str:
    first, second = np.split(pin, 2)
    return ":".join(",".join(f"{x:g}" for x in half) for half in (first, second))


def pull_of(layout: Layout, pins: Floats, cells: Cells) -> tuple[Floats, Floats]:
    """Weight of the nearest pin for each pair of samples, and the pair's residual from it.

    Both from 0 to 1. The residual is by how much the samples are not equally far along both
    outlines from the pin.
    """
    a, b = layout.a[:, None] - pins[:, 0], layout.b[:, None] - pins[:, 1]
    a, b = (a - np.round(a)) / PIN_REACH, (b - np.round(b)) / PIN_REACH
    near = np.maximum(1 - np.minimum(np.abs(a)[cells[0]], np.abs(b)[cells[1]]), 0.0)
    residual = np.minimum(np.abs(a[cells[0]] - b[cells[1]]), 1.0)
    strongest = near.argmax(axis=-1)[..., None]
    return (
        np.take_along_axis(near, strongest, axis=-1)[..., 0],
        np.take_along_axis(residual, strongest, axis=-1)[..., 0],
    )
