"""Choosing which matched samples of an outline move as nodes; the curves between follow them."""

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index, Points
from shapetween.geometry.linearmaps import as_complex, squared
from shapetween.geometry.polygon import polygon_area

__all__ = ["outline_nodes"]

#: Steps, in roots of the area, in which distances are compared. Finer, and rounding, so the unit,
#: chooses among samples of one distance; coarser, and nodes lie beside corners.
GRAIN = 2.0**-30


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
    count = len(source)
    # Both in one array of complex numbers, gone round twice, so that every span is a slice.
    outlines = np.stack([p / np.sqrt(abs(float(polygon_area(p)))) for p in (source, target)])
    around = np.tile(as_complex(outlines), (1, 2))
    nodes = set(kept.tolist())
    ordered = kept.tolist()
    spans = [(i, j) for i, j in zip(ordered, [*ordered[1:], ordered[0] + count], strict=True)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        deviation = _rounded(_distances(around[:, first : last + 1]).max(axis=0))
        if deviation.max() > tolerance:
            middle = first + 1 + int(deviation.argmax())
        elif _rounded(np.abs(around[:, last] - around[:, first])).max() > span:
            middle = (first + last) // 2
        else:
            continue
        nodes.add(middle % count)
        spans += [(first, middle), (middle, last)]
    return np.array(sorted(nodes), dtype=np.intp)


def _distances(points: Complex) -> Floats:
    """Distance of the inner points to the chord of the outer ones, its ends counted, (K, N - 2).

    Parameters
    ----------
    points : (K, N) complex128
    """
    offset = points[:, 1:-1] - points[:, :1]
    chord = points[:, -1:] - points[:, :1]
    square = squared(chord)
    along = (offset * chord.conj()).real / np.where(square > 0, square, 1.0)
    return np.abs(offset - np.minimum(np.maximum(along, 0.0), 1.0) * chord)


def _rounded(distances: Floats) -> Floats:
    return np.asarray(np.round(distances / GRAIN) * GRAIN)
