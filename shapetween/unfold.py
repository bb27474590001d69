"""Moving an outline's nodes so that nothing folds: the whole plane moves along, and is checked.

The quads lead the inside of a mesh of the whole plane, whose outside keeps parts from passing
through each other. The drawn curves are looked at all along the movement; where they cross, the
outside is made stiffer, then the nodes denser, one setting for the whole movement.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from shapetween.arrays import Floats, Index, Points
from shapetween.carry import Carrier
from shapetween.errors import MeshError, OutlineError
from shapetween.geometry.bezier import flatten
from shapetween.geometry.polygon import polygon_area
from shapetween.guide import QuadGuide
from shapetween.interpolate import Tween, tween
from shapetween.matched import MatchedOutlines, Samples
from shapetween.mesh import MeshPair
from shapetween.nodes import outline_nodes
from shapetween.plane.check import simple_frames
from shapetween.plane.mesh import PlaneMesh, plane_mesh
from shapetween.plane.motion import PlaneMotion, Stiffness

__all__ = ["Carried", "NodePath", "bare", "unfolded"]

#: Even times at which the drawn curves are looked at, and chords a curve is looked at with.
CHECKED, CHORDS = 81, 8

#: Greatest distance of the outline from its nodes' polygon, as a share of the root of the area:
#: the first is enough for most pairs, finer ones cost time and are for details that cross.
TOLERANCES = (0.03, 0.012, 0.005)

#: Greatest distance of neighbouring nodes in the same unit.
SPAN = 0.6

#: How the plane resists, in the order tried.
STIFFNESSES = (
    Stiffness(0.3, 4.0),
    Stiffness(0.3, 1.0),
    Stiffness(0.3, 0.0),
    Stiffness(1.0, 0.0),
    Stiffness(3.0, 0.0),
)


class NodePath(Protocol):
    """Where the nodes of an outline are at any time."""

    def nodes(self, t: Floats) -> Points:
        """Nodes at the times (F,), (F, n, 2)."""


@dataclass(frozen=True, slots=True, eq=False)
class MeshNodes:
    """The first vertices of a moving mesh."""

    tween: Tween
    count: int

    def nodes(self, t: Floats) -> Points:
        """Nodes at the times (F,), (F, n, 2)."""
        return self.tween.vertices(t)[:, : self.count]


@dataclass(frozen=True, slots=True, eq=False)
class PlaneNodes:
    """The nodes of a moving plane mesh."""

    motion: PlaneMotion

    def nodes(self, t: Floats) -> Points:
        """Nodes at the times (F,), (F, n, 2)."""
        return self.motion.vertices(t)[:, : self.motion.mesh.nodes]


@dataclass(frozen=True, slots=True, eq=False)
class Carried:
    """An outline's curves on moving nodes, and what was seen of them.

    Attributes
    ----------
    path : NodePath
    carrier : Carrier
    crossing : int
        At how many of `checked` even times the drawn curves cross.
    checked : int
    setting : str
        What moves the nodes.
    led : float
        Share of the inside that follows a quad.
    """

    path: NodePath
    carrier: Carrier
    crossing: int
    checked: int
    setting: str
    led: float

    def curves(self, t: Floats) -> Points:
        """Control points at the times (F,), (F, P, 4, 2)."""
        return self.carrier.curves(self.path.nodes(t), t)


def _carried(
    outlines: MatchedOutlines,
    w: Floats,
    source: Points,
    target: Points,
    path: NodePath,
    setting: str,
    led: float,
) -> Carried:
    """Put an outline's curves on moving nodes and look at them all along.

    Parameters
    ----------
    outlines : MatchedOutlines
    w : (n,) float64
        Places of the nodes, increasing.
    source, target : (n, 2) float64
        The nodes at the ends.
    path : NodePath
    setting : str
    led : float
    """
    carrier = Carrier(outlines.cut(w), w, source, target)
    t = np.linspace(0, 1, CHECKED)
    simple = simple_frames(flatten(carrier.curves(path.nodes(t), t), CHORDS))
    # The ends are the drawings themselves, whatever they do.
    return Carried(path, carrier, int((~simple[1:-1]).sum()), CHECKED - 2, setting, led)


def unfolded(
    outlines: MatchedOutlines, samples: Samples, pair: MeshPair, kept: Index, method: str
) -> Carried:
    """The first of ever stronger settings that crosses nowhere, else the one that does least.

    Parameters
    ----------
    outlines : MatchedOutlines
    samples : Samples
        What nodes are chosen from.
    pair : MeshPair
        Quads that lead.
    kept : (n,) intp
        Samples that are the pair's own nodes.
    method : str
        What moves the quads.
    """
    best: Carried | None = None
    for found in _settings(outlines, samples, pair, kept, method):
        if best is None or found.crossing < best.crossing:
            best = found
        if not best.crossing:
            break
    return best or bare(outlines, samples, pair, kept, method)


def bare(
    outlines: MatchedOutlines, samples: Samples, pair: MeshPair, kept: Index, method: str
) -> Carried:
    """The mesh's own nodes, moved by the method alone; parameters as for `unfolded`."""
    nodes = MeshNodes(tween(pair, method), len(kept))
    ends = pair.source[: len(kept)], pair.target[: len(kept)]
    return _carried(outlines, samples.w[kept], *ends, nodes, "mesh alone", 1.0)


def _settings(
    outlines: MatchedOutlines, samples: Samples, pair: MeshPair, kept: Index, method: str
) -> Iterator[Carried]:
    for tolerance in TOLERANCES:
        chosen = outline_nodes(samples.source, samples.target, kept, tolerance=tolerance, span=SPAN)
        source, target, w = samples.source[chosen], samples.target[chosen], samples.w[chosen]
        if not simple_frames(np.stack([source, target])).all():
            continue
        try:
            mesh = plane_mesh(source, target)
        except (MeshError, OutlineError):
            continue
        guide, led = _guide(mesh, pair, method)
        for stiffness in STIFFNESSES:
            motion = PlaneMotion.prepare(mesh, stiffness, guide)
            setting = (
                f"nodes within {tolerance:g}, outside {stiffness.outside:g}, "
                f"length {stiffness.length:g}"
            )
            yield _carried(outlines, w, source, target, PlaneNodes(motion), setting, led)


def _guide(mesh: PlaneMesh, pair: MeshPair, method: str) -> tuple[QuadGuide | None, float]:
    """What the quads ask of the plane mesh's inside, and of how much of it.

    The plane mesh moves between the poses of the two shapes, so the quads are moved between the
    same poses: an affine pair then asks the same of both.
    """
    sizes = [pose.size for pose in mesh.poses]
    posed = MeshPair(pair.source / sizes[0], pair.target / sizes[1], pair.quads, pair.triangles)
    corners = [
        points[mesh.triangles[mesh.inside]] / size
        for points, size in zip((mesh.source, mesh.target), sizes, strict=True)
    ]
    guide = QuadGuide.of(posed, tween(posed, method), *corners)
    if guide is None:
        return None, 0.0
    areas = np.abs(polygon_area(corners[0]))
    return guide, float(areas[guide.follows].sum() / areas.sum())
