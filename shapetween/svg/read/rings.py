"""Subpaths to the rings of a shape."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import line_curves
from shapetween.geometry.polygon import cross
from shapetween.model.drawing import Box
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.svg.read.pathdata import Subpath

__all__ = ["bounds", "encloses_nothing", "ring_of", "unfolded"]

#: Length of a dot, as a share of its width: less than shows, more than is printed away.
DOT = 1e-3

#: A gap that is closed by moving the last point instead of drawing a line, as a share of the
#: ring's size: what programs that add up rounded numbers leave. Larger and a line that somebody
#: drew would go; smaller and rings get closing lines of no visible length, with any direction.
CLOSING_GAP = 1e-6

#: Width of a ring over its length, below which it encloses nothing: rounding of its coordinates.
FLAT = 1e-12


def bounds(subpaths: Sequence[Subpath]) -> Box:
    """The least box around what subpaths draw, without strokes."""
    curves = np.concatenate([np.zeros((0, 4, 2)), *(subpath.curves for subpath in subpaths)])
    if not len(curves):
        return Box(0.0, 0.0, 0.0, 0.0)
    # A coordinate is extreme at an end, or where the derivative c + b t + a t^2 is 0.
    p0, p1, p2, p3 = np.moveaxis(curves, 1, 0)
    a, b, c = p3 - p0 + 3 * (p1 - p2), 2 * (p0 - 2 * p1 + p2), p1 - p0
    with np.errstate(all="ignore"):
        half = -(b + np.copysign(np.sqrt(b * b - 4 * a * c), b)) / 2
        roots = np.stack([half / a, c / half])
    t = np.where((roots > 0) & (roots < 1), roots, 0.0)
    s = 1 - t
    inner = s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3
    points = np.concatenate([p0, p3, inner.reshape(-1, 2)])
    least, greatest = points.min(axis=0), points.max(axis=0)
    return Box(*least.tolist(), *(greatest - least).tolist())


def ring_of(
    subpath: Subpath, *, filled: bool, stroked: bool, dots: bool, width: float = 1.0
) -> Outline | None:
    """The ring that a subpath draws.

    Parameters
    ----------
    subpath : Subpath
    filled, stroked : bool
        How the shape is painted. A ring that is only filled is closed; one that is stroked stays
        open if it was drawn so.
    dots : bool
        Whether a line without length shows, as the caps of its stroke.
    width : float
        Of the stroke.

    Returns
    -------
    Outline or None
        None if there is nothing to see.
    """
    curves = subpath.curves
    curves = curves[(curves != curves[:, :1]).any(axis=(1, 2))]
    if not len(curves):
        if stroked and dots and (subpath.closed or len(subpath.curves)):
            return _dot(subpath.start, width)
        return None
    closed = subpath.closed or not stroked
    if closed:
        curves = _closed(curves)
    if filled and not stroked and _is_flat(curves):
        return None
    return Outline(curves, closed)


def _dot(place: Points, width: float) -> Outline:
    """A dot as a line too short to be seen: what has no length has no direction to be moved by."""
    end = place + np.array([DOT * width, 0.0])
    return Outline(line_curves(place[None], end[None]), closed=False)


def encloses_nothing(ring: Outline) -> bool:
    """Whether a ring, closed by a line, lies on one line, so that nothing fills it."""
    return _is_flat(ring.curves) or not np.ptp(ring.curves.reshape(-1, 2), axis=0).any()


def unfolded(rings: Sequence[Outline], style: Style) -> list[tuple[tuple[Outline, ...], Style]]:
    """Stroked rings as they are moved: what runs out and back on one line becomes that line.

    At both of its ends such a ring is joined, not capped; a miter of no angle is cut off.

    Returns
    -------
    list of rings and the style that strokes them
    """
    stroke = style.stroke
    assert stroke is not None  # it is strokes that are asked for
    flat = [ring.closed and _is_flat(ring.curves) for ring in rings]
    if stroke.dashes or not any(flat):
        return [(tuple(rings), style)]
    cap: Literal["round", "butt"] = "round" if stroke.join == "round" else "butt"
    lines = tuple(_whole_line(ring) for ring, is_flat in zip(rings, flat, strict=True) if is_flat)
    others = tuple(ring for ring, is_flat in zip(rings, flat, strict=True) if not is_flat)
    capped = replace(style, stroke=replace(stroke, cap=cap))
    return [part for part in ((others, style), (lines, capped)) if part[0]]


def _whole_line(ring: Outline) -> Outline:
    """The line between those ends of a flat ring's curves that are farthest apart."""
    points = ring.curves[:, [0, 3]].reshape(-1, 2)
    start = points[np.abs(points - points[0]).sum(axis=1).argmax()]
    end = points[np.abs(points - start).sum(axis=1).argmax()]
    first, last = (start, end) if tuple(start) <= tuple(end) else (end, start)
    return Outline(line_curves(first[None], last[None]), closed=False)


def _closed(curves: Curves) -> Curves:
    start, end = curves[0, 0], curves[-1, 3]
    gap = np.abs(end - start).max()
    if gap == 0:
        return curves
    points = curves.reshape(-1, 2)
    if gap <= CLOSING_GAP * np.ptp(points, axis=0).max():
        curves = curves.copy()
        curves[-1, 3] = start
        # The curve may have been nothing but that gap.
        return curves if (curves[-1] != start).any() or len(curves) == 1 else curves[:-1]
    return np.concatenate([curves, line_curves(end[None], start[None])])


def _is_flat(curves: Curves) -> bool:
    """Whether all control points lie on one line, so that nothing is enclosed."""
    points = curves.reshape(-1, 2)
    offsets = points - points[0]
    size = np.abs(offsets).max()
    if size == 0:
        return True
    farthest = offsets[np.abs(offsets).max(axis=1).argmax()]
    # Divided by the size first: neither square may vanish in a tiny drawing.
    return bool(np.abs(cross(offsets / size, farthest / size)).max() <= FLAT)
