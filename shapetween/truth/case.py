"""What a generated scene knows: two drawings, and what really happened between them."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.mesh.pair import MeshPair

__all__ = ["GRID", "TIMES", "Case", "texture_places"]

#: Times at which the truth is known.
TIMES = np.array([0.25, 0.5, 0.75])

#: Points of the texture along each side of a quad, corners not among them.
GRID = 5


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """One scene.

    Attributes
    ----------
    family : str
        What kind of scene it is.
    pair : MeshPair
        Its two drawings.
    vertices : (F, V, 2) float64
        Where the mesh's vertices truly are at `TIMES`.
    texture : (F, Q, K, 2) float64 or None
        Where the points of a texture on every quad truly are, where the scene has one.
    places : (Q, K, 2) float64 or None
        Where those points are in the source drawing.
    free : bool
        Whether the whole may be moved rigidly in every frame before it is compared: what stands
        still in a figure is a matter of taste, before a camera it is not.
    """

    family: str
    pair: MeshPair
    vertices: Points
    texture: Points | None = None
    places: Points | None = None
    free: bool = False


def texture_places() -> Floats:
    """Even places in the unit square, (K, 2)."""
    step = (np.arange(GRID) + 0.5) / GRID
    return np.stack(np.meshgrid(step, step), axis=-1).reshape(-1, 2)
