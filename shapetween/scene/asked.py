"""What a user asks of the parts: who becomes whom, how readily, and how others come and go."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.errors import OptionError
from shapetween.fill.naming import is_given
from shapetween.model.drawing import Shape

__all__ = ["PRICES", "Asked", "Change", "Exchange", "Group", "Pairing", "groups_of"]

Change: TypeAlias = Literal["fade", "draw", "grow", "slide"]
"""How everything comes and goes that has no partner."""

Pairing: TypeAlias = Literal["loose", "normal", "strict"]
"""How readily things become others: loose leaves little alone, strict much."""

Exchange: TypeAlias = Literal["never", "unlike", "always"]
"""Whether drawings are exchanged as wholes: where they are too unlike, or whatever they are."""

#: What leaving alone costs, times the usual.
PRICES: dict[Pairing, float] = {"loose": 1.5, "normal": 1.0, "strict": 0.55}

Group: TypeAlias = tuple[tuple[int, ...], tuple[int, ...]]
"""Shapes of both drawings that become each other; one side may be empty."""


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
    """Everything that is asked.

    Attributes
    ----------
    groups : tuple of Group
    price : float
        What leaving alone costs, times the usual.
    change : str or None
    pins : (K, 4) float64
        In the movement's frame.
    exchange : {"never", "unlike", "always"}
        Whether the drawings are exchanged as wholes.
    """

    groups: tuple[Group, ...] = ()
    price: float = 1.0
    change: Change | None = None
    pins: Points = field(default_factory=lambda: np.zeros((0, 4)))
    exchange: Exchange = "never"


def groups_of(
    first: Sequence[Shape], second: Sequence[Shape], matches: Sequence[tuple[str, str]]
) -> tuple[Group, ...]:
    """Groups that a user names, and those of names that both drawings share.

    Parameters
    ----------
    first, second : sequence of Shape
    matches : sequence of (str, str)
        Each side an id, ``#N`` for the N-th shape in paint order, several of them with commas
        between, or nothing.

    Raises
    ------
    OptionError
        If there is no such shape, or it is named twice.
    """
    groups: list[Group] = []
    for one, other in matches:
        if not one and not other:
            raise OptionError("match: ':' names no shape; expected a:b, a: or :b")
        sides = _named(one, first, "first"), _named(other, second, "second")
        if min(len(side) for side in sides) > 1:
            raise OptionError(
                f"match: '{one}:{other}' names several shapes of both drawings; "
                "expected one of at least one of them"
            )
        groups.append(sides)
    for side, which in enumerate(("first", "second")):
        named = [k for group in groups for k in group[side]]
        if len(set(named)) < len(named):
            raise OptionError(f"match: a shape of the {which} drawing is matched twice")
    taken = [{k for group in groups for k in group[side]} for side in (0, 1)]
    for i, j in _alike(first, second):
        if i not in taken[0] and j not in taken[1]:
            groups.append(((i,), (j,)))
    return tuple(groups)


def _named(names: str, shapes: Sequence[Shape], which: str) -> tuple[int, ...]:
    return tuple(_find(name, shapes, which) for name in names.split(",")) if names else ()


def _find(name: str, shapes: Sequence[Shape], which: str) -> int:
    known = [k for k, shape in enumerate(shapes) if shape.name == name]
    if known:
        return known[0]
    if name.startswith("#") and name[1:].isdecimal():
        number = int(name[1:])
        if 1 <= number <= len(shapes):
            return number - 1
        raise OptionError(
            f"match: the {which} drawing has no shape {name}; it has {len(shapes)}, "
            f"#1 to #{len(shapes)}"
        )
    named = sorted({shape.name for shape in shapes if shape.name})
    have = f"; it has {', '.join(named[:8])}" if named else "; its shapes have no ids"
    raise OptionError(f"match: the {which} drawing has no shape {name!r}{have}")


def _alike(first: Sequence[Shape], second: Sequence[Shape]) -> list[tuple[int, int]]:
    """Pairs of shapes by names that a person gave and both drawings have once."""
    counts = [Counter(shape.name for shape in side) for side in (first, second)]
    there = {shape.name: j for j, shape in enumerate(second)}
    return [
        (i, there[shape.name])
        for i, shape in enumerate(first)
        if is_given(shape.name) and counts[0][shape.name] == counts[1][shape.name] == 1
    ]
