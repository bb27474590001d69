"""One matching and one mesh, moved by every method."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OptionError, ShapetweenError
from shapetween.compare.skeleton import Skeleton
from shapetween.deform.deformation import Deformation
from shapetween.fill.parts import FilledPart
from shapetween.interpolate import METHODS
from shapetween.model.movement import Movement, Part
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.unfold import bare
from shapetween.pipeline import Folds, Prepared

__all__ = ["ABOUT", "Variant", "bare_variants", "first_variant"]

#: What each method does, in a few words.
ABOUT = {
    "projective": "Corners as rigid as they can be, the inside by homographies.",
    "projective-2007": "Wong, Kovesi and Datta's own form.",
    "arap": "As rigid as possible, by fair triangles.",
    "arap-2000": "Alexa, Cohen-Or and Levin's own form.",
    "linear": "Every corner goes straight.",
}

#: The same where folds are prevented.
GUARDED = "The quads lead; the plane around the shape moves along, so that nothing folds."


@dataclass(frozen=True, slots=True, eq=False)
class Variant:
    """One way to move the pair, or why it cannot be moved that way.

    Attributes
    ----------
    key : str
        Names it in files: the method, after ``guarded-`` where folds are prevented.
    title, about : str
        For people.
    method : str
    folds : {"prevent", "allow"}
    movement : Movement or None
        Without names of shapes, so that several stand in one document.
    skeletons : tuple of Skeleton
        What moves inside each body.
    failure : str
        Why there is no movement; empty if there is one.
    """

    key: str
    title: str
    about: str
    method: str
    folds: Folds
    movement: Movement | None
    skeletons: tuple[Skeleton, ...] = ()
    failure: str = ""

    @property
    def bodies(self) -> tuple[Carried, ...]:
        """All bodies of all filled shapes, in paint order."""
        parts = () if self.movement is None else self.movement.parts
        return tuple(b for p in parts if isinstance(p, FilledPart) for b in p.bodies)


def first_variant(prepared: Prepared, method: str, folds: Folds, failure: str = "") -> Variant:
    """The variant that a movement already prepared is, unless it failed.

    Raises
    ------
    OptionError
        If nothing in it has a mesh: every method would show the same.
    """
    if not prepared.filled:
        raise OptionError(
            "there is nothing to compare: no filled shape has a partner that is filled"
        )
    variant = _named(method, folds)
    if failure:
        return replace(variant, failure=failure)
    parts = tuple(
        _remembering(part) if isinstance(part, FilledPart) else part
        for part in prepared.movement.parts
    )
    movement = _unnamed(replace(prepared.movement, parts=parts))
    moving = replace(variant, movement=movement)
    skeletons = tuple(Skeleton.of(body, method) for body in moving.bodies)
    return replace(moving, skeletons=skeletons)


def bare_variants(prepared: Prepared, methods: Sequence[str] = tuple(METHODS)) -> list[Variant]:
    """The same matching and mesh, moved by each method alone; a method that fails says why."""
    return [_bare_variant(prepared, method) for method in methods]


class _Remembered:
    """A path that is asked for the same times again and again, and solved for them once."""

    def __init__(self, path: Deformation) -> None:
        self._path = path
        self._found: dict[bytes, Points] = {}
        #: What regions bind to and a skeleton is made of.
        self.mesh = path.mesh

    def vertices(self, t: Floats) -> Points:
        """All vertices at the times (F,), (F, V, 2)."""
        key = t.tobytes()
        if key not in self._found:
            self._found[key] = self._path.vertices(t)
        return self._found[key]


def _remembering(part: FilledPart) -> FilledPart:
    """The same part, all of whose bodies and attached share what was solved."""
    bodies = [replace(body, path=_Remembered(body.path)) for body in part.bodies]
    known = {id(old): new for old, new in zip(part.bodies, bodies, strict=True)}
    appearing = tuple(
        region if region.on is None else replace(region, on=known[id(region.on)])
        for region in part.appearing
    )
    return replace(part, bodies=tuple(bodies), appearing=appearing)


def _named(method: str, folds: Folds) -> Variant:
    guarded = folds == "prevent"
    return Variant(
        f"guarded-{method}" if guarded else method,
        f"{method}, guarded" if guarded else method,
        GUARDED if guarded else ABOUT.get(method, ""),
        method,
        folds,
        None,
    )


def _bare_variant(prepared: Prepared, method: str) -> Variant:
    variant = _named(method, "allow")
    parts: list[Part] = []
    skeletons: list[Skeleton] = []
    try:
        for part in prepared.movement.parts:
            if not isinstance(part, FilledPart):
                parts.append(part)
                continue
            bodies = tuple(bare(rings, method) for rings in _grouped(part))
            skeletons += [Skeleton.of(body, method) for body in bodies]
            # Without an ambient mesh there is nothing to be bound to.
            appearing = tuple(replace(region, on=None) for region in part.appearing)
            parts.append(replace(part, bodies=bodies, appearing=appearing))
    except ShapetweenError as error:
        return replace(variant, failure=str(error))
    movement = replace(prepared.movement, parts=tuple(parts))
    return replace(variant, movement=_unnamed(movement), skeletons=tuple(skeletons))


def _grouped(part: FilledPart) -> list[list[RingMatch]]:
    """Rings by body: those that move in one plane are taken apart, each outer with its holes."""
    groups: list[list[RingMatch]] = []
    for ring in (ring for body in part.bodies for ring in body.nodes.rings):
        if ring.hole:
            groups[-1].append(ring)
        else:
            groups.append([ring])
    return groups


def _unnamed(movement: Movement) -> Movement:
    # Every kind of part is a dataclass with a name; the protocol does not say so.
    return replace(
        movement,
        parts=tuple(replace(part, name="") for part in movement.parts),  # type: ignore[type-var]
    )
