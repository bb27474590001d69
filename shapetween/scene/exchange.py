"""Whether two drawings have so little in common that one goes as a whole and the other comes.

To move the parts of a bicycle into those of a taxi shows for half of the time what is neither. What
is drawn whole at any time is better then, small where it changes.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.scene.assign import Role, Roles
from shapetween.scene.backdrops import backdrops
from shapetween.scene.disturbance import holes_apart, intricacy, recoloured
from shapetween.scene.doubtful import nothing_corresponds, share_of_hull
from shapetween.scene.forms import RoundedBox, Segment
from shapetween.scene.items import Item
from shapetween.scene.likeness import goes_elsewhere
from shapetween.scene.pairs import of_one_kind
from shapetween.scene.relations import Scene, drawn_box, in_common, picture
from shapetween.scene.torn import closes
from shapetween.scene.unmatched.going import Going
from shapetween.scene.unmatched.presence import Leaving

if TYPE_CHECKING:
    import shapely

__all__ = [
    "LEFT",
    "behind_both",
    "difference",
    "exchange_goings",
    "exchange_roles",
    "too_different",
]

Behind: TypeAlias = tuple[Mask, Mask]
"""Which items of either drawing are behind all else."""

#: Sum of what counts against moving, less what it keeps, from which on drawings are exchanged.
#: Fitted with the weights below to pairs judged by fresh eyes as they moved: of those above it that
#: moved 3 were ready, 21 not. Smaller, and an apple leaves for a pear to come; larger, and the hand
#: that holds a gift crumples into a card.
EXCHANGED = 0.7

#: The same of drawings in lines, in which every bump is seen: of 14 pairs above it that moved one
#: looked well. Smaller, and a bell leaves for one that is crossed out; larger, and a plane crumples
#: into a bookmark.
EXCHANGED_LINES = 0.6

#: The same once a pair has been given up that tears on its way: what is left must be reason enough.
#: Larger, and a disk's border alone moves on to be part of a crossed out letter; smaller, and an
#: arrow leaves because its tray becomes a cloud.
LEFT = 0.45

#: The same of drawings whose pairs change their colours, between which mud is seen. Of 16 such
#: pairs between both values that moved, 1 was ready. Smaller, and a red apple leaves for a green
#: pear to come; larger, and a snail is mud before it is a turtle.
EXCHANGED_COLOURED = 0.52

#: What counts, beside how little drawings have in common, of a turn that outlines of what changes
#: have, of one that is on the way alone, and of holes that have no counterparts: of 13 pairs with
#: such holes none looked well as it moved.
INTRICATE, WAVY, PIERCING = 0.2, 7.0, 1.0

#: By how much more must count where one drawing is one thing that has a partner. Smaller, and a sun
#: leaves for a moon to come; larger, and a rocket becomes a star.
ONE_THING = 0.36

#: What counts, beside the share of both drawings that has no partner, of how unlike the largest
#: pair's pictures are, and of how much more of its hull one of that pair fills.
UNLIKE, HOLLOW = 0.5, 1.0

#: Way of a pair, as a share of the drawing, and logarithm of its sizes, from which on together
#: nothing of a drawing is kept by it. Smaller, and what makes room for a badge is not seen to stay;
#: larger, and an angle becomes the fold of a sheet that comes across it.
OFF_WAY, OFF_SIZES = 0.3, 0.5

#: Distance of the ends of a line, as a share of its length, up to which it is seen as an outline.
#: Larger, and an arc is a disc; smaller, and a bolt drawn with a gap is nothing like a bolt.
NEARLY_CLOSED = 0.15

#: How far beside an open line one lies that is like it, as a share of its size. Smaller, and two
#: clouds drawn by hand have nothing in common; larger, and all lines are blots.
BESIDE = 0.06

#: Likeness of pictures, greatest way as a share of the drawing, and logarithm of sizes, of layers
#: of one thing. Looser, and rings in rings are layers; stricter, and shades drawn by hand are none.
LAYER_LIKE, LAYER_WAY, LAYER_SIZES = 0.85, 0.04, 0.12

#: Greatest way, as a share of the drawing, and ratio of sizes of what stays although the drawings
#: are exchanged: the ground that both stand on.
GROUND_WAY, GROUND_SIZES = 0.12, 2.0

#: Greatest difference of colours of the ground.
GROUND_COLOUR = 0.15

#: When the first drawing goes, and when the second comes: it shrinks to nothing first, before half
#: of the time, so that no frame half-way is blank. Of 14 pairs of icons shown to three fresh judges
#: two found all ready so, one 13. Overlapping, both are a lump in the middle; where one
#: leaps at some size to be the other, a cut is seen; apart, nothing is seen for a while.
GOES, COMES = (0.0, 0.44), (0.44, 1.0)

#: Power of size by which lines thin. At 1 they are pale when small; at 0 what is close clots.
THINS = 0.6

#: Share of both drawings, by size, from which on they are drawn in lines. Smaller, and emoji with
#: an outline are; larger, and a line drawing with a dot is none.
LINES = 0.5


def behind_both(a: Scene, b: Scene, roles: Roles) -> Behind:
    """What of either drawing is its sheet or a backdrop, or that one's outline."""
    cards = [roles.pairs[k] for k in backdrops(a, b, roles)]
    found = []
    for scene, own in ((a, [c.first for c in cards]), (b, [c.second for c in cards])):
        behind = scene.sheets | np.isin(scene.outlined, own)
        behind[own] = True
        found.append(np.asarray(behind))
    return found[0], found[1]


def too_different(
    a: Scene,
    b: Scene,
    roles: Roles,
    behind: Behind,
    waves: Mapping[int, float] | None = None,
    most: float | None = None,
) -> bool:
    """Whether two drawings are to be exchanged.

    One thing becomes one other, whatever the two are (of single areas with holes
    `shapetween.scene.pierced.pierced_apart` is asked).

    Parameters
    ----------
    a, b : Scene
    roles : Roles
        Who would become whom.
    behind : (mask, mask)
        What `behind_both` finds.
    waves : mapping of int to float, optional
        The `waviness` of each pair as it would move; without, it is asked whether they differ too
        much however it does.
    most : float, optional
        What may count against moving.
    """
    counts = [int((~own).sum()) for own in behind]
    firsts, seconds = _ends(roles, behind)
    paired = len(firsts) > 0
    if min(counts) == 0 or (paired and max(counts) == 1):
        return False
    if paired and all(isinstance(form, Segment) for scene in (a, b) for form in scene.forms):
        return False  # bars turn into whatever other bars are
    # One thing, and who it would become.
    alone = _main_pair(a, b, firsts, seconds)[:2] if paired and min(counts) == 1 else None
    if alone is not None and nothing_corresponds(
        *of_one_kind(a.items[alone[0]], b.items[alone[1]])
    ):
        return True
    against = difference(a, b, roles, behind) + INTRICATE * intricacy(a, b, roles)
    against += PIERCING * holes_apart(a, b, roles)
    if waves is not None:
        against += WAVY * max(waves.values(), default=0.0)
    lines = _in_lines(a, b)
    plain = EXCHANGED_COLOURED if recoloured(a, b, firsts, seconds) else EXCHANGED
    least = most or (EXCHANGED_LINES if lines else plain)
    if alone is not None:
        forms = a.forms[alone[0]], b.forms[alone[1]]
        # Of lines, only a circle becomes whatever it is.
        if not lines or any(isinstance(form, RoundedBox) and form.round for form in forms):
            least += ONE_THING
    return bool(np.round(against, 6) > least)


def difference(a: Scene, b: Scene, roles: Roles, behind: Behind) -> float:
    """How little two drawings have in common, less what the largest pair keeps of a drawing.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
        Who would become whom.
    behind : (mask, mask)
        What `behind_both` finds.
    """
    firsts, seconds = _ends(roles, behind)
    sizes = [np.where(own, 0.0, scene.sizes) for scene, own in zip((a, b), behind, strict=True)]
    # Light and shade that cover a thing as a whole count with it, or not at all: a body of many
    # such layers has most of a drawing's weight, whatever there is on it.
    once = [np.where(_layers(s), 0.0, own) for s, own in zip((a, b), sizes, strict=True)]
    alone = max(_alone(sizes, (firsts, seconds)), _alone(once, (firsts, seconds)))
    if not len(firsts):
        return float(alone + UNLIKE)
    i, j, weight = _main_pair(a, b, firsts, seconds)
    one, other = a.items[i], b.items[j]
    areas = one.filled and other.filled
    bodies = [item.drawn if areas else _body(item) for item in (one, other)]
    seen = [picture(body, np.reshape(body.bounds, (2, 2)))[None] for body in bodies]
    alike = float(in_common(seen[0], seen[1])[0, 0])
    scale = (a.scale + b.scale) / 2
    if closes(one, other, scale):
        # A ring that comes down onto an open line has little of its place and of its hull.
        return alone - alike * weight
    stays = one.closed == other.closed
    kept = alike * weight if stays and not _goes_off(a, b, i, j, scale) else 0.0
    lines = not (one.filled or one.closed or other.filled or other.closed)
    hollow = 0.0 if lines else abs(share_of_hull(bodies[0]) - share_of_hull(bodies[1]))
    return float(alone + UNLIKE * (1 - alike) + HOLLOW * hollow - kept)


def _goes_off(a: Scene, b: Scene, i: int, j: int, scale: float) -> bool:
    """Whether one of a pair is elsewhere in its drawing and of another size."""
    way = float(np.linalg.norm(a.centres[i] - b.centres[j]))
    growth = abs(float(np.log(a.sizes[i] / b.sizes[j])))
    return way > OFF_WAY * scale and growth > OFF_SIZES


def _ends(roles: Roles, behind: Behind) -> tuple[Index, Index]:
    """Items of both drawings that become each other, but for what is behind all else."""
    pairs = [role for role in roles.pairs if not behind[0][role.first]]
    firsts = np.array([role.first for role in pairs], dtype=np.intp)
    seconds = np.array([role.second for role in pairs], dtype=np.intp)
    return firsts, seconds


def _main_pair(a: Scene, b: Scene, firsts: Index, seconds: Index) -> tuple[int, int, float]:
    """The largest of some pairs that tells more than a line, and its size as a share."""
    weights = np.minimum(a.sizes[firsts] / a.scale, b.sizes[seconds] / b.scale)
    # A straight line that goes elsewhere is like any other, and no reason to move.
    telling = np.array(
        [not goes_elsewhere(a.forms[i], b.forms[j]) for i, j in zip(firsts, seconds, strict=True)]
    )
    weights[~telling] *= 1e-3
    k = int(np.round(weights, 9).argmax())
    return int(firsts[k]), int(seconds[k]), float(weights[k])


def _body(item: Item) -> "shapely.Geometry":
    """What an item is from afar: what it goes round, or of an open line what is beside it."""
    import shapely

    if item.filled:
        return item.enclosed
    points = item.chords
    gap = float(np.linalg.norm(points[-1] - points[0]))
    if (item.closed or gap < NEARLY_CLOSED * item.length) and len(points) > 3:
        area = shapely.make_valid(shapely.Polygon(points))
        if area.area > 0:
            return area
    return item.drawn.buffer(BESIDE * float(np.hypot(*np.ptp(item.box, axis=0))))


def _alone(sizes: Sequence[Floats], paired: tuple[Index, Index]) -> float:
    """Share of both drawings' sizes that has no partner."""
    return float(1 - sum(s[own].sum() / s.sum() for s, own in zip(sizes, paired, strict=True)) / 2)


def _layers(scene: Scene) -> Mask:
    """Which items lie on one that has their outline."""
    away = np.linalg.norm(scene.centres[:, None] - scene.centres, axis=-1)
    same = in_common(scene.pictures, scene.pictures) > LAYER_LIKE
    same &= away < LAYER_WAY * scene.scale
    same &= np.abs(np.log(scene.sizes[:, None] / scene.sizes)) < LAYER_SIZES
    return np.asarray(np.tril(same, -1).any(axis=1))


def exchange_roles(
    a: Scene, b: Scene, roles: Roles, cut: tuple[Scene, Scene], behind: Behind
) -> Roles:
    """Roles of drawings that are exchanged: all is alone but what is behind or below it.

    Parameters
    ----------
    a, b : Scene
        As drawn.
    roles : Roles
        Who would become whom.
    cut : (Scene, Scene)
        What those are the roles of: with items that are cut into several.
    behind : (mask, mask)
        What `behind_both` finds in those.
    """
    places = [{id(item): k for k, item in enumerate(scene.items)} for scene in (a, b)]
    staying = []
    for role in roles.pairs:
        first = places[0].get(id(cut[0].items[role.first]))
        second = places[1].get(id(cut[1].items[role.second]))
        if first is None or second is None:
            continue
        if (behind[0][role.first] and behind[1][role.second]) or _is_ground(first, second, a, b):
            staying.append(Role(first, second, role.cost, role.reason))
    ends = {role.first for role in staying}, {role.second for role in staying}
    disappearing, appearing = (
        tuple(k for k in range(len(scene.items)) if k not in own)
        for scene, own in zip((a, b), ends, strict=True)
    )
    return Roles(
        tuple(staying),
        disappearing,
        appearing,
        (np.inf,) * len(disappearing),
        (np.inf,) * len(appearing),
    )


def exchange_goings(a: Scene, b: Scene, roles: Roles) -> tuple[dict[int, Going], dict[int, Going]]:
    """How the items of a drawing that is exchanged go together, and those of the other come.

    They shrink to one place, midway between the middles of both, or on the ground where one stays.

    Parameters
    ----------
    a, b : Scene
    roles : Roles
        What `exchange_roles` gives.
    """
    ends = (a, roles.disappearing, GOES), (b, roles.appearing, COMES)
    place = np.mean([_foot(scene, lone) for scene, lone, _ in ends], axis=0)
    thins = THINS if _in_lines(a, b) else 1.0
    sheet = Going(Leaving((0.0, 1.0), fades=True))
    one, other = (
        {k: sheet if scene.sheets[k] else Going(Leaving(window, place, thins=thins)) for k in lone}
        for scene, lone, window in ends
    )
    return one, other


def _in_lines(a: Scene, b: Scene) -> bool:
    """Whether two drawings are drawn in lines."""
    lines = [
        float(
            s.sizes[[not item.filled and s.outlined[k] < 0 for k, item in enumerate(s.items)]].sum()
        )
        for s in (a, b)
    ]
    whole = [float(s.sizes[~s.sheets].sum()) for s in (a, b)]
    return all(own >= LINES * of > 0 for own, of in zip(lines, whole, strict=True))


def _foot(scene: Scene, lone: Sequence[int]) -> Points:
    """The middle of what goes or comes, (2,), or its foot where something below it stays."""
    alone = np.zeros(len(scene.items), dtype=bool)
    alone[list(lone)] = True
    box = drawn_box(scene.items, scene.sheets | ~alone)
    place = box.mean(axis=0)
    stays = [scene.items[k].box[0, 1] for k in np.flatnonzero(~alone & ~scene.sheets)]
    if stays and min(stays) > place[1]:
        place[1] = box[1, 1]
    return np.asarray(place)


def _is_ground(i: int, j: int, a: Scene, b: Scene) -> bool:
    """Whether a pair is the ground: a disc or box below all else, near by."""
    forms = a.forms[i], b.forms[j]
    if not all(isinstance(form, RoundedBox) for form in forms):
        return False
    scale = (a.scale + b.scale) / 2
    grounds = all(
        scene.parents[k] < 0 and scene.items[k].centre[1] >= _lowest(scene, k)
        for scene, k in ((a, i), (b, j))
    )
    return bool(
        grounds
        and np.linalg.norm(a.centres[i] - b.centres[j]) < GROUND_WAY * scale
        and abs(np.log(a.sizes[i] / b.sizes[j])) < np.log(GROUND_SIZES)
        and np.abs(a.colours[i] - b.colours[j]).sum() < GROUND_COLOUR
    )


def _lowest(scene: Scene, ground: int) -> float:
    """The lowest middle of all other things of a drawing."""
    return max(
        (
            float(item.centre[1])
            for k, item in enumerate(scene.items)
            if k != ground and not scene.sheets[k]
        ),
        default=-np.inf,
    )
