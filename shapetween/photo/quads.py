"""Quads of two pictures: read from JSON or from drawings, checked, and joined into meshes.

The JSON is ``{"quads": [{"id": "board", "a": [[x, y] x 4], "b": [[x, y] x 4], "depth": 0}, ...]}``
in pixels, x to the right and y down from the outer corner of the first pixel; ``id`` and ``depth``
may be left out.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Affine, Index, Points
from shapetween.base.errors import MeshError
from shapetween.geometry.affine import mapped
from shapetween.geometry.polygon import corner_sines, cross, polygon_area
from shapetween.io.jsonfile import check_keys, parse, real, rows
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing, Shape

__all__ = ["PictureQuad", "load_quads", "meshes_of_quads", "quads_of_drawings"]

#: Least sine of a corner. Raise it and boards seen nearly edge-on are refused; lower it and what
#: is left of a corner is rounding error.
MIN_CORNER_SINE = 1e-3

#: Corners nearer than this in both pictures are one, in pixels: a hand does no better.
SAME_CORNER = 0.5

#: How far a side may bulge and still be straight, as a share of its length.
STRAIGHT = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class PictureQuad:
    """A quad of picture A and what it becomes in B.

    Attributes
    ----------
    name : str
        What messages call it.
    a, b : (4, 2) float64
        Corners in each picture's own pixels, in the same order, convex.
    depth : float
        Greater is nearer.
    """

    name: str
    a: Points
    b: Points
    depth: float = 0.0


def load_quads(text: str, name: str) -> list[PictureQuad]:
    """Quads from JSON, read strictly.

    Parameters
    ----------
    text : str
    name : str
        What errors call the file.

    Raises
    ------
    MeshError
        If anything is not as it should be; the message names the place in the file.
    """
    data = parse(text, name)
    if not isinstance(data, dict) or "quads" not in data:
        raise MeshError(f'{name}: expected {{"quads": [...]}}')
    check_keys(data, {"quads"}, f"{name}: ")
    items = data["quads"]
    if not isinstance(items, list) or not items:
        raise MeshError(f"{name}: quads: expected a list of at least one quad")
    quads: list[PictureQuad] = []
    for k, item in enumerate(items):
        place = f"{name}: quads[{k}]"
        if not isinstance(item, dict):
            raise MeshError(f"{place}: expected an object with a and b")
        check_keys(item, {"id", "a", "b", "depth"}, f"{place}: ")
        quad_id = item.get("id", str(k))
        if not isinstance(quad_id, str):
            raise MeshError(f"{place}.id: expected text")
        if quad_id in [quad.name for quad in quads]:
            raise MeshError(f"{place}.id: {quad_id!r} is the id of an earlier quad")
        corners = []
        for side in ("a", "b"):
            if side not in item:
                raise MeshError(f"{place}: has no {side}; expected four corners [x, y]")
            points = rows(item[side], f"{place}.{side}", 2, real)
            if len(points) != 4:
                raise MeshError(f"{place}.{side}: {len(points)} corners; expected 4")
            corners.append(points.astype(np.float64))
        depth = real(item.get("depth", 0), f"{place}.depth")
        quads.append(_checked(PictureQuad(quad_id, corners[0], corners[1], depth), place))
    return quads


def quads_of_drawings(
    drawings: tuple[Drawing, Drawing], fits: tuple[Affine, Affine], names: tuple[str, str]
) -> list[PictureQuad]:
    """Quads drawn over both pictures, each shape of one drawing with its namesake in the other.

    Parameters
    ----------
    drawings : (Drawing, Drawing)
        Every shape has a name and is one ring of four straight sides. Corners go to corners in
        the order in which they were drawn.
    fits : ((2, 3), (2, 3)) float64
        From each drawing's user units to its picture's pixels.
    names : (str, str)
        What errors call the drawings.

    Returns
    -------
    list of PictureQuad
        Those painted later are nearer.

    Raises
    ------
    MeshError
        If a shape is no quad, or has no namesake.
    """
    found: list[dict[str, Points]] = []
    for drawing, fit, name in zip(drawings, fits, names, strict=True):
        corners: dict[str, Points] = {}
        for k, shape in enumerate(drawing.shapes):
            if not shape.name:
                raise MeshError(f"{name}: shape {k + 1} has no id; every quad needs one")
            if shape.name in corners:
                raise MeshError(f"{name}: two shapes are called {shape.name!r}")
            corners[shape.name] = mapped(_corners(shape, name), fit)
        found.append(corners)
    for one, other, k in ((found[0], found[1], 0), (found[1], found[0], 1)):
        alone = [quad for quad in one if quad not in other]
        if alone:
            raise MeshError(f"{names[k]}: {alone[0]!r} has no namesake in {names[1 - k]}")
    return [
        _checked(PictureQuad(quad, a, found[1][quad], float(k)), f"{names[0]}, {names[1]}: {quad}")
        for k, (quad, a) in enumerate(found[0].items())
    ]


def _corners(shape: Shape, name: str) -> Points:
    """The four corners of a shape that is a quad."""
    if len(shape.rings) == 1 and shape.rings[0].closed:
        curves = shape.rings[0].curves
        chords = curves[:, 3] - curves[:, 0]
        lengths = np.linalg.norm(chords, axis=1)
        curves, chords, lengths = (part[lengths > 0] for part in (curves, chords, lengths))
        handles = curves[:, 1:3] - curves[:, :1]
        bulges = np.abs(cross(handles, chords[:, None])).max(axis=1) / lengths
        if len(curves) == 4 and (bulges <= STRAIGHT * lengths).all():
            return np.asarray(curves[:, 0])
    raise MeshError(f"{name}: {shape.name!r} is no quad; expected four straight sides")


def _checked(quad: PictureQuad, place: str) -> PictureQuad:
    """The quad, once it is known to have an in-between."""
    for side, corners in (("a", quad.a), ("b", quad.b)):
        sines = corner_sines(corners)
        left, right = sines < -MIN_CORNER_SINE, sines > MIN_CORNER_SINE
        if left.all() or right.all():
            continue
        wrong = f"{place}.{side}: quad {quad.name!r}"
        if left.sum() == right.sum() == 2:
            raise MeshError(f"{wrong} crosses itself; expected its corners in order around it")
        corner = int(np.argmin(sines * np.sign(sines.sum())))
        raise MeshError(f"{wrong} is not convex at corner {corner}; expected a convex quad")
    if (polygon_area(quad.a) > 0) != (polygon_area(quad.b) > 0):
        raise MeshError(
            f"{place}: quad {quad.name!r} is inverted between a and b; "
            "expected both clockwise or both counter-clockwise"
        )
    return quad


def meshes_of_quads(quads: Sequence[PictureQuad]) -> list[MeshPair]:
    """Quads joined where they share corners in both pictures, in paint order.

    Of two meshes the one of greater depth is painted later; at equal depth the larger one, by the
    mean of its area at both ends, and then the one that comes later. Only quads of one depth are
    joined.
    """
    corner = _corner_numbers(quads)
    meshes = []
    for group in _hanging_together(corner):
        _, first, faces = np.unique(corner[group], return_index=True, return_inverse=True)
        source = np.concatenate([quads[k].a for k in group])[first]
        target = np.concatenate([quads[k].b for k in group])[first]
        pair = MeshPair(source, target, faces.reshape(-1, 4))
        areas = [np.abs(polygon_area(points[pair.quads])).sum() for points in (source, target)]
        meshes.append((quads[group[0]].depth, float(sum(areas)), pair))
    order = sorted(range(len(meshes)), key=lambda k: meshes[k][:2])
    return [meshes[k][2] for k in order]


def _corner_numbers(quads: Sequence[PictureQuad]) -> Index:
    """Numbers of the quads' corners, equal where they are one, (Q, 4)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import KDTree

    source = np.concatenate([quad.a for quad in quads])
    target = np.concatenate([quad.b for quad in quads])
    depth = np.repeat([quad.depth for quad in quads], 4)
    i, j = KDTree(source).query_pairs(SAME_CORNER, output_type="ndarray").T
    same = (np.linalg.norm(target[i] - target[j], axis=1) <= SAME_CORNER) & (depth[i] == depth[j])
    links = coo_array((np.ones(same.sum()), (i[same], j[same])), shape=(len(source),) * 2)
    labels = connected_components(links, directed=False)[1]
    return np.asarray(labels, np.intp).reshape(-1, 4)


def _hanging_together(corner: Index) -> list[list[int]]:
    """Quads that share corners with one another, each group in the quads' order."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = len(corner)
    owners, columns = np.repeat(np.arange(count), 4), corner.ravel()
    incidence = coo_array((np.ones(len(columns)), (owners, columns)))
    labels = connected_components(incidence @ incidence.T, directed=False)[1]
    return [np.flatnonzero(labels == label).tolist() for label in range(labels.max() + 1)]
