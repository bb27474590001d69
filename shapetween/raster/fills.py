"""Textures inside moving shapes: both ends' as pictures, and the mesh that carries them."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Affine, Floats, Index, Mask, Points
from shapetween.deform.deformation import Deformation, VertexPath
from shapetween.geometry.affine import inverted, mapped
from shapetween.geometry.polygon import polygon_area
from shapetween.model.drawing import Box
from shapetween.model.paint import Style
from shapetween.model.part import Part
from shapetween.raster.field import Field
from shapetween.raster.light import Shares
from shapetween.raster.picture import Picture
from shapetween.raster.resvg import drawn, drawn_apart
from shapetween.svg.textures import plain_texture, texture_svg

__all__ = ["Fill", "fill_of"]

#: Room around a shape in its texture, as a share of the shape's extent and in pixels: on the way
#: its outline may reach a little over what the mesh makes of it.
MARGIN, LEAST_MARGIN = 0.05, 4.0

#: Most pixels of the texture for one of the frame along a side, where a shape grows.
MOST_ENLARGED = 3

#: Most pixels of one texture. A larger one is drawn coarser.
MOST_PIXELS = 32_000_000

#: Cells along each side of the grid for a shape without a mesh of its own, and room around the
#: shape as a share of its extent. More cells cost time, fewer make the plane's bends edgy.
GRID, GRID_MARGIN = 16, 0.3

#: Extent of a shape at one end over that at the other, below which it is nothing there.
NOTHING = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Fill:
    """What fills a shape on its way.

    Attributes
    ----------
    path : VertexPath
        Of the mesh's vertices, in user units.
    triangles : (T, 3) intp
    ends : ((T, 3, 2), (T, 3, 2)) float64
        Corners of the triangles in each picture's pixels.
    pictures : (Picture, Picture)
        What fills it at the start and at the end.
    empty : tuple of str
        Files whose texture shows nothing, as a picture does that is damaged.
    shown : callable
        From the times that are asked for (F,) to the movement's.
    """

    path: VertexPath
    triangles: Index
    ends: tuple[Points, Points]
    pictures: tuple[Picture, Picture]
    shown: Callable[[Floats], Floats]
    empty: tuple[str, ...] = ()

    def vertices(self, t: Floats) -> Points:
        """The mesh at the times (F,), (F, V, 2), in user units."""
        return self.path.vertices(self._shown(t))

    def _shown(self, t: Floats) -> Floats:
        """The movement's own times, which end at its ends: what fills a part does not overshoot."""
        return np.asarray(np.clip(self.shown(t), 0.0, 1.0))

    def light(self, vertices: Points, seen: Mask, t: float) -> Shares:
        """Light of the pixels that are seen, (N, 4) in units of 1 / FULL, row by row.

        Parameters
        ----------
        vertices : (V, 2) float64
            In the frame's pixels.
        seen : (H, W) bool
        t : float
        """
        t = float(self._shown(np.array([t]))[0])
        field = Field.of(vertices[self.triangles], seen)
        light = np.zeros((len(field.x), 4), np.float32)
        for picture, corners, share in zip(self.pictures, self.ends, (1 - t, t), strict=True):
            if share > 0:
                light += np.float32(share) * field.colours(picture, corners)
        return light


def fill_of(part: Part, fit: Affine) -> Fill | None:
    """Prepare what fills a part; None if that is no texture at either end.

    Parameters
    ----------
    part : Part
    fit : (2, 3) float64
        From user units to a frame's pixels.

    Raises
    ------
    InputError
        If a texture cannot be drawn.
    """
    shown, part = part.shown, replace(part, clock=None)
    styles = [part.style(0.0), part.style(1.0)]
    if all(style.texture is None for style in styles):
        return None
    curves = part.curves(np.array([0.0, 1.0])).reshape(2, -1, 2)
    extents = np.ptp(curves, axis=1).max(axis=1)
    there = [k for k in (0, 1) if styles[k].opacity > 0]
    whole = [k for k in there if extents[k] > NOTHING * extents.max()]
    if not whole:
        return None
    path, triangles = _mesh(part, whole[0])
    places = path.vertices(np.array([0.0, 1.0]))
    growth = np.sqrt(_areas(places, triangles))
    ends, pictures, empty = [], [], []
    for k in (0, 1):
        # What is nothing at one end, or not seen, shows there what it shows at the other.
        end = k if k in whole else whole[0]
        larger = float(growth.max() / growth[end])
        picture, window = _picture(styles[end], curves[end], fit, larger)
        ends.append(mapped(places[end], window)[triangles])
        pictures.append(picture)
        texture = styles[end].texture
        if texture is not None and not picture.light[..., 3].any():
            empty.append(texture.name)
    pair = (pictures[0], pictures[1])
    return Fill(path, triangles, (ends[0], ends[1]), pair, shown, tuple(empty))


def _areas(places: Points, triangles: Index) -> Floats:
    return np.asarray(np.abs(polygon_area(places[:, triangles])).sum(axis=1))


def _picture(style: Style, points: Points, fit: Affine, larger: float) -> tuple[Picture, Affine]:
    """What fills a shape at one end, and where that is: from user units to the picture's pixels.

    Its pixels are those of the frame, or whole parts of them where the shape grows, so that the
    frame of that end shows them as they are.
    """
    there = mapped(points, fit)
    low, high = there.min(axis=0), there.max(axis=0)
    margin = max(LEAST_MARGIN, MARGIN * float((high - low).max()))
    low, high = np.floor(low - margin), np.ceil(high + margin)
    # A little growth is not worth twice the pixels.
    scale = float(np.clip(np.ceil(larger - 0.25), 1, MOST_ENLARGED))
    scale = min(scale, float(np.sqrt(MOST_PIXELS / np.prod(high - low))))
    width, height = np.maximum(1, np.round(scale * (high - low))).astype(int).tolist()
    window = scale * np.column_stack([fit[:, :2], fit[:, 2] - low])
    if style.texture is not None:
        text = texture_svg(style.texture, window, width, height)
        return Picture.of(drawn_apart(text, width, height, style.texture.name)), window
    corners = mapped(np.array([[0.0, 0.0], [width, height]]), inverted(window))
    box = Box(*corners[0].tolist(), *(corners[1] - corners[0]).tolist())
    text = texture_svg(plain_texture(style.fill, box), window, width, height)
    return Picture.of(drawn(text, width, height)), window


def _mesh(part: Part, whole: int) -> tuple[VertexPath, Index]:
    """The mesh that carries what fills a part, and how it moves."""
    paths = tuple(path for area in part.areas for path in area.deformations)
    meshes = [path.mesh for path in paths if path.mesh is not None]
    if len(meshes) < len(paths) or not all(track.areas for track in part.tracks):
        return _Grid.around(part, whole), _grid_triangles()
    first = np.cumsum([0, *(len(mesh.source) for mesh in meshes)]).tolist()
    triangles = []
    for mesh, start in zip(meshes, first, strict=False):
        kept = ~mesh.inverted
        if len(meshes) > 1:
            # Planes of several bodies lie over one another, so each shows its body and its edge.
            kept &= mesh.inside | (mesh.triangles < mesh.nodes).any(axis=1)
        triangles.append(mesh.triangles[kept] + start)
    return _Bodies(paths), np.concatenate(triangles)


@dataclass(frozen=True, slots=True, eq=False)
class _Bodies:
    """The ambient meshes of several bodies."""

    paths: tuple[Deformation, ...]

    def vertices(self, t: Floats) -> Points:
        return np.concatenate([path.vertices(t) for path in self.paths], axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class _Grid:
    """A grid around a shape that goes along with it.

    Attributes
    ----------
    part : Part
    vertices_at_home : (V, 2) float64
        Where the shape is whole.
    outline : (K, 2) float64
        Points of the shape there.
    """

    part: Part
    vertices_at_home: Points
    outline: Points

    @classmethod
    def around(cls, part: Part, whole: int) -> "_Grid":
        outline = part.curves(np.array([float(whole)])).reshape(-1, 2)
        low, high = outline.min(axis=0), outline.max(axis=0)
        room = GRID_MARGIN * float((high - low).max())
        steps = np.linspace(0.0, 1.0, GRID + 1)[:, None]
        x, y = ((low - room) + steps * (high - low + 2 * room)).T
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        return cls(part, grid, outline)

    def vertices(self, t: Floats) -> Points:
        points = np.concatenate([self.vertices_at_home, self.outline])
        carried = np.repeat(points[None], len(t), axis=0)
        grid, outline = np.split(carried @ (1, 1j), [len(self.vertices_at_home)], axis=1)
        shown = self.part.curves(t).reshape(len(t), -1, 2) @ (1, 1j)
        # The grid goes with the shape by the best similarity: in complex
        # numbers a turn and a size are one factor.
        centres = outline.mean(axis=1, keepdims=True), shown.mean(axis=1, keepdims=True)
        offsets = outline - centres[0]
        spread = (np.abs(offsets) ** 2).sum(axis=1, keepdims=True)
        factor = (offsets.conj() * (shown - centres[1])).sum(axis=1, keepdims=True)
        factor = np.divide(factor, spread, out=np.zeros_like(factor), where=spread > 0)
        moved = centres[1] + factor * (grid - centres[0])
        return np.stack([moved.real, moved.imag], axis=-1)


def _grid_triangles() -> Index:
    """Two triangles for each cell of a grid."""
    row, column = np.divmod(np.arange(GRID * GRID), GRID)
    corner = row * (GRID + 1) + column
    right, below = corner + 1, corner + GRID + 1
    halves = [[corner, right, below + 1], [corner, below + 1, below]]
    return np.concatenate([np.stack(half, axis=1) for half in halves])
