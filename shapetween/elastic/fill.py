"""One filled shape becoming another: its pieces and holes matched, meshed and moved."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import islice

import numpy as np

from shapetween.attach.passengers import Deck, Passenger
from shapetween.attach.specks import morph_speck
from shapetween.attach.whole import MOTION_TIMES, WholeMotion
from shapetween.base.arrays import Points
from shapetween.base.errors import MeshError, OptionError, OutlineError
from shapetween.base.notices import Kind, Notice
from shapetween.base.observe import Observer
from shapetween.elastic.pairing import Thing, pair_things
from shapetween.elastic.parts import FilledPart
from shapetween.elastic.regions import Region, regions_of
from shapetween.elastic.splitting import split_alike
from shapetween.geometry.rotation import rotations
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Shape
from shapetween.model.gradients import has_gradient
from shapetween.model.outline import Outline
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.carry import affine_between
from shapetween.outline.matching import CORNERS, match_hole, match_outer, next_matches
from shapetween.outline.unfold import MOST_NODES, TOLERANCES, bare, unfolded

__all__ = ["FillSettings", "morph_fill"]

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

#: Next best matchings tried where the best one crosses. More cost seconds and are rarely right.
OTHER_MATCHINGS = 2

#: Distance of a pin from the pieces it may belong to, as a share of their size.
PIN_REACH = 0.05


@dataclass(slots=True, eq=False)
class FillSettings:
    """What the user asked of all filled shapes, and which of it has found its place.

    Attributes
    ----------
    method : str
    folds : {"prevent", "allow"}
    quads : int or None
    pins : (K, 4) float64
        In the movement's frame.
    meshes : sequence of (str, MeshPair)
        In the movement's frame, by name of shape.
    observe : Observer
    meshed : bool
        Whether every area moves by a mesh of its own, whatever simpler way there is.
    """

    method: str
    folds: str
    quads: int | None
    pins: Points
    meshes: Sequence[tuple[str, MeshPair]]
    observe: Observer
    meshed: bool = False
    used_pins: set[int] = field(default_factory=set)
    used_meshes: set[int] = field(default_factory=set)

    def has_mesh(self, name: str) -> bool:
        """Whether a mesh was given for the shape of that very name."""
        return bool(name) and any(name == known for known, _ in self.meshes)

    def mesh_for(self, name: str) -> MeshPair | None:
        """The next mesh given for pieces of a shape, in the order they are written in."""
        free = [k for k in range(len(self.meshes)) if k not in self.used_meshes]
        mine = [k for k in free if self.meshes[k][0] == name]
        mine = mine or [k for k in free if not self.meshes[k][0]]
        if not mine:
            return None
        self.used_meshes.add(mine[0])
        return self.meshes[mine[0]][1]

    def pins_for(self, first: Region, second: Region) -> Points:
        """Pins that lie on these two pieces, (K, 4)."""
        mine = []
        for k, pin in enumerate(self.pins):
            near = [_near(region, point) for region, point in ((first, pin[:2]), (second, pin[2:]))]
            if k not in self.used_pins and all(near):
                mine.append(k)
        self.used_pins.update(mine)
        return self.pins[mine]

    def check_used(self) -> None:
        """Refuse what belongs to no shape."""
        for k, pin in enumerate(self.pins):
            if k not in self.used_pins:
                ax, ay, bx, by = pin.tolist()
                raise OptionError(
                    f"pin {k + 1} ({ax:g},{ay:g} to {bx:g},{by:g} in the first drawing's units): "
                    "does not lie on two outlines that become each other"
                )
        unused = [name for k, (name, _) in enumerate(self.meshes) if k not in self.used_meshes]
        if unused:
            raise MeshError(f"mesh: there is no filled shape {unused[0]!r} to use it for")


def _near(region: Region, point: Points) -> bool:
    from shapetween.model.arclength import ArcLength

    size = float(np.linalg.norm(np.ptp(region.outer.box, axis=0)))
    return bool(ArcLength(region.outer).nearest(point)[1] <= PIN_REACH * size)


def morph_fill(
    first: Shape, second: Shape, settings: FillSettings, names: tuple[str, str], *, alone: bool
) -> tuple[FilledPart, tuple[Notice, ...]]:
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
        before, said_a = regions_of(first, _called(first, names[0]))
        after, said_b = regions_of(second, _called(second, names[1]))
        boxes = np.array([region.outer.box for region in (*before, *after)])
        scale = float(np.linalg.norm(np.ptp(boxes, axis=(0, 1))))
        divided = None
        if alone and first.style.stroke is None and second.style.stroke is None:
            divided = _divided(before, after)
        if divided is not None:
            before, after = divided
            settled = [(k, k) for k in range(len(before))]
        else:
            settled = [(0, 0)] if _is_main(before) and _is_main(after) else []
        pairing = pair_things(
            [_thing(r) for r in before], [_thing(r) for r in after], scale, fixed=settled
        )
    notices = [*said_a, *said_b]
    bodies: list[list[RingMatch]] = []
    strangers: list[tuple[Region, bool, int]] = []
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
    for i, j in meshed:
        outer = match_outer(
            before[i].outer,
            after[j].outer,
            quads=settings.quads,
            pins=settings.pins_for(before[i], after[j]),
            mesh=settings.mesh_for(name),
            upright=not alone or len(pairing.pairs) > 1,
            observe=settings.observe,
            corners=corners[i],
        )
        # Of a drawing of many shapes each one's matching matters little, and few could be pinned.
        if alone and outer.matching.confidence == "unsure":
            notices.append(
                Notice(
                    "uncertain",
                    "matched with little certainty",
                    instead="look at the matching with 'shapetween mesh' and correct it with --pin",
                )
            )
        holes, others = _matched_holes(before[i], after[j], outer, settings)
        notices += _of_limits(before[i], after[j], name)
        strangers += [(Region(hole), arrives, len(bodies)) for hole, arrives in others]
        bodies.append([outer, *holes])
    with settings.observe("move"):
        carried, holder = _moved(bodies, settings, touching=divided is not None)
        decks = [Deck.of(body) for body in carried]
        passengers = [
            Passenger.of(region.outer, (), arrives, decks[holder[body]], is_hole=True)
            for region, arrives, body in strangers
        ]
        specks = tuple(morph_speck(before[i].outer, after[j].outer) for i, j in small)
        passengers += [
            Passenger.of(hole, (), arrives, None, is_hole=True)
            for side, k, arrives in _ends_of(small)
            for hole in (before, after)[side][k].holes
        ]
        for side, only, arrives in (
            (before, pairing.first_only, False),
            (after, pairing.second_only, True),
        ):
            on = decks[0] if len(decks) == 1 else None
            passengers += [Passenger.of(side[k].outer, side[k].holes, arrives, on) for k in only]
    if settings.folds == "prevent":
        notices += [*_of_crossings(carried, name), *_of_fallbacks(carried, name)]
    styles = (first.style, second.style)
    motion = _whole_motion(carried) if any(map(has_gradient, styles)) else None
    part = FilledPart(name, styles, tuple(carried), tuple(passengers), specks, motion)
    return part, tuple(notices)


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
        crossing = [body for body in bodies if body.crossing and body.detail == detail]
        if crossing:
            worst = max(crossing, key=lambda body: body.crossing / body.checked)
            often = f"at {worst.crossing} of {worst.checked} times on the way"
            notices.append(Notice(kind, f"{text} {often}", name, more))
    return notices


def _of_fallbacks(bodies: list[Carried], name: str) -> list[Notice]:
    """What to tell of outlines that are not moved as outlines otherwise are."""
    notices = []
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


def _whole_motion(bodies: list[Carried]) -> WholeMotion | None:
    """The motion of all bodies as one."""
    inside, areas = zip(*(body.inside(MOTION_TIMES) for body in bodies), strict=True)
    return WholeMotion.of(np.concatenate(inside, axis=1), np.concatenate(areas))


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
    order = sorted(range(len(pairs)), key=lambda k: -sizes[k])
    curves = sum(len(piece.outer.curves) for piece in (*before, *after))
    least = LEAST_ROUGH if curves > MANY_CURVES else LEAST_MESHED
    meshed = {k for k in order[:MOST_MESHED] if sizes[k] >= least * sizes[order[0]]}
    return (
        [pair for k, pair in enumerate(pairs) if k in meshed],
        [pair for k, pair in enumerate(pairs) if k not in meshed],
    )


def _ends_of(pairs: list[tuple[int, int]]) -> list[tuple[int, int, bool]]:
    """Side, index and whether it arrives, of both members of each pair."""
    return [(side, pair[side], bool(side)) for pair in pairs for side in (0, 1)]


def _called(shape: Shape, file: str) -> str:
    return f"{file}: shape {shape.name!r}" if shape.name else file


def _thing(region: Region) -> Thing:
    return Thing(region.centre, float(np.sqrt(abs(region.area))))


def _matched_holes(
    first: Region, second: Region, outer: RingMatch, settings: FillSettings
) -> tuple[list[RingMatch], list[tuple[Outline, bool]]]:
    """Holes matched where the outer rings' own movement puts them, and those left over."""
    angle, stretch = affine_between(outer.samples.source, outer.samples.target)
    linear = rotations(np.asarray(angle)) @ stretch
    means = outer.samples.source.mean(axis=0), outer.samples.target.mean(axis=0)
    size = float(np.linalg.norm(np.ptp(second.outer.box, axis=0)))
    before = [_thing(Region(hole)) for hole in first.holes]
    grown = float(np.sqrt(np.linalg.det(linear)))
    put = [Thing((t.centre - means[0]) @ linear.T + means[1], t.size * grown) for t in before]
    after = [_thing(Region(hole)) for hole in second.holes]
    pairing = pair_things(put, after, size)
    sizes = [-max(before[i].size, after[j].size) for i, j in pairing.pairs]
    order = np.argsort(sizes, kind="stable").tolist()
    chosen = sorted(pairing.pairs[k] for k in order[:MOST_HOLES])
    matched, alone = [], []
    for i, j in chosen:
        try:
            matched.append(
                match_hole(first.holes[i], second.holes[j], float(angle), settings.observe)
            )
        except OutlineError:
            alone += [(first.holes[i], False), (second.holes[j], True)]
    for side, holes in enumerate((first.holes, second.holes)):
        known = {pair[side] for pair in chosen}
        alone += [(hole, bool(side)) for k, hole in enumerate(holes) if k not in known]
    return matched, alone


def _moved(
    bodies: list[list[RingMatch]], settings: FillSettings, *, touching: bool
) -> tuple[list[Carried], list[int]]:
    """Movements of all bodies, and which of them each body is in.

    They move in one plane, which keeps them apart; where that fails, or they touch where one
    divides, each moves in its own.
    """
    each = list(range(len(bodies)))
    if settings.folds == "allow":
        return [bare(rings, settings.method) for rings in bodies], each
    together = None
    if 1 < len(bodies) <= MOST_TOGETHER and not touching:
        together = unfolded([ring for rings in bodies for ring in rings], settings.method)
        if not together.crossing or together.detail:
            return [together], [0] * len(bodies)
    curves = sum(len(r.source.curves) + len(r.target.curves) for rings in bodies for r in rings)
    alone = [_alone(rings, settings, rough=curves > MANY_CURVES) for rings in bodies]
    if together is not None and together.crossing <= sum(c.crossing for c in alone):
        return [together], [0] * len(bodies)
    return alone, each


def _alone(rings: list[RingMatch], settings: FillSettings, *, rough: bool) -> Carried:
    """One body in a plane of its own; where it crosses, by the next best matching.

    Of a rough shape's bodies none is worth that much time.
    """
    outer, holes = rings[0], rings[1:]
    best = unfolded(rings, settings.method, TOLERANCES[:1] if rough else TOLERANCES)
    pinned = outer.found == "given" or len(settings.used_pins) > 0
    if rough or outer.coarse or pinned or not best.crossing or len(best.nodes.ends[0]) > MOST_NODES:
        return best
    for other in islice(next_matches(outer, settings.quads, settings.observe), OTHER_MATCHINGS):
        found = unfolded([other, *holes], settings.method, TOLERANCES[:2])
        if found.crossing < best.crossing:
            best = found
        if not best.crossing:
            break
    return best
