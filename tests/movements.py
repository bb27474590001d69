"""Movements made by formula, for testing what is done with a movement."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Style
from shapetween.model.part import BlendedPaint, Leaf, Part

#: From times (F,) and curves (N, 4, 2) to (F, N, 4, 2).
Move: TypeAlias = Callable[[Floats, Curves], Curves]

BLACK = Style()

#: Handle length that makes four cubics a circle to within 0.03 % of its radius.
KAPPA = 0.5522847498


def circle(centre: Points, radius: float) -> Curves:
    """Four cubics that run clockwise around a centre, (4, 4, 2)."""
    quarter = np.array([[1, 0], [1, KAPPA], [KAPPA, 1], [0, 1]])
    turn = np.array([[0, -1], [1, 0]])
    turned = [quarter @ np.linalg.matrix_power(turn, k).T for k in range(4)]
    curves = np.asarray(centre) + radius * np.array(turned)
    curves[:, 3] = np.roll(curves[:, 0], -1, axis=0)
    return np.asarray(curves)


@dataclass(frozen=True)
class FormulaTrack(Leaf):
    """Rings whose points are a function of time and of where they start."""

    start: Curves
    move: Move
    counts: tuple[int, ...]
    closed: tuple[bool, ...]

    def curves(self, t: Floats) -> Curves:
        return self.move(t, self.start)


def formula_part(
    start: Curves,
    move: Move,
    first: Style = BLACK,
    last: Style = BLACK,
    name: str = "",
    rings: tuple[int, ...] = (4,),
    closed: tuple[bool, ...] = (True,),
) -> Part:
    """A part whose points are a function of time and of where they start."""
    track = FormulaTrack(start, move, rings, closed)
    return Part(name, (track,), BlendedPaint((first, last)))


def spin(
    turns: float, shift: tuple[float, float] = (0.0, 0.0)
) -> Callable[[Floats, Curves], Curves]:
    """Turn about the mean of the control points, and move in a straight line."""

    def move(t: Floats, start: Curves) -> Curves:
        centre = start.reshape(-1, 2).mean(axis=0)
        angle = 2 * np.pi * turns * t
        cos, sin = np.cos(angle), np.sin(angle)
        turn = np.stack([np.stack([cos, -sin], -1), np.stack([sin, cos], -1)], -2)  # (F, 2, 2)
        local = np.einsum("fij,nkj->fnki", turn, start - centre)
        return np.asarray(local + centre + t[:, None, None, None] * np.array(shift))

    return move


def rest(t: Floats, start: Curves) -> Curves:
    """Stand still."""
    return np.broadcast_to(start, (len(t), *start.shape))


def ellipse(centre: tuple[float, float], radii: tuple[float, float]) -> Curves:
    """A circle stretched along the axes."""
    return np.asarray(circle(np.zeros(2), 1.0) * np.array(radii) + np.array(centre))


def sample_movement(first: Style | None = None, last: Style | None = None) -> Movement:
    """An ellipse that turns by a third while a ring with a hole stands still behind it."""
    hole = circle(np.array([50.0, 50.0]), 30.0)[::-1, ::-1]
    ring = np.concatenate([circle(np.array([50.0, 50.0]), 45.0), hole])
    behind = formula_part(
        ring,
        rest,
        Style(Colour(0.2, 0.6, 0.4)),
        Style(Colour(0.2, 0.6, 0.4)),
        "ring",
        (4, 4),
        (True, True),
    )
    front = formula_part(
        ellipse((30.0, 50.0), (25.0, 10.0)),
        spin(1 / 3, (40.0, 0.0)),
        first or Style(Colour(1.0, 0.0, 0.0)),
        last or Style(Colour(0.0, 0.0, 1.0)),
        "front",
    )
    return Movement((behind, front), Box(0, 0, 100, 100), "Ring & ellipse")


def sample_chain() -> tuple[Movement, Movement, Movement]:
    """Movements that follow each other: an ellipse turns, is joined by a ring, and goes home.

    The ring opens and closes within the second one, whose structure is another.
    """
    start = ellipse((30.0, 50.0), (25.0, 10.0))
    legs = []
    colours = [Colour(1, 0, 0), Colour(0, 0, 1), Colour(0, 0.5, 0), Colour(1, 0, 0)]
    moves = [spin(0.25, (40.0, 0.0)), spin(0.25, (-20.0, 20.0)), spin(-0.5, (-20.0, -20.0))]
    for k, move in enumerate(moves):
        part = formula_part(start, move, Style(colours[k]), Style(colours[k + 1]), "ellipse")
        legs.append(Movement((part,), Box(0, 0, 100, 100)))
        start = move(np.ones(1), start)[0]

    hole = circle(np.zeros(2), 8.0)[::-1, ::-1]
    ring = np.concatenate([circle(np.zeros(2), 14.0), hole])

    def open_and_close(t: Floats, start: Curves) -> Curves:
        return np.array([20.0, 80.0]) + (4 * t * (1 - t))[:, None, None, None] * start

    joined = formula_part(ring, open_and_close, name="ring", rings=(4, 4), closed=(True, True))
    return legs[0], Movement((*legs[1].parts, joined), legs[1].box), legs[2]
