"""Rings without a partner: they open from a point, or close to one, riding on the plane."""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.attach.planes import Finders, Spots
from shapetween.base.arrays import Curves, Floats, Points
from shapetween.deform.mesh import AmbientMesh
from shapetween.geometry.bezier import flatten
from shapetween.model.outline import Outline
from shapetween.outline.body import Carried

__all__ = ["Deck", "Passenger"]

#: Chords of a curve where a polygon will do.
CHORDS = 8


@dataclass(frozen=True, slots=True, eq=False)
class Deck:
    """A body whose moving plane can be ridden on.

    Attributes
    ----------
    body : Carried
    finders : Finders
        Made once for all that ride on it.
    """

    body: Carried
    finders: Finders

    @classmethod
    def of(cls, body: Carried) -> "Deck | None":
        """The plane around a body; None if it moves without one."""
        mesh = getattr(body.path, "mesh", None)
        return cls(body, Finders(mesh)) if isinstance(mesh, AmbientMesh) else None


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
    centre : (2,) float64
        The point.
    on : Carried or None
        The body whose moving plane they ride on; None to stay in place.
    spots : Spots or None
        Where their control points and the centre lie in that plane.
    """

    curves_at_home: Curves
    counts: tuple[int, ...]
    arrives: bool
    centre: Points
    on: Carried | None = None
    spots: Spots | None = None

    @classmethod
    def of(
        cls,
        outer: Outline,
        holes: tuple[Outline, ...],
        arrives: bool,
        on: Deck | None,
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
        on : Deck or None
            What they ride on, if they lie on it.
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
        still = cls(curves, tuple(len(r.curves) for r in rings), arrives, centre)
        if on is None:
            return still
        spots = on.finders.spots(np.concatenate([curves.reshape(-1, 2), [centre]]), arrives)
        return still if spots.beyond.any() else replace(still, on=on.body, spots=spots)

    def curves(self, t: Floats, vertices: Points | None = None) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2).

        Parameters
        ----------
        t : (F,) float64
        vertices : (F, V, 2) float64, optional
            Where the plane that it rides on is at these times, if that is known already.
        """
        points = np.concatenate([self.curves_at_home.reshape(-1, 2), self.centre[None]])
        if self.on is None or self.spots is None:
            moved = np.repeat(points[None], len(t), axis=0)
        else:
            moved = self.spots.at(self.on.path.vertices(t) if vertices is None else vertices)
        centre = moved[:, -1:]
        size = t if self.arrives else 1 - t
        shrunk = centre + size[:, None, None] * (moved[:, :-1] - centre)
        result = shrunk.reshape(len(t), *self.curves_at_home.shape)
        result[size == 1] = self.curves_at_home
        return np.asarray(result)
