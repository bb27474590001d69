"""Meshes as JSON that a person can read, edit and draw by hand, and what makes one valid.

One mesh is an object with ``source`` and ``target``, the vertices in the two drawings' own units,
and ``quads`` and ``triangles``, which count vertices from 0. Several are ``{"meshes": [...]}``,
each with the ``id`` of the shape it belongs to.
"""

import json
from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Index, Points
from shapetween.base.errors import MeshError, ShapetweenError
from shapetween.geometry.polygon import corner_sines, polygon_area
from shapetween.io.jsonfile import check_keys, parse, real, rows
from shapetween.mesh.pair import MeshPair

__all__ = ["check_faces", "check_mesh", "dump_meshes", "load_meshes"]

#: How far a node on the boundary may be from the outline, as a share of the outline's diagonal.
#: Smaller refuses nodes placed by eye; larger takes a mesh that was made for another shape.
NEAR_OUTLINE = 0.01

#: Least sine of a quad's corner. Raise it and thin but valid quads are refused; lower it and what
#: is left of a corner is rounding error.
MIN_CORNER_SINE = 1e-6

_POINTS, _FACES = {"source": 2, "target": 2}, {"quads": 4, "triangles": 3}


def dump_meshes(meshes: Sequence[tuple[str, MeshPair]]) -> str:
    """Meshes with the ids of their shapes as JSON, a vertex or face to a line.

    A single mesh stands alone; an empty id is left out.
    """
    if len(meshes) == 1:
        return _dumped(*meshes[0], indent="") + "\n"
    bodies = ",\n".join("  " + _dumped(name, pair, indent="  ") for name, pair in meshes)
    return f'{{"meshes": [\n{bodies}\n]}}\n'


def _dumped(name: str, pair: MeshPair, indent: str) -> str:
    fields = [f'"id": {json.dumps(name)}'] if name else []
    for key in (*_POINTS, *_FACES):
        rows = [", ".join(f"{value:.12g}" for value in row) for row in getattr(pair, key).tolist()]
        if rows:
            body = ",\n".join(f"{indent}  [{row}]" for row in rows)
            fields.append(f'"{key}": [\n{body}\n{indent} ]')
    return "{\n" + ",\n".join(f"{indent} {field}" for field in fields) + f"\n{indent}}}"


def load_meshes(text: str, name: str) -> list[tuple[str, MeshPair]]:
    """Meshes with the ids of their shapes, read strictly.

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
    if not isinstance(data, dict):
        raise MeshError(f"{name}: expected an object with source, target and quads, or meshes")
    if "meshes" not in data:
        return [_mesh(data, name, "")]
    check_keys(data, {"meshes"}, f"{name}: ")
    items = data["meshes"]
    if not isinstance(items, list) or not items:
        raise MeshError(f"{name}: meshes: expected a list of at least one mesh")
    # Several of one id are the pieces of one shape, in order.
    return [_mesh(item, name, f"meshes[{k}]") for k, item in enumerate(items)]


def _mesh(data: object, name: str, path: str) -> tuple[str, MeshPair]:
    """One mesh; `path` is its place in the file, empty for the whole of it."""
    place = f"{name}: {path}: " if path else f"{name}: "
    if not isinstance(data, dict):
        raise MeshError(f"{place}expected an object with source, target and quads")
    check_keys(data, {"id", *_POINTS, *_FACES}, place)
    inner = f"{name}: {path}." if path else f"{name}: "
    mesh_id = data.get("id", "")
    if not isinstance(mesh_id, str):
        raise MeshError(f"{inner}id: expected text")
    for key in _POINTS:
        if key not in data:
            raise MeshError(f"{place}has no {key}; expected a list of [x, y]")
    points = {key: rows(data[key], inner + key, width, real) for key, width in _POINTS.items()}
    faces = {
        key: rows(data.get(key, []), inner + key, width, _index) for key, width in _FACES.items()
    }
    try:
        return mesh_id, MeshPair(**points, **faces)
    except ShapetweenError as error:
        raise MeshError(f"{place}{error}") from error


def _index(value: object, place: str) -> int:
    # A vertex number past any list is refused here, before it can fail to fit an array's items.
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**31:
        raise MeshError(f"{place}: expected the number of a vertex, counted from 0")
    return value


def check_mesh(pair: MeshPair, source_polygon: Points, target_polygon: Points) -> Index:
    """Check that a mesh is valid in both shapes and covers them.

    Every face must run clockwise as drawn and every quad be convex; faces must meet edge to edge;
    the boundary must be one simple cycle; and the boundary's vertices must lie on the outlines.

    Parameters
    ----------
    pair : MeshPair
    source_polygon, target_polygon : (N, 2) float64
        The outlines, as closed polygons.

    Returns
    -------
    (B,) intp
        Vertices of the boundary, clockwise as drawn, from the one that comes first.

    Raises
    ------
    MeshError
        What is wrong, and with which face, edge or vertex.

    Notes
    -----
    Faces that all run clockwise inside a simple boundary cannot overlap, nor leave a gap: each
    point is covered as often as the boundary winds around it, which is once.
    """
    check_faces(pair)
    cycle = _boundary(pair)
    sides = (
        ("source", pair.source, source_polygon),
        ("target", pair.target, target_polygon),
    )
    for side, points, polygon in sides:
        _check_boundary(side, points, cycle, polygon)
    return cycle


def check_faces(pair: MeshPair) -> None:
    """Check that every face runs clockwise as drawn at both ends, and every quad is convex there.

    Raises
    ------
    MeshError
        What is wrong, and with which face.
    """
    for side, points in (("source", pair.source), ("target", pair.target)):
        _check_side(pair, side, points)


def _check_side(pair: MeshPair, side: str, points: Points) -> None:
    for kind, faces in (("triangle", pair.triangles), ("quad", pair.quads)):
        corners = points[faces]
        backward = np.flatnonzero(polygon_area(corners) <= 0)
        if backward.size:
            raise MeshError(
                f"{side}: {kind} {backward[0]} has no area or runs counter-clockwise as drawn; "
                "expected its vertices clockwise"
            )
        sharp = np.argwhere(corner_sines(corners) < MIN_CORNER_SINE)
        if sharp.size:
            face, corner = sharp[0]
            raise MeshError(
                f"{side}: {kind} {face} is not convex at vertex {faces[face, corner]}; "
                "expected convex faces"
            )


def _boundary(pair: MeshPair) -> Index:
    """The cycle of edges with a face on one side only, clockwise as the faces are."""
    edges = np.concatenate(
        [
            np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
            for faces in (pair.quads, pair.triangles)
        ]
    )
    directed, counts = np.unique(edges, axis=0, return_counts=True)
    if (counts > 1).any():
        a, b = directed[counts.argmax()]
        raise MeshError(f"edge {a}-{b}: more than one face lies on the same side of it")
    unused = np.setdiff1d(np.arange(len(pair.source)), edges)
    if unused.size:
        raise MeshError(f"vertex {unused[0]} belongs to no face")

    count = len(pair.source)
    codes = directed[:, 0] * count + directed[:, 1]
    inner = np.isin(codes, directed[:, 1] * count + directed[:, 0])
    starts, ends = directed[~inner].T
    again = np.flatnonzero(np.bincount(starts, minlength=count) > 1)
    if again.size:
        raise MeshError(f"vertex {again[0]}: the boundary touches itself there")
    following = dict(zip(starts.tolist(), ends.tolist(), strict=True))
    if not following:
        raise MeshError("the mesh has no boundary")
    cycle = [int(starts[0])]
    while (vertex := following[cycle[-1]]) != cycle[0]:
        cycle.append(vertex)
    if len(cycle) < len(following):
        other = min(set(following) - set(cycle))
        raise MeshError(
            f"the boundary is more than one cycle: one passes vertex {cycle[0]}, another vertex "
            f"{other}; expected one mesh without holes, its faces joined along edges"
        )
    return np.array(cycle, np.intp)


def _check_boundary(side: str, points: Points, cycle: Index, polygon: Points) -> None:
    """The boundary crosses itself nowhere, and its vertices lie on the outline."""
    from shapely import LinearRing, is_simple

    if not is_simple(LinearRing(points[cycle])):
        raise MeshError(f"{side}: the mesh's boundary crosses itself")
    size = float(np.linalg.norm(np.ptp(polygon, axis=0)))
    far = _distances(points[cycle], polygon)
    worst = int(far.argmax())
    if far[worst] > NEAR_OUTLINE * size:
        x, y = points[cycle[worst]]
        raise MeshError(
            f"{side}: vertex {cycle[worst]} at {x:.6g},{y:.6g} is {far[worst]:.3g} from the "
            f"outline; expected at most {NEAR_OUTLINE * size:.3g}"
        )


def _distances(points: Points, polygon: Points) -> Points:
    """Distance of each point to the nearest side of a closed polygon, (P,)."""
    sides = np.roll(polygon, -1, axis=0) - polygon
    offsets = points[:, None] - polygon
    length = (sides**2).sum(-1)
    share = np.clip((offsets * sides).sum(-1) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    return np.asarray(np.linalg.norm(offsets - share[..., None] * sides, axis=-1).min(axis=1))
