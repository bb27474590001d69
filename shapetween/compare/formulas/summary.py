"""All measures of one method on one mesh pair."""

from dataclasses import asdict, dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.compare.formulas import distortion, paths
from shapetween.geometry.polygon import corner_sines, polygon_area, rms_radius
from shapetween.interpolate import INTERIORS, tween
from shapetween.interpolate.faces import mesh_edges
from shapetween.interpolate.inside import Inside
from shapetween.interpolate.projective import AlignedFaces
from shapetween.mesh.pair import MeshPair

__all__ = ["Measured", "MeshFigures", "boundary_edges", "measure_mesh"]

#: Even times at which a movement is looked at, and places along a quad's side.
FRAMES, SAMPLES = 41, 4


@dataclass(frozen=True, slots=True)
class MeshFigures:
    """Measures of a movement, one number each; smaller is better but for the least ones.

    Attributes
    ----------
    conformal : float
        Mean of K = s1 / s2 over time and, by source area, over the shape.
    conformal_excess : float
        Largest share by which K leaves the bound that the end sets.
    isometric : float
        Mean of max(s1, 1 / s2).
    symmetric_dirichlet : float
        Mean over time of the mean of (s1^2 + s2^2 + s1^-2 + s2^-2) / 4.
    rigidity : float
        Mean over time of the energy ((s1 - 1)^2 + (s2 - 1)^2) against the nearer key, over area.
    area, perimeter : float
        Largest distance from the straight path, as a share.
    area_detour, perimeter_detour : float
        Total variation beyond what the ends need, as a share.
    edge_overshoot : float
        Worst share by which an edge leaves the range of its two lengths.
    folded : int
        Frames, of `FRAMES`, in which a face is not convex or is inverted.
    least_sine : float
        Least sine of a face's corner at any time, negative in folded frames.
    least_w : float
        Least ratio of a homography's w over its quad; 1 if all is affine.
    roughness : float
        Mean second derivative in time, in diameters.
    travel : float
        Mean length of the vertices' paths, in diameters.
    reversibility : float
        Distance of the way back, as a share of the radius.
    residual : float or None
        How much the faces disagreed before alignment, at the worst time, as a share of the
        radius; None for methods without one.
    """

    conformal: float
    conformal_excess: float
    isometric: float
    symmetric_dirichlet: float
    rigidity: float
    area: float
    area_detour: float
    perimeter: float
    perimeter_detour: float
    edge_overshoot: float
    folded: int
    least_sine: float
    least_w: float
    roughness: float
    travel: float
    reversibility: float
    residual: float | None

    def as_dict(self) -> dict[str, float | int | None]:
        """The figures by name, as JSON takes them: None for what is infinite."""
        each = asdict(self)
        return {name: x if x is None or np.isfinite(x) else None for name, x in each.items()}


@dataclass(frozen=True, slots=True, eq=False)
class Measured:
    """A movement's figures, and what they are at every time.

    Attributes
    ----------
    figures : MeshFigures
    times : (F,) float64
    conformal, isometric, symmetric_dirichlet, rigidity : (F,) float64
    areas, perimeters : (F,) float64
        Of the mesh, in user units.
    folded : (F,) bool
    """

    figures: MeshFigures
    times: Floats
    conformal: Floats
    isometric: Floats
    symmetric_dirichlet: Floats
    rigidity: Floats
    areas: Floats
    perimeters: Floats
    folded: Mask


def boundary_edges(pair: MeshPair) -> Index:
    """Edges that belong to one face only, (E, 2)."""
    edges, count = mesh_edges([pair.quads, pair.triangles])
    return np.asarray(edges[count == 1])


def measure_mesh(pair: MeshPair, method: str, frames: int = FRAMES) -> Measured:
    """Move a mesh pair by a method and measure how.

    Parameters
    ----------
    pair : MeshPair
    method : str
        One of `shapetween.interpolate.METHODS`.
    frames : int
        Even times, 3 at least.

    Raises
    ------
    OptionError
        If there is no such method.
    MeshError
        If a face has no in-between by it.
    """
    movement = tween(pair, method)
    t = np.linspace(0, 1, frames)
    points = movement.vertices(t)
    inside = Inside.of(pair, INTERIORS[method])
    jacobians, around = inside.jacobians(points, SAMPLES)
    share = around / around.sum()
    conformal = distortion.conformal_distortion(jacobians) @ share
    isometric = distortion.isometric_distortion(jacobians) @ share
    dirichlet = distortion.symmetric_dirichlet(jacobians, around)
    rigidity = _rigidity(jacobians, around)
    faces = [f for f in (pair.quads, pair.triangles) if len(f)]
    turning = np.sign(polygon_area(pair.source[faces[0][0]]))
    least = np.min([(turning * corner_sines(points[:, f])).min(axis=(1, 2)) for f in faces], axis=0)
    areas = turning * sum(polygon_area(points[:, f]).sum(axis=1) for f in faces)
    perimeters = _lengths(points, boundary_edges(pair)).sum(axis=1)
    lengths = _lengths(points, mesh_edges(faces)[0])
    ends = np.stack([pair.source, pair.target])
    radius = float(rms_radius(ends).mean())
    diameter = float(np.linalg.norm(np.ptp(ends, axis=1), axis=1).max())
    back = tween(pair.reversed(), method).vertices(1 - t)
    figures = MeshFigures(
        conformal=float(conformal.mean()),
        conformal_excess=float(distortion.excess_conformal(jacobians, jacobians[-1]).max()),
        isometric=float(isometric.mean()),
        symmetric_dirichlet=float(dirichlet.mean()),
        rigidity=float(rigidity.mean()),
        area=paths.straightness(areas, t),
        area_detour=paths.detour(areas),
        perimeter=paths.straightness(perimeters, t),
        perimeter_detour=paths.detour(perimeters),
        edge_overshoot=paths.overshoot(lengths),
        folded=int((least <= 0).sum()),
        least_sine=float(least.min()),
        least_w=float(inside.least_weights(points).min()),
        roughness=paths.roughness(points, t, diameter),
        travel=paths.travel(points, diameter),
        reversibility=paths.reversibility(points, back, radius),
        residual=(
            float(movement.residual(t).max()) / radius
            if isinstance(movement, AlignedFaces)
            else None
        ),
    )
    return Measured(
        figures, t, conformal, isometric, dirichlet, rigidity, areas, perimeters, least <= 0
    )


def _rigidity(jacobians: Floats, areas: Floats) -> Floats:
    """Energy over area against the nearer of the two keys, (F,): poses are not punished.

    Seen from the target, the Jacobian is J_t J_1^-1 and the area around a place |det J_1| times
    that in the source.
    """
    from_source = distortion.arap_energy(jacobians, areas) / areas.sum()
    last = jacobians[-1]
    areas_there = areas * np.abs(np.linalg.det(last))
    seen = jacobians @ np.linalg.inv(last)
    from_target = distortion.arap_energy(seen, areas_there) / areas_there.sum()
    return np.asarray(np.minimum(from_source, from_target))


def _lengths(points: Points, edges: Index) -> Floats:
    """Lengths of edges (E, 2) between moving points (F, V, 2), (F, E)."""
    return np.asarray(np.linalg.norm(points[:, edges[:, 1]] - points[:, edges[:, 0]], axis=-1))
