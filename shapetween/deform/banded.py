"""Symmetric matrices summed from small blocks, kept as narrow bands.

A triangulation of a few hundred vertices, numbered from one side to the other, has a matrix whose
non-zeros lie near the diagonal; LAPACK factorises such a band faster than a sparse solver finds
its pattern. The pattern is prepared once and filled many times.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index, Mask

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["BandPattern", "BandSystem", "factorised", "numbered", "substituted"]


def numbered(elements: Index, fixed: Mask) -> tuple[Index, Index]:
    """Number the free vertices so that those of an element lie close (reverse Cuthill-McKee).

    Parameters
    ----------
    elements : (E, K) intp
        Vertices of every element; -1 for none.
    fixed : (V,) bool

    Returns
    -------
    unknowns : (E, K) intp
        Elements in the new numbers; -1 for fixed vertices and for none.
    free : (U,) intp
        The vertex of each number.
    """
    from scipy.sparse import coo_array  # slow to import, and many drawings need no mesh

    free = np.flatnonzero(~fixed)
    number = np.append(np.where(fixed, -1, np.cumsum(~fixed) - 1), -1)
    unknowns = number[elements]
    i, j = (x.ravel() for x in np.broadcast_arrays(unknowns[:, :, None], unknowns[:, None, :]))
    both = (i >= 0) & (j >= 0)
    graph = coo_array((np.ones(both.sum()), (i[both], j[both])), shape=(len(free), len(free)))
    order = _from_side_to_side(graph.tocsr())
    rank = np.append(np.argsort(order), -1)
    return rank[unknowns], free[order]


def _from_side_to_side(graph: "csr_array[np.float64]") -> Index:
    """The vertices of a symmetric graph in reverse Cuthill-McKee order.

    scipy's own sorts the degrees by whatever the processor sorts with, which leaves equal ones in
    another order on another, and so the last digits of everything solved.
    """
    graph.sort_indices()
    degree = np.diff(graph.indptr)
    row = np.repeat(np.arange(len(degree)), degree)
    beside = graph.indices[np.lexsort((degree[graph.indices], row))].tolist()
    begin = graph.indptr.tolist()
    order: list[int] = []
    seen = [False] * len(degree)
    for start in np.argsort(degree, kind="stable").tolist():
        if seen[start]:
            continue
        seen[start] = True
        reached = len(order)
        order.append(start)
        while reached < len(order):
            here = order[reached]
            for vertex in beside[begin[here] : begin[here + 1]]:
                if not seen[vertex]:
                    seen[vertex] = True
                    order.append(vertex)
            reached += 1
    return np.array(order[::-1], dtype=np.intp)


@dataclass(frozen=True, slots=True, eq=False)
class BandPattern:
    """Where the blocks of elements go in a band.

    Attributes
    ----------
    elements : (E, K) intp
        Unknowns of every element, numbered for a narrow band; -1 stands for a known value.
    count : int
        Number of unknowns.
    height : int
        Rows of the band, the diagonal included.
    """

    elements: Index
    count: int
    height: int
    _entry: Index
    _cell: Index

    @classmethod
    def of(cls, elements: Index, count: int) -> "BandPattern":
        """Pattern of elements (E, K) over `count` unknowns."""
        i, j = np.broadcast_arrays(elements[:, :, None], elements[:, None, :])
        entry = np.flatnonzero((j >= 0) & (i >= j))
        row, column = i.ravel()[entry], j.ravel()[entry]
        height = int((row - column).max(initial=0)) + 1
        return cls(elements, count, height, entry, (row - column) + height * column)

    def band(self, blocks: Floats) -> Floats:
        """Sum symmetric blocks (E, K, K) into the lower band, (height, count), as LAPACK has it."""
        size = self.height * self.count
        values = blocks.reshape(-1)[self._entry]
        cells = np.bincount(self._cell, weights=values, minlength=size)
        return np.asarray(cells.reshape(self.count, self.height).T, dtype=np.float64)

    def vector(self, parts: Floats) -> Floats:
        """Sum the elements' parts (E, K) of a vector, (count,)."""
        known = self.elements < 0
        where = np.where(known, self.count, self.elements).ravel()
        sums = np.bincount(where, weights=parts.ravel(), minlength=self.count + 1)
        return np.asarray(sums[: self.count], dtype=np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class BandSystem:
    """Points in the plane that solve ``((1 - t) A + t B) x = r`` with some of them known.

    Attributes
    ----------
    free : (U,) intp
        Unknown points, in the order of the band.
    """

    free: Index
    _bands: tuple[Floats, Floats]
    _sum: "csr_array[np.float64, tuple[int, int]]"
    _border: Index
    _corners: Index
    _blocks: tuple[Floats, Floats]

    @classmethod
    def of(cls, elements: Index, fixed: Mask, start: Floats, end: Floats) -> "BandSystem":
        """Sum A and B from blocks (E, K, K) of elements (E, K); -1 names no point."""
        from scipy.sparse import coo_array

        unknowns, free = numbered(elements, fixed)
        pattern = BandPattern.of(unknowns, len(free))
        rows, columns = unknowns[unknowns >= 0], np.flatnonzero(unknowns.ravel() >= 0)
        total = coo_array(
            (np.ones(len(rows)), (rows, columns)), shape=(len(free), unknowns.size)
        ).tocsr()
        known = (unknowns < 0) & (elements >= 0)
        border = np.flatnonzero(known.any(axis=1))
        corners = np.where(known, elements, -1)[border]
        bands = pattern.band(start), pattern.band(end)
        return cls(free, bands, total, border, corners, (start[border], end[border]))

    def solver(self, t: Floats, points: Complex) -> Callable[[Complex], Complex]:
        """Factorise at the times (F,), with known points from (F, V), as complex numbers.

        Returns
        -------
        callable
            From the elements' parts of r, (F, E, K), to all points, (F, V).
        """
        start, end = self._bands
        factors = [factorised((1 - s) * start + s * end) for s in t]
        time = t[:, None, None, None]
        blocks = (1 - time) * self._blocks[0] + time * self._blocks[1]
        held = np.where(self._corners >= 0, points[:, self._corners], 0)
        pull = (blocks @ held[..., None])[..., 0]

        def solve(parts: Complex) -> Complex:
            frames, count, corners = parts.shape
            parts = parts.copy()
            parts[:, self._border] -= pull
            flat = np.ascontiguousarray(np.moveaxis(parts, 0, 2)).view(np.float64)
            right = np.asarray(self._sum @ flat.reshape(count * corners, 2 * frames))
            solved = points.copy()
            for frame, factor in enumerate(factors):
                two = right[:, 2 * frame : 2 * frame + 2]
                solution = np.ascontiguousarray(substituted(factor, two))
                solved[frame, self.free] = solution.view(np.complex128)[:, 0]
            return solved

        return solve


def factorised(band: Floats) -> Floats:
    """Cholesky factor of a lower band (height, U), which it may overwrite.

    LAPACK itself costs less than its wrapper.

    Raises
    ------
    LinAlgError
        If the matrix is not positive definite.
    """
    from scipy.linalg.lapack import dpbtrf

    factor, failed = dpbtrf(band, lower=1, overwrite_ab=1)
    if failed:
        raise np.linalg.LinAlgError(f"not positive definite at unknown {failed}")
    return np.asarray(factor)


def substituted(factor: Floats, right: Floats) -> Floats:
    """Solution for right sides (U, K) by a factor of `factorised`, (U, K)."""
    from scipy.linalg.lapack import dpbtrs

    return np.asarray(dpbtrs(factor, right, lower=1)[0])
