"""A schedule of stiffness: stiffer motions are tried until the drawn outlines stay simple.

One setting holds for the whole motion.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.deform.check import simple_frames
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.mesh import AmbientMesh
from shapetween.deform.motion import AmbientMotion, InsideTarget, Stiffness
from shapetween.deform.repair import repair_inversions

__all__ = ["STIFFNESS_SCHEDULE", "FramesCheck", "SolvedMotion", "solve"]

FramesCheck: TypeAlias = Callable[[Floats, Points], Mask]
"""Which frames are simple: times (F,) and the outlines' nodes (F, N, 2) to (F,)."""

#: Settings in the order tried. The first keeps limbs long; each later one keeps parts further
#: apart and lets limbs shorten.
STIFFNESS_SCHEDULE = (Stiffness(0.5, 9.5), Stiffness(1.0, 1.0), Stiffness(3.0, 0.0))

#: Even times at which a motion is solved, and at which it is repaired where outlines cross. Fewer
#: lose quick movements; more cost time and change nothing that is seen.
SOLVED_TIMES, REPAIRED_TIMES = 21, 81

#: Number of times at which a motion is checked. Fewer miss short contacts.
CHECKED_TIMES = 161


@dataclass(frozen=True, slots=True, eq=False)
class SolvedMotion:
    """A motion, how it was found, and what is left wrong with it.

    Attributes
    ----------
    motion : KeyedMotion
    stiffness : Stiffness
    repaired : bool
        Whether the motion was repaired frame by frame.
    crossing : (C,) float64
        Times among those checked at which outlines cross; empty if all is well.
    """

    motion: KeyedMotion
    stiffness: Stiffness
    repaired: bool
    crossing: Floats


def solve(
    mesh: AmbientMesh,
    check: FramesCheck | None = None,
    target: InsideTarget | None = None,
    schedule: tuple[Stiffness, ...] = STIFFNESS_SCHEDULE,
    *,
    denser: bool = True,
) -> SolvedMotion:
    """Find a motion of a mesh without crossings.

    Parameters
    ----------
    mesh : AmbientMesh
    check : FramesCheck, optional
        Checks the outlines as they are drawn; by default the polygons of their nodes.
    target : InsideTarget, optional
        What the inside triangles should do.
    schedule : tuple of Stiffness
        Settings to try, at least one.
    denser : bool
        Whether more nodes can be had. Where the polygons of the nodes are simple and yet `check`
        finds crossings, these help more than any further setting, and none is tried.

    Returns
    -------
    SolvedMotion
        The first without a crossing, else the one with the fewest.
    """
    solved, checked = np.linspace(0, 1, SOLVED_TIMES), np.linspace(0, 1, CHECKED_TIMES)
    polygons = _polygons(mesh)
    passes = check or polygons
    tried: list[SolvedMotion] = []
    for stiffness in schedule:
        plain = KeyedMotion.of(mesh, AmbientMotion.prepare(mesh, stiffness, target).posed(solved))
        for repaired in (False, True):
            motion = repair_inversions(plain, REPAIRED_TIMES) if repaired else plain
            nodes = motion.nodes(checked)
            crossing = checked[~passes(checked, nodes)]
            tried.append(SolvedMotion(motion, stiffness, repaired, crossing))
            if not len(crossing):
                return tried[-1]
        if denser and check and polygons(checked, nodes).all():
            break
    return min(tried, key=lambda solved: len(solved.crossing))


def _polygons(mesh: AmbientMesh) -> FramesCheck:
    """Check the polygons of the nodes."""
    order = np.concatenate(mesh.rings)
    sizes = tuple(len(ring) for ring in mesh.rings)
    return lambda _, nodes: simple_frames(nodes[:, order], sizes)
