"""From any dissection to a valid mesh: simple node polygons, faces convex in both shapes.

Chords that do not stay inside are dropped, faces that are not valid are cut anew, and what has no
common diagonal is filled by an overlay. It always succeeds for simple outlines.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.base.errors import OutlineError
from shapetween.geometry.polygon import polygon_area
from shapetween.mesh.contour import rounded
from shapetween.mesh.dissection import dissect, joined_chains, linked_chains
from shapetween.mesh.inner import joined_triangles, smoothed
from shapetween.mesh.overlay import overlay
from shapetween.mesh.quality import MIN_CORNER_SINE, face_figures
from shapetween.mesh.simple import inner_diagonals, touching_sides

__all__ = ["Faces", "mesh_polygon", "repaired", "simple_nodes"]

#: Quads tried at once on a fixed polygon. Polygons with more are halved first; smaller, and the
#: halves fit worse.
QUAD_LIMIT = 60_000

#: Prices, in quads, of a triangle and of a sliver's sharpness.
TRIANGLE_PRICE, SLIVER_PRICE = 1.2, 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """Faces of one polygon in two shapes.

    Attributes
    ----------
    points : (2, V, 2) float64
        The polygon's corners, then inner vertices.
    quads : (Q, 4) intp
    triangles : (T, 3) intp
    """

    points: Points
    quads: Index
    triangles: Index


def simple_nodes(points: Points, nodes: Index) -> Index:
    """Add samples to nodes until their polygon is simple and clockwise in both shapes.

    Parameters
    ----------
    points : (2, N, 2) float64
    nodes : (n,) intp
        Increasing.

    Raises
    ------
    OutlineError
        If even the polygon of all samples crosses itself.
    """
    total = points.shape[1]
    while True:
        rings = points[:, nodes]
        touching = touching_sides(rings[0]) | touching_sides(rings[1])
        if (polygon_area(rings) <= 0).any():
            touching[:] = True
        if not touching.any():
            return nodes
        added = []
        for side in np.flatnonzero(touching).tolist():
            first = int(nodes[side])
            gap = (int(nodes[(side + 1) % len(nodes)]) - first - 1) % total + 1
            if gap > 1:
                added.append(_deepest(points, first, gap))
        if not added:
            raise OutlineError("an outline crosses or touches itself")
        nodes = np.array(sorted({*nodes.tolist(), *added}), dtype=np.intp)


def _deepest(points: Points, first: int, gap: int) -> int:
    """Sample between `first` and `first + gap` furthest off the chord in either shape."""
    total = int(points.shape[1])
    arc = points[:, np.arange(first, first + gap + 1) % total]
    chord = arc[:, -1:] - arc[:, :1]
    offset = arc[:, 1:-1] - arc[:, :1]
    size = np.maximum((chord**2).sum(-1), np.finfo(float).tiny)
    share = np.clip((offset * chord).sum(-1) / size, 0, 1)
    off = ((offset - share[..., None] * chord) ** 2).sum(-1).sum(axis=0)
    return (first + 1 + int(rounded(off).argmax())) % total  # of equals the first


def repaired(rings: Points, chords: Index) -> Faces:
    """Mesh a polygon in two shapes, keeping those of the given chords that are valid.

    Parameters
    ----------
    rings : (2, n, 2) float64
        Simple polygons, clockwise as drawn.
    chords : (K, 2) intp
        Pairs of corners that do not cross each other, best kept first.
    """
    inside = inner_diagonals(rings[0]) & inner_diagonals(rings[1])
    pieces = [list(range(rings.shape[1]))]
    for a, b in np.sort(chords, axis=1).tolist():
        if not inside[a, b]:
            continue
        piece = next((p for p in pieces if a in p and b in p), None)
        if piece is not None:
            pieces.remove(piece)
            pieces += _halves(piece, *sorted((piece.index(a), piece.index(b))))
    mesh = _joined(rings, pieces)
    points = mesh.points
    if points.shape[1] > rings.shape[1]:
        points = smoothed(points, rings.shape[1], [mesh.quads, mesh.triangles])
    quads, triangles = joined_triangles(points, mesh.triangles)
    return Faces(points, np.concatenate([mesh.quads, quads]), triangles)


def _halves(piece: list[int], i: int, j: int) -> list[list[int]]:
    return [piece[i : j + 1], piece[j:] + piece[: i + 1]]


def _joined(rings: Points, pieces: list[list[int]]) -> Faces:
    """Mesh every piece of a polygon and put the faces together."""
    fours = [piece for piece in pieces if len(piece) == 4]
    sines = face_figures(rings[:, np.array(fours, dtype=np.intp).reshape(-1, 4)]).sine.tolist()
    points = rings
    quads: list[list[int]] = []
    triangles: list[list[int]] = []
    for piece in pieces:
        if len(piece) == 3:
            triangles.append(piece)
            continue
        if len(piece) == 4 and sines.pop(0) > MIN_CORNER_SINE:
            quads.append(piece)
            continue
        faces = mesh_polygon(rings[:, piece])
        extra = faces.points[:, len(piece) :]
        names = np.array(piece + list(range(points.shape[1], points.shape[1] + extra.shape[1])))
        points = np.concatenate([points, extra], axis=1)
        quads += names[faces.quads].tolist()
        triangles += names[faces.triangles].tolist()
    return Faces(
        points,
        np.array(quads, dtype=np.intp).reshape(-1, 4),
        np.array(triangles, dtype=np.intp).reshape(-1, 3),
    )


def mesh_polygon(rings: Points) -> Faces:
    """Mesh a polygon in two shapes on its own corners, or with inner vertices if it must be.

    Parameters
    ----------
    rings : (2, n, 2) float64
        Simple polygons of at least 4 corners, clockwise as drawn.
    """
    count = rings.shape[1]
    inside = inner_diagonals(rings[0]) & inner_diagonals(rings[1])
    if inside.any():
        found = _dissected(rings, inside)
        if found is not None:
            return found
        i, j = np.nonzero(np.triu(inside))
        length = np.sqrt(((rings[:, i] - rings[:, j]) ** 2).sum(-1)).sum(axis=0)
        best = int(np.lexsort((length, -np.minimum(j - i, count - (j - i))))[0])
        return _joined(rings, _halves(list(range(count)), int(i[best]), int(j[best])))
    faces, inner = overlay(rings)
    return _joined(np.concatenate([rings, inner], axis=1), faces)


def _dissected(rings: Points, inside: Mask) -> Faces | None:
    """Cut a polygon by common inner diagonals alone, if that is possible."""
    count = rings.shape[1]
    own = np.arange(count)
    links = np.triu(inside)
    links[own[:-1], own[1:]] = True
    lids = np.triu(inside)
    lids[0, -1] = True
    chains = linked_chains(links)
    if chains.shape[1] * max(1.0, links.sum() / count) > QUAD_LIMIT:
        return None
    triangles = chains[:, lids[chains[0], chains[2]]].T
    sharp = face_figures(rings[:, triangles]).sine
    valid = sharp > 0
    triangles, sharp = triangles[valid], sharp[valid]
    first, second = joined_chains(chains, lids)
    quads = np.stack([*chains[:, first], chains[2][second]], axis=1)
    figures = face_figures(rings[:, quads])
    valid = figures.sine > MIN_CORNER_SINE
    sides = np.full((count, count), np.inf)
    sides[own[:-1], own[1:]] = 0.0
    closing = np.full(count, np.inf)
    closing[0] = 0.0
    found = dissect(
        sides,
        np.where(np.triu(inside), 0.0, np.inf),
        closing,
        (quads[valid], _quad_costs(figures.sine[valid], figures.usable[valid])),
        (triangles, TRIANGLE_PRICE + SLIVER_PRICE * np.clip(1 - sharp / 0.3, 0, 1)),
    )
    if not np.isfinite(found.cost):
        return None
    return Faces(rings, found.quads, found.triangles)


def _quad_costs(sine: Floats, usable: Mask) -> Floats:
    return np.asarray(1 + np.clip(1 - sine / 0.5, 0, 1) + ~usable)
