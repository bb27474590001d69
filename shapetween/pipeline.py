"""From two drawings to the movement between them, one stage after another."""

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from shapetween.arrays import Affine
from shapetween.drawing import Drawing, Shape
from shapetween.errors import OptionError
from shapetween.fill import FillSettings, morph_fill
from shapetween.fit import Fit, fit_matrix, mapped
from shapetween.geometry.bezier import curve_lengths
from shapetween.gradients import has_gradient
from shapetween.lines import LineMorph, morph_line
from shapetween.mesh import MeshPair
from shapetween.movement import Movement, Part
from shapetween.observe import Observer, unobserved
from shapetween.outline import Outline
from shapetween.pairing import Pairing, Thing, pair_shapes, pair_things
from shapetween.parts import FilledPart, LinePart, LonePart
from shapetween.stroking import outlined
from shapetween.whole import MOTION_TIMES, WholeMotion

__all__ = ["Folds", "Options", "Prepared", "prepare"]

Folds: TypeAlias = Literal["prevent", "allow"]
"""Whether the plane around a shape moves along so that nothing folds, or the bare mesh moves."""


@dataclass(frozen=True, slots=True)
class Options:
    """How a movement is prepared.

    Attributes
    ----------
    method : str
        One of `shapetween.interpolate.METHODS`.
    quads : int or None
        About how many quads; None for as few as a shape needs.
    pins : tuple of (ax, ay, bx, by)
        Points that belong together, each in its own drawing's user units.
    matches : tuple of (str, str)
        Names of shapes that become each other.
    meshes : tuple of (str, MeshPair)
        Meshes to use, with the name of the shape, vertices in each drawing's own user units; the
        name "" serves any shape. Several of one name serve its pieces in turn.
    fit : {"view", "geometry", "none"}
        How the second drawing is brought into the first one's frame.
    folds : {"prevent", "allow"}
        Whether the plane around a shape moves along so that nothing folds, or the bare mesh moves.
    """

    method: str = "projective"
    quads: int | None = None
    pins: tuple[tuple[float, float, float, float], ...] = ()
    matches: tuple[tuple[str, str], ...] = ()
    meshes: tuple[tuple[str, MeshPair], ...] = ()
    fit: Fit = "view"
    folds: Folds = "prevent"

    def __post_init__(self) -> None:
        """Check what does not depend on the drawings."""
        if self.quads is not None and self.quads < 1:
            raise OptionError(f"quads: {self.quads} is no count; give 1 or more")
        if not np.isfinite(np.array(self.pins, dtype=np.float64)).all():
            raise OptionError("pin: coordinates must be finite numbers")


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A movement and how it came about.

    Attributes
    ----------
    movement : Movement
        Its parts are `FilledPart`, `LinePart` and `LonePart`.
    fit : (2, 3) float64
        From the second drawing's user units to the movement's.
    warnings : tuple of str
    """

    movement: Movement
    fit: Affine
    warnings: tuple[str, ...]

    @property
    def filled(self) -> tuple[FilledPart, ...]:
        """The parts that have meshes."""
        return tuple(part for part in self.movement.parts if isinstance(part, FilledPart))


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
    options : Options, optional
    names : tuple of str
        What messages call the drawings.
    observe : Observer, optional
        Told of every stage.

    Raises
    ------
    OutlineError
        If a shape encloses nothing.
    OptionError, MeshError
        If a pin, a match or a mesh does not fit the drawings.
    """
    chosen = Options() if options is None else options
    with observe("fit"):
        matrix = fit_matrix(source, target, chosen.fit)
        shapes = _plain(source.shapes), _plain(target.transformed(matrix).shapes)
        scale = float(np.hypot(source.box.width, source.box.height))
        pairing = pair_shapes(*shapes, scale, _settled(*shapes, chosen.matches))
    pins = np.array(chosen.pins, dtype=np.float64).reshape(-1, 4)
    pins[:, 2:] = mapped(pins[:, 2:], matrix)
    meshes = [(name, _in_frame(mesh, matrix)) for name, mesh in chosen.meshes]
    settings = FillSettings(chosen.method, chosen.folds, chosen.quads, pins, meshes, observe)
    warnings = [f"{names[0]}: {w}" for w in source.warnings]
    warnings += [f"{names[1]}: {w}" for w in target.warnings]
    alone = all(len(side) == 1 for side in shapes)
    pairs: dict[int, Part] = {}
    for i, j in pairing.pairs:
        part, said = _morph_pair(shapes[0][i], shapes[1][j], settings, names, alone=alone)
        pairs[i] = part
        warnings += said
    settings.check_used()
    parts = _in_paint_order(shapes, pairing, pairs)
    title = " to ".join(t for t in (source.title, target.title) if t)
    return Prepared(Movement(parts, source.box, title), matrix, tuple(dict.fromkeys(warnings)))


def _in_frame(mesh: MeshPair, matrix: Affine) -> MeshPair:
    return MeshPair(mesh.source, mapped(mesh.target, matrix), mesh.quads, mesh.triangles)


def _plain(shapes: tuple[Shape, ...]) -> tuple[Shape, ...]:
    """Shapes each either filled or stroked along open lines.

    A filled ring is closed and a stroked one is as it was drawn; where the two differ the shape
    becomes two.
    """
    plain = []
    for shape in shapes:
        open_rings = any(not ring.closed for ring in shape.rings)
        if shape.style.fill is None or not open_rings:
            plain.append(shape)
            continue
        closed = tuple(ring.close() for ring in shape.rings)
        plain.append(Shape(closed, replace(shape.style, stroke=None), shape.name))
        if shape.style.stroke is not None:
            plain.append(Shape(shape.rings, replace(shape.style, fill=None), ""))
    return tuple(plain)


def _settled(
    first: tuple[Shape, ...], second: tuple[Shape, ...], matches: tuple[tuple[str, str], ...]
) -> list[tuple[int, int]]:
    """Indices of the shapes that the user matched by name."""
    settled = []
    for pair in matches:
        found = []
        for name, side, which in zip(pair, (first, second), ("first", "second"), strict=True):
            known = [k for k, shape in enumerate(side) if shape.name == name]
            if not known:
                named = sorted({shape.name for shape in side if shape.name})
                have = f"; it has {', '.join(named[:8])}" if named else "; its shapes have no ids"
                raise OptionError(f"match: the {which} drawing has no shape {name!r}{have}")
            found.append(known[0])
        settled.append((found[0], found[1]))
    for k, which in enumerate(("first", "second")):
        if len({pair[k] for pair in settled}) < len(settled):
            raise OptionError(f"match: a shape of the {which} drawing is matched twice")
    return settled


def _morph_pair(
    first: Shape, second: Shape, settings: FillSettings, names: tuple[str, str], *, alone: bool
) -> tuple[Part, tuple[str, ...]]:
    lines = [shape.style.fill is None for shape in (first, second)]
    if all(lines):
        return _morph_lines(first, second), ()
    # A line that becomes an area becomes its own outline first.
    first, second = (
        outlined(shape) if line else shape
        for shape, line in zip((first, second), lines, strict=True)
    )
    return morph_fill(first, second, settings, names, alone=alone)


def _morph_lines(first: Shape, second: Shape) -> LinePart:
    """Lines to lines; where one side has more, its lines part from the nearest of the other's."""
    things = [[_thing(ring) for ring in shape.rings] for shape in (first, second)]
    scale = max(max(t.size for t in side) for side in things) or 1.0
    pairing = pair_things(things[0], things[1], scale)
    pairs = [
        *pairing.pairs,
        *((i, _nearest(things[0][i], things[1])) for i in pairing.first_only),
        *((_nearest(things[1][j], things[0]), j) for j in pairing.second_only),
    ]
    lines = tuple(morph_line(first.rings[i], second.rings[j]) for i, j in pairs)
    styles = (first.style, second.style)
    motion = _whole_motion(lines) if any(map(has_gradient, styles)) else None
    return LinePart(first.name or second.name, styles, lines, motion)


def _whole_motion(lines: tuple[LineMorph, ...]) -> WholeMotion | None:
    """The motion of all lines as one."""
    curves = np.concatenate([line.curves(MOTION_TIMES) for line in lines], axis=1)
    return WholeMotion.of(curves.mean(axis=2), curve_lengths(curves[0]))


def _nearest(thing: Thing, others: list[Thing]) -> int:
    return min(
        range(len(others)), key=lambda k: float(np.linalg.norm(others[k].centre - thing.centre))
    )


def _thing(ring: Outline) -> Thing:
    low, high = ring.box
    return Thing((low + high) / 2, float(np.linalg.norm(high - low)))


def _in_paint_order(
    shapes: tuple[tuple[Shape, ...], tuple[Shape, ...]], pairing: Pairing, pairs: dict[int, Part]
) -> tuple[Part, ...]:
    """All parts, the last on top: the first drawing's order, newcomers above what they follow."""
    parts = [
        pairs[i] if i in pairs else LonePart(shape.name, shape.style, shape.rings, arrives=False)
        for i, shape in enumerate(shapes[0])
    ]
    partner = {j: pairs[i] for i, j in pairing.pairs}
    below: Part | None = None
    for j, shape in enumerate(shapes[1]):
        if j in partner:
            below = partner[j]
            continue
        part = LonePart(shape.name, shape.style, shape.rings, arrives=True)
        place = parts.index(below) + 1 if below is not None else 0
        parts.insert(place, part)
        below = part
    return tuple(parts)
