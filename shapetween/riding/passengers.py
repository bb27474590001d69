"""Rings without a partner: they open from a point, or close to one, riding on the plane."""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Curves, Floats, Index, Points
from shapetween.geometry.bezier import flatten
from shapetween.outline import Outline
from shapetween.plane.mesh import PlaneMesh
from shapetween.riding.planes import BEYOND, Finder
from shapetween.rings.body import Carried

__all__ = ["Passenger"]

#: Chords of a curve where a polygon will do.
CHORDS = 8


@dataclass(frozen=True, slots=True, eq=False)
class Passenger:
    """Rings that are whole at one end of the movement and a point at the other.

    Attributes
    ----------
    curves_at_home : (P, 4, 2) float64
        All their curves where they are whole.
    counts : tuple of int
        Number of curves in each ring.
    arrives : bool
        Whether they are whole at the end; else at the start.
    ride : _Ride or None
        The moving plane that they ride on; None to stay in place.
    """

    curves_at_home: Curves
    counts: tuple[int, ...]
    arrives: bool
    centre: Points
    ride: "_Ride | None"

    @classmethod
    def of(
        cls,
        outer: Outline,
        holes: tuple[Outline, ...],
        arrives: bool,
        on: Carried | None,
        *,
        is_hole: bool = False,
    ) -> "Passenger":
        """Take rings aboard.

        Parameters
        ----------
        outer : Outline
            Clockwise as drawn, as are the holes.
        holes : tuple of Outline
        arrives : bool
        on : Carried or None
            The body whose plane they ride on.
        is_hole : bool
            Whether the ring is itself a hole, and is drawn the other way round.
        """
        import shapely

        first = outer.reversed() if is_hole else outer
        rings = [first, *(hole.reversed() for hole in holes)]
        curves = np.concatenate([ring.curves for ring in rings])
        polygon = shapely.make_valid(
            shapely.Polygon(flatten(outer.curves, CHORDS)), method="structure", keep_collapsed=False
        )
        extent = float(np.ptp(outer.box, axis=0).max())
        # A ring so thin that nothing of it is left closes to the middle of its box.
        centre = np.asarray(outer.box.mean(axis=0))
        if not polygon.is_empty:
            circle = shapely.maximum_inscribed_circle(polygon, tolerance=1e-2 * extent)
            centre = np.array(circle.coords[0])
        mesh = getattr(on.path, "mesh", None) if on is not None else None
        ride = None
        if on is not None and isinstance(mesh, PlaneMesh):
            ride = _Ride.of(on, mesh, np.concatenate([curves.reshape(-1, 2), [centre]]), arrives)
        return cls(curves, tuple(len(r.curves) for r in rings), arrives, centre, ride)

    @property
    def on(self) -> Carried | None:
        """The body it rides on."""
        return None if self.ride is None else self.ride.on

    def curves(self, t: Floats, vertices: Points | None = None) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2).

        Parameters
        ----------
        t : (F,) float64
        vertices : (F, V, 2) float64, optional
            Where the plane that it rides on is at these times, if that is known already.
        """
        points = np.concatenate([self.curves_at_home.reshape(-1, 2), self.centre[None]])
        if self.ride is None:
            moved = np.repeat(points[None], len(t), axis=0)
        else:
            moved = self.ride.at(self.ride.on.path.vertices(t) if vertices is None else vertices)
        centre = moved[:, -1:]
        size = t if self.arrives else 1 - t
        shrunk = centre + size[:, None, None] * (moved[:, :-1] - centre)
        result = shrunk.reshape(len(t), *self.curves_at_home.shape)
        result[size == 1] = self.curves_at_home
        return np.asarray(result)


@dataclass(frozen=True, slots=True, eq=False)
class _Ride:
    """Points held by the triangles of a moving plane."""

    on: Carried
    corners: Index
    weights: Floats

    @classmethod
    def of(cls, on: Carried, mesh: PlaneMesh, points: Points, arrives: bool) -> "_Ride | None":
        """Find each point's triangle; None if one lies outside the plane mesh."""
        corners, weights = Finder(mesh, arrives).find(points)
        return None if weights.min() < -BEYOND else cls(on, corners, weights)

    def at(self, vertices: Points) -> Points:
        return np.asarray(np.einsum("pk,fpkd->fpd", self.weights, vertices[:, self.corners]))
