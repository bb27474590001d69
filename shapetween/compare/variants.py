"""One matching and one mesh, moved by every method."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OptionError, ShapetweenError
from shapetween.compare.skeleton import Skeleton
from shapetween.deform.deformation import Deformation
from shapetween.fill.track import FillTrack
from shapetween.interpolate import METHODS
from shapetween.model.movement import Movement
from shapetween.model.part import CurveTrack
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
    bodies : tuple of Carried
        All bodies of all filled shapes, in paint order.
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
    bodies: tuple[Carried, ...] = ()
    skeletons: tuple[Skeleton, ...] = ()
    failure: str = ""


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
    return _moving(variant, prepared, [_remembering(track) for track in prepared.filled])


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


def _remembering(track: FillTrack) -> FillTrack:
    """The same track, all of whose bodies and attached share what was solved."""
    bodies = [replace(body, path=_Remembered(body.path)) for body in track.bodies]
    known = {id(old): new for old, new in zip(track.bodies, bodies, strict=True)}
    appearing = tuple(
        region if region.on is None else replace(region, on=known[id(region.on)])
        for region in track.appearing
    )
    return replace(track, bodies=tuple(bodies), appearing=appearing)


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
    tracks: list[FillTrack] = []
    try:
        for track in prepared.filled:
            bodies = tuple(bare(rings, method) for rings in _grouped(track))
            # Without an ambient mesh there is nothing to be bound to.
            appearing = tuple(replace(region, on=None) for region in track.appearing)
            tracks.append(replace(track, bodies=bodies, appearing=appearing))
        return _moving(variant, prepared, tracks)
    except ShapetweenError as error:
        return replace(variant, failure=str(error))


def _moving(variant: Variant, prepared: Prepared, tracks: Sequence[FillTrack]) -> Variant:
    """The variant in which the filled shapes move by these tracks instead of their own."""
    fresh: dict[int, CurveTrack] = {
        id(old): new for old, new in zip(prepared.filled, tracks, strict=True)
    }
    parts = tuple(
        replace(part.following(lambda track: fresh.get(id(track), track)), name="")
        for part in prepared.movement.parts
    )
    bodies = tuple(body for track in tracks for body in track.bodies)
    skeletons = tuple(Skeleton.of(body, variant.method) for body in bodies)
    movement = replace(prepared.movement, parts=parts)
    return replace(variant, movement=movement, bodies=bodies, skeletons=skeletons)


def _grouped(track: FillTrack) -> list[list[RingMatch]]:
    """Rings by body: those that move in one plane are taken apart, each outer with its holes."""
    groups: list[list[RingMatch]] = []
    for ring in (ring for body in track.bodies for ring in body.nodes.rings):
        if ring.hole:
            groups[-1].append(ring)
        else:
            groups.append([ring])
    return groups
