"""What moves, from whichever files say so: quads, a mesh, or outlines drawn over the pictures."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from shapetween import files
from shapetween.arrays import Affine, Points
from shapetween.drawing import Drawing
from shapetween.errors import MeshError, OptionError, ShapetweenError
from shapetween.fit import mapped
from shapetween.image.light import srgb_to_linear
from shapetween.image.picture import Picture
from shapetween.image.quads import PictureQuad, load_quads, meshes_of_quads, quads_of_drawings
from shapetween.jsonfile import parse
from shapetween.mesh import MeshPair
from shapetween.observe import Observer, unobserved
from shapetween.paint import Colour

__all__ = ["Moving", "lay_over", "light_of_colour", "read_json", "read_moving", "read_quads"]


@dataclass(frozen=True, slots=True, eq=False)
class Moving:
    """Meshes over both pictures.

    Attributes
    ----------
    meshes : tuple of MeshPair
        In paint order; source in A's pixels, target in B's.
    warnings : tuple of str
        What may not be as meant, one line each.
    """

    meshes: tuple[MeshPair, ...]
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
        return _with_warnings(_read_meshes(mesh), pictures)
    if outlines is not None:
        return _with_warnings(_meshes_in_outlines(outlines, pictures, observe), pictures)
    found = read_quads(quads, pictures)
    warnings = tuple(
        f"quad {quad.name!r} reaches beyond picture {side}; nothing is shown there"
        for quad in found
        for side, corners, picture in zip("AB", (quad.a, quad.b), pictures, strict=True)
        if _beyond(corners, picture)
    )
    return Moving(tuple(meshes_of_quads(found)), warnings)


def _with_warnings(meshes: Sequence[MeshPair], pictures: tuple[Picture, Picture]) -> Moving:
    warnings = tuple(
        f"mesh {k} reaches beyond picture {side}; nothing is shown there"
        for k, pair in enumerate(meshes)
        for side, vertices, picture in zip("AB", (pair.source, pair.target), pictures, strict=True)
        if _beyond(vertices, picture)
    )
    return Moving(tuple(meshes), warnings)


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
    from shapetween.svg.read import read_svg

    return read_svg(files.read_bytes(path), str(path))


def _over(drawing: Drawing, picture: Picture) -> Affine:
    """From the units of a drawing laid over a picture to the picture's pixels, (2, 3)."""
    from shapetween.image.transition import fitted

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
    from shapetween.meshfile import check_faces, load_meshes

    meshes = load_meshes(files.read_text(path), str(path))
    for k, (name, pair) in enumerate(meshes):
        try:
            check_faces(pair)
        except ShapetweenError as error:
            place = f"{path}: mesh {name or k}: " if len(meshes) > 1 else f"{path}: "
            raise MeshError(f"{place}{error}") from error
    return [pair for _, pair in meshes]


def _meshes_in_outlines(
    paths: tuple[Path, Path], pictures: tuple[Picture, Picture], observe: Observer
) -> list[MeshPair]:
    """Meshes inside outlines that were matched as those of drawings are."""
    from shapetween.api import morph

    drawings = (_drawing(paths[0]), _drawing(paths[1]))
    found = [pair for _, pair in morph(*drawings, observe=observe).meshes]
    return _laid_over(found, drawings, pictures)


def lay_over(
    meshes: Sequence[MeshPair], paths: tuple[Path, Path], pictures: tuple[Picture, Picture]
) -> list[MeshPair]:
    """Meshes in the units of two SVG files, in the pixels of the pictures they lie over.

    Raises
    ------
    InputError
        If a file cannot be read.
    """
    return _laid_over(meshes, (_drawing(paths[0]), _drawing(paths[1])), pictures)


def _laid_over(
    meshes: Sequence[MeshPair],
    drawings: tuple[Drawing, Drawing],
    pictures: tuple[Picture, Picture],
) -> list[MeshPair]:
    fits = [_over(drawing, picture) for drawing, picture in zip(drawings, pictures, strict=True)]
    return [
        MeshPair(
            mapped(pair.source, fits[0]), mapped(pair.target, fits[1]), pair.quads, pair.triangles
        )
        for pair in meshes
    ]


def light_of_colour(text: str) -> tuple[float, float, float, float] | None:
    """Linear red, green and blue, and alpha, of a CSS colour; None if it is none."""
    from shapetween.svg.colours import parse_paint

    value = parse_paint(text)
    if value is None or value.reference or not isinstance(value.colour, Colour):
        return None
    colour = value.colour
    red, green, blue = srgb_to_linear(np.array([colour.red, colour.green, colour.blue])).tolist()
    return red, green, blue, colour.alpha
