"""The movement of a drawing as one: its silhouette moves, and the plane around it along with it.

A silhouette is matched and moved as any filled shape is; what is drawn rides on its plane. So
outlines, areas and details keep together wherever they lie in the file.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.attach.planes import AffinePlane, MeshPlane, Plane
from shapetween.base.arrays import Affine, Points
from shapetween.base.errors import MeshError, OutlineError
from shapetween.elastic.fill import FillSettings
from shapetween.elastic.pairing import LEFT, Thing, pair_things
from shapetween.elastic.regions import Region
from shapetween.elastic.silhouette import Areas, silhouette
from shapetween.geometry.bezier import flatten
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.matching import match_outer
from shapetween.outline.unfold import TOLERANCES, unfolded

__all__ = ["Flow", "Lane", "drawing_flow", "resting_flow"]

#: Residual of an affine map between two drawings of the same structure, as a share of their
#: extent, up to which they are affine images of each other.
AFFINE = 1e-6

#: Share of its box that an outline covers to count as that box.
BOX = 0.95

#: Distance from a silhouette, as a share of its extent, past which the plane is nobody's: what lies
#: there is taken to be where it is drawn.
BESIDE = 0.02

#: Chords of a silhouette's curve, which are straight or short, when it is looked at.
CHORDS = 2


@dataclass(frozen=True, slots=True, eq=False)
class Lane:
    """A plane, and what of both drawings it carries.

    Attributes
    ----------
    plane : Plane
    outlines : (Points, Points)
        Polygons at both ends, (N, 2) and (M, 2).
    """

    plane: Plane
    outlines: tuple[Points, Points]

    @property
    def extents(self) -> tuple[float, float]:
        """Diagonals of the boxes at both ends."""
        first, second = (float(np.linalg.norm(np.ptp(p, axis=0))) for p in self.outlines)
        return first, second

    @property
    def drift(self) -> Plane:
        """A plane that only shifts as the middle of what this one carries does.

        What lies beside that would be flung about by the plane, which is nobody's there.
        """
        start, end = ((p.min(axis=0) + p.max(axis=0)) / 2 for p in self.outlines)
        return AffinePlane(np.column_stack([np.eye(2), end - start]), start)

    def distance(self, point: Points, end: int) -> float:
        """How far a point lies from what the plane carries at one end; 0 inside."""
        import shapely

        return float(shapely.Polygon(self.outlines[end]).distance(shapely.Point(point)))


@dataclass(frozen=True, slots=True, eq=False)
class Flow:
    """How a drawing moves as one.

    Attributes
    ----------
    lanes : tuple of Lane
        At least one.
    bodies : tuple of Carried
        The silhouettes behind them, if there are any.
    exact : bool
        Whether the drawings are affine images of each other.
    """

    lanes: tuple[Lane, ...]
    bodies: tuple[Carried, ...] = ()
    exact: bool = False

    def carries(self, point: Points, end: int = 0) -> bool:
        """Whether a place (2,) at the start, or at the end, is on what moves as one, not beside."""
        if not self.bodies:
            return True
        near = BESIDE * max(lane.extents[end] for lane in self.lanes)
        return any(lane.distance(point, end) <= near for lane in self.lanes)

    def lane(self, source: Points | None, target: Points | None) -> Lane:
        """The lane of what has its middle there at the start, at the end, or both, each (2,)."""
        if len(self.lanes) == 1:
            return self.lanes[0]
        ends = [(end, p) for end, p in enumerate((source, target)) if p is not None]
        return min(self.lanes, key=lambda lane: sum(lane.distance(p, end) for end, p in ends))


def resting_flow(first: Sequence[Shape], second: Sequence[Shape]) -> Flow:
    """No movement as one: every shape goes its own way."""
    plane = AffinePlane(np.eye(2, 3), np.zeros(2))
    return Flow((Lane(plane, (_points(first), _points(second))),))


def drawing_flow(
    first: Sequence[Shape],
    second: Sequence[Shape],
    areas: tuple[Areas, Areas],
    boxes: tuple[Points, Points],
    settings: FillSettings,
) -> Flow:
    """The movement of one drawing to another, each as one.

    Parameters
    ----------
    first, second : sequence of Shape
        In one frame.
    areas : ((N,), (M,)) of shapely.Geometry
        What each of them covers.
    boxes : ((2, 2) float64, (2, 2) float64)
        What is shown of each, as least and greatest corners.
    settings : FillSettings
    """
    ends = _points(first), _points(second)
    matrix = _affine(first, second)
    if matrix is not None:
        return Flow((Lane(AffinePlane(matrix, ends[0].mean(axis=0)), ends),), exact=True)
    with settings.observe("silhouette"):
        outlines = tuple(map(silhouette, (first, second), areas, boxes))
    if all(len(side) == 1 and _is_box(side[0]) for side in outlines):
        ends = outlines[0][0].curves.reshape(-1, 2), outlines[1][0].curves.reshape(-1, 2)
        return Flow((Lane(AffinePlane(_boxes(*ends, even=False), ends[0].mean(axis=0)), ends),))
    bodies = _matched(outlines[0], outlines[1], settings) if all(outlines) else []
    carried = _carried(bodies, settings)
    if not carried:
        return Flow((Lane(AffinePlane(_boxes(*ends), ends[0].mean(axis=0)), ends),))
    lanes = []
    for body in carried:
        mesh = getattr(body.path, "mesh", None)
        if mesh is None:
            continue
        sides = [
            np.concatenate([flatten(getattr(r, side).curves, CHORDS) for r in body.nodes.rings])
            for side in ("source", "target")
        ]
        lanes.append(Lane(MeshPlane(mesh, body.path), (sides[0], sides[1])))
    if not lanes:
        return Flow((Lane(AffinePlane(_boxes(*ends), ends[0].mean(axis=0)), ends),))
    return Flow(tuple(lanes), tuple(carried))


def _points(shapes: Sequence[Shape]) -> Points:
    return np.concatenate([ring.curves.reshape(-1, 2) for s in shapes for ring in s.rings])


def _affine(first: Sequence[Shape], second: Sequence[Shape]) -> Affine | None:
    """The affine map that takes one drawing onto the other, curve by curve, if there is one."""
    rings = [[ring for shape in side for ring in shape.rings] for side in (first, second)]
    shapes = [[len(shape.rings) for shape in side] for side in (first, second)]
    counts = [[(len(ring.curves), ring.closed) for ring in side] for side in rings]
    if shapes[0] != shapes[1] or counts[0] != counts[1]:
        return None
    p, q = _points(first), _points(second)
    centre = p.mean(axis=0)
    local = np.column_stack([p - centre, np.ones(len(p))])
    solution, _, rank, _ = np.linalg.lstsq(local, q, rcond=None)
    if rank < 3 or np.linalg.det(solution[:2]) <= 0:
        return None
    if np.abs(local @ solution - q).max() > AFFINE * float(np.ptp(q, axis=0).max()):
        return None
    linear = solution[:2].T
    return np.column_stack([linear, solution[2] - linear @ centre])


def _is_box(outline: Outline) -> bool:
    """Whether an outline is about a box that stands upright: a page, a flag."""
    width, height = np.ptp(outline.box, axis=0).tolist()
    return bool(outline.area >= BOX * width * height)


def _boxes(first: Points, second: Points, *, even: bool = True) -> Affine:
    """The scaling that takes one set of points' box to the other's."""
    boxes = [(p.min(axis=0), p.max(axis=0)) for p in (first, second)]
    sizes = [float(np.linalg.norm(high - low)) for low, high in boxes]
    scale = sizes[1] / sizes[0] if min(sizes) > 0 else 1.0
    middles = [(low + high) / 2 for low, high in boxes]
    spans = [high - low for low, high in boxes]
    scales = np.full(2, scale) if even else spans[1] / spans[0]
    return np.column_stack([np.diag(scales), middles[1] - scales * middles[0]])


def _matched(
    first: tuple[Outline, ...], second: tuple[Outline, ...], settings: FillSettings
) -> list[RingMatch]:
    """Pieces of two silhouettes matched and meshed."""
    points = np.concatenate([o.box for o in (*first, *second)])
    scale = float(np.linalg.norm(np.ptp(points, axis=0)))
    things = [[_thing(outline) for outline in side] for side in (first, second)]
    pairing = pair_things(things[0], things[1], scale, left=LEFT)
    return [
        match_outer(
            first[i],
            second[j],
            quads=settings.quads,
            pins=settings.pins_for(Region(first[i]), Region(second[j])),
            mesh=settings.mesh_for(""),
            upright=len(pairing.pairs) > 1,
            observe=settings.observe,
        )
        for i, j in pairing.pairs
    ]


def _thing(outline: Outline) -> Thing:
    return Thing(np.asarray(outline.box.mean(axis=0)), float(np.sqrt(abs(outline.area))))


def _carried(rings: list[RingMatch], settings: FillSettings) -> list[Carried]:
    """All pieces in one plane, or each in its own where that crosses."""
    if not rings:
        return []
    try:
        with settings.observe("move"):
            together = unfolded(rings, settings.method, TOLERANCES[:1])
            if not together.crossing or len(rings) == 1:
                return [together]
            alone = [unfolded([ring], settings.method, TOLERANCES[:1]) for ring in rings]
    except (MeshError, OutlineError):
        return []
    return alone if sum(c.crossing for c in alone) < together.crossing else [together]
