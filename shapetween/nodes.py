"""Choosing which matched samples of an outline move as nodes; the curves between follow them."""

import numpy as np

from shapetween.arrays import Floats, Index, Points
from shapetween.geometry.polygon import polygon_area

__all__ = ["outline_nodes"]


def outline_nodes(
    source: Points, target: Points, kept: Index, *, tolerance: float, span: float
) -> Index:
    """Fewest samples, the kept ones among them, whose polygon stays near both outlines.

    Parameters
    ----------
    source, target : (N, 2) float64
        Matched samples of two closed outlines.
    kept : (n,) intp
        Samples that are nodes in any case, increasing, at least 2.
    tolerance : float
        Greatest distance of a sample from the chord of its span, in either outline, as a share of
        the root of its area.
    span : float
        Greatest length of a chord, in the same unit.

    Returns
    -------
    (m,) intp
        Increasing.

    Notes
    -----
    Douglas and Peucker's simplification of the two outlines as one curve in four dimensions, the
    deviation being the larger of the two.
    """
    outlines = [p / np.sqrt(abs(float(polygon_area(p)))) for p in (source, target)]
    count = len(source)
    nodes = set(kept.tolist())
    ordered = kept.tolist()
    spans = [(i, j) for i, j in zip(ordered, [*ordered[1:], ordered[0] + count], strict=True)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        inner = np.arange(first + 1, last)
        deviation, length = np.zeros(len(inner)), 0.0
        for points in outlines:
            a, b = points[first % count], points[last % count]
            deviation = np.maximum(deviation, _distance(points[inner % count], a, b))
            length = max(length, float(np.linalg.norm(b - a)))
        if deviation.max() > tolerance:
            middle = first + 1 + int(deviation.argmax())
        elif length > span:
            middle = (first + last) // 2
        else:
            continue
        nodes.add(middle % count)
        spans += [(first, middle), (middle, last)]
    return np.array(sorted(nodes), dtype=np.intp)


def _distance(points: Points, a: Points, b: Points) -> Floats:
    """Distance of points to the chord a-b, the part beyond its ends counted, (N,)."""
    chord = b - a
    square = float(chord @ chord)
    along = (
        np.clip((points - a) @ chord / square, 0.0, 1.0) if square > 0 else np.zeros(len(points))
    )
    return np.asarray(np.linalg.norm(points - a - along[:, None] * chord, axis=1))
