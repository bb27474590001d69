"""One quad topology over two matched outlines."""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Index, Mask, Points, frozen
from shapetween.errors import OutlineError, ShapeError
from shapetween.geometry.polygon import polygon_area
from shapetween.mesh import MeshPair
from shapetween.meshing.candidates import candidate_nodes, simplified
from shapetween.meshing.contour import Contours, arc_waste
from shapetween.meshing.quality import face_figures
from shapetween.meshing.repair import Faces, repaired, simple_nodes
from shapetween.meshing.search import LEVELS, Search
from shapetween.meshing.slide import slid

__all__ = ["MatchedMesh", "mesh_matched"]

#: Candidates for nodes. More find better meshes in time that grows with their third power.
CANDIDATES = 64

#: Nodes of a mesh where the search finds none.
FALLBACK_NODES = 24


@dataclass(frozen=True, slots=True, eq=False)
class MatchedMesh:
    """A mesh whose outer vertices are matched samples of two outlines.

    Attributes
    ----------
    pair : MeshPair
        The first n vertices are the nodes, round the outline; any others lie inside.
    nodes : (n,) intp
        Samples the nodes are, increasing.
    level : str
        How it was found: "search", "repaired" where faces had to be cut anew, or "overlay" where
        inner vertices were needed as well.
    sine : float
        Least corner sine of the quads in both shapes; 1 if there are none.
    perspective : float
        Largest ratio of the homography's w over the corners of a quad.
    left_out : (float, float)
        Area between the node polygon and the samples' polygon in source and target, as a share of
        the latter's. Stretches that fold back over themselves count more than their area.
    """

    pair: MeshPair
    nodes: Index
    level: str
    sine: float
    perspective: float
    left_out: tuple[float, float]


def mesh_matched(
    source: Points, target: Points, corners: Mask | None = None, quads: int | None = None
) -> MatchedMesh:
    """Mesh two matched outlines with few large quads.

    Parameters
    ----------
    source, target : (N, 2) float64
        Samples of two closed outlines, sample k of one matched to sample k of the other, both
        running clockwise as drawn. Scales and places are unrelated.
    corners : (N,) bool, optional
        Samples that nodes had better be: corners and joints of either outline.
    quads : int, optional
        About how many quads; by default as few as the shapes need.

    Raises
    ------
    OutlineError
        If an outline has no area, runs the wrong way round or crosses itself.
    ShapeError
        If the arrays do not fit together.
    """
    outlines = np.stack(
        [frozen(points, np.float64, last=(2,)) for points in (source, target)]
        if len(source) == len(target)
        else _unlike(source, target)
    )
    total = outlines.shape[1]
    marks = np.zeros(total, bool) if corners is None else np.asarray(corners, dtype=bool)
    if total < 3 or marks.shape != (total,):
        raise ShapeError(f"{total} samples and {len(marks)} corner marks do not make two outlines")
    area = polygon_area(outlines)
    if (area <= 0).any():
        raise OutlineError("an outline has no area, or crosses itself")
    scale = 1 / np.sqrt(area)
    middle = outlines.mean(axis=1, keepdims=True)
    contours = Contours.of((outlines - middle) * scale[:, None, None])

    candidates = candidate_nodes(contours.points, marks, CANDIDATES)
    for level in LEVELS:
        found = Search.over(contours, candidates, level).cheapest()
        if np.isfinite(found.cost):
            break
    nodes, faces, untouched = _sound(contours, marks, found.quads, found.triangles)

    points = faces.points / scale[:, None, None] + middle
    points[:, : len(nodes)] = outlines[:, nodes]
    figures = face_figures(faces.points[:, faces.quads])
    waste = arc_waste(contours, nodes, np.roll(nodes, -1)).sum(axis=-1)
    return MatchedMesh(
        MeshPair(points[0], points[1], faces.quads, faces.triangles),
        frozen(nodes, np.intp, ndim=1),
        "overlay" if points.shape[1] > len(nodes) else "search" if untouched else "repaired",
        float(figures.sine.min(initial=1.0)),
        float(figures.perspective.max(initial=1.0)),
        (float(waste[0]), float(waste[1])),
    )


def _unlike(source: Points, target: Points) -> list[Points]:
    raise ShapeError(f"{len(source)} source samples and {len(target)} target samples")


def _sound(
    contours: Contours, corners: Mask, quads: Index, triangles: Index
) -> tuple[Index, Faces, bool]:
    """Slide the nodes of a mesh, then mend what is not sound.

    Returns the nodes, the faces over them, and whether nothing had to be mended.
    """
    nodes = np.unique(np.concatenate([quads.ravel(), triangles.ravel()]))
    if len(nodes) < 3:
        nodes = simplified(contours.points, corners, FALLBACK_NODES)
    quads, triangles = np.searchsorted(nodes, quads), np.searchsorted(nodes, triangles)
    nodes = slid(contours, corners, nodes, quads, triangles)
    sides = [np.stack([f, np.roll(f, -1, axis=1)], axis=-1) for f in (quads, triangles)]
    samples = nodes[np.concatenate([s.reshape(-1, 2) for s in sides])]
    nodes = simple_nodes(contours.points, np.sort(nodes))
    chords = np.unique(np.sort(np.searchsorted(nodes, samples), axis=1), axis=0)
    faces = repaired(contours.points[:, nodes], chords)
    return nodes, faces, len(faces.quads) == len(quads) and len(faces.triangles) == len(triangles)
