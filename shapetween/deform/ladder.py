"""Trying stiffer motions until the drawn outlines stay simple, one setting for the whole motion."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.deform.airmesh import mended
from shapetween.deform.check import simple_frames
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.mesh import PlaneMesh
from shapetween.deform.motion import InsideTarget, PlaneMotion, Stiffness

__all__ = ["LADDER", "FramesCheck", "SettledMotion", "settle"]

FramesCheck: TypeAlias = Callable[[Floats, Points], Mask]
"""Which frames are simple: times (F,) and the outlines' nodes (F, N, 2) to (F,)."""

#: Settings in the order tried. The first keeps limbs long; each later one keeps parts further
#: apart and lets limbs shorten.
LADDER = (Stiffness(0.5, 8.0), Stiffness(1.0, 1.0), Stiffness(3.0, 0.0))

#: Even times at which a motion is solved, and at which it is mended where outlines cross. Fewer
#: lose quick movements; more cost time and change nothing that is seen.
SOLVED_TIMES, MENDED_TIMES = 21, 81

#: Number of times at which a motion is looked at. Fewer miss short contacts.
CHECKED_TIMES = 161


@dataclass(frozen=True, slots=True, eq=False)
class SettledMotion:
    """A motion, how it was found, and what is left wrong with it.

    Attributes
    ----------
    motion : KeyedMotion
    stiffness : Stiffness
    mended : bool
        Whether the motion was mended frame by frame.
    crossing : (C,) float64
        Times among those checked at which outlines cross; empty if all is well.
    """

    motion: KeyedMotion
    stiffness: Stiffness
    mended: bool
    crossing: Floats


def settle(
    mesh: PlaneMesh,
    check: FramesCheck | None = None,
    target: InsideTarget | None = None,
    ladder: tuple[Stiffness, ...] = LADDER,
    *,
    denser: bool = True,
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
    denser : bool
        Whether more nodes can be had. Where the polygons of the nodes are simple and yet `check`
        finds crossings, these help more than any further setting, and none is tried.

    Returns
    -------
    SettledMotion
        The first without a crossing, else the one with the fewest.
    """
    solved, checked = np.linspace(0, 1, SOLVED_TIMES), np.linspace(0, 1, CHECKED_TIMES)
    polygons = _polygons(mesh)
    look = check or polygons
    tried: list[SettledMotion] = []
    for stiffness in ladder:
        plain = KeyedMotion.of(mesh, PlaneMotion.prepare(mesh, stiffness, target).posed(solved))
        for mend in (False, True):
            motion = mended(plain, MENDED_TIMES) if mend else plain
            nodes = motion.nodes(checked)
            crossing = checked[~look(checked, nodes)]
            tried.append(SettledMotion(motion, stiffness, mend, crossing))
            if not len(crossing):
                return tried[-1]
        if denser and check and polygons(checked, nodes).all():
            break
    return min(tried, key=lambda settled: len(settled.crossing))


def _polygons(mesh: PlaneMesh) -> FramesCheck:
    """Look at the polygons of the nodes."""
    order = np.concatenate(mesh.rings)
    sizes = tuple(len(ring) for ring in mesh.rings)
    return lambda _, nodes: simple_frames(nodes[:, order], sizes)
