"""Whether two drawings have so little in common that one goes as a whole and the other comes.

To move the parts of a bicycle into those of a taxi shows for half of the time what is neither. What
is drawn whole at any time is better then, small where it changes.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask
from shapetween.scene.assign import Roles
from shapetween.scene.backdrops import backdrops, one_is_a_face
from shapetween.scene.disturbance import holes_apart, intricacy, recoloured
from shapetween.scene.doubtful import nothing_corresponds, share_of_hull
from shapetween.scene.forms import RoundedBox, Segment
from shapetween.scene.items import Item
from shapetween.scene.likeness import goes_elsewhere
from shapetween.scene.pairs import of_one_kind
from shapetween.scene.relations import Scene, in_common, picture
from shapetween.scene.torn import closes

if TYPE_CHECKING:
    import shapely

__all__ = [
    "LEFT",
    "behind_both",
    "difference",
    "in_lines",
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

#: Size of the largest pair of lines, as a share of either drawing, from which on those have most of
#: what is seen in common, and by how much more must count then. Of 4 such pairs that fresh eyes saw
#: both ways all were rather seen moving; of 6 pairs of areas that moved 4 were bad. Smaller, and
#: most of what moves then is rather seen to leave; larger, and a cloud leaves for one that is open.
MOSTLY, IN_COMMON = 0.6, 0.5

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
    main = _main_pair(a, b, firsts, seconds) if paired else None
    # One thing, and who it would become.
    alone = main[:2] if main is not None and min(counts) == 1 else None
    if alone is not None and nothing_corresponds(
        *of_one_kind(a.items[alone[0]], b.items[alone[1]])
    ):
        return True
    changes = recoloured(a, b, firsts, seconds)
    if changes and main is not None and alone is None and one_is_a_face(a, b, *main[:2]):
        return True  # half-way its features would be on a thing of mud
    against = difference(a, b, roles, behind) + INTRICATE * intricacy(a, b, roles)
    against += PIERCING * holes_apart(a, b, roles)
    if waves is not None:
        against += WAVY * max(waves.values(), default=0.0)
    lines = in_lines(a, b)
    plain = EXCHANGED_COLOURED if changes else EXCHANGED
    least = most or (EXCHANGED_LINES if lines else plain)
    if main is not None and lines and _mostly_one(a, b, *main):
        least += IN_COMMON
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


def _mostly_one(a: Scene, b: Scene, i: int, j: int, weight: float) -> bool:
    """Whether a pair is most of both drawings, and is not torn open."""
    one, other = a.items[i], b.items[j]
    kept = one.closed == other.closed or closes(one, other, (a.scale + b.scale) / 2)
    return kept and round(weight, 6) >= MOSTLY


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


def in_lines(a: Scene, b: Scene) -> bool:
    """Whether two drawings are drawn in lines."""
    lines = [
        float(
            s.sizes[[not item.filled and s.outlined[k] < 0 for k, item in enumerate(s.items)]].sum()
        )
        for s in (a, b)
    ]
    whole = [float(s.sizes[~s.sheets].sum()) for s in (a, b)]
    return all(own >= LINES * of > 0 for own, of in zip(lines, whole, strict=True))
