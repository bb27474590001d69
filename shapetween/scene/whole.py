"""Whether a whole drawing is another one turned or mirrored, so that it turns as one."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Affine, Floats, Points
from shapetween.model.gradients import moved_style
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.outline.carry import affine_between
from shapetween.scene.assign import alike_in_place
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Frame
from shapetween.scene.relations import Scene, perceive
from shapetween.scene.strokes.outlined import as_lines

__all__ = ["frame_between", "moved_items", "moved_paint", "turns_over", "with_lines"]

#: Turns that are tried, radians, and least likeness of the turned drawing, and what it must be more
#: than the unturned one's. Half right angles are asked for more: feet would do them by chance.
TURNS = (np.pi / 2, -np.pi / 2, np.pi, np.pi / 4, -np.pi / 4)
LIKE, BETTER = 0.85, 0.2
LIKE_OBLIQUE, BETTER_OBLIQUE = 0.93, 0.4

#: What the mirrored drawing must be like more than any turned one to turn over as a card does, and
#: its items more alike in place, together. Arrows are their own mirror images, and turn.
OVER = 0.04

#: Least size of an item, as a share of the drawing, that is alike in place and so forbids a turn.
STAYS = 0.25

#: Least share, by size, of what is alike in place once the drawing is turned: other drawings may
#: turn into the same silhouette by chance.
ALIKE = 0.6

#: Logarithm of lengths up to which items may be the same, turned. Smaller, and what was drawn
#: again for the other way is not known; larger, and more drawings are compared in vain.
LENGTHS = 0.25

#: Points along each side of the grid that drawings are compared on.
GRID = 48

#: How much less alike items may be that are compared after a turn.
LOOSE = 2.5

#: Residual of a similarity, as a share of the drawing, up to which it is exact.
EXACT = 2e-4


def frame_between(a: Scene, b: Scene) -> Frame | None:
    """The frame in which one drawing turns into the other; None if it does not."""
    exact = _affine(a, b)
    if exact is not None:
        return exact
    if not _of_same_lengths(a, b) or _something_stays(a, b):
        return None
    places = _places(a)
    drawn = _grid(a, places)
    plain = _like(places, drawn, b, _frame(a, b, 0.0))
    ways = [(_frame(a, b, turn), abs(abs(turn) - np.pi / 4) < 1e-9) for turn in TURNS]
    ways += [(_frame(a, b, 0.0, over), False) for over in (0, 1)]
    found: list[tuple[float, Frame]] = []
    for frame, oblique in ways:
        like = _like(places, drawn, b, frame)
        least, better = (LIKE_OBLIQUE, BETTER_OBLIQUE) if oblique else (LIKE, BETTER)
        if like > least and like > plain + better:
            alike = _share_alike(a, b, frame)
            if alike > ALIKE:
                found.append((round(like + alike - OVER * (frame.over >= 0), 6), frame))
    best = max((score for score, _ in found), default=0.0)
    over = [frame for score, frame in found if frame.over >= 0 and score == best]
    # Of turns the first one, which is the shortest.
    turned = [frame for _, frame in found if frame.over < 0]
    return next(iter(over + turned), None)


def turns_over(one: Item, other: Item) -> bool:
    """Whether an item is another one's mirror image, and so turns over to become it."""
    longer = [item.length / max(item.extent, 1e-9 * item.length) for item in (one, other)]
    if abs(np.log(longer[0] / longer[1])) > LENGTHS:
        return False
    view = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])
    frame = frame_between(perceive([one], view), perceive([other], view))
    return frame is not None and frame.over >= 0


def with_lines(
    one: Sequence[Item], other: Sequence[Item], views: tuple[Points, Points]
) -> tuple[tuple[Item, ...], tuple[Item, ...]]:
    """Both drawings' items, with areas that are outlined strokes as lines.

    Where one drawing is the other turned, but just one of them would have lines, neither has: they
    are alike.
    """
    found = as_lines(one, other)
    uneven = len(one) == len(other) and len(found[0]) != len(found[1])
    if uneven and frame_between(perceive(one, views[0]), perceive(other, views[1])) is not None:
        return tuple(one), tuple(other)
    return found


def moved_items(scene: Scene, frame: Frame) -> tuple[Item, ...]:
    """The second drawing's items as they are in the frame."""
    found = []
    for item in scene.items:
        moved = item.transformed(frame.back)
        if frame.over >= 0 and item.filled:
            moved = moved.replaced(_clockwise(moved.rings))
        if frame.over >= 0 and moved.painted is not None:
            painted = replace(moved.painted, rings=_clockwise(moved.painted.rings))
            moved = replace(moved, painted=painted)
        style = moved_paint(item.style, frame.back, 1 / frame.growth)
        found.append(replace(moved, style=style))
    return tuple(found)


def _clockwise(rings: tuple[Outline, ...]) -> tuple[Outline, ...]:
    """An area's rings, which run clockwise, after it has been mirrored."""
    return tuple(Outline(ring.curves[::-1, ::-1], ring.closed) for ring in rings)


def moved_paint(style: Style, matrix: Affine, growth: float) -> Style:
    """A style moved along by a map (2, 3), its stroke as much wider as the map makes lengths."""
    style = moved_style(style, matrix)
    if style.stroke is None or growth == 1.0:
        return style
    stroke = style.stroke
    return replace(
        style,
        stroke=replace(
            stroke,
            width=stroke.width * growth,
            dashes=tuple(dash * growth for dash in stroke.dashes),
            dash_offset=stroke.dash_offset * growth,
        ),
    )


def _frame(a: Scene, b: Scene, turn: float, over: int = -1) -> Frame:
    radii = []
    for scene in (a, b):
        points = np.concatenate([item.points for item in scene.items])
        radii.append(float(np.sqrt(((points - scene.box.mean(axis=0)) ** 2).sum(axis=1).mean())))
    growth = radii[1] / radii[0] if min(radii) > 0 else 1.0
    centres = np.stack([a.box.mean(axis=0), b.box.mean(axis=0)])
    stretch = growth * np.eye(2)
    if over >= 0:
        stretch[over, over] *= -1
    return Frame(centres, turn, stretch, over)


def _grid(scene: Scene, places: Points) -> Floats:
    """Which of some places (N, 2) are painted."""
    import shapely

    drawn = [item.drawn for item, own in zip(scene.items, scene.sheets, strict=True) if not own]
    seen = np.zeros(len(places))
    for shape in drawn:
        shapely.prepare(shape)  # its chords in a tree, for all places at once
        x0, y0, x1, y1 = shape.bounds
        near = (x0 <= places[:, 0]) & (places[:, 0] <= x1)
        near &= (y0 <= places[:, 1]) & (places[:, 1] <= y1)
        some = np.flatnonzero(near)
        seen[some[shapely.contains_xy(shape, *places[some].T)]] = 1.0
    return seen


def _places(scene: Scene) -> Points:
    """The grid that a drawing and others are compared on, (GRID^2, 2)."""
    steps = (np.arange(GRID) + 0.5) / GRID * 2 - 1
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    return np.asarray(scene.box.mean(axis=0) + 0.75 * scene.scale * grid)


def _like(places: Points, drawn: Floats, other: Scene, frame: Frame) -> float:
    """Share that a drawing, given as which places it paints, has in a frame with another one."""
    there = _grid(other, (places - frame.centres[0]) @ frame.linear.T + frame.centres[1])
    both = (drawn * there).sum()
    return float(both / max(drawn.sum() + there.sum() - both, 1.0))


def _of_same_lengths(a: Scene, b: Scene) -> bool:
    """Whether most items have one as long in the other drawing, without which none is turned."""
    lengths = [np.log([max(i.length, 1e-9 * s.scale) for i in s.items]) for s in (a, b)]
    growth = np.log(_frame(a, b, 0.0).growth)
    alike = np.abs(lengths[0][:, None] + growth - lengths[1]) < LENGTHS
    shares = [
        float(s.sizes[alike.any(axis=axis)].sum() / s.sizes.sum()) for s, axis in ((a, 1), (b, 0))
    ]
    return min(shares) > ALIKE


def _something_stays(a: Scene, b: Scene) -> bool:
    never = a.sheets[:, None] | b.sheets
    pairs = alike_in_place(a, b, never, {})
    return any(min(a.sizes[i], b.sizes[j]) > STAYS * a.scale for i, j in pairs)


def _share_alike(a: Scene, b: Scene, frame: Frame) -> float:
    """Share, by size, of items of either drawing that are where the other one's are."""
    view = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])
    back = perceive(moved_items(b, frame), view)
    pairs = alike_in_place(a, back, np.zeros((len(a.items), len(b.items)), dtype=bool), {}, LOOSE)
    shared = sum(float(a.sizes[i]) for i, _ in pairs)
    return shared / max(float(a.sizes.sum()), float(b.sizes.sum()))


def _affine(a: Scene, b: Scene) -> Frame | None:
    """The affine map that takes one drawing's curves onto the other's, if there is one."""
    rings = [[r for item in s.items for r in item.rings] for s in (a, b)]
    counts = [[(len(r.curves), r.closed) for r in side] for side in rings]
    if counts[0] != counts[1]:
        return None
    one, other = (np.concatenate([r.curves.reshape(-1, 2) for r in side]) for side in rings)
    angle, stretch = affine_between(one, other)
    frame = Frame(np.stack([one.mean(axis=0), other.mean(axis=0)]), float(angle), stretch)
    missed = (one - frame.centres[0]) @ frame.linear.T + frame.centres[1] - other
    if np.abs(missed).max() > EXACT * b.scale:
        return None
    if abs(frame.turn) < 1e-6 and np.abs(stretch - frame.growth * np.eye(2)).max() < 1e-6:
        return None
    turn = frame.turn + 2 * np.pi * (frame.turn < 1e-9 - np.pi)
    return Frame(frame.centres, turn, stretch)
