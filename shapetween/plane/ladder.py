"""Trying stiffer motions until the drawn outlines stay simple, one setting for the whole motion."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.arrays import Floats, Mask, Points
from shapetween.plane.airmesh import MendedMotion
from shapetween.plane.check import simple_frames
from shapetween.plane.mesh import PlaneMesh
from shapetween.plane.motion import InsideTarget, PlaneMotion, Stiffness

__all__ = ["LADDER", "FramesCheck", "SettledMotion", "settle"]

FramesCheck: TypeAlias = Callable[[Floats, Points], Mask]
"""Which frames are simple: times (F,) and all vertices (F, V, 2) to (F,)."""

#: Settings in the order tried. The first keeps limbs long; each later one keeps parts further
#: apart and lets limbs shorten.
LADDER = (Stiffness(0.5, 8.0), Stiffness(1.0, 1.0), Stiffness(3.0, 0.0))

#: Number of times at which a motion is looked at; it is solved at every other one and interpolated
#: between, which is far cheaper and as good. Fewer miss short contacts.
CHECKED_TIMES = 161


@dataclass(frozen=True, slots=True, eq=False)
class SettledMotion:
    """A motion, how it was found, and what is left wrong with it.

    Attributes
    ----------
    motion : PlaneMotion or MendedMotion
    stiffness : Stiffness
    crossing : (C,) float64
        Times among those checked at which outlines cross; empty if all is well.
    """

    motion: PlaneMotion | MendedMotion
    stiffness: Stiffness
    crossing: Floats

    @property
    def mended(self) -> bool:
        """Whether the motion was mended frame by frame."""
        return isinstance(self.motion, MendedMotion)


def settle(
    mesh: PlaneMesh,
    check: FramesCheck | None = None,
    target: InsideTarget | None = None,
    ladder: tuple[Stiffness, ...] = LADDER,
) -> SettledMotion:
    """Find a motion of a mesh without crossings.

    Parameters
    ----------
    mesh : PlaneMesh
    check : FramesCheck, optional
        Looks at the outlines as they are drawn; by default at the polygons of their nodes.
    target : InsideTarget, optional
        What the inside triangles should do.
    ladder : tuple of Stiffness
        Settings to try, at least one.

    Returns
    -------
    SettledMotion
        The first without a crossing, else the one with the fewest. Where the polygons of the nodes
        are simple and yet `check` finds crossings, only more nodes can help, and no further
        setting is tried.
    """
    t = np.linspace(0, 1, CHECKED_TIMES)
    solved = t[::2]
    polygons = _polygons(mesh)
    look = check or polygons
    tried: list[SettledMotion] = []
    for stiffness in ladder:
        motion = PlaneMotion.prepare(mesh, stiffness, target)
        vertices = motion.vertices(solved)
        tried.append(SettledMotion(motion, stiffness, t[~look(t, _denser(vertices))]))
        if not len(tried[-1].crossing):
            return tried[-1]
        mended = MendedMotion.of(motion, solved, vertices)
        moved = vertices + mended.added(solved)
        tried.append(SettledMotion(mended, stiffness, t[~look(t, _denser(moved))]))
        if not len(tried[-1].crossing):
            return tried[-1]
        if check and polygons(solved, moved).all():
            break
    return min(tried, key=lambda settled: len(settled.crossing))


def _denser(vertices: Points) -> Points:
    """Frames (F, V, 2) and those half way between them, (2 F - 1, V, 2), by cubics."""
    dense = np.repeat(vertices, 2, axis=0)[:-1]
    a, b, c, d = vertices[:-3], vertices[1:-2], vertices[2:-1], vertices[3:]
    dense[3:-3:2] = (9 * (b + c) - (a + d)) / 16
    dense[1] = (5 * a[0] + 15 * b[0] - 5 * c[0] + d[0]) / 16
    dense[-2] = (5 * d[-1] + 15 * c[-1] - 5 * b[-1] + a[-1]) / 16
    return dense


def _polygons(mesh: PlaneMesh) -> FramesCheck:
    """Look at the polygons of the nodes."""
    order = np.concatenate(mesh.rings)
    sizes = tuple(len(ring) for ring in mesh.rings)
    return lambda _, vertices: simple_frames(vertices[:, order], sizes)
