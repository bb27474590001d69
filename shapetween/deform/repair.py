"""Repairing what still inverts in a moving ambient mesh, frame by frame and then smoothly in time.

A triangle that has become too small, or is inverted, pushes its corners apart until it has a
share of the area it has at the ends [MCKM15]_; as the mesh covers the outside as well, this keeps
outlines from crossing.

.. [MCKM15] M. Mueller, N. Chentanez, T.-Y. Kim, M. Macklin, *Air meshes for robust collision
   handling*, ACM TOG 34(4), 2015.
"""

import numpy as np

from shapetween.base.arrays import Complex, Floats, row_sums
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.mesh import AmbientMesh
from shapetween.geometry.linearmaps import as_complex, squared

__all__ = ["repair_inversions"]

#: Share of its smaller area at the ends that a triangle keeps. Larger keeps parts further apart
#: and moves more of the mesh; smaller leaves contacts that curves between the nodes cross.
LEAST_SHARE = 0.2
#: Sweeps at most, at first and after smoothing.
SWEEPS, SWEEPS_AFTER = 60, 30
#: Overrelaxation of a sweep. Larger converges sooner until it oscillates, from about 1.5.
RELAXATION = 1.2
#: Passes of (1, 2, 1) / 4 over the displacements in time. Fewer let the repair show as a jolt.
SMOOTHING = 3


def repair_inversions(motion: KeyedMotion, count: int) -> KeyedMotion:
    """The same motion, repaired at even times, `count` in all; the ends stay."""
    mesh, t = motion.mesh, np.linspace(0, 1, count)
    plain = motion.posed(t)
    added = _pushed(mesh, plain, SWEEPS) - plain
    for _ in range(SMOOTHING):
        added[1:-1] = (added[:-2] + 2 * added[1:-1] + added[2:]) / 4
    return KeyedMotion.of(mesh, _pushed(mesh, plain + added, SWEEPS_AFTER))


def _pushed(mesh: AmbientMesh, posed: Complex, sweeps: int) -> Complex:
    """Push the corners of small triangles apart in all but the first and last frame, (F, V)."""
    triangles = mesh.triangles[~mesh.inverted]
    ends = [
        _areas(as_complex(pose.normalise(points))[triangles])
        for pose, points in zip(mesh.poses, (mesh.source, mesh.target), strict=True)
    ]
    least = LEAST_SHARE * np.minimum(*ends)
    frames, count = posed.shape
    held = (count * np.arange(frames)[:, None] + mesh.frame).ravel()
    result = posed.copy()
    flat = result.reshape(-1)
    frame, face = (x.ravel() for x in np.indices((frames - 2, len(triangles))))
    frame = frame + 1
    for _ in range(sweeps):
        cell = frame[:, None] * count + triangles[face]
        corners = flat[cell]
        lack = least[face] - _areas(corners)
        bad = lack > 0
        if not bad.any():
            break
        cell, corners, lack = cell[bad], corners[bad], lack[bad]
        gradient = 0.5j * (corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]])
        step = (lack / row_sums(squared(gradient)))[:, None] * gradient
        cell, step = cell.ravel(), step.ravel()
        sums = [np.bincount(cell, part, flat.size) for part in (step.real, step.imag)]
        number = np.bincount(cell, minlength=flat.size)
        number[held] = 0
        pushed = np.flatnonzero(number)
        flat[pushed] += RELAXATION * (sums[0] + 1j * sums[1])[pushed] / number[pushed]
        # A triangle that nothing has touched is as valid as it was.
        moved = number.reshape(frames, count) > 0
        touched = np.flatnonzero(moved.any(axis=1))
        first, second, third = (moved[touched][:, corner] for corner in triangles.T)
        near = first | second | third
        frame, face = np.divmod(np.flatnonzero(near), len(triangles))  # quicker than by axes
        frame = touched[frame]
    return result


def _areas(corners: Complex) -> Floats:
    """Signed areas of triangles (..., 3)."""
    first, second = corners[..., 1] - corners[..., 0], corners[..., 2] - corners[..., 0]
    return np.asarray((first.conj() * second).imag / 2)
