"""Measures of a movement, with exact definitions: distortion, paths, validity, possible views."""

from shapetween.compare.formulas.distortion import (
    arap_energy,
    conformal_distortion,
    excess_conformal,
    isometric_distortion,
    signed_stretches,
    symmetric_dirichlet,
)
from shapetween.compare.formulas.epipolar import (
    epipolar_distance,
    fundamental_matrix,
    transfer_error,
)
from shapetween.compare.formulas.paths import (
    detour,
    overshoot,
    reversibility,
    roughness,
    straightness,
    travel,
)
from shapetween.compare.formulas.summary import Measured, MeshFigures, boundary_edges, measure_mesh

__all__ = [
    "Measured",
    "MeshFigures",
    "arap_energy",
    "boundary_edges",
    "conformal_distortion",
    "detour",
    "epipolar_distance",
    "excess_conformal",
    "fundamental_matrix",
    "isometric_distortion",
    "measure_mesh",
    "overshoot",
    "reversibility",
    "roughness",
    "signed_stretches",
    "straightness",
    "symmetric_dirichlet",
    "transfer_error",
    "travel",
]
