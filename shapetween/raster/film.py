"""A movement between drawings as pictures, frame by frame, with patterns and pictures in them.

What SVG can paint is drawn by resvg, shape upon shape in sRGB, as browsers do. A texture is drawn
once for each end; both are warped with the plane that moves the shape, dissolved into one another
in linear light, and cut out by the outline that resvg draws.
"""

from collections.abc import Generator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Affine, Floats
from shapetween.base.errors import OptionError
from shapetween.geometry.affine import mapped
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Style
from shapetween.raster.fills import Fill, fill_of
from shapetween.raster.light import FULL, Bytes, Shares, encode
from shapetween.raster.resvg import drawn
from shapetween.raster.streams import in_order
from shapetween.svg.write.sequence import frame_svg

__all__ = ["Film", "frame_size"]

#: Larger side of frames for which no size is given.
USUAL_SIDE = 800

#: Frames whose shapes are computed at once. More cost memory, fewer time.
AT_ONCE = 16

#: Decimals of a pixel that outlines are drawn with.
DECIMALS = 3


def frame_size(box: Box, size: tuple[int, ...] | None = None) -> tuple[int, int]:
    """Width and height of frames that show a box, in pixels; a width alone finds its height."""
    if size is not None and len(size) == 2:
        return size[0], size[1]
    width = size[0] if size else USUAL_SIDE * min(1.0, box.width / box.height)
    return max(1, round(width)), max(1, round(width * box.height / box.width))


@dataclass(frozen=True, slots=True, eq=False)
class Film:
    """Movements that follow each other, ready to be drawn.

    Attributes
    ----------
    movements : tuple of Movement
        All in the same frame of coordinates.
    times : (F,) float64
        Of the frames of each; the last frame of one is the first of the next.
    size : (int, int)
        Width and height of the frames.
    fit : (2, 3) float64
        From user units to a frame's pixels.
    fills : tuple of dict
        For each movement, textures by number of their part.
    background : Colour or None
        What is behind the drawings.
    """

    movements: tuple[Movement, ...]
    times: Floats
    size: tuple[int, int]
    fit: Affine
    fills: tuple[dict[int, Fill], ...]
    background: Colour | None = None

    @classmethod
    def of(
        cls,
        movements: Sequence[Movement],
        times: Floats,
        *,
        size: tuple[int, int],
        background: Colour | None = None,
    ) -> "Film":
        """Draw the textures of all ends.

        Parameters
        ----------
        movements : sequence of Movement
            At least one.
        times : (F,) float64
            At least two.
        size : (int, int)
            The movement's box is scaled evenly to fit, and centred.
        background : Colour, optional

        Raises
        ------
        OptionError
            If resvg or Pillow is not installed.
        InputError
            If a texture cannot be drawn.
        """
        if len(times) < 2:
            raise OptionError(f"{len(times)} frames: expected at least 2")
        fit = _fit(movements[0].box, size)
        fills = tuple(
            {
                k: fill
                for k, part in enumerate(movement.parts)
                if (fill := fill_of(part, fit)) is not None
            }
            for movement in movements
        )
        return cls(tuple(movements), times, size, fit, fills, background)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What does not show as it may have been meant, one line each."""
        names = (name for fills in self.fills for fill in fills.values() for name in fill.empty)
        loss = "a pattern or picture in it shows nothing"
        return tuple(f"{name}: {loss}" for name in dict.fromkeys(names))

    @property
    def count(self) -> int:
        """How many frames there are."""
        return 1 + len(self.movements) * (len(self.times) - 1)

    @property
    def ends(self) -> list[int]:
        """Frames that show the drawings themselves."""
        return list(range(0, self.count, len(self.times) - 1))

    def frames(
        self, order: Sequence[int] | None = None, workers: int = 1
    ) -> Generator[Bytes, None, None]:
        """Frames one after the other, a few of them drawn at the same time.

        Parameters
        ----------
        order : sequence of int, optional
            Which frames; all of them if left out.
        workers : int
            How many are drawn at once.

        Yields
        ------
        (H, W, 3) uint8 if the background is opaque, else (H, W, 4)
        """
        indices = range(self.count) if order is None else order
        for start in range(0, len(indices), AT_ONCE):
            shots = self._shots(indices[start : start + AT_ONCE])
            yield from in_order(self._drawn, shots, workers)

    def _shots(self, indices: Sequence[int]) -> "list[_Shot]":
        """What moves in some frames, computed for all of them together."""
        steps = len(self.times) - 1
        legs = [max(index - 1, 0) // steps for index in indices]
        times = np.array(
            [self.times[index - leg * steps] for index, leg in zip(indices, legs, strict=True)]
        )
        shots: list[_Shot | None] = [None] * len(indices)
        for leg in sorted(set(legs)):
            here = [k for k, other in enumerate(legs) if other == leg]
            movement, fills = self.movements[leg], self.fills[leg]
            drawings = movement.at(times[here])
            places = {k: mapped(fill.vertices(times[here]), self.fit) for k, fill in fills.items()}
            for row, k in enumerate(here):
                vertices = {part: place[row] for part, place in places.items()}
                shots[k] = _Shot(float(times[k]), drawings[row].shapes, fills, vertices)
        return [shot for shot in shots if shot is not None]

    def _drawn(self, shot: "_Shot") -> Bytes:
        """One frame."""
        width, height = self.size
        canvas = np.zeros((height, width, 4), np.float32)
        if self.background is not None:
            colour = self.background
            canvas[:] = [colour.red, colour.green, colour.blue, 1]
            canvas *= np.float32(colour.alpha)
        plain: list[Shape] = []
        for k, shape in enumerate(shot.shapes):
            fill = shot.fills.get(k)
            if fill is None or shape.style.fill is None:  # which is then not shown
                plain.append(shape)
                continue
            self._paint(canvas, plain)
            plain = [replace(shape, style=replace(shape.style, fill=None, texture=None))]
            seen = self._picture([_cut_out(shape)])[..., 3].astype(np.float32)
            seen *= np.float32(shape.style.opacity / 255)
            _over(canvas, _in_srgb(fill.light(shot.vertices[k], seen > 0, shot.time), seen))
        self._paint(canvas, plain)
        return _bytes(canvas, opaque=self.background is not None and self.background.alpha == 1)

    def _paint(self, canvas: Shares, shapes: Sequence[Shape]) -> None:
        """Paint shapes that need no texture."""
        styles = [shape.style for shape in shapes]
        if any(style.fill is not None or style.stroke is not None for style in styles):
            pixels = self._picture(shapes).astype(np.float32) * np.float32(1 / 255)
            pixels[..., :3] *= pixels[..., 3:]
            _over(canvas, pixels)

    def _picture(self, shapes: Sequence[Shape]) -> Bytes:
        """Shapes as resvg draws them, (H, W, 4)."""
        width, height = self.size
        there = Drawing(tuple(shapes), Box(0, 0, width, height)).transformed(self.fit)
        return drawn(frame_svg(there, DECIMALS, in_page=False), width, height)


@dataclass(frozen=True, slots=True, eq=False)
class _Shot:
    """One frame before it is drawn.

    Attributes
    ----------
    time : float
    shapes : tuple of Shape
    fills : dict
        Textures, by number of their shape.
    vertices : dict
        Where the vertices of each texture's mesh are in the frame, (V, 2).
    """

    time: float
    shapes: tuple[Shape, ...]
    fills: dict[int, Fill]
    vertices: dict[int, Floats]


def _fit(box: Box, size: tuple[int, int]) -> Affine:
    scale = min(size[0] / box.width, size[1] / box.height)
    middle = np.array([box.x + box.width / 2, box.y + box.height / 2])
    return np.column_stack([scale * np.eye(2), np.array(size) / 2 - scale * middle])


def _cut_out(shape: Shape) -> Shape:
    """The area of a shape in black, as far as the groups that it is in show it."""
    groups = tuple(replace(g, filter=None, blend="normal") for g in shape.style.groups)
    style = Style(Colour(), fill_rule=shape.style.fill_rule, groups=groups)
    return replace(shape, style=style)


def _in_srgb(light: Shares, seen: Shares) -> Shares:
    """Light of the pixels that are seen as premultiplied values of sRGB, times how much of each."""
    result = np.zeros((*seen.shape, 4), np.float32)
    pixels = encode((light * np.float32(1 / FULL))[None], opaque=False)[0].astype(np.float32)
    pixels *= np.float32(1 / 255)
    pixels[:, :3] *= pixels[:, 3:]
    result[seen > 0] = pixels * seen[seen > 0][:, None]
    return result


def _over(canvas: Shares, pixels: Shares) -> None:
    """Paint premultiplied pixels over a canvas of such."""
    canvas *= 1 - pixels[..., 3:]
    canvas += pixels


def _bytes(canvas: Shares, *, opaque: bool) -> Bytes:
    alpha = canvas[..., 3:]
    colours = np.divide(canvas[..., :3], alpha, out=np.zeros_like(canvas[..., :3]), where=alpha > 0)
    whole = colours if opaque else np.concatenate([colours, alpha], axis=2)
    return np.asarray(np.rint(np.clip(whole, 0, 1) * 255), np.uint8)
