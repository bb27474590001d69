"""Whether a whole drawing is another one turned, so that it turns as one."""

from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Affine, Floats, Points
from shapetween.geometry.linearmaps import as_complex
from shapetween.model.gradients import moved_style
from shapetween.model.paint import Style
from shapetween.outline.carry import affine_between
from shapetween.scene.assign import alike_in_place
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Frame
from shapetween.scene.relations import Scene, perceive

__all__ = ["frame_between", "moved_items", "moved_paint"]

#: Turns that are tried, radians, and least likeness of the turned drawing, and what it must be more
#: than the unturned one's. Half right angles are asked for more: feet would do them by chance.
TURNS = (np.pi / 2, -np.pi / 2, np.pi, np.pi / 4, -np.pi / 4)
LIKE, BETTER = 0.85, 0.2
LIKE_OBLIQUE, BETTER_OBLIQUE = 0.93, 0.4

#: Least size of an item, as a share of the drawing, that is alike in place and so forbids a turn.
STAYS = 0.25

#: Least share, by size, of what is alike in place once the drawing is turned: other drawings may
#: turn into the same silhouette by chance.
ALIKE = 0.6

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
    if _something_stays(a, b):
        return None
    plain = _like(a, b, 0.0)
    for turn in TURNS:
        oblique = abs(abs(turn) - np.pi / 4) < 1e-9
        like, better = (LIKE_OBLIQUE, BETTER_OBLIQUE) if oblique else (LIKE, BETTER)
        found = _like(a, b, turn)
        if found > like and found > plain + better:
            frame = _frame(a, b, turn)
            if _mostly_alike(a, b, frame):
                return frame
    return None


def moved_items(scene: Scene, frame: Frame) -> tuple[Item, ...]:
    """The second drawing's items as they are in the frame."""
    return tuple(
        replace(
            item.transformed(frame.back),
            style=moved_paint(item.style, frame.back, 1 / frame.growth),
        )
        for item in scene.items
    )


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


def _frame(a: Scene, b: Scene, turn: float) -> Frame:
    radii = []
    for scene in (a, b):
        points = np.concatenate([item.points for item in scene.items])
        radii.append(float(np.sqrt(((points - scene.box.mean(axis=0)) ** 2).sum(axis=1).mean())))
    growth = radii[1] / radii[0] if min(radii) > 0 else 1.0
    centres = np.stack([a.box.mean(axis=0), b.box.mean(axis=0)])
    return Frame(centres, turn, growth * np.eye(2))


def _grid(scene: Scene, places: Points) -> Floats:
    """Which of some places (N, 2) are painted."""
    import shapely

    seen = np.zeros(len(places), dtype=bool)
    for item, sheet in zip(scene.items, scene.sheets, strict=True):
        if not sheet:
            seen |= shapely.contains_xy(item.drawn, places[:, 0], places[:, 1])
    return seen.astype(np.float64)


def _like(a: Scene, b: Scene, turn: float) -> float:
    """Share that the first drawing turned and the second one have in common."""
    frame = _frame(a, b, turn)
    steps = (np.arange(GRID) + 0.5) / GRID * 2 - 1
    half = 0.75 * a.scale
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * half
    places = a.box.mean(axis=0) + grid
    one = _grid(a, places)
    factor = np.exp(1j * turn) * frame.growth
    moved = as_complex(places - frame.centres[0]) * factor
    there = np.stack([moved.real, moved.imag], axis=1) + frame.centres[1]
    other = _grid(b, there)
    both = (one * other).sum()
    return float(both / max(one.sum() + other.sum() - both, 1.0))


def _something_stays(a: Scene, b: Scene) -> bool:
    never = a.sheets[:, None] | b.sheets
    pairs = alike_in_place(a, b, never, {})
    return any(min(a.sizes[i], b.sizes[j]) > STAYS * a.scale for i, j in pairs)


def _mostly_alike(a: Scene, b: Scene, frame: Frame) -> bool:
    """Whether most items of the second drawing are where those of the first one are."""
    view = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])
    back = perceive(moved_items(b, frame), view)
    pairs = alike_in_place(a, back, np.zeros((len(a.items), len(b.items)), dtype=bool), {}, LOOSE)
    shared = sum(float(a.sizes[i]) for i, _ in pairs)
    return shared > ALIKE * max(float(a.sizes.sum()), float(b.sizes.sum()))


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
