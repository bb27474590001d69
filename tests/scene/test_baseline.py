"""What drawings of parts are seen as and how they move, in figures that are known.

Most cases are real drawings whose shapes are scaled, leant and shifted by chance, a little or much,
so that some of them lie near every threshold.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.model.drawing import Drawing, Shape
from shapetween.pipeline import Options, Prepared, prepare
from shapetween.svg.read.reader import read_svg
from tests.baseline import assert_known

TESTS = Path(__file__).resolve().parents[1]

FOLDERS = {
    "gallery": TESTS.parent / "gallery/inputs",
    "pairing": TESTS / "data/pairing",
    "scene": TESTS / "data/scene",
}

#: Folder and names of two drawings; behind a number sign what chance starts from.
CASES = (TESTS / "data/scene/known.txt").read_text("utf-8").split()

TIMES = np.array([0.0, 0.2, 0.45, 0.6, 0.9])

#: By how much shapes are scaled and leant; they are shifted by an eighth of it, times the drawing.
AMOUNTS = (0.004, 0.02, 0.06, 0.12, 0.2, 0.3, 0.45)


def drawings(case: str) -> tuple[Drawing, Drawing]:
    """Both as they are, or moved by chance."""
    place, _, seed = case.partition("#")
    folder, *names = place.split(":")
    if folder == "scene":
        names = [f"{names[0]}.a", f"{names[0]}.b"]
    paths = [FOLDERS[folder] / f"{name}.svg" for name in names]
    first, second = (read_svg(path.read_bytes(), path.name) for path in paths)
    if not seed:
        return first, second
    return moved(first, 2 * int(seed)), moved(second, 2 * int(seed) + 1)


def moved(drawing: Drawing, seed: int) -> Drawing:
    """Every shape scaled, leant and shifted by chance."""
    rng = np.random.default_rng(seed)
    size = max(drawing.box.width, drawing.box.height)
    shapes: list[Shape] = []
    for shape in drawing.shapes:
        points = np.concatenate([ring.curves.reshape(-1, 2) for ring in shape.rings])
        centre = (points.min(axis=0) + points.max(axis=0)) / 2
        by = rng.normal(size=6) * AMOUNTS[seed % len(AMOUNTS)]
        linear = np.array([[1 + by[0], by[1] / 3], [by[2] / 3, 1 + by[3]]])
        shift = centre - linear @ centre + by[4:] * size / 8
        matrix = np.column_stack([linear, shift])
        shapes += replace(drawing, shapes=(shape,)).transformed(matrix).shapes
    return replace(drawing, shapes=tuple(shapes))


def of_roles(found: Prepared) -> list[float]:
    """Who becomes whom, at what cost, and what being alone costs."""
    if found.scene is None:
        return []
    roles = found.scene.roles if found.scene.matched is None else found.scene.matched[1]
    pairs = [(k + 1) * (p.first + 1.7 * p.second) for k, p in enumerate(roles.pairs)]
    figures = [float(len(pairs)), float(sum(pairs))]
    costs = [p.cost for p in roles.pairs], roles.disappearing_costs, roles.appearing_costs
    for own in costs:
        weights = 1 + 0.37 * np.arange(len(own))
        figures.append(float(sum(w * c for w, c in zip(weights, own, strict=True) if c < np.inf)))
    return figures


def of_movement(found: Prepared) -> list[float]:
    """Where all control points are on the way, weighed by chance."""
    parts = found.movement.parts
    box = found.movement.box
    every = [part.curves(TIMES).reshape(len(TIMES), -1, 2) for part in parts]
    points: Floats = np.concatenate(every, axis=1) - [box.x, box.y]
    weights = 1.5 + np.cos(np.arange(points.shape[1]))
    means = np.tensordot(points, weights, axes=(1, 0)) / weights.sum() / max(box.width, box.height)
    return [float(len(parts)), *(means @ [1.0, 1.5]).tolist()]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("case", CASES)
def test_the_scene_is_known(case: str) -> None:
    found = prepare(*drawings(case))
    assert_known("scene", case, of_roles(found) + of_movement(found))


@pytest.mark.filterwarnings("ignore")
def test_how_readily_things_pair_is_known() -> None:
    figures = []
    for case in ("pairing:iconoir-lock:iconoir-key", "gallery:icon-mail:icon-mail-open"):
        for pairing in ("loose", "strict"):
            found = prepare(*drawings(case), Options(pairing=pairing))
            figures += of_roles(found)
    assert_known("scene", "loose and strict", figures)
