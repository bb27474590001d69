"""Regions without counterpart: they open from a point, or close to one, and move along."""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.base.ends import End
from shapetween.deform.locate import BoundPoints, MeshBinder
from shapetween.geometry.bezier import flatten
from shapetween.model.outline import Outline
from shapetween.outline.body import Carried

__all__ = ["AppearingRegion", "Ground"]

#: Chords of a curve where a polygon will do.
CHORDS = 8

#: Steps of the grid, in a ring's size, on which its middle is looked for. A coarser one moves it, a
#: finer one lets through what rounding leaves.
GRID = 2.0**30

#: Distance of the centroid from the border, as a share of the greatest one that a point inside has,
#: from which a ring closes to it. With less, a crescent closes to a place on its edge; with all of
#: it, only a ring without any dent closes to its centroid.
CLEAR = 0.6


@dataclass(frozen=True, slots=True, eq=False)
class Ground:
    """A body whose ambient mesh other regions can be bound to.

    Attributes
    ----------
    body : OutlineMotion
    binder : MeshBinder
        Made once for all that are bound.
    """

    body: Carried
    binder: MeshBinder

    @classmethod
    def of(cls, body: Carried) -> "Ground | None":
        """The mesh around a body; None if it moves without one."""
        mesh = body.path.mesh
        return None if mesh is None else cls(body, MeshBinder(mesh))


@dataclass(frozen=True, slots=True, eq=False)
class AppearingRegion:
    """Rings that are whole at one end of the movement and a point at the other.

    Attributes
    ----------
    whole : (P, 4, 2) float64
        All their curves where they are whole.
    counts : tuple of int
        Number of curves in each ring.
    end : End
        Where they are whole.
    centre : (2,) float64
        The point.
    on : Carried or None
        The body whose mesh they are bound to; None to stay in place.
    bound : BoundPoints or None
        Where their control points and the centre lie in that mesh.
    """

    whole: Curves
    counts: tuple[int, ...]
    end: End
    centre: Points
    on: Carried | None = None
    bound: BoundPoints | None = None

    @classmethod
    def of(
        cls,
        outer: Outline,
        holes: tuple[Outline, ...],
        end: End,
        on: Ground | None,
        *,
        is_hole: bool = False,
    ) -> "AppearingRegion":
        """Prepare rings.

        Parameters
        ----------
        outer : Outline
            Clockwise as drawn, as are the holes.
        holes : tuple of Outline
        end : End
            Where they are whole.
        on : Ground or None
            What they are bound to, if they lie on it.
        is_hole : bool
            Whether the ring is itself a hole, and is drawn the other way round.
        """
        first = outer.reversed() if is_hole else outer
        rings = [first, *(hole.reversed() for hole in holes)]
        curves = np.concatenate([ring.curves for ring in rings])
        centre = _middle(outer)
        still = cls(curves, tuple(len(r.curves) for r in rings), end, centre)
        if on is None:
            return still
        bound = on.binder.bind(np.concatenate([curves.reshape(-1, 2), [centre]]), end)
        return still if bound.beyond.any() else replace(still, on=on.body, bound=bound)

    def curves(self, t: Floats, vertices: Points | None = None) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2).

        Parameters
        ----------
        t : (F,) float64
        vertices : (F, V, 2) float64, optional
            Where the vertices of that mesh are at these times, if that is known already.
        """
        points = np.concatenate([self.whole.reshape(-1, 2), self.centre[None]])
        if self.on is None or self.bound is None:
            moved = np.repeat(points[None], len(t), axis=0)
        else:
            moved = self.bound.at(self.on.path.vertices(t) if vertices is None else vertices)
        centre = moved[:, -1:]
        size = t if self.end is End.TARGET else 1 - t
        shrunk = centre + size[:, None, None] * (moved[:, :-1] - centre)
        result = shrunk.reshape(len(t), *self.whole.shape)
        result[size == 1] = self.whole
        return np.asarray(result)


def _middle(outer: Outline) -> Points:
    """The point that a ring closes to: its centroid where that lies well inside, (2,).

    Else the middle of the largest circle in it. A slot has many such circles: of those, rounding
    would choose.
    """
    import shapely

    low, high = outer.box
    middle, extent = (low + high) / 2, float((high - low).max())
    if not extent > 0:
        return np.asarray(middle)
    points = np.round((flatten(outer.curves, CHORDS) - middle) / extent * GRID) / GRID
    polygon = shapely.make_valid(shapely.Polygon(points), method="structure", keep_collapsed=False)
    if polygon.is_empty:  # so thin that nothing of it is left
        return np.asarray(middle)
    circle = shapely.maximum_inscribed_circle(polygon, tolerance=1e-2)
    best, centroid = circle.length, polygon.centroid
    clear = shapely.distance(polygon.boundary, centroid) >= CLEAR * best
    chosen = centroid if clear and polygon.contains(centroid) else shapely.get_point(circle, 0)
    return np.asarray(middle + extent * shapely.get_coordinates(chosen)[0])
