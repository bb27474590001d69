"""The movement between two drawings as scenes of parts."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ends import End
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice, distinct
from shapetween.base.ranking import comparable
from shapetween.fill.morph import morph_fill
from shapetween.fill.settings import Claimed, FillSettings
from shapetween.fill.track import FillTrack, fills_of
from shapetween.model.part import CurveTrack, Part
from shapetween.scene.asked import Asked
from shapetween.scene.assign import Roles
from shapetween.scene.attachments import kept_to
from shapetween.scene.borders import bordered_tracks
from shapetween.scene.contents import contents_apart
from shapetween.scene.disturbance import waviest, waviness
from shapetween.scene.doubtful import hopeless_pairs
from shapetween.scene.exchange import LEFT, behind_both, too_different
from shapetween.scene.exchanged import exchange_goings, exchange_roles
from shapetween.scene.items import Item
from shapetween.scene.kept.areas import KeptArea
from shapetween.scene.limits import limits_of_pairs
from shapetween.scene.motion.tracks import Frame, Shared
from shapetween.scene.paint_order import Layer, layers_of
from shapetween.scene.pairing import Paired, pair_items
from shapetween.scene.pairs import main_pairs, of_one_kind, pair_tracks
from shapetween.scene.parts import PairPaint, joined_parts, pair_part
from shapetween.scene.relations import Scene, perceive
from shapetween.scene.strokes.outlined import as_painted, stroke_notice
from shapetween.scene.unmatched.choose import goings_between
from shapetween.scene.unmatched.going import Going
from shapetween.scene.unmatched.part import unmatched_part

__all__ = ["SceneMovement", "move_scene"]

#: What is told of drawings that are exchanged.
EXCHANGED_NOTICE = Notice(
    "exchanged",
    "the drawings have so little in common that the first goes as a whole and the second comes",
    instead="to move parts into parts all the same, give --loose, or --match for parts",
)


@dataclass(frozen=True, eq=False)
class SceneMovement:
    """What moves, and how that was found.

    Attributes
    ----------
    parts : tuple of Part
        In paint order.
    scenes : (Scene, Scene)
        The second one as it is in the frame.
    roles : Roles
    notices : tuple of Notice
    tracks : dict of int to tuple of CurveTrack
        By pair.
    settings : FillSettings
    frame : Frame or None
    matched : ((Scene, Scene), Roles) or None
        Who would become whom, of drawings that are exchanged.
    """

    parts: tuple[Part, ...]
    scenes: tuple[Scene, Scene]
    roles: Roles
    notices: tuple[Notice, ...]
    tracks: dict[int, tuple[CurveTrack, ...]]
    settings: FillSettings
    frame: Frame | None
    matched: tuple[tuple[Scene, Scene], Roles] | None = None

    @property
    def areas(self) -> tuple[FillTrack, ...]:
        """What of the parts the outline engine moves, in paint order."""
        return fills_of(track for part in self.parts for track in part.tracks)

    @property
    def meshed(self) -> tuple[FillTrack, ...]:
        """Every pair of areas as the outline engine would move it, in the order of their roles."""
        return self._meshed[0]

    @property
    def unmeshed(self) -> tuple[Notice, ...]:
        """Of which of them there is no mesh, and why."""
        return self._meshed[1]

    @cached_property
    def _meshed(self) -> tuple[tuple[FillTrack, ...], tuple[Notice, ...]]:
        settings = replace(self.settings, pins=np.zeros((0, 4)), claimed=Claimed(), meshed=True)
        found: list[FillTrack] = []
        failed: list[Notice] = []
        scenes, roles, tracks = self.scenes, self.roles, self.tracks
        if self.matched is not None:
            scenes, roles, tracks = *self.matched, {}
        for k, role in enumerate(roles.pairs):
            one = scenes[0].items[role.first]
            other = scenes[1].items[role.second]
            if not (one.filled and other.filled):
                continue
            own = fills_of(tracks.get(k, ()))
            if own and self.frame is None:
                found += own
                continue
            if self.frame is not None:
                forth = self.frame.forth
                other = other.replaced(tuple(ring.transformed(forth) for ring in other.rings))
            try:
                shapes = one.as_shape, other.as_shape
                found.append(morph_fill(*shapes, settings, ("", ""), alone=False)[0])
            except OutlineError as error:
                name = one.name or other.name
                failed.append(Notice("no-mesh", str(error), name, "it has no mesh", "note"))
        return tuple(found), tuple(failed)


def move_scene(
    first: Sequence[Item],
    second: Sequence[Item],
    views: tuple[Points, Points],
    asked: Asked,
    settings: FillSettings,
    names: tuple[str, str],
    kept: Sequence[KeptArea] = (),
) -> SceneMovement:
    """The movement between two drawings' items.

    Parameters
    ----------
    first, second, views, asked, kept
        As for `pair_items`.
    settings : FillSettings
    names : tuple of str
        What messages call the drawings.
    """
    paired = pair_items(first, second, views, asked, kept, settings.observe)
    (a, b), roles, frame = paired.scenes, paired.roles, paired.frame
    tracks: dict[int, tuple[CurveTrack, ...]] = {}
    notices: list[Notice] = []
    exchange, matched = False, None
    may = asked.exchange != "never" and not kept and frame is None
    with settings.observe("move"):
        if may:
            roles = roles.without(hopeless_pairs(a, b, roles))
            behind = behind_both(a, b, roles)
            exchange = asked.exchange == "always" or too_different(a, b, roles, behind)
        if not exchange:
            tracks, notices = _moved_pairs(a, b, roles, paired, settings, names)
            waves = waviness(a, b, roles, tracks) if may else {}
            exchange = may and too_different(a, b, roles, behind, waves)
            if exchange:
                # One pair that tears on its way is given up, if the rest is reason enough to move.
                worst = waviest(waves)
                fewer = roles.without({worst} if roles.pairs[worst].reason == "matched" else ())
                if not too_different(a, b, fewer, behind, most=LEFT):
                    roles = fewer
                    tracks, notices = _moved_pairs(a, b, roles, paired, settings, names)
                    waves = waviness(a, b, roles, tracks)
                    exchange = too_different(a, b, roles, behind, waves)
        apart = contents_apart(a, b, roles, tracks) if may and not exchange else set()
        if apart:
            roles = roles.without(apart)
            tracks, notices = _moved_pairs(a, b, roles, paired, settings, names)
        if exchange:
            matched = (a, b), roles
            a, b = perceive(first, views[0]), perceive(second, views[1])
            roles = exchange_roles(a, b, roles, paired.scenes, behind)
            tracks, notices = _moved_pairs(a, b, roles, paired, settings, names)
            notices.insert(0, EXCHANGED_NOTICE)
        elif not (paired.pinned or paired.still or frame is not None):
            for k, one in bordered_tracks(a, b, roles, tracks).items():
                tracks[k] = tuple(map(Shared, one))
        anchors = (
            {role.first: tracks[k] for k, role in enumerate(roles.pairs)},
            {role.second: tracks[k] for k, role in enumerate(roles.pairs)},
        )
        if exchange:
            goings = exchange_goings(a, b, roles)
        else:
            goings = goings_between(
                (a, b), anchors, (roles.disappearing, roles.appearing), asked.change
            )
        parts: list[Part] = []
        named: set[str] = set()
        drawn = [
            _part(layer, a, b, roles, tracks, goings, frame) for layer in layers_of(a, b, roles)
        ]
        for part in joined_parts((part, paint) for part, paint, _ in drawn):
            parts.append(part if part.name not in named else replace(part, name=""))
            named.add(part.name)
    notices += [notice for _, _, own in drawn for notice in own]
    notices += [*paired.notices, *limits_of_pairs(a, b, roles)]
    return SceneMovement(
        tuple(parts), (a, b), roles, distinct(notices), tracks, settings, frame, matched
    )


def _moved_pairs(
    a: Scene,
    b: Scene,
    roles: Roles,
    paired: Paired,
    settings: FillSettings,
    names: tuple[str, str],
) -> tuple[dict[int, tuple[CurveTrack, ...]], list[Notice]]:
    """Tracks of every pair, as what each keeps to asks for, and what to tell of them."""
    tracks: dict[int, tuple[CurveTrack, ...]] = {}
    notices: list[Notice] = []
    mains = main_pairs(a, b, roles)
    for k in _largest_first(a, roles):
        role = roles.pairs[k]
        pair = role.first, role.second
        if pair in paired.still:
            tracks[k] = tuple(map(Shared, paired.still[pair]))
            continue
        mine = [p for p, own in paired.pinned.items() if own == pair]
        found, more = pair_tracks(k, a, b, roles, settings, names, mine, main=k in mains)
        tracks[k] = tuple(Shared(track) for track in kept_to(k, found, a, b, roles, tracks))
        notices += more
    return tracks, notices


def _largest_first(a: Scene, roles: Roles) -> list[int]:
    """Pairs so that what others keep to comes before them: what is closed, then longer lines."""
    first = np.array([role.first for role in roles.pairs], dtype=np.intp)
    lines = np.array([not (a.items[k].filled or a.items[k].closed) for k in first], dtype=bool)
    keys = first, -comparable(a.sizes[first]), lines, a.outlined[first] >= 0
    return [int(k) for k in np.lexsort(keys)]


def _part(
    layer: Layer,
    a: Scene,
    b: Scene,
    roles: Roles,
    tracks: dict[int, tuple[CurveTrack, ...]],
    goings: tuple[dict[int, Going], dict[int, Going]],
    frame: Frame | None,
) -> tuple[Part, PairPaint | None, tuple[Notice, ...]]:
    if layer.pair is not None:
        role = roles.pairs[layer.pair]
        one, other = of_one_kind(a.items[role.first], b.items[role.second])
        one, other, found = as_painted(one, other, tracks[layer.pair])
        notices: tuple[Notice, ...] = ()
        if not one.filled and (one.painted is not None or other.painted is not None):
            notices = (stroke_notice(one.name or other.name, "it is drawn as a line of one width"),)
        return *pair_part(one, other, found, frame, layer), notices
    if layer.disappearing is not None:
        item, going, end = a.items[layer.disappearing], goings[0][layer.disappearing], End.SOURCE
    else:
        assert layer.appearing is not None
        item, going, end = b.items[layer.appearing], goings[1][layer.appearing], End.TARGET
    part, notices = unmatched_part(item, going, end, frame)
    return part, None, notices
