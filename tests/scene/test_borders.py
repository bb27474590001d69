"""One body cut into areas: borders that two of them share stay shared all the way."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely.affinity import scale

from shapetween.pipeline import prepare
from shapetween.scene.borders import Bordered
from shapetween.svg.read.reader import read_svg
from tests.scene.test_kept import PAGE, drawn, off, path

COLOURS = ("#c33", "#3a3", "#33c")
T = np.linspace(0, 1, 9)


def country(swell: float, phase: float, cuts: tuple[float, float]) -> list[shapely.Geometry]:
    """A wavy body in three parts, one beside the other."""
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    away = 34 + 4 * np.sin(3 * turn + phase) + swell * np.cos(2 * turn)
    body = shapely.Polygon(50 + away[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1))
    y = np.linspace(0, 100, 18)
    left = []
    for k, x in enumerate(cuts):
        line = np.stack([x + 3 * np.sin(y / 9 + phase + k), y], axis=-1)
        left.append(shapely.Polygon([(-50, 0), *line, (-50, 100)]))
    return [
        body.intersection(left[0]),
        body.intersection(left[1]).difference(left[0]),
        body.difference(left[1]),
    ]


def parts(areas: list[shapely.Geometry]) -> str:
    return "".join(path(area, colour) for area, colour in zip(areas, COLOURS, strict=True))


@pytest.mark.parametrize("unit", [1.0, 1e-4])
def test_parts_of_one_body_never_come_apart(unit: float) -> None:
    ends = country(3, 0.0, (38, 62)), country(6, 2.0, (36, 66))
    sides = [
        f"{PAGE}{parts(areas)}</svg>".replace("0 0 100 100", f"0 0 {100 * unit} {100 * unit}")
        .replace("<path", f"<path transform='scale({unit})'")
        .encode()
        for areas in ends
    ]
    one, other = (read_svg(side, "x") for side in sides)
    found = prepare(one, other)
    tracks = [track for part in found.movement.parts for track in part.tracks]
    assert sum(isinstance(getattr(t, "track", t), Bordered) for t in tracks) == 3
    for t, frame in zip(T, found.movement.at(T), strict=True):
        areas = [
            scale(drawn(replace(frame, shapes=(shape,))), 1 / unit, 1 / unit, origin=(0, 0))
            for shape in frame.shapes
        ]
        together = shapely.union_all(areas)
        assert together.buffer(1e-6).geom_type == "Polygon"
        assert not together.buffer(0.01).interiors
        assert sum(area.area for area in areas) == pytest.approx(together.area, abs=0.05)
        if t in (0, 1):
            whole = shapely.union_all(ends[int(t)])
            assert off(together, whole) < 0.05


def test_parts_that_meet_others_at_the_end_move_by_themselves() -> None:
    first = country(3, 0.0, (38, 62))
    second = [first[1], first[0], first[2]]
    one, other = (read_svg(f"{PAGE}{parts(a)}</svg>".encode(), "x") for a in (first, second))
    tracks = [track for part in prepare(one, other).movement.parts for track in part.tracks]
    assert not any(isinstance(getattr(t, "track", t), Bordered) for t in tracks)
