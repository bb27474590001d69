"""How ambient meshes are made and move, in figures that are known."""

import numpy as np
import pytest

from shapetween.base.arrays import Index, Points
from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.schedule import solve
from tests.baseline import assert_known
from tests.deform.shapes import blob, bowed_strip, comb, ring_with_hole, two_discs

TIMES = np.array([0.1, 0.25, 0.5, 0.8])

Case = tuple[Points, Points, list[Index] | None]


def ring(points: Points) -> list[Index]:
    return [np.arange(len(points))]


CASES: dict[str, Case] = {
    "a strip that bends far": (bowed_strip(-2.0), bowed_strip(3.0), None),
    "a comb that leans": (comb(3, -0.1), comb(3, 0.35), None),
    "a star and another": (blob(3, 14), blob(8, 14), None),
    "stars of which one is turned": (blob(5, 20), blob(6, 20)[:, ::-1] * [-1, 1], None),
    "a hole that moves": (ring_with_hole(-0.4)[0], ring_with_hole(0.45)[0], ring_with_hole(0)[1]),
    "discs that go round": (two_discs(0.0)[0], two_discs(2.0)[0], two_discs(0.0)[1]),
    "a comb that becomes a star": (comb(2, 0.0), blob(4, 10), None),
    "a strip that bends the other way": (bowed_strip(-6.0), bowed_strip(6.0), None),
    "discs that nearly change places": (
        two_discs(0.0)[0],
        two_discs(3.0)[0],
        two_discs(0.0)[1],
    ),
    "discs that run into each other": (
        two_discs(0.0)[0],
        two_discs(3.14)[0],
        two_discs(0.0)[1],
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_the_motion_is_known(case: str) -> None:
    source, target, rings = CASES[case]
    mesh = ambient_mesh(source, target, rings)
    solved = solve(mesh)
    nodes = solved.motion.nodes(TIMES)[:, :: max(1, len(source) // 4)]
    size = np.ptp(np.concatenate([source, target]))
    figures = [
        len(mesh.triangles),
        int(mesh.inverted.sum()),
        solved.stiffness.outside,
        float(solved.repaired),
        len(solved.crossing),
        *((nodes - source.mean(axis=0)) / size).ravel().tolist(),
    ]
    assert_known("deform", case, figures)
