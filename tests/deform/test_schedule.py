import numpy as np

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.deform.check import simple_frames
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.mesh import AmbientMesh, ambient_mesh
from shapetween.deform.motion import AmbientMotion, Stiffness
from shapetween.deform.repair import repair_inversions
from shapetween.deform.schedule import STIFFNESS_SCHEDULE, solve
from shapetween.geometry.linearmaps import LinearMaps
from shapetween.geometry.polygon import polygon_area
from tests.baseline import assert_known
from tests.deform.shapes import bowed_strip, comb

T = np.linspace(0, 1, 41)


def _hooks(angle: float) -> tuple[Points, list[np.ndarray]]:
    """Two curled strips one above the other, backs or ends towards each other."""
    left = bowed_strip(angle, 10) + np.array([0.0, 0.5])
    return np.concatenate([left, -left]), [np.arange(20), np.arange(20, 40)]


def test_an_easy_motion_takes_the_first_setting() -> None:
    solved = solve(ambient_mesh(comb(4, -0.5), comb(4, 0.5)))
    assert solved.stiffness is STIFFNESS_SCHEDULE[0]
    assert not solved.repaired
    assert not len(solved.crossing)


def _clapping() -> tuple[AmbientMesh, KeyedMotion]:
    """Two bars that swing into each other and back."""
    strip = bowed_strip(0.0, 10)
    nodes = np.concatenate([strip + np.array([0.0, y]) for y in (-0.25, 0.25)])
    rings = [np.arange(20), np.arange(20, 40)]
    mesh = ambient_mesh(nodes, nodes, rings)
    above = mesh.source[mesh.triangles[mesh.inside]].mean(axis=1)[:, 1] < 0

    def clap(t: Floats, own: LinearMaps) -> LinearMaps:
        swing = 0.7 * np.sin(np.pi * t)[:, None]
        return own.turned(np.exp(1j * np.where(above, swing, -swing)))

    solver = AmbientMotion.prepare(mesh, Stiffness(outside=1e-3, length=0.0), clap)
    return mesh, KeyedMotion.of(mesh, solver.posed(np.linspace(0, 1, 21)))


def test_what_folds_is_repaired_and_stays_smooth() -> None:
    mesh, motion = _clapping()
    plain = motion.vertices(T)
    assert not simple_frames(plain[:, :40], (20, 20)).all()
    repaired = repair_inversions(motion, len(T))
    moved = repaired.vertices(T)
    assert (polygon_area(moved[:, mesh.triangles]) > 0).all()
    np.testing.assert_array_equal(moved[[0, -1]], plain[[0, -1]])
    np.testing.assert_allclose(moved[:, mesh.frame], plain[:, mesh.frame], atol=1e-12)
    fine = repaired.nodes(np.linspace(0, 1, 161))
    assert simple_frames(fine, (20, 20)).all()
    jolts = [np.abs(np.diff(x[:, :40], 2, axis=0)).max() * 1600 for x in (plain, moved)]
    assert jolts[1] < 20 > jolts[0]


def test_the_callers_look_decides() -> None:
    mesh = ambient_mesh(comb(4, -0.5), comb(4, 0.5))
    seen: list[tuple[int, ...]] = []

    def never(t: Floats, vertices: Points) -> Mask:
        seen.append(vertices.shape)
        return np.asarray((t < 0.25) | (t > 0.25 + 0.01 * len(seen)))

    solved = solve(mesh, never)
    assert len(seen) == 2  # the nodes themselves do not cross: no other setting would help
    assert solved.stiffness is STIFFNESS_SCHEDULE[0]
    np.testing.assert_allclose(solved.crossing, [0.25, 0.25625])
    solve(mesh, never, denser=False)
    assert len(seen) == 2 + 2 * len(STIFFNESS_SCHEDULE)


def test_what_is_looked_at_is_what_moves() -> None:
    mesh = ambient_mesh(comb(4, -1.5), comb(4, 1.5))
    looked: list[Points] = []

    def look(t: Floats, nodes: Points) -> Mask:
        looked.append(nodes)
        return np.full(len(t), True)

    solved = solve(mesh, look)
    t = np.linspace(0, 1, len(looked[0]))
    drawn = solved.motion.vertices(t)[:, : mesh.nodes]
    np.testing.assert_allclose(looked[0], drawn, atol=1e-12 * np.ptp(drawn))
    exact = AmbientMotion.prepare(mesh, solved.stiffness).vertices(t)[:, : mesh.nodes]
    np.testing.assert_allclose(drawn, exact, atol=1e-4 * np.ptp(drawn))


def test_curled_strips_pass_each_other() -> None:
    nodes, rings = _hooks(2.5)
    solved = solve(ambient_mesh(nodes, _hooks(-2.5)[0], rings))
    moved = solved.motion.vertices(np.linspace(0, 1, 161))[:, :40]
    assert not len(solved.crossing)
    assert simple_frames(moved, (20, 20)).all()


def test_the_repair_is_known() -> None:
    mesh, motion = _clapping()
    moved = repair_inversions(motion, len(T)).vertices(T[1:-1:3])
    areas = polygon_area(moved[:, mesh.triangles])
    figures = [*areas.min(axis=1).tolist(), *moved[:, :40:3].ravel().tolist()]
    assert_known("deform", "bars that clap", figures)
