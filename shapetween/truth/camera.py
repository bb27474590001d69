"""Flat things and a cube moving rigidly before a pinhole camera.

The camera is at the origin and looks along z; a point (x, y, z) is seen at focal (x, y) / z. Things
turn at an even rate about one axis while their centre goes straight.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.polygon import corner_sines
from shapetween.mesh.pair import MeshPair
from shapetween.truth.case import TIMES, Case, texture_places

__all__ = ["SCENES"]

#: Focal length, and how far away things are; a unit square then fills the view about as much as
#: a photograph of a board does.
FOCAL, DEPTH = 2.0, 2.0

#: Least corner sine of a face at all times. Less, and a face is seen nearly from its side.
LEAST_SINE = 0.15

#: Times at which a movement is looked at before it is used.
LOOKS = np.linspace(0, 1, 9)


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """Quads in space, every one a parallelogram.

    Attributes
    ----------
    points : (V, 3) float64
    quads : (Q, 4) intp
    """

    points: Floats
    quads: Index

    def texture(self) -> Floats:
        """Points of the texture on every quad, (Q, K, 3)."""
        places = texture_places()
        a, b, _, d = np.moveaxis(self.points[self.quads], 1, 0)
        along, down = b - a, d - a
        return np.asarray(
            a[:, None] + places[:, :1] * along[:, None] + places[:, 1:] * down[:, None]
        )


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """A rigid motion in space.

    Attributes
    ----------
    first : (3, 3) float64
        Orientation at the start.
    axis : (3,) float64
        Unit vector that it turns about.
    angle : float
        How far, radians.
    places : (2, 3) float64
        Where the centre is at the start and at the end.
    """

    first: Floats
    axis: Floats
    angle: float
    places: Floats

    def seen(self, points: Floats, t: Floats) -> Points:
        """Points (..., 3) before the camera at the times (F,), (F, ..., 2)."""
        turns = np.stack([turned(self.axis, x * self.angle) for x in t]) @ self.first
        centres = (1 - t)[:, None] * self.places[0] + t[:, None] * self.places[1]
        flat = points.reshape(-1, 3) @ np.swapaxes(turns, 1, 2) + centres[:, None]
        image = FOCAL * flat[..., :2] / flat[..., 2:]
        return np.asarray(image.reshape(len(t), *points.shape[:-1], 2))


def turned(axis: Floats, angle: float) -> Floats:
    """Rotation matrix, (3, 3), about a unit vector: Rodrigues' formula."""
    x, y, z = axis
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * across + (1 - np.cos(angle)) * across @ across)


def _square(columns: int, rows: int) -> Solid:
    """A board of unit height made of equal quads."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, columns + 1), np.linspace(-0.5, 0.5, rows + 1))
    points = np.stack([x.ravel() * columns / rows, y.ravel(), 0 * x.ravel()], axis=1)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    return Solid(
        points, np.stack([first, first + 1, first + columns + 2, first + columns + 1], axis=1)
    )


def _cube() -> Solid:
    """The three faces of a cube around one corner, 7 points."""
    corners = np.array(
        [
            [0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1],
        ],
        dtype=np.float64,
    )  # fmt: skip
    return Solid(corners - 0.5, np.array([[0, 1, 2, 3], [1, 0, 4, 5], [0, 3, 6, 4]]))


def _in_plane(rng: np.random.Generator) -> Floats:
    angle = rng.uniform(0, 2 * np.pi)
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def _any_axis(rng: np.random.Generator) -> Floats:
    axis = rng.normal(size=3)
    return np.asarray(axis / np.linalg.norm(axis))


def _places(rng: np.random.Generator, aside: float, depth: float) -> Floats:
    """Two places about the middle of the view."""
    reach = np.array([aside, aside, depth])
    return np.asarray(np.array([0.0, 0.0, DEPTH]) + rng.uniform(-1, 1, (2, 3)) * reach)


def _tilt(rng: np.random.Generator) -> Motion:
    angle = np.deg2rad(rng.uniform(20, 60))
    return Motion(np.eye(3), _in_plane(rng), angle, np.tile([0.0, 0.0, DEPTH], (2, 1)))


def _tilt_and_shift(rng: np.random.Generator) -> Motion:
    places = _places(rng, 0.5, 0.3)
    places[0] = [0.0, 0.0, DEPTH]
    return Motion(np.eye(3), _in_plane(rng), np.deg2rad(rng.uniform(20, 60)), places)


def _shift(rng: np.random.Generator) -> Motion:
    first = turned(_in_plane(rng), np.deg2rad(rng.uniform(20, 50)))
    return Motion(first, _in_plane(rng), 0.0, _places(rng, 0.6, 0.4))


def _roll(rng: np.random.Generator) -> Motion:
    first = turned(_in_plane(rng), np.deg2rad(rng.uniform(0, 40)))
    axis = np.array([0.0, 0.0, 1.0]) + 0.2 * _in_plane(rng)
    angle = np.deg2rad(rng.uniform(45, 145))
    return Motion(first, axis / np.linalg.norm(axis), angle, _places(rng, 0.3, 0.2))


def _turn(rng: np.random.Generator) -> Motion:
    first = turned(_in_plane(rng), np.deg2rad(rng.uniform(20, 50)))
    return Motion(first, _any_axis(rng), np.deg2rad(rng.uniform(20, 60)), _places(rng, 0.3, 0.2))


def _cube_turn(rng: np.random.Generator) -> Motion:
    corner = turned(np.array([1.0, -1.0, 0.0]) / np.sqrt(2), np.arccos(1 / np.sqrt(3)))
    first = turned(_any_axis(rng), np.deg2rad(rng.uniform(0, 25))) @ corner
    places = _places(rng, 0.3, 0.3) + np.array([0.0, 0.0, 1.0])
    return Motion(first, _any_axis(rng), np.deg2rad(rng.uniform(15, 60)), places)


def _cases(
    family: str, solid: Solid, draw: Callable[[np.random.Generator], Motion]
) -> Callable[[np.random.Generator], Iterator[Case]]:
    """Endless scenes of one kind, every second one backwards."""

    def scenes(rng: np.random.Generator) -> Iterator[Case]:
        backwards = False
        while True:
            motion = draw(rng)
            looks = motion.seen(solid.points, LOOKS)
            sines = corner_sines(looks[:, solid.quads])
            if not ((sines > LEAST_SINE).all() or (sines < -LEAST_SINE).all()):
                continue  # a face is hidden, or as good as
            t = np.concatenate([[0.0], TIMES, [1.0]])
            vertices = motion.seen(solid.points, t)
            texture = motion.seen(solid.texture(), t)
            if backwards:
                vertices, texture = vertices[::-1], texture[::-1]
            backwards = not backwards
            pair = MeshPair(vertices[0], vertices[-1], solid.quads)
            yield Case(family, pair, vertices[1:-1], texture[1:-1], texture[0])

    return scenes


SCENES: dict[str, Callable[[np.random.Generator], Iterator[Case]]] = {
    "plane tilting": _cases("plane tilting", _square(1, 1), _tilt),
    "plane tilting, shifting": _cases("plane tilting, shifting", _square(1, 1), _tilt_and_shift),
    "plane shifting": _cases("plane shifting", _square(1, 1), _shift),
    "plane rolling": _cases("plane rolling", _square(1, 1), _roll),
    "plane turning": _cases("plane turning", _square(1, 1), _turn),
    "board of 12 quads": _cases("board of 12 quads", _square(4, 3), _turn),
    "cube": _cases("cube", _cube(), _cube_turn),
}
"""Endless generators of scenes by family."""
