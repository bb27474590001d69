"""From two drawings to the movement between them, one stage after another."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from shapetween.arrays import Affine, Curves, Floats
from shapetween.blend import blend
from shapetween.drawing import Drawing, Shape
from shapetween.errors import OptionError, OutlineError
from shapetween.fit import Fit, fit_matrix, mapped
from shapetween.geometry.bezier import flatten
from shapetween.mesh import MeshPair
from shapetween.movement import Movement
from shapetween.observe import Observer, unobserved
from shapetween.outline import Outline
from shapetween.paint import Style
from shapetween.ring import Folds, RingMorph, morph_ring
from shapetween.tidy import tidy

if TYPE_CHECKING:
    import shapely

__all__ = ["Options", "Prepared", "ShapeMorph", "prepare"]

#: Chords of a curve when an outline is first checked for crossings, and when one was found: a
#: coarse polygon may touch itself in a slit where the curve does not.
CHECK_CHORDS, RECHECK_CHORDS = 12, 96

#: Share of its area by which an outline may overlap itself and still count as simple: editors
#: round coordinates and leave closing lines that step back by the last digit.
NEGLIGIBLE_FOLD = 1e-4


@dataclass(frozen=True, slots=True)
class Options:
    """How a movement is prepared.

    Attributes
    ----------
    method : str
        One of `shapetween.interpolate.METHODS`.
    quads : int or None
        About how many quads a shape is split into; None for as few as it needs.
    pins : tuple of (ax, ay, bx, by)
        Points that belong together, each in its own drawing's user units.
    meshes : mapping of str to MeshPair
        Meshes to use, by the name of the shape, vertices in each drawing's own user units; the
        name "" serves any shape.
    fit : {"view", "geometry", "none"}
        How the second drawing is brought into the first one's frame.
    folds : {"prevent", "allow"}
        Whether the plane around a shape moves along so that nothing folds, or the bare mesh moves.
    """

    method: str = "projective"
    quads: int | None = None
    pins: tuple[tuple[float, float, float, float], ...] = ()
    meshes: Mapping[str, MeshPair] = field(default_factory=dict)
    fit: Fit = "view"
    folds: Folds = "prevent"

    def __post_init__(self) -> None:
        """Check what does not depend on the drawings."""
        if self.quads is not None and self.quads < 1:
            raise OptionError(f"quads: {self.quads} is no count; give 1 or more")
        if not np.isfinite(np.array(self.pins, dtype=np.float64)).all():
            raise OptionError("pin: coordinates must be finite numbers")


@dataclass(frozen=True, slots=True, eq=False)
class ShapeMorph:
    """One shape through the whole movement; a `shapetween.movement.Part`."""

    name: str
    ring: RingMorph
    styles: tuple[Style, Style]

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return (self.ring.carried.carrier.count,)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return (True,)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return self.ring.curves(t)

    def style(self, t: float) -> Style:
        """Paint at one time."""
        return blend(*self.styles, t)


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A movement and how it came about.

    Attributes
    ----------
    movement : Movement
    shapes : tuple of ShapeMorph
    fit : (2, 3) float64
        From the second drawing's user units to the movement's.
    warnings : tuple of str
    """

    movement: Movement
    shapes: tuple[ShapeMorph, ...]
    fit: Affine
    warnings: tuple[str, ...]


def prepare(
    source: Drawing,
    target: Drawing,
    options: Options | None = None,
    *,
    names: tuple[str, str] = ("source", "target"),
    observe: Observer = unobserved,
) -> Prepared:
    """Prepare the movement from one drawing to another.

    Parameters
    ----------
    source, target : Drawing
        Each with one filled closed outline.
    options : Options, optional
    names : tuple of str
        What messages call the drawings.
    observe : Observer, optional
        Told of every stage.

    Raises
    ------
    OutlineError
        If a drawing has no outline or several, or one without area or crossing itself.
    OptionError, MeshError
        If a pin or a mesh does not fit the outlines.
    """
    chosen = Options() if options is None else options
    shape_a, shape_b = _only_shape(source, names[0]), _only_shape(target, names[1])
    with observe("fit"):
        matrix = fit_matrix(source, target, chosen.fit)
        outline_a = _checked(shape_a.rings[0], names[0])
        outline_b = _checked(shape_b.rings[0], names[1]).transformed(matrix)
    pins = np.array(chosen.pins, dtype=np.float64).reshape(-1, 4)
    pins[:, 2:] = mapped(pins[:, 2:], matrix)
    name = shape_a.name or shape_b.name
    given = chosen.meshes.get(name, chosen.meshes.get(""))
    if given is not None:
        target_vertices = mapped(given.target, matrix)
        given = MeshPair(given.source, target_vertices, given.quads, given.triangles)
    ring = morph_ring(
        outline_a,
        outline_b,
        method=chosen.method,
        folds=chosen.folds,
        quads=chosen.quads,
        pins=pins,
        mesh=given,
        observe=observe,
    )
    shape = ShapeMorph(name, ring, (shape_a.style, shape_b.style))
    title = " to ".join(t for t in (source.title, target.title) if t)
    movement = Movement((shape,), source.box, title)
    warnings = [f"{names[0]}: {w}" for w in source.warnings]
    warnings += [f"{names[1]}: {w}" for w in target.warnings]
    if ring.mesh.matching.confidence == "unsure":
        warnings.append(
            "the two outlines were matched with little certainty; look at the matching with "
            "'shapetween mesh' and correct it with --pin"
        )
    return Prepared(movement, (shape,), matrix, tuple(warnings))


def _only_shape(drawing: Drawing, name: str) -> Shape:
    """The drawing's one filled closed outline."""
    filled = [s for s in drawing.shapes if s.style.fill is not None]
    rings = sum(len(s.rings) for s in filled)
    lines = len(drawing.shapes) - len(filled)
    if rings == 1:
        return filled[0]
    found = [f"{rings} filled outlines" if rings else "no filled outline"]
    if len(filled) > 1:
        found[0] += f" in {len(filled)} shapes"
    if lines:
        found.append(f"{lines} drawn as lines only")
    raise OutlineError(f"{name}: one filled outline is needed; found {' and '.join(found)}")


def _checked(outline: Outline, name: str) -> Outline:
    """The outline run clockwise, refused where it has no inside or crosses itself."""
    import shapely

    low, high = outline.box
    size = float(np.max(high - low))
    if abs(outline.area) <= 1e-9 * size * size:
        raise OutlineError(f"{name}: the outline encloses no area")
    for chords in (CHECK_CHORDS, RECHECK_CHORDS):
        polygon = shapely.Polygon(flatten(outline.curves, chords))
        if polygon.is_valid or _fold(polygon, outline.area) <= NEGLIGIBLE_FOLD:
            return tidy(outline if outline.area > 0 else outline.reversed())
    reason = shapely.is_valid_reason(polygon)
    where = reason[reason.find("[") + 1 : reason.find("]")].split()
    place = " near " + ", ".join(f"{float(x):.6g}" for x in where) if len(where) == 2 else ""
    raise OutlineError(
        f"{name}: the outline crosses or touches itself{place}; simplify it in an editor "
        "(union of the path with itself)"
    )


def _fold(polygon: "shapely.Polygon", signed_area: float) -> float:
    """Area counted otherwise by crossings than by the even-odd rule, as a share."""
    import shapely

    return abs(float(shapely.make_valid(polygon).area) / abs(signed_area) - 1)
