"""Seconds of the plane mesh by its stages, for a comb whose teeth lean over."""

from typing import Any

import numpy as np
import pytest

from shapetween.deform.ladder import settle
from shapetween.deform.mesh import plane_mesh
from shapetween.deform.motion import PlaneMotion
from tests.deform.shapes import comb


@pytest.mark.parametrize("teeth", [4, 12, 40])
def test_mesh(benchmark: Any, teeth: int) -> None:
    mesh = benchmark(plane_mesh, comb(teeth, -0.5), comb(teeth, 0.5))
    assert not mesh.turned.any()


@pytest.mark.parametrize("teeth", [4, 12, 40])
def test_motion(benchmark: Any, teeth: int) -> None:
    motion = PlaneMotion.prepare(plane_mesh(comb(teeth, -0.5), comb(teeth, 0.5)))
    moved = benchmark(motion.vertices, np.linspace(0, 1, 81))
    assert np.isfinite(moved).all()


@pytest.mark.parametrize("teeth", [4, 12])
def test_settle(benchmark: Any, teeth: int) -> None:
    settled = benchmark(settle, plane_mesh(comb(teeth, -0.5), comb(teeth, 0.5)))
    assert not len(settled.crossing)
