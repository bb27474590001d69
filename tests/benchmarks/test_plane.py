"""Seconds of the plane mesh by its stages, for a comb whose teeth lean over."""

from typing import Any

import numpy as np
import pytest

from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.motion import AmbientMotion
from shapetween.deform.schedule import solve
from tests.deform.shapes import comb


@pytest.mark.parametrize("teeth", [4, 12, 40])
def test_mesh(benchmark: Any, teeth: int) -> None:
    mesh = benchmark(ambient_mesh, comb(teeth, -0.5), comb(teeth, 0.5))
    assert not mesh.inverted.any()


@pytest.mark.parametrize("teeth", [4, 12, 40])
def test_motion(benchmark: Any, teeth: int) -> None:
    motion = AmbientMotion.prepare(ambient_mesh(comb(teeth, -0.5), comb(teeth, 0.5)))
    moved = benchmark(motion.vertices, np.linspace(0, 1, 81))
    assert np.isfinite(moved).all()


@pytest.mark.parametrize("teeth", [4, 12])
def test_settle(benchmark: Any, teeth: int) -> None:
    solved = benchmark(solve, ambient_mesh(comb(teeth, -0.5), comb(teeth, 0.5)))
    assert not len(solved.crossing)
