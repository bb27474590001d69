"""One filled shape becoming another: its pieces and holes matched, meshed and moved."""

from collections.abc import Mapping

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ends import End
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.base.ranking import comparable
from shapetween.fill.appearing import AppearingRegion, Ground
from shapetween.fill.notices import (
    crossing_notices,
    facing_notices,
    fallback_notices,
    hole_notices,
    too_many_pieces,
    uncertain,
)
from shapetween.fill.pairing import Thing, pair_things
from shapetween.fill.regions import Region, regions_of
from shapetween.fill.settings import FillSettings
from shapetween.fill.small import blend_small
from shapetween.fill.splitting import split_alike
from shapetween.fill.track import FillTrack
from shapetween.geometry.rotation import rotations
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.outline.alone import looked_at, moved_alone
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.carry import affine_between
from shapetween.outline.fairing import faired
from shapetween.outline.matching import CORNERS, match_hole, match_outer
from shapetween.outline.preview import previewed_body
from shapetween.outline.straight import straightened
from shapetween.outline.unfold import bare, unfolded

__all__ = ["morph_fill"]

#: Most pieces of a shape that move in one plane, kept apart from each other. More cost too much.
MOST_TOGETHER = 12

#: Most pieces of a shape that get meshes, and the least share of the largest one's area that a
#: piece with a mesh has. Coasts have hundreds of islands.
MOST_MESHED, LEAST_MESHED = 16, 1e-3

#: The same share where pieces have very many curves, each of which takes time.
LEAST_ROUGH = 1e-2

#: Most holes of a piece that become holes of the other. Where there are more, as in an engraving,
#: the smaller ones close and open: none is known again, and each would take its time.
MOST_HOLES = 16

#: Share of a shape's area past which its largest piece is the shape, the others its islands.
MAIN = 0.5

#: Corners of the least coarse shape of a piece.
LEAST_CORNERS = 12

#: Curves of all pieces of both shapes past which one setting is all there is time for.
MANY_CURVES = 1500


def morph_fill(
    first: Shape, second: Shape, settings: FillSettings, names: tuple[str, str], *, alone: bool
) -> tuple[FillTrack, tuple[Notice, ...]]:
    """Prepare the movement of one filled shape, and what there is to tell.

    Parameters
    ----------
    first, second : Shape
        In one frame.
    settings : FillSettings
    names : tuple of str
        What messages call the drawings.
    alone : bool
        Whether they are all of their drawings, and may turn as a whole.
    """
    name = first.name or second.name
    with settings.observe("regions"):
        before, notices_a = regions_of(first, _called(first, names[0]))
        after, notices_b = regions_of(second, _called(second, names[1]))
        boxes = np.array([region.outer.box for region in (*before, *after)])
        scale = float(np.linalg.norm(np.ptp(boxes, axis=(0, 1))))
        divided = None
        if alone and first.style.stroke is None and second.style.stroke is None:
            divided = _divided(before, after)
        if divided is not None:
            before, after = divided
            fixed = [(k, k) for k in range(len(before))]
        else:
            fixed = [(0, 0)] if _is_main(before) and _is_main(after) else []
        pairing = pair_things(
            [_thing(r) for r in before], [_thing(r) for r in after], scale, fixed=fixed
        )
    notices = [*notices_a, *notices_b]
    bodies: list[list[RingMatch]] = []
    unmatched: list[tuple[Region, End, int]] = []
    meshed, small = _by_size(pairing.pairs, before, after)
    if len(pairing.pairs) > MOST_MESHED:
        notices.append(too_many_pieces(len(small), len(pairing.pairs), name))
    corners = _shared_corners([i for i, _ in meshed], before)
    single = alone and len(before) == len(after) == 1
    given = settings.given_to(name, [(before[i], after[j]) for i, j in meshed], alone=single)
    for (i, j), own in zip(meshed, given, strict=True):
        outer = match_outer(
            before[i].outer,
            after[j].outer,
            quads=settings.quads,
            pins=own.pins,
            mesh=own.mesh,
            upright=not alone or len(pairing.pairs) > 1,
            observe=settings.observe,
            corners=corners[i],
            choice=own.choice,
            meshed=settings.effort == "full",
        )
        # Of a drawing of many shapes each one's matching matters little, and few could be pinned.
        if alone and outer.matching.confidence == "unsure":
            notices.append(uncertain(alone=single))
        if single and not own.decides and outer.pair is not None:
            notices += facing_notices(outer)
        holes, others, failed = _matched_holes(before[i], after[j], outer, own.holes, settings)
        if failed:
            notices.append(
                Notice(
                    "hole-alone", f"{failed} holes cannot be matched", name, "they close and open"
                )
            )
        notices += hole_notices(before[i], after[j], MOST_HOLES, name)
        unmatched += [(Region(hole), end, len(bodies)) for hole, end in others]
        bodies.append([outer, *holes])
    with settings.observe("move"):
        decided = any(own.decides for own in given)
        carried, holder = _moved(bodies, settings, decided, touching=divided is not None)
        grounds = [Ground.of(body) for body in carried]
        appearing = [
            AppearingRegion.of(region.outer, (), end, grounds[holder[body]], is_hole=True)
            for region, end, body in unmatched
        ]
        contours = tuple(blend_small(before[i].outer, after[j].outer) for i, j in small)
        appearing += [
            AppearingRegion.of(hole, (), end, None, is_hole=True)
            for side, k, end in _ends_of(small)
            for hole in (before, after)[side][k].holes
        ]
        for side, only, end in (
            (before, pairing.first_only, End.SOURCE),
            (after, pairing.second_only, End.TARGET),
        ):
            on = grounds[0] if len(grounds) == 1 else None
            appearing += [AppearingRegion.of(side[k].outer, side[k].holes, end, on) for k in only]
    if settings.folds == "prevent":
        notices += [*crossing_notices(carried, name), *fallback_notices(carried, name)]
        if settings.effort == "full":
            notices += _limit_notices(bodies, name)
    track = FillTrack(name, tuple(carried), tuple(appearing), contours)
    return track, tuple(notices)


def _divided(
    before: tuple[Region, ...], after: tuple[Region, ...]
) -> tuple[tuple[Region, ...], tuple[Region, ...]] | None:
    """The pieces of both where one of a side divides into those of the other."""
    if len(before) == 1:
        parts = split_alike(before[0], after)
        return None if parts is None else (parts, after)
    if len(after) == 1:
        parts = split_alike(after[0], before)
        return None if parts is None else (before, parts)
    return None


def _shared_corners(chosen: list[int], pieces: tuple[Region, ...]) -> dict[int, int]:
    """How many corners the coarse shape of each piece may have, all together `CORNERS`."""
    sizes = {k: float(np.sqrt(abs(pieces[k].area))) for k in chosen}
    total = sum(sizes.values())
    return {k: max(LEAST_CORNERS, round(CORNERS * size / total)) for k, size in sizes.items()}


def _is_main(pieces: tuple[Region, ...]) -> bool:
    """Whether the first piece is most of the shape, and so becomes what is most of the other."""
    areas = [abs(piece.area) for piece in pieces]
    return areas[0] > MAIN * sum(areas)


def _by_size(
    pairs: tuple[tuple[int, int], ...], before: tuple[Region, ...], after: tuple[Region, ...]
) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Pairs of pieces that get meshes of their own, and those too many or too small for it."""
    sizes = [max(abs(before[i].area), abs(after[j].area)) for i, j in pairs]
    order = np.argsort(-comparable(sizes), kind="stable").tolist()
    curves = sum(len(piece.outer.curves) for piece in (*before, *after))
    least = LEAST_ROUGH if curves > MANY_CURVES else LEAST_MESHED
    meshed = {k for k in order[:MOST_MESHED] if sizes[k] >= least * sizes[order[0]]}
    return (
        [pair for k, pair in enumerate(pairs) if k in meshed],
        [pair for k, pair in enumerate(pairs) if k not in meshed],
    )


def _ends_of(pairs: list[tuple[int, int]]) -> list[tuple[int, int, End]]:
    """Side, index and end of both members of each pair."""
    return [(side, pair[side], End(side)) for pair in pairs for side in (0, 1)]


def _called(shape: Shape, file: str) -> str:
    return f"{file}: shape {shape.name!r}" if shape.name else file


def _thing(region: Region) -> Thing:
    return Thing(region.centre, float(np.sqrt(abs(region.area))))


def _matched_holes(
    first: Region,
    second: Region,
    outer: RingMatch,
    pins: Mapping[tuple[int, int], Points],
    settings: FillSettings,
) -> tuple[list[RingMatch], list[tuple[Outline, End]], int]:
    """Holes matched by pins or where the outer rings' own movement maps them, and those left.

    And how many pairs of those cannot be matched.
    """
    angle, stretch = affine_between(outer.samples.source, outer.samples.target)
    linear = rotations(np.asarray(angle)) @ stretch
    means = outer.samples.source.mean(axis=0), outer.samples.target.mean(axis=0)
    size = float(np.linalg.norm(np.ptp(second.outer.box, axis=0)))
    before = [_thing(Region(hole)) for hole in first.holes]
    grown = float(np.sqrt(np.linalg.det(linear)))
    mapped = [Thing((t.centre - means[0]) @ linear.T + means[1], t.size * grown) for t in before]
    after = [_thing(Region(hole)) for hole in second.holes]
    pairing = pair_things(mapped, after, size, fixed=list(pins))
    sizes = comparable([max(before[i].size, after[j].size) for i, j in pairing.pairs])
    free = np.array([pair not in pins for pair in pairing.pairs], dtype=bool)
    order = np.lexsort((-sizes, free)).tolist()
    chosen = sorted(pairing.pairs[k] for k in order[:MOST_HOLES])
    matched, alone, failed = [], [], 0
    for i, j in chosen:
        ends = first.holes[i], second.holes[j]
        try:
            matched.append(match_hole(*ends, float(angle), settings.observe, pins.get((i, j))))
        except OutlineError:
            alone += [(ends[0], End.SOURCE), (ends[1], End.TARGET)]
            failed += 1
    for side, holes in enumerate((first.holes, second.holes)):
        known = {pair[side] for pair in chosen}
        alone += [(hole, End(side)) for k, hole in enumerate(holes) if k not in known]
    return matched, alone, failed


def _moved(
    bodies: list[list[RingMatch]], settings: FillSettings, decided: bool, *, touching: bool
) -> tuple[list[Carried], list[int]]:
    """Movements of all bodies, and which of them each body is in.

    They move in one plane, which keeps them apart; where that fails, or they touch where one
    divides, each moves in its own.
    """
    each = list(range(len(bodies)))
    if settings.effort != "full":
        return [previewed_body(rings, settings.effort) for rings in bodies], each
    if settings.folds == "allow":
        return [bare(rings, settings.method) for rings in bodies], each
    together = None
    if 1 < len(bodies) <= MOST_TOGETHER and not touching:
        every = [ring for rings in bodies for ring in rings]
        together = straightened(faired(unfolded(every, settings.method)))
        if not together.crossing or together.detail:
            return [looked_at(together)], [0] * len(bodies)
    rough = _curves(bodies) > MANY_CURVES
    alone = [
        moved_alone(
            rings,
            settings.method,
            settings.quads,
            settings.observe,
            rough=rough,
            decided=rings[0].found == "given" or decided,
        )
        for rings in bodies
    ]
    if together is not None and together.crossing <= sum(body.crossing for body in alone):
        return [looked_at(together)], [0] * len(bodies)
    return alone, each


def _curves(bodies: list[list[RingMatch]]) -> int:
    """How many curves all rings have at both ends."""
    return sum(len(r.source.curves) + len(r.target.curves) for rings in bodies for r in rings)


def _limit_notices(bodies: list[list[RingMatch]], name: str) -> list[Notice]:
    """What to tell of limits on what is done to keep outlines from crossing."""
    notices = []
    if len(bodies) > MOST_TOGETHER:
        text = f"{len(bodies)} pieces are too many to be kept apart from each other"
        notices.append(Notice("apart", text, name, "each moves by itself", "note"))
    if _curves(bodies) > MANY_CURVES:
        text = "an outline of so many curves leaves time for one setting"
        notices.append(Notice("one-setting", text, name, "the first is taken", "note"))
    return notices
