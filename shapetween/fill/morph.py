"""One filled shape becoming another: its pieces and holes matched, meshed and moved."""

from collections.abc import Mapping

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ends import End
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Kind, Notice
from shapetween.base.ranking import comparable
from shapetween.fill.appearing import AppearingRegion, Ground
from shapetween.fill.pairing import Thing, pair_things
from shapetween.fill.regions import Region, regions_of
from shapetween.fill.settings import FillSettings
from shapetween.fill.small import blend_small
from shapetween.fill.splitting import split_alike
from shapetween.fill.track import FillTrack
from shapetween.geometry.rotation import rotations
from shapetween.match import Matcher
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.outline.alone import looked_at, moved_alone
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.carry import affine_between
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
        before, told_a = regions_of(first, _called(first, names[0]))
        after, told_b = regions_of(second, _called(second, names[1]))
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
    notices = [*told_a, *told_b]
    bodies: list[list[RingMatch]] = []
    unmatched: list[tuple[Region, End, int]] = []
    meshed, small = _by_size(pairing.pairs, before, after)
    if len(pairing.pairs) > MOST_MESHED:
        more = len(small)
        notices.append(
            Notice(
                "too-many-pieces",
                f"{more} of {len(pairing.pairs)} pieces are too many or too small for meshes",
                name,
                "they move straight",
                severity="note",
            )
        )
    corners = _shared_corners([i for i, _ in meshed], before)
    lone = alone and len(before) == len(after) == 1
    given = settings.given_to(name, [(before[i], after[j]) for i, j in meshed], lone=lone)
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
            notices.append(
                Notice(
                    "uncertain",
                    "matched with little certainty",
                    instead="'shapetween alternatives' shows what else it may be, to be taken with "
                    "--matching, and --pin corrects it"
                    if lone
                    else "look at the matching with 'shapetween mesh' and correct it with --pin",
                )
            )
        if lone and not own.settles and outer.pair is not None:
            notices += _of_facing(outer)
        holes, others = _matched_holes(before[i], after[j], outer, own.holes, settings)
        notices += _of_limits(before[i], after[j], name)
        unmatched += [(Region(hole), end, len(bodies)) for hole, end in others]
        bodies.append([outer, *holes])
    with settings.observe("move"):
        settled = any(own.settles for own in given)
        carried, holder = _moved(bodies, settings, settled, touching=divided is not None)
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
        notices += [*_of_crossings(carried, name), *_of_fallbacks(carried, name)]
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


def _of_facing(outer: RingMatch) -> list[Notice]:
    """What to tell of two outlines that seem to face opposite ways."""
    if outer.coarse or not Matcher(outer.source, outer.target).faces_other_way(outer.matching):
        return []
    remedy = "--flip b mirrors the second one"
    return [Notice("facing", f"the drawings seem to face opposite ways; {remedy}")]


def _of_crossings(bodies: list[Carried], name: str) -> list[Notice]:
    """What to tell of outlines that cross on the way: of the worst body of each kind."""
    kinds: tuple[tuple[bool, Kind, str, str], ...] = (
        (False, "crossing", "the outline crosses itself", "pins on the parts that cross may help"),
        (
            True,
            "details-touch",
            "small details of the outline run into each other",
            "its large parts do not",
        ),
    )
    notices = []
    for detail, kind, text, more in kinds:
        seen = [body for body in bodies if body.crossing and not body.seen.nothing]
        crossing = [body for body in seen if body.detail == detail]
        if crossing:
            worst = max(crossing, key=lambda body: body.crossing / body.checked)
            wide = f"by {1000 * worst.seen.width:.2g} of 1000 pixels"
            often = f"at {worst.crossing} of {worst.checked} times on the way, {wide}"
            notices.append(Notice(kind, f"{text} {often}", name, more))
    return notices


def _of_fallbacks(bodies: list[Carried], name: str) -> list[Notice]:
    """What to tell of outlines that are not moved as outlines otherwise are."""
    notices = []
    if any(body.other_matching for body in bodies):
        notices.append(
            Notice(
                "other-matching",
                "the best matching makes the outline cross itself on the way",
                name,
                "another is taken that costs little more",
            )
        )
    if any(body.parted for body in bodies):
        notices.append(
            Notice(
                "parted",
                "parts of the outline would run into each other on the way",
                name,
                "they are kept apart",
                "note",
            )
        )
    if any(body.bare for body in bodies):
        notices.append(
            Notice("bare-mesh", "nothing keeps the outline from folding", name, "its mesh moves it")
        )
    if any(ring.coarse for body in bodies for ring in body.nodes.rings):
        notices.append(
            Notice(
                "coarse",
                "an outline of so many curves is matched and moved by a simpler one",
                name,
                "its details go along",
                severity="note",
            )
        )
    return notices


def _of_limits(first: Region, second: Region, name: str) -> list[Notice]:
    """What to tell of more holes than are matched."""
    most = min(len(first.holes), len(second.holes))
    if most <= MOST_HOLES:
        return []
    return [
        Notice(
            "too-many-holes",
            f"a piece has {most} holes, of which {MOST_HOLES} become holes of the other",
            name,
            "the rest close and open",
        )
    ]


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
) -> tuple[list[RingMatch], list[tuple[Outline, End]]]:
    """Holes matched by pins or where the outer rings' own movement puts them, and those left."""
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
    matched, alone = [], []
    for i, j in chosen:
        ends = first.holes[i], second.holes[j]
        try:
            matched.append(match_hole(*ends, float(angle), settings.observe, pins.get((i, j))))
        except OutlineError:
            alone += [(ends[0], End.SOURCE), (ends[1], End.TARGET)]
    for side, holes in enumerate((first.holes, second.holes)):
        known = {pair[side] for pair in chosen}
        alone += [(hole, End(side)) for k, hole in enumerate(holes) if k not in known]
    return matched, alone


def _moved(
    bodies: list[list[RingMatch]], settings: FillSettings, settled: bool, *, touching: bool
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
        together = straightened(unfolded(every, settings.method))
        if not together.crossing or together.detail:
            return [looked_at(together)], [0] * len(bodies)
    curves = sum(len(r.source.curves) + len(r.target.curves) for rings in bodies for r in rings)
    alone = [
        moved_alone(
            rings,
            settings.method,
            settings.quads,
            settings.observe,
            rough=curves > MANY_CURVES,
            settled=rings[0].found == "given" or settled,
        )
        for rings in bodies
    ]
    if together is not None and together.crossing <= sum(body.crossing for body in alone):
        return [looked_at(together)], [0] * len(bodies)
    return alone, each
