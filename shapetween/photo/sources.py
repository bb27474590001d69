"""What moves, from whichever files say so: quads, a mesh, or outlines drawn over the pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Affine, Index, Points
from shapetween.base.errors import MeshError, OptionError, OutlineError, ShapetweenError
from shapetween.base.observe import Observer, unobserved
from shapetween.deform.keyed import KeyedMotion
from shapetween.geometry.affine import inverted, mapped
from shapetween.io import files
from shapetween.io.jsonfile import parse
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing
from shapetween.model.paint import Style
from shapetween.model.srgb import srgb_to_linear
from shapetween.outline.body import Carried, joined_meshes
from shapetween.photo.layers import Piece
from shapetween.photo.quads import PictureQuad, load_quads, meshes_of_quads, quads_of_drawings
from shapetween.raster.picture import Picture

__all__ = [
    "Moving",
    "light_of_colour",
    "meshes_in_outlines",
    "read_json",
    "read_moving",
    "read_quads",
]

#: Greatest distance of a mesh's edge from the outline that it fills, as a share of the root of the
#: outline's area. Larger leaves slivers of the picture behind; smaller takes longer.
NEAR_OUTLINE = 0.002


@dataclass(frozen=True, slots=True, eq=False)
class Moving:
    """Meshes over both pictures.

    Attributes
    ----------
    pieces : tuple of Piece
        In paint order.
    warnings : tuple of str
        What may not be as meant, one line each.
    """

    pieces: tuple[Piece, ...]
    warnings: tuple[str, ...] = ()


def read_moving(
    pictures: tuple[Picture, Picture],
    *,
    quads: Sequence[Path] = (),
    mesh: Path | None = None,
    outlines: tuple[Path, Path] | None = None,
    observe: Observer = unobserved,
) -> Moving:
    """Read what moves from one of three kinds of file.

    Parameters
    ----------
    pictures : (Picture, Picture)
    quads : sequence of Path
        One JSON file, or one SVG over each picture.
    mesh : Path, optional
        A mesh file in pixels.
    outlines : (Path, Path), optional
        One SVG over each picture, between whose outlines meshes are found.
    observe : Observer
        Told the stages of finding meshes.

    Raises
    ------
    ShapetweenError
        If a file cannot be read, or what it says cannot move.
    """
    if mesh is not None:
        return _with_warnings([Piece(pair) for pair in _read_meshes(mesh)], pictures)
    if outlines is not None:
        return _with_warnings(meshes_in_outlines(outlines, pictures, observe), pictures)
    found = read_quads(quads, pictures)
    warnings = tuple(
        f"quad {quad.name!r} reaches beyond picture {side}; nothing is shown there"
        for quad in found
        for side, corners, picture in zip("AB", (quad.a, quad.b), pictures, strict=True)
        if _beyond(corners, picture)
    )
    return Moving(tuple(map(Piece, meshes_of_quads(found))), warnings)


def _with_warnings(pieces: Sequence[Piece], pictures: tuple[Picture, Picture]) -> Moving:
    warnings = tuple(
        f"mesh {k} reaches beyond picture {side}; nothing is shown there"
        for k, pair in enumerate(piece.pair for piece in pieces)
        for side, vertices, picture in zip("AB", (pair.source, pair.target), pictures, strict=True)
        if _beyond(vertices, picture)
    )
    return Moving(tuple(pieces), warnings)


def _beyond(points: Points, picture: Picture) -> bool:
    """Whether points are outside a picture by half a pixel or more."""
    size = (picture.width, picture.height)
    return bool((points <= -0.5).any() or (points >= np.add(size, 0.5)).any())


def read_quads(paths: Sequence[Path], pictures: tuple[Picture, Picture]) -> list[PictureQuad]:
    """Quads from one JSON file, or from one SVG over each picture.

    Raises
    ------
    OptionError
        If the files are neither.
    MeshError
        If a quad has no in-between.
    InputError
        If a file cannot be read.
    """
    kinds = [path.suffix.lower() for path in paths]
    if kinds == [".json"]:
        return load_quads(files.read_text(paths[0]), str(paths[0]))
    if len(kinds) == 2 and set(kinds) <= {".svg", ".svgz"}:
        drawings = (_drawing(paths[0]), _drawing(paths[1]))
        fits = (_over(drawings[0], pictures[0]), _over(drawings[1], pictures[1]))
        return quads_of_drawings(drawings, fits, (str(paths[0]), str(paths[1])))
    named = ", ".join(map(str, paths))
    raise OptionError(f"--quads {named}: expected one JSON, or two SVGs, A's and B's")


def _drawing(path: Path) -> Drawing:
    from shapetween.svg.read.reader import read_svg

    return read_svg(files.read_bytes(path), str(path))


def _over(drawing: Drawing, picture: Picture) -> Affine:
    """From the units of a drawing laid over a picture to the picture's pixels, (2, 3)."""
    from shapetween.photo.transition import fitted

    box = drawing.box
    fit = fitted(box.width, box.height, (picture.width, picture.height))
    corner = np.array([box.x, box.y])
    return np.column_stack([fit[:, :2], fit[:, 2] - fit[:, :2] @ corner])


def read_json(path: Path) -> tuple[list[PictureQuad], list[MeshPair]]:
    """Quads, or meshes, from whichever of both a JSON file holds.

    Raises
    ------
    MeshError
        If it holds neither, or what it says cannot move.
    """
    text = files.read_text(path)
    data = parse(text, str(path))
    if isinstance(data, dict) and {"source", "target", "meshes"} & set(data):
        return [], _read_meshes(path)
    return load_quads(text, str(path)), []


def _read_meshes(path: Path) -> list[MeshPair]:
    """Meshes whose faces can move."""
    from shapetween.mesh.file import check_faces, load_meshes

    meshes = load_meshes(files.read_text(path), str(path))
    for k, (name, pair) in enumerate(meshes):
        try:
            check_faces(pair)
        except ShapetweenError as error:
            place = f"{path}: mesh {name or k}: " if len(meshes) > 1 else f"{path}: "
            raise MeshError(f"{place}{error}") from error
    return [pair for _, pair in meshes]


def meshes_in_outlines(
    paths: tuple[Path, Path],
    pictures: tuple[Picture, Picture],
    observe: Observer = unobserved,
    **settings: Any,
) -> list[Piece]:
    """Meshes in pictures' pixels, inside outlines that are matched as those of drawings are.

    Parameters
    ----------
    paths : (Path, Path)
        An SVG over each picture; shapes count as filled however they are painted.
    pictures : (Picture, Picture)
    observe : Observer
    **settings
        What else `shapetween.morph` takes.

    Raises
    ------
    OptionError
        If no outlines belong together.
    ShapetweenError
        If a file cannot be read, or its outlines cannot be meshed.
    """
    from shapetween.api import morph

    drawings = [_filled(_drawing(path)) for path in paths]
    try:
        found = morph(drawings[0], drawings[1], together=False, observe=observe, **settings)
    except OutlineError as error:
        raise OutlineError(f"{paths[0]}, {paths[1]}: {error}") from error
    fits = [_over(drawing, picture) for drawing, picture in zip(drawings, pictures, strict=True)]
    pieces = [
        _piece(body, settings.get("method", "projective"), fits, found.prepared.fit)
        for part in found.prepared.filled
        for body in part.bodies
    ]
    if not pieces:
        raise OptionError(f"{paths[0]}, {paths[1]}: no outline of one belongs to one of the other")
    return pieces


def _piece(body: Carried, method: str, fits: Sequence[Affine], fit: Affine) -> Piece:
    """The inside of a body's outlines, in triangles that its quads lead.

    The body itself has as few vertices as its curves need; a picture has no curves to follow the
    outline by, so its vertices stand denser.
    """
    from shapetween.outline.unfold import unfolded

    dense = unfolded(body.nodes.rings, method, (NEAR_OUTLINE,))
    if not isinstance(dense.path, KeyedMotion):
        pair = joined_meshes(body.nodes.rings)
        source, target = mapped(pair.source, fits[0]), _back(pair.target, fits[1], fit)
        return Piece(MeshPair(source, target, pair.quads, pair.triangles))
    mesh = dense.path.mesh
    used, triangles = np.unique(mesh.triangles[mesh.inside & ~mesh.inverted], return_inverse=True)
    pair = MeshPair(
        mapped(mesh.source[used], fits[0]),
        _back(mesh.target[used], fits[1], fit),
        np.zeros((0, 4), np.intp),
        triangles.reshape(-1, 3),
    )
    return Piece(pair, _Laid(dense.path, used, fits[0]))


def _back(points: Points, fit_of_picture: Affine, fit_of_drawing: Affine) -> Points:
    """From A's user units to B's, and from those to B's pixels."""
    return mapped(mapped(points, inverted(fit_of_drawing)), fit_of_picture)


@dataclass(frozen=True, slots=True, eq=False)
class _Laid:
    """Some vertices of a plane's motion in a picture's pixels."""

    motion: KeyedMotion
    used: Index
    fit: Affine

    def vertices(self, t: ArrayLike) -> Points:
        """Vertices at the times (F,), shape (F, V, 2)."""
        return mapped(self.motion.vertices(t)[:, self.used], self.fit)


def _filled(drawing: Drawing) -> Drawing:
    return replace(drawing, shapes=tuple(replace(shape, style=Style()) for shape in drawing.shapes))


def light_of_colour(text: str) -> tuple[float, float, float, float] | None:
    """Linear red, green and blue, and alpha, of a CSS colour; None if it is none."""
    from shapetween.svg.read.colours import plain_colour

    colour = plain_colour(text)
    if colour is None:
        return None
    red, green, blue = srgb_to_linear(np.array([colour.red, colour.green, colour.blue])).tolist()
    return red, green, blue, colour.alpha
