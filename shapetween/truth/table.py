"""Every method against what really happened, by kind of scene."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OptionError, ShapeError
from shapetween.base.observe import Observer, unobserved
from shapetween.compare.formulas.epipolar import epipolar_distance
from shapetween.geometry.polygon import cross, rms_radius
from shapetween.geometry.rotation import rotations
from shapetween.interpolate import INTERIORS, METHODS, tween
from shapetween.interpolate.inside import Inside
from shapetween.truth import camera, figure
from shapetween.truth.case import TIMES, Case

__all__ = ["Row", "format_table", "scenes", "table"]

#: Seeds that numpy's generator takes and that a table can be asked for again by.
LARGEST_SEED = 2**32 - 1

#: Most scenes of a family, so that a mistyped count does not run for hours.
LARGEST_COUNT = 1000

#: Error up to which two methods are as good as each other, as a share of the scene's radius.
TIE = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """Errors of all methods in one family, corners or texture.

    Attributes
    ----------
    family : str
    what : {"vertices", "texture", "views"}
    errors : mapping of str to (N,) float64
        By method, one for each scene: the root mean square error over all points and `TIMES`, as a
        share of the root mean square radius of the scene; or, for views, how far the in-betweens
        are from any view of what either end shows (`epipolar_distance`).
    """

    family: str
    what: str
    errors: Mapping[str, Floats]

    def median(self, method: str) -> float:
        """Middle error of a method."""
        return float(np.median(self.errors[method]))

    def worst(self, method: str) -> float:
        """Largest error of a method."""
        return float(self.errors[method].max())

    def wins(self, method: str) -> float:
        """Share of the scenes in which no other method is better."""
        least = np.min(list(self.errors.values()), axis=0)
        return float((self.errors[method] <= least + TIE).mean())


def scenes(seed: int, count: int) -> Iterator[tuple[str, list[Case]]]:
    """Scenes of every family, the same for the same seed.

    Raises
    ------
    OptionError
        If the seed or the count is out of range.
    """
    if not 0 <= seed <= LARGEST_SEED:
        raise OptionError(f"seed: {seed} is out of range; give a whole number from 0 to 2^32 - 1")
    if not 1 <= count <= LARGEST_COUNT:
        raise OptionError(f"count: {count} is out of range; give 1 to {LARGEST_COUNT}")
    for number, (family, generator) in enumerate({**camera.SCENES, **figure.SCENES}.items()):
        yield family, list(islice(generator(np.random.default_rng([seed, number])), count))


def table(
    seed: int = 0,
    count: int = 40,
    methods: tuple[str, ...] = tuple(METHODS),
    observe: Observer = unobserved,
) -> list[Row]:
    """Errors of methods in `count` scenes of every family.

    Raises
    ------
    OptionError
        If the seed or the count is out of range, or there is no such method.
    """
    rows = []
    for family, cases in scenes(seed, count):
        with observe(family):
            found = {method: [_errors(case, method) for case in cases] for method in methods}
        for column, what in enumerate(("vertices", "texture", "views")):
            errors = {m: np.array([each[column] for each in all_]) for m, all_ in found.items()}
            if not np.isnan(errors[methods[0]]).any():
                rows.append(Row(family, what, errors))
    return rows


def _errors(case: Case, method: str) -> tuple[float, float, float]:
    """Error of vertices, texture and views; not a number where a scene has no such thing."""
    vertices = tween(case.pair, method).vertices(TIMES)
    ends = np.stack([case.pair.source, case.pair.target])
    radius = float(rms_radius(ends).mean())
    moved = _moved_onto(vertices, case.vertices) if case.free else vertices
    corners = _rms(moved - case.vertices) / radius
    if case.texture is None or case.places is None:
        return corners, np.nan, np.nan
    inside = Inside.of(case.pair, INTERIORS[method]).points(vertices, case.places)
    return corners, _rms(inside - case.texture) / radius, _views(case, case.places, inside)


def _views(case: Case, places: Points, inside: Points) -> float:
    """Mean epipolar distance of in-betweens (F, Q, K, 2) from both ends; none in flat scenes."""
    last = Inside.of(case.pair, "homography").points(case.pair.target[None], places)
    ends = places.reshape(-1, 2), last.reshape(-1, 2)
    try:
        epipolar_distance(*ends)
    except ShapeError:
        return np.nan
    frames = inside.reshape(len(inside), -1, 2)
    return float(np.mean([epipolar_distance(end, x) for end in ends for x in frames]))


def _rms(offsets: Points) -> float:
    return float(np.sqrt((offsets**2).sum(axis=-1).mean()))


def _moved_onto(points: Points, wanted: Points) -> Points:
    """Every frame of points (F, V, 2) moved rigidly to be nearest to the wanted ones."""
    a = points - points.mean(axis=1, keepdims=True)
    middle = wanted.mean(axis=1, keepdims=True)
    b = wanted - middle
    angles = np.arctan2(cross(a, b).sum(axis=1), (a * b).sum(axis=(1, 2)))
    return np.asarray(a @ np.swapaxes(rotations(angles), 1, 2) + middle)


def format_table(rows: list[Row]) -> str:
    """The table as text: median / worst error in percent, and how often nothing was better."""
    methods = list(rows[0].errors)
    names = [f"{row.family}, {row.what}" for row in rows]
    width = max(map(len, names)) + 2
    lines = [" " * width + "".join(f"{m:>22}" for m in methods)]
    for name, row in zip(names, rows, strict=True):
        cells = [
            f"{100 * row.median(m):6.2f} /{100 * row.worst(m):6.2f} {100 * row.wins(m):4.0f} %"
            for m in methods
        ]
        lines.append(f"{name:<{width}}" + "".join(f"{cell:>22}" for cell in cells))
    means = [100 * np.mean([row.median(m) for row in rows]) for m in methods]
    lines.append(f"{'mean of medians':<{width}}" + "".join(f"{x:>14.2f}{'':8}" for x in means))
    return "\n".join(line.rstrip() for line in lines)
