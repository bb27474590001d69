"""One quad topology over two matched outlines."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Index, Mask, Points, frozen
from shapetween.base.errors import OutlineError, ShapeError
from shapetween.geometry.polygon import polygon_area
from shapetween.mesh.candidates import candidate_nodes, far_sample, simplified
from shapetween.mesh.contour import Contours, left_out
from shapetween.mesh.dissection import Dissection
from shapetween.mesh.pair import MeshPair
from shapetween.mesh.prices import QUAD_PRICE
from shapetween.mesh.quality import face_figures
from shapetween.mesh.refine import with_split_quads
from shapetween.mesh.repair import Faces, repaired, simple_nodes
from shapetween.mesh.search import LEVELS, Links, Search
from shapetween.mesh.slide import slid

__all__ = ["MatchedMesh", "mesh_matched"]

#: Candidates for nodes in each round of the search. The second is only for meshes that the first
#: left with triangles or with quads that would not move well. More candidates find better meshes,
#: in time that grows with their third power.
ROUNDS = (64, 112)

#: Prices of a quad between which a number of quads asked for is sought, and in how many steps.
#: Cheaper quads come out as slivers; beyond, quads split across are better.
PRICES, PRICE_STEPS = (0.0, 32.0), 12

#: Price, in quads about, that it is worth to put a node on a corner of an outline.
CORNER_PULL = 0.5

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
        the latter's. Where the outline folds back over itself it is counted for each fold.
    """

    pair: MeshPair
    nodes: Index
    level: str
    sine: float
    perspective: float
    left_out: tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class _Draft:
    """A mesh being made: nodes as samples, cyclically increasing, and faces over their numbers."""

    nodes: Index
    quads: Index
    triangles: Index

    @classmethod
    def of(cls, quads: Index, triangles: Index) -> "_Draft":
        """Faces whose corners are samples."""
        nodes = np.unique(np.concatenate([quads.ravel(), triangles.ravel()]))
        return cls(nodes, np.searchsorted(nodes, quads), np.searchsorted(nodes, triangles))


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

    Notes
    -----
    The same mesh is found wherever the samples start, and whichever outline is the source.
    """
    source, target = (frozen(points, np.float64, last=(2,)) for points in (source, target))
    marks = np.zeros(len(source), bool) if corners is None else np.asarray(corners, dtype=bool)
    if not len(source) == len(target) == len(marks) >= 3:
        raise ShapeError(
            f"{len(source)} and {len(target)} samples with {len(marks)} corner marks; "
            "they must be as many, and at least 3"
        )
    outlines = np.stack([source, target])
    area = polygon_area(outlines)
    if (area <= 0).any():
        raise OutlineError("an outline has no area, runs anticlockwise or crosses itself")
    unit = 1 / np.sqrt(area)[:, None, None]
    step = np.sqrt(((np.roll(outlines, -1, axis=1) - outlines) ** 2).sum(-1))
    round_about = step.sum(axis=1) * unit[:, 0, 0]
    order = slice(None, None, -1 if round_about[0] > round_about[1] else 1)  # rounder shape first
    start = far_sample(outlines * unit)

    from_start = np.roll(outlines, -start, axis=1)[order]
    contours = Contours.of((from_start - from_start[:, :1]) * unit[order])
    draft = _search(contours, np.roll(marks, -start), quads)
    nodes, faces = _valid(contours, draft)

    # Back to the samples' own start, and to the units and the order of the input.
    count = len(nodes)
    samples = (nodes + start) % len(source)
    turn = int(samples.argmin())
    samples = np.roll(samples, -turn)
    inner = faces.points[order, count:] / unit + outlines[:, start : start + 1]
    points = np.concatenate([outlines[:, samples], inner], axis=1)
    number = np.arange(points.shape[1])
    number[:count] = (number[:count] - turn) % count
    pair = MeshPair(points[0], points[1], number[faces.quads], number[faces.triangles])

    figures = face_figures(points[:, pair.quads])
    untouched = len(faces.quads) == len(draft.quads) > 0
    untouched &= len(faces.triangles) == len(draft.triangles)
    lost = left_out(contours, nodes)[order]
    return MatchedMesh(
        pair,
        frozen(samples, np.intp, ndim=1),
        "overlay" if inner.size else "search" if untouched else "repaired",
        float(figures.sine.min(initial=1.0)),
        float(figures.perspective.max(initial=1.0)),
        (float(lost[0]), float(lost[1])),
    )


def _search(contours: Contours, corners: Mask, quads: int | None) -> _Draft:
    """Search for a mesh, and once more round its nodes if it is not valid everywhere."""
    pull = np.where(corners, CORNER_PULL, 0.0)
    draft = None
    for count in ROUNDS:
        kept = None if draft is None else draft.nodes
        candidates = candidate_nodes(contours.points, corners, count, kept)
        links = Links.between(contours, candidates, LEVELS[0].outside)
        for level in LEVELS:
            if level.outside > links.most:
                links = Links.between(contours, candidates, level.outside)
            search = Search.over(links, level)
            found = search.cheapest(QUAD_PRICE)
            if np.isfinite(found.cost):
                break
        else:
            continue
        if quads is not None:
            found = _with_about(search, quads)
        draft = _Draft.of(found.quads, found.triangles)
        nodes = slid(contours, pull, draft.nodes, draft.quads, draft.triangles)
        draft = _Draft(nodes, draft.quads, draft.triangles)
        figures = face_figures(contours.points[:, nodes[draft.quads]])
        if not len(draft.triangles) and figures.usable.all():
            break
    if draft is None:
        nodes = np.sort(simplified(contours.points, corners, FALLBACK_NODES))
        draft = _Draft(nodes, np.zeros((0, 4), np.intp), np.zeros((0, 3), np.intp))
    elif quads is not None:
        samples = draft.nodes[draft.quads], draft.nodes[draft.triangles]
        samples = with_split_quads(contours, *samples, quads), samples[1]
        draft = _Draft.of(*samples)
    return draft


def _with_about(search: Search, quads: int) -> Dissection:
    """The cheapest mesh at the price of a quad that brings it nearest to a number of quads."""
    low, high = PRICES
    best = search.cheapest(QUAD_PRICE)
    for _ in range(PRICE_STEPS):
        price = (low + high) / 2
        found = search.cheapest(price)
        if abs(len(found.quads) - quads) < abs(len(best.quads) - quads):
            best = found
        if len(found.quads) > quads:
            low = price
        else:
            high = price
    return best


def _valid(contours: Contours, draft: _Draft) -> tuple[Index, Faces]:
    """Make the node polygons simple and repair the faces that are not valid.

    Returns the nodes, increasing, and the faces over them.
    """
    sides = [np.stack([f, np.roll(f, -1, axis=1)], -1) for f in (draft.quads, draft.triangles)]
    samples = draft.nodes[np.concatenate([s.reshape(-1, 2) for s in sides])]
    nodes = simple_nodes(contours.points, np.sort(draft.nodes))
    chords = np.unique(np.sort(np.searchsorted(nodes, samples), axis=1), axis=0)
    return nodes, repaired(contours.points[:, nodes], chords)
