"""From two drawings to the movement between them, one stage after another."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from shapetween.base.arrays import Affine, Points
from shapetween.base.errors import OptionError
from shapetween.base.notices import Notice, distinct
from shapetween.base.observe import Observer, unobserved
from shapetween.base.threads import one_thread
from shapetween.deform.check import LOOKED
from shapetween.fill.morph import morph_fill
from shapetween.fill.settings import FillSettings
from shapetween.fill.track import FillTrack
from shapetween.geometry.affine import mapped
from shapetween.interpolate import check_method
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.fit import Fit, Flip, fit_matrix
from shapetween.model.gradients import has_gradient
from shapetween.model.movement import Movement
from shapetween.model.part import BlendedPaint, Part
from shapetween.outline.preview import Effort
from shapetween.scene.asked import PRICES, Asked, Change, Exchange, Pairing, groups_of
from shapetween.scene.boards import boards_between
from shapetween.scene.disturbance import tears
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item, in_view, items_of
from shapetween.scene.joining import joined_lines
from shapetween.scene.kept.drawings import kept_drawings
from shapetween.scene.limbs import with_limbs
from shapetween.scene.limits import limits_of_items
from shapetween.scene.motion.anchors import anchors
from shapetween.scene.motion.choose import SAME, corners_suffice
from shapetween.scene.motion.mouths import mouth_track
from shapetween.scene.pierced import opens_well, pierced, pierced_apart, suits_lines
from shapetween.scene.strokes.outlined import as_lines
from shapetween.scene.swelling import swells
from shapetween.scene.torn import opens
from shapetween.scene.whole import turns_over, with_lines

if TYPE_CHECKING:
    from shapetween.scene.kept.areas import KeptArea
    from shapetween.scene.movement import SceneMovement

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
        Names of shapes that become each other, ``#N`` for the N-th in paint order; several of one
        side with commas between; an empty side for a shape that comes or goes alone.
    meshes : tuple of (str, MeshPair)
        Meshes to use, with the name of the shape, vertices in each drawing's own user units; the
        name "" serves any shape. Several of one name serve its pieces in turn.
    fit : {"view", "geometry", "none"}
        How the second drawing is brought into the first one's frame.
    folds : {"prevent", "allow"}
        Whether the plane around a shape moves along so that nothing folds, or the bare mesh moves.
    together : bool
        Whether the parts of a drawing move as they are seen together; else every area moves by a
        mesh of its own, as all do where meshes are given.
    matching : int
        Which of the distinct matchings of two outlines to take, the best one being 1.
    flip : {"none", "b"}
        Whether the second drawing is mirrored about its upright axis first.
    pairing : {"normal", "loose", "strict"}
        How readily parts become others instead of coming and going by themselves. Unless "loose",
        drawings that have too little in common are exchanged as wholes.
    change : {"fade", "draw", "grow", "slide"} or None
        How parts without a partner come and go; None for each as it lies.
    effort : {"line", "plane", "full"}
        How much is done for the way that outlines take; where they go is the same.
    """

    method: str = "projective"
    quads: int | None = None
    pins: tuple[tuple[float, float, float, float], ...] = ()
    matches: tuple[tuple[str, str], ...] = ()
    meshes: tuple[tuple[str, MeshPair], ...] = ()
    fit: Fit = "view"
    folds: Folds = "prevent"
    together: bool = True
    matching: int = 1
    flip: Flip = "none"
    pairing: Pairing = "normal"
    change: Change | None = None
    effort: Effort = "full"

    def __post_init__(self) -> None:
        """Check what does not depend on the drawings."""
        check_method(self.method)
        if self.folds not in get_args(Folds):
            raise OptionError(f"folds: {self.folds!r} is none of {', '.join(get_args(Folds))}")
        if self.pairing not in get_args(Pairing):
            raise OptionError(
                f"pairing: {self.pairing!r} is none of {', '.join(get_args(Pairing))}"
            )
        if self.change is not None and self.change not in get_args(Change):
            raise OptionError(f"change: {self.change!r} is none of {', '.join(get_args(Change))}")
        if self.effort not in get_args(Effort):
            raise OptionError(f"effort: {self.effort!r} is none of {', '.join(get_args(Effort))}")
        if self.quads is not None and self.quads < 1:
            raise OptionError(f"quads: {self.quads} is no count; give 1 or more")
        if self.matching < 1:
            raise OptionError(f"matching: {self.matching} is no number; the best one is 1")
        if not np.isfinite(np.array(self.pins, dtype=np.float64)).all():
            raise OptionError("pin: coordinates must be finite numbers")


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A movement and how it came about.

    Attributes
    ----------
    movement : Movement
    fit : (2, 3) float64
        From the second drawing's user units to the movement's.
    notices : tuple of Notice
        What was lost, is doubtful, or was done another way.
    scene : SceneMovement or None
        How the drawings' parts were seen and paired; None of single areas.
    filled : tuple of FillTrack
        What of the parts the outline engine moves by meshes, in paint order.
    """

    movement: Movement
    fit: Affine
    notices: tuple[Notice, ...]
    filled: tuple[FillTrack, ...]
    scene: "SceneMovement | None" = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """What there is to warn of, one line each."""
        return tuple(str(notice) for notice in self.notices if notice.severity == "warning")

    @property
    def meshed(self) -> tuple[FillTrack, ...]:
        """What can be shown as meshes: also areas that move some simpler way."""
        return self.filled if self.scene is None else self.scene.meshed


@one_thread()
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
        matrix = fit_matrix(source, target, chosen.fit, chosen.flip)
        shapes = source.shapes, target.transformed(matrix).shapes
        groups = groups_of(*shapes, chosen.matches)
    pins = np.array(chosen.pins, dtype=np.float64).reshape(-1, 4)
    pins[:, 2:] = mapped(pins[:, 2:], matrix)
    meshes = [(name, _in_frame(mesh, matrix)) for name, mesh in chosen.meshes]
    meshed = bool(meshes) or not chosen.together
    settings = FillSettings(
        chosen.method,
        chosen.folds,
        chosen.quads,
        pins,
        meshes,
        observe,
        meshed,
        chosen.matching,
        chosen.effort,
    )
    notices = [
        Notice("file", warning, name)
        for name, drawing in zip(names, (source, target), strict=True)
        for warning in drawing.warnings
    ]
    boxes = _corners(source.box), mapped(_corners(target.box), matrix)
    free = chosen.pairing != "loose" and not (groups or len(pins) or meshed or chosen.change)
    free = free and chosen.matching == 1
    asked = Asked(
        groups, PRICES[chosen.pairing], chosen.change, pins, "unlike" if free else "never"
    )
    parts, areas, moved, scene = _moved(source.shapes, shapes[1], boxes, asked, settings, names)
    notices += moved
    settings.check_used()
    if chosen.folds == "prevent" and chosen.effort == "full":
        with observe("move"):
            notices += _of_attached(areas, len(parts))
    title = " to ".join(t for t in (source.title, target.title) if t)
    movement = Movement(parts, source.box, title, source.page)
    return Prepared(movement, matrix, distinct(notices), areas, scene)


_Moved: TypeAlias = tuple[
    tuple[Part, ...], tuple[FillTrack, ...], tuple[Notice, ...], "SceneMovement | None"
]


def _moved(
    first: tuple[Shape, ...],
    second: tuple[Shape, ...],
    boxes: tuple[Points, Points],
    asked: Asked,
    settings: FillSettings,
    names: tuple[str, str],
) -> _Moved:
    """A single area that becomes another by the outline engine, or else a scene."""
    found = [items_of(side, name) for side, name in zip((first, second), names, strict=True)]
    free = all(group[0] and group[1] for group in asked.groups)
    notices = tuple(notice for _, own in found for notice in own)
    one, other = found[0][0], found[1][0]
    if not (asked.groups or settings.meshed):
        (one, out), (other, more) = (
            in_view(side, view, name)
            for side, view, name in zip((one, other), boxes, names, strict=True)
        )
        notices = (*notices, *out, *more)
    one, other = joined_lines(one), joined_lines(other)
    if not settings.meshed:
        notices = (*notices, *limits_of_items(one, other))
    if not (settings.meshed or len(settings.pins) or settings.choice > 1):
        with settings.observe("perceive"):
            boards = () if asked.groups else boards_between(one, other, settings.method)
        if boards:
            return _scene((one, other), boxes, asked, settings, names, notices, boards)
        with settings.observe("perceive"):
            kept = kept_drawings(one, other, asked.groups)
        notices = (*notices, *kept.notices)
        if kept.areas:
            lines = as_lines(kept.first, kept.second)
            return _scene(lines, boxes, asked, settings, names, notices, kept.areas)
        apart = with_limbs(one, other)
        if apart is not None:
            return _scene(as_lines(*apart), boxes, asked, settings, names, notices)
    lines = with_lines(one, other, boxes)
    areas = free and _two_outlines(one, other) and not swells(one[0], other[0], lines)
    areas = areas or (free and opens(one, other, lines))
    may = asked.exchange == "unlike" and not _asked_for(settings)
    if asked.exchange == "unlike" and len(one) == len(other) == 1:
        exchange = _exchange(one[0], other[0], lines, settings, areas=areas)
        asked = replace(asked, exchange=exchange)
    if asked.exchange == "always":
        return _scene((one, other), boxes, asked, settings, names, notices)
    if not areas:
        one, other = lines
    if free and len(one) == len(other) == 1 and _by_engine(one[0], other[0], settings):
        shapes = [_closed(side[item.shape]) for side, (item,) in ((first, one), (second, other))]
        track, moved = morph_fill(shapes[0], shapes[1], settings, names, alone=True)
        if may and tears(track) and pierced(one[0], other[0]):
            asked = replace(asked, exchange="always")
            return _scene((one, other), boxes, asked, settings, names, notices)
        styles = shapes[0].style, shapes[1].style
        motion = track.whole_motion() if any(map(has_gradient, styles)) else None
        parts = (Part(track.name, (track,), BlendedPaint(styles, motion)),)
        return parts, (track,), (*notices, *moved), None
    return _scene((one, other), boxes, asked, settings, names, notices)


def _scene(
    sides: tuple[Sequence[Item], Sequence[Item]],
    boxes: tuple[Points, Points],
    asked: Asked,
    settings: FillSettings,
    names: tuple[str, str],
    notices: tuple[Notice, ...],
    kept: Sequence["KeptArea"] = (),
) -> _Moved:
    """Both sides' items as parts, each of which moves, disappears or appears by itself."""
    from shapetween.scene.movement import move_scene  # slow to import, and one outline needs none

    scene = move_scene(*sides, boxes, asked, settings, names, kept)
    return scene.parts, scene.areas, (*notices, *scene.notices), scene


def _exchange(
    one: Item,
    other: Item,
    lines: tuple[Sequence[Item], Sequence[Item]],
    settings: FillSettings,
    *,
    areas: bool,
) -> Exchange:
    """Whether two drawings of one item each are exchanged.

    Areas are where no other way suits them and nobody wants a mesh of them. Where they move as
    lines, several of them, those are a drawing of parts.
    """
    if len(lines[0]) + len(lines[1]) > 2:
        if not areas:
            return "unlike"
        suited = _by_engine(one, other, settings)
    else:
        suited = _asked_for(settings) or (suits_lines(one, other, lines) and not areas)
        suited = suited or turns_over(one, other) or opens_well(one, other)
    return "never" if suited or not pierced_apart(one, other) else "always"


def _asked_for(settings: FillSettings) -> bool:
    """Whether somebody wants a movement of areas that is no other way's."""
    return (settings.method, settings.quads, settings.folds) != ("projective", None, "prevent")


def _two_outlines(one: Sequence[Item], other: Sequence[Item]) -> bool:
    """Whether one area becomes one other, and neither is a mere bar.

    They do so as areas, even if they are made of strokes, unless those swell on the way: as lines
    an E becomes a K by an arm that shrinks and one that comes up elsewhere.
    """
    if not len(one) == len(other) == 1:
        return False
    items = one[0], other[0]
    return all(item.filled and not isinstance(form_of(item), RoundedBox) for item in items)


def _by_engine(one: Item, other: Item, settings: FillSettings) -> bool:
    """Whether the outline engine moves a drawing of one item: areas of no simple form."""
    if not (one.filled and other.filled):
        return False
    if settings.meshed or settings.folds == "allow" or len(settings.pins) or settings.choice > 1:
        return True
    if settings.method != "projective" or settings.quads is not None:
        return True
    if isinstance(form_of(one), RoundedBox) and isinstance(form_of(other), RoundedBox):
        return False
    if turns_over(one, other) or mouth_track(one, other) is not None:
        return False
    if anchors(one, other, SAME * (one.extent + other.extent) / 2) is not None:
        return False
    return not corners_suffice(one, other)


def _closed(shape: Shape) -> Shape:
    return replace(shape, rings=tuple(ring.close() for ring in shape.rings))


def _of_attached(areas: tuple[FillTrack, ...], count: int) -> list[Notice]:
    """What to tell of those of so many parts in which something attached crosses itself."""
    crossing = sum(bool(area.crossing(LOOKED).any()) for area in areas)
    if not crossing:
        return []
    among = f"{crossing} of {count} shapes" if count > 1 else "the shape"
    return [Notice("crossing", f"in {among}, attached parts cross themselves on the way")]


def _corners(box: Box) -> Points:
    return np.array([[box.x, box.y], [box.x + box.width, box.y + box.height]])


def _in_frame(mesh: MeshPair, matrix: Affine) -> MeshPair:
    return MeshPair(mesh.source, mapped(mesh.target, matrix), mesh.quads, mesh.triangles)
