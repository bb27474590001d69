"""A transition between two pictures, drawn frame by frame."""

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from shapetween.base.arrays import Affine, Floats, Index, Mask, times
from shapetween.base.errors import OptionError
from shapetween.photo.coverage import coverage
from shapetween.photo.filling import filled
from shapetween.photo.layers import Layer, Piece
from shapetween.raster.light import FULL, Bytes, Light, Shares, encode
from shapetween.raster.picture import Picture, fourfold
from shapetween.raster.sampling import Texture
from shapetween.raster.streams import in_order

__all__ = ["SLIP_TOLERANCE", "Transition", "fitted"]

#: Slip along a shared side, in pixels, past which quads are mapped bilinearly. Smaller gives up
#: straight lines inside quads for a step that nobody sees; larger lets the step be seen.
SLIP_TOLERANCE = 1.0

#: Pixels worked on at a time: what they need then stays in the processor's cache.
BLOCK = 1 << 15


def fitted(width: float, height: float, size: tuple[int, int]) -> Affine:
    """Map from a picture's pixels to a frame's: as large as fits, in the middle, (2, 3)."""
    scale = min(size[0] / width, size[1] / height)
    return np.array(
        [
            [scale, 0.0, (size[0] - scale * width) / 2],
            [0.0, scale, (size[1] - scale * height) / 2],
        ]
    )


@dataclass(frozen=True, slots=True, eq=False)
class Transition:
    """Two pictures, meshes that carry parts of both, and what is behind them.

    Attributes
    ----------
    pictures : (Picture, Picture)
        A and B.
    times : (F,) float64
        Of the frames, from 0 to 1.
    size : (int, int)
        Width and height of the frames.
    layers : tuple of Layer
        In paint order.
    backgrounds : (Light, Light)
        What is behind at the start and at the end, (H, W, 4) each; it dissolves from one to the
        other, and stands still if they are one.
    ends : (Light, Light)
        The same in the very first and the very last moment.
    opaque : bool
        Whether every pixel of every frame is opaque.
    """

    pictures: tuple[Picture, Picture]
    times: Floats
    size: tuple[int, int]
    layers: tuple[Layer, ...]
    backgrounds: tuple[Light, Light]
    ends: tuple[Light, Light]
    opaque: bool

    @classmethod
    def between(
        cls,
        a: Picture,
        b: Picture,
        pieces: Sequence[Piece],
        moments: Floats,
        *,
        size: tuple[int, int] | None = None,
        background: "Picture | tuple[float, float, float, float] | str" = "dissolve",
        method: str = "projective",
        tolerance: float = SLIP_TOLERANCE,
    ) -> "Transition":
        """Prepare a transition.

        Parameters
        ----------
        a, b : Picture
            May be one.
        pieces : sequence of Piece
            What moves, in paint order.
        moments : (F,) float64
            Times of the frames, from 0 to 1.
        size : (int, int), optional
            Width and height of the frames; A's if left out. Both pictures are scaled evenly to
            fit, and centred.
        background : Picture, (red, green, blue, alpha), "keep", "dissolve" or "fill"
            What is behind: a picture, which is fitted too; light in linear components from 0 to 1;
            A; A that dissolves into B; or that with the places of what moves filled from around
            them on the way.
        method : str
            One of `shapetween.interpolate.METHODS`.
        tolerance : float
            Slip along shared sides, in the frame's pixels, past which quads are mapped
            bilinearly.

        Raises
        ------
        MeshError
            If a mesh has no in-between.
        OptionError
            If the background is none of these, or OpenCV is needed and not installed.
        """
        size = size or (a.width, a.height)
        fits = (fitted(a.width, a.height, size), fitted(b.width, b.height, size))
        moments = times(moments)
        layers = tuple(Layer.of(piece, fits, moments, method, tolerance) for piece in pieces)
        ends = _backgrounds(a, b, "dissolve" if background == "fill" else background, size)
        backgrounds = ends
        if background == "fill":
            both = np.array([0.0, 1.0])
            there = [Layer.of(piece, fits, both, method, tolerance) for piece in pieces]
            first, last = (filled(ends[k], _covered(there, k, size)) for k in (0, 1))
            backgrounds = first, last
        opaque = all(bool((light[..., 3] == FULL).all()) for light in (*backgrounds, *ends))
        return cls((a, b), moments, size, layers, backgrounds, ends, opaque)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is not drawn as asked, one line each."""
        lines = []
        for k, layer in enumerate(self.layers):
            if layer.split:
                named = ", ".join(map(str, layer.split))
                lines.append(f"mesh {k}: quad {named} does not stay convex: two triangles instead")
            if layer.bilinear.any():
                lines.append(
                    f"mesh {k}: {int(layer.bilinear.sum())} of {len(layer.bilinear)} quads are "
                    "mapped bilinearly, as their sides would part"
                )
        return tuple(lines)

    def report(self) -> dict[str, Any]:
        """What moves and how far neighbours part, ready for JSON."""
        meshes = [
            {
                "quads": len(layer.pair.quads),
                "triangles": len(layer.pair.triangles),
                "split": list(layer.split),
                "bilinear": np.flatnonzero(layer.bilinear).tolist(),
                "slip_of_homographies": layer.slips[0],
                "slip": layer.slips[1],
            }
            for layer in self.layers
        ]
        return {
            "size": list(self.size),
            "frames": len(self.times),
            "meshes": meshes,
        }

    def frame(self, index: int) -> Bytes:
        """Pixels of one frame, (H, W, 3) uint8 if opaque, else (H, W, 4)."""
        t = float(self.times[index])
        canvas = _dissolved(self.ends if t in (0.0, 1.0) else self.backgrounds, t)
        for layer in self.layers:
            _draw(canvas, layer, index, self.pictures, t)
        return encode(canvas, opaque=self.opaque)

    def frames(
        self, order: Sequence[int] | None = None, workers: int = 1
    ) -> Generator[Bytes, None, None]:
        """Frames one after the other, a few of them drawn at the same time.

        Parameters
        ----------
        order : sequence of int, optional
            Which frames; all of them if left out.
        workers : int
            How many are drawn at once; one more than that are held.
        """
        return in_order(self.frame, range(len(self.times)) if order is None else order, workers)


def _draw(
    canvas: Shares, layer: Layer, index: int, pictures: tuple[Picture, Picture], t: float
) -> None:
    """Paint a layer's faces over the canvas.

    Faces of one layer are added up, each times the share of the pixel that it covers, and the sum
    is painted over what is behind.
    """
    height, width = canvas.shape[:2]
    faces = layer.faces(index)
    covers = [coverage(face.corners, width, height) for face in faces]
    seen = [(face, cover) for face, cover in zip(faces, covers, strict=True) if cover is not None]
    if not seen:
        return
    left = min(cover.left for _, cover in seen)
    top = min(cover.top for _, cover in seen)
    right = max(cover.left + cover.shares.shape[1] for _, cover in seen)
    bottom = max(cover.top + cover.shares.shape[0] for _, cover in seen)
    sheet = np.zeros((bottom - top, right - left, 4), np.float32)
    for face, cover in seen:
        textures = [
            (Texture.of(picture, inverse, footprint, corners), share)
            for picture, inverse, footprint, corners, share in zip(
                pictures, face.inverses, face.footprints, face.ends, (1 - t, t), strict=True
            )
            if share > 0
        ]
        rows_at_once = max(1, BLOCK // cover.shares.shape[1])
        for start in range(0, cover.shares.shape[0], rows_at_once):
            shares = cover.shares[start : start + rows_at_once]
            rows, columns = np.nonzero(shares)
            x = columns.astype(np.float64) + (cover.left + 0.5)
            y = rows.astype(np.float64) + (cover.top + start + 0.5)
            colours = np.zeros((len(x), 4), np.float32)
            for texture, share in textures:
                seen_there = texture.at(x, y)
                seen_there *= np.float32(share)
                colours += seen_there
            colours *= fourfold(shares[rows, columns])
            _add(sheet, rows + (cover.top + start - top), columns + (cover.left - left), colours)
    place = canvas[top:bottom, left:right]
    gap = 1 - np.minimum(sheet[..., 3].reshape(-1), 1)
    place *= fourfold(gap).reshape(sheet.shape)
    place += sheet


def _add(sheet: Shares, rows: Index, columns: Index, colours: Shares) -> None:
    """Add colours, (N, 4), to as many different pixels of a sheet.

    Pixels are fetched and put back as one number of 16 bytes each, which takes a third of the
    time of four.
    """
    pixels = sheet.reshape(-1).view(np.complex128)
    index = rows * sheet.shape[1] + columns
    colours += pixels.take(index).view(np.float32).reshape(-1, 4)
    pixels[index] = colours.reshape(-1).view(np.complex128)


def _dissolved(lights: tuple[Light, Light], t: float) -> Shares:
    """A canvas with the mixture of two lights."""
    first, last = lights
    if first is last:
        return np.asarray(first * np.float32(1 / FULL), np.float32)
    canvas = np.asarray(first * np.float32((1 - t) / FULL), np.float32)
    canvas += last * np.float32(t / FULL)
    return canvas


def _backgrounds(
    a: Picture,
    b: Picture,
    background: Picture | tuple[float, float, float, float] | str,
    size: tuple[int, int],
) -> tuple[Light, Light]:
    """Light behind the layers at the start and at the end."""
    if isinstance(background, str):
        if background not in ("keep", "dissolve"):
            raise OptionError(
                f"background: {background!r} is neither 'keep' nor 'dissolve' nor 'fill'"
            )
        first = _spread(a, size)
        return first, first if background == "keep" or a is b else _spread(b, size)
    if isinstance(background, Picture):
        still = _spread(background, size)
    else:
        *colour, alpha = background
        amounts = np.array([*(part * alpha for part in colour), alpha]) * FULL
        still = np.broadcast_to(np.rint(amounts).astype(np.uint16), (size[1], size[0], 4))
    return still, still


def _covered(layers: Sequence[Layer], index: int, size: tuple[int, int]) -> Mask:
    """Which pixels of a frame layers cover, some of each at least, (H, W)."""
    width, height = size
    found = np.zeros((height, width), bool)
    for layer in layers:
        for face in layer.faces(index):
            cover = coverage(face.corners, width, height)
            if cover is not None:
                rows, columns = cover.shares.shape
                place = found[cover.top : cover.top + rows, cover.left : cover.left + columns]
                place |= cover.shares > 0
    return found


def _spread(picture: Picture, size: tuple[int, int]) -> Light:
    """A picture's light fitted into a frame, with nothing beside it."""
    if size == (picture.width, picture.height):
        return picture.light
    fit = fitted(picture.width, picture.height, size)
    box = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * [picture.width, picture.height]
    layer = Layer.still(box.astype(np.float64), fit)
    canvas = np.zeros((size[1], size[0], 4), np.float32)
    _draw(canvas, layer, 0, (picture, picture), 0.0)
    return np.rint(np.clip(canvas, 0, 1) * FULL).astype(np.uint16)
