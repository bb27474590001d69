"""Measures of a movement, with exact definitions: distortion, paths, validity, possible views."""

from shapetween.compare.measures.distortion import (
    arap_energy,
    conformal_distortion,
    excess_conformal,
    isometric_distortion,
    signed_stretches,
    symmetric_dirichlet,
)
from shapetween.compare.measures.epipolar import (
    epipolar_distance,
    fundamental_matrix,
    transfer_error,
)
from shapetween.compare.measures.paths import (
    detour,
    overshoot,
    reversibility,
    roughness,
    straightness,
    travel,
)
from shapetween.compare.measures.summary import Figures, Measured, boundary_edges, measure

__all__ = [
    "Figures",
    "Measured",
    "arap_energy",
    "boundary_edges",
    "conformal_distortion",
    "detour",
    "epipolar_distance",
    "excess_conformal",
    "fundamental_matrix",
    "isometric_distortion",
    "measure",
    "overshoot",
    "reversibility",
    "roughness",
    "signed_stretches",
    "straightness",
    "symmetric_dirichlet",
    "transfer_error",
    "travel",
]
