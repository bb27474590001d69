"""Mending what still folds in a moving plane mesh, frame by frame and then smoothly in time.

A triangle that has become too small, or is turned over, pushes its corners apart until it has a
share of the area it has at the ends [MCKM15]_; as the mesh covers the outside as well, this keeps
outlines from crossing.

.. [MCKM15] M. Mueller, N. Chentanez, T.-Y. Kim, M. Macklin, *Air meshes for robust collision
   handling*, ACM TOG 34(4), 2015.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from shapetween.arrays import Floats, Points, times
from shapetween.geometry.polygon import polygon_area
from shapetween.plane.mesh import PlaneMesh
from shapetween.plane.motion import PlaneMotion

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

__all__ = ["MendedMotion"]

#: Share of its smaller area at the ends that a triangle keeps. Larger keeps parts further apart
#: and moves more of the mesh; smaller leaves contacts that curves between the nodes cross.
LEAST_SHARE = 0.2
#: Sweeps at most, at first and after smoothing.
SWEEPS, SWEEPS_AFTER = 60, 30
#: Overrelaxation of a sweep. Larger converges sooner until it oscillates, from about 1.5.
RELAXATION = 1.2
#: Passes of (1, 2, 1) / 4 over the displacements in time. Fewer let the mending show as a jolt.
SMOOTHING = 3


@dataclass(frozen=True, slots=True, eq=False)
class MendedMotion:
    """A plane motion and what is added to it, zero at the ends."""

    motion: PlaneMotion
    _added: "CubicSpline[np.float64]"

    @classmethod
    def of(cls, motion: PlaneMotion, t: Floats, vertices: Points) -> "MendedMotion":
        """Mend a motion at the times (F,), 0 first and 1 last, where its vertices are given."""
        from scipy.interpolate import CubicSpline  # slow to import, and few pairs need mending

        mended = _push(motion.mesh, t, vertices, SWEEPS)
        added = mended - vertices
        for _ in range(SMOOTHING):
            added[1:-1] = (added[:-2] + 2 * added[1:-1] + added[2:]) / 4
        added = _push(motion.mesh, t, vertices + added, SWEEPS_AFTER) - vertices
        return cls(motion, CubicSpline(t, added))

    @property
    def mesh(self) -> PlaneMesh:
        """The mesh that moves."""
        return self.motion.mesh

    def vertices(self, t: ArrayLike) -> Points:
        """Vertices at the times (F,), in user units, (F, V, 2); the mesh's own at 0 and 1."""
        at = times(t)
        return self.motion.vertices(at) + self.added(at)

    def added(self, t: Floats) -> Points:
        """What is added at the times (F,), (F, V, 2)."""
        inner = ((t > 0) & (t < 1))[:, None, None]
        return np.where(inner, self._added(t), 0)


def _push(mesh: PlaneMesh, t: Floats, vertices: Points, sweeps: int) -> Points:
    """Push the corners of small triangles apart at the inner times, (F, V, 2) to (F, V, 2)."""
    triangles = mesh.triangles[~mesh.turned]
    sizes = np.array([pose.size for pose in mesh.poses])
    ends = [polygon_area(points[triangles]) for points in (mesh.source, mesh.target)]
    least = LEAST_SHARE * np.minimum(ends[0] / sizes[0] ** 2, ends[1] / sizes[1] ** 2)
    scale = ((1 - t) * sizes[0] + t * sizes[1]) ** 2
    count = len(mesh.source)
    moved, near = np.zeros(count, dtype=bool), np.ones(len(triangles), dtype=bool)
    result = vertices.copy()
    active = np.flatnonzero((t > 0) & (t < 1))
    for _ in range(sweeps):
        corners = result[active][:, triangles[near]]
        lack = least[near] * scale[active, None] - polygon_area(corners)
        bad = lack > 0
        some = bad.any(axis=1)
        active, frame, face = active[some], *np.nonzero(bad[some])
        if not len(active):
            break
        opposite = np.roll(corners[bad], 1, axis=1) - np.roll(corners[bad], -1, axis=1)
        gradient = np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1) / 2
        step = (lack[bad] / (gradient**2).sum(axis=(1, 2)))[:, None, None] * gradient
        cell = (frame[:, None] * count + triangles[near][face]).ravel()
        size = len(active) * count
        sums = [np.bincount(cell, step[..., axis].ravel(), size) for axis in (0, 1)]
        number = np.maximum(np.bincount(cell, minlength=size), 1)
        move = RELAXATION * np.stack(sums, axis=1) / number[:, None]
        move = move.reshape(len(active), count, 2)
        move[:, mesh.frame] = 0
        result[active] += move
        # A triangle that nothing has touched yet is as sound as it was.
        moved |= move.any(axis=(0, 2))
        near = np.asarray(moved[triangles].any(axis=1))
    return result
