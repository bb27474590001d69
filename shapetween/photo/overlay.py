"""Quads and meshes drawn over the pictures they were made for, with their names or numbers."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

import numpy as np

from shapetween.base.arrays import Points
from shapetween.io.files import fresh_file
from shapetween.mesh.pair import MeshPair
from shapetween.photo.quads import PictureQuad
from shapetween.raster.light import FULL, Bytes, encode
from shapetween.raster.load import pillow
from shapetween.raster.picture import Picture

__all__ = ["LabelledFace", "faces_of_meshes", "faces_of_quads", "overlay", "write_overlay"]

Side: TypeAlias = Literal["a", "b"]
"""Which of the two pictures."""

#: Width of lines and height of labels, as shares of the picture's larger side.
LINE, LABEL = 1 / 320, 1 / 40

#: White between two pictures, as a share of the wider one.
GAP = 1 / 50

#: Around lines and letters, so that they show on anything.
INK = "#10141a"

#: Colours that faces take in turn.
COLOURS = ("#ffd23f", "#5ee0a0", "#6fc3ff", "#ff8fb1", "#c9a4ff", "#ffa05c")


@dataclass(frozen=True, slots=True, eq=False)
class LabelledFace:
    """A face to draw.

    Attributes
    ----------
    label : str
    corners : (K, 2) float64
        In the picture's pixels.
    """

    label: str
    corners: Points


def overlay(picture: Picture, faces: Sequence[LabelledFace]) -> Bytes:
    """A picture with faces drawn over it, each corner numbered by its place in the face.

    Returns
    -------
    (H, W, 3) uint8
        On white where the picture is transparent.
    """
    from PIL import ImageDraw, ImageFont

    light = picture.light.astype(np.float32) * np.float32(1 / FULL)
    light += 1 - light[..., 3:]
    image = pillow().fromarray(encode(light, opaque=True))
    draw = ImageDraw.Draw(image)
    side = max(image.size)
    line = max(1, round(side * LINE))
    font = ImageFont.load_default(max(9, round(side * LABEL)))
    small = ImageFont.load_default(max(8, round(side * LABEL * 0.6)))
    for k, face in enumerate(faces):
        ring = [tuple(corner) for corner in [*face.corners.tolist(), face.corners[0].tolist()]]
        draw.line(ring, fill=INK, width=3 * line, joint="curve")
        draw.line(ring, fill=COLOURS[k % len(COLOURS)], width=line, joint="curve")
    for k, face in enumerate(faces):
        colour = COLOURS[k % len(COLOURS)]
        middle = face.corners.mean(axis=0)
        labels = [(middle, face.label, font)]
        for number, corner in enumerate(face.corners):
            # A little inside, so that numbers of neighbours do not lie on one another.
            inward = min(0.16, 14 * line / float(np.linalg.norm(middle - corner)))
            labels.append((corner + inward * (middle - corner), str(number), small))
        for (x, y), text, letters in labels:
            draw.text(
                (x, y),
                text,
                fill=colour,
                font=letters,
                anchor="mm",
                stroke_width=2 * line if letters is font else line,
                stroke_fill=INK,
            )
    return np.array(image)


def side_by_side(pictures: Sequence[Bytes]) -> Bytes:
    """Pictures next to one another, all as high as the highest, with white between them."""
    height = max(len(picture) for picture in pictures)
    gap = max(1, round(max(picture.shape[1] for picture in pictures) * GAP))
    columns: list[Bytes] = []
    for picture in pictures:
        columns += [np.full((height, gap, 3), 255, np.uint8)] if columns else []
        below = np.full((height - len(picture), picture.shape[1], 3), 255, np.uint8)
        columns.append(np.concatenate([picture, below]))
    return np.concatenate(columns, axis=1)


def faces_of_quads(quads: Sequence[PictureQuad], side: Side) -> list[LabelledFace]:
    """Quads of one picture under their names."""
    return [LabelledFace(quad.name, quad.a if side == "a" else quad.b) for quad in quads]


def faces_of_meshes(meshes: Sequence[MeshPair], side: Side) -> list[LabelledFace]:
    """Faces of one picture under the numbers that a mesh file counts them by, triangles with a t.

    Of several meshes, each face has its mesh's number before its own.
    """
    faces = []
    for number, pair in enumerate(meshes):
        vertices = pair.source if side == "a" else pair.target
        prefix = f"{number}." if len(meshes) > 1 else ""
        for sign, group in (("", pair.quads), ("t", pair.triangles)):
            faces += [
                LabelledFace(f"{prefix}{sign}{k}", vertices[face]) for k, face in enumerate(group)
            ]
    return faces


def write_overlay(
    out: Path, pictures: Sequence[Picture], faces: Sequence[Sequence[LabelledFace]]
) -> None:
    """Write a PNG of pictures side by side, each with its faces drawn over it.

    Raises
    ------
    OptionError
        If it cannot be written; a file that was there is then still whole.
    """
    drawn = [overlay(picture, group) for picture, group in zip(pictures, faces, strict=True)]
    with fresh_file(out) as fresh:
        pillow().fromarray(side_by_side(drawn)).save(fresh, "PNG")
