"""Groups between the groups that a shape is in first and those that it is in last.

Groups that do the same kind of thing become each other. What only one side has fades: as the share
of what it does, so that a shadow or a mask comes and goes evenly.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from shapetween.model.outline import Outline
from shapetween.model.paint import Filter, Group, Mask, Primitive, Style

__all__ = ["blend_groups"]

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_COLOUR = re.compile(r"#[0-9a-f]{6}")

Between = Callable[[Style, Style], Style]


def blend_groups(
    a: Sequence[Group], b: Sequence[Group], t: float, between: Between
) -> tuple[Group, ...]:
    """The groups at time `t`, which is after 0 and before 1.

    Parameters
    ----------
    a, b : sequence of Group
    t : float
    between : callable
        The style between two, for shapes of masks.

    Notes
    -----
    Which groups there are, and their keys, is the same at all these times.
    """
    found: list[Group] = []
    rest = list(b)
    for group in a:
        partner = next((k for k, other in enumerate(rest) if _alike(group, other)), None)
        if partner is None:
            found.append(replace(group, share=group.share * (1 - t)))
            continue
        found += [_arriving(other, t) for other in rest[:partner]]
        found.append(_between_groups(group, rest[partner], t, between))
        del rest[: partner + 1]
    return (*found, *(_arriving(other, t) for other in rest))


def _arriving(group: Group, t: float) -> Group:
    return replace(group, share=group.share * t)


def _alike(a: Group, b: Group) -> bool:
    """Whether there is something between two groups."""
    if (a.blend, a.isolated, len(a.masks)) != (b.blend, b.isolated, len(b.masks)):
        return False
    if not all(map(_same_masks, a.masks, b.masks)):
        return False
    if a.filter is None or b.filter is None:
        return a.filter is b.filter
    return _same_filters(a.filter, b.filter)


def _same_masks(a: Mask, b: Mask) -> bool:
    """Whether the shapes of two masks have the same curves, ring by ring."""
    if a.plain != b.plain or len(a.shapes) != len(b.shapes):
        return False
    for one, two in zip(a.shapes, b.shapes, strict=True):
        rings = [[(len(ring.curves), ring.closed) for ring in s.rings] for s in (one, two)]
        if rings[0] != rings[1] or len(one.style.groups) != len(two.style.groups):
            return False
    return True


def _same_filters(a: Filter, b: Filter) -> bool:
    if (a.in_box, a.box_units, a.matrix) != (b.in_box, b.box_units, b.matrix):
        return False
    return _same_primitives(a.primitives, b.primitives)


def _same_primitives(a: Sequence[Primitive], b: Sequence[Primitive]) -> bool:
    if len(a) != len(b):
        return False
    for one, two in zip(a, b, strict=True):
        if one.tag != two.tag or [n for n, _ in one.attributes] != [n for n, _ in two.attributes]:
            return False
        if [(n, len(v)) for n, v in one.lengths] != [(n, len(v)) for n, v in two.lengths]:
            return False
        if not _same_primitives(one.children, two.children):
            return False
        values = zip(one.attributes, two.attributes, strict=True)
        if not all(_mixed(p, q, 0.5) is not None for (_, p), (_, q) in values):
            return False
    return True


def _between_groups(a: Group, b: Group, t: float, between: Between) -> Group:
    found = a.filter
    if a.filter is not None and b.filter is not None:
        x, y, width, height = (
            (1 - t) * p + t * q for p, q in zip(a.filter.region, b.filter.region, strict=True)
        )
        primitives = _between_primitives(a.filter.primitives, b.filter.primitives, t)
        found = replace(a.filter, primitives=primitives, region=(x, y, width, height))
    masks = tuple(
        _between_masks(one, two, t, between) for one, two in zip(a.masks, b.masks, strict=True)
    )
    return replace(
        a,
        key=(a.key, b.key),
        opacity=(1 - t) * a.opacity + t * b.opacity,
        filter=found,
        masks=masks,
        share=(1 - t) * a.share + t * b.share,
    )


def _between_masks(a: Mask, b: Mask, t: float, between: Between) -> Mask:
    if a is b:
        return a
    shapes = []
    for one, two in zip(a.shapes, b.shapes, strict=True):
        rings = tuple(
            Outline((1 - t) * p.curves + t * q.curves, p.closed)
            for p, q in zip(one.rings, two.rings, strict=True)
        )
        shapes.append(replace(one, rings=rings, style=between(one.style, two.style)))
    return Mask(tuple(shapes), a.plain)


def _between_primitives(
    a: Sequence[Primitive], b: Sequence[Primitive], t: float
) -> tuple[Primitive, ...]:
    found = []
    for one, two in zip(a, b, strict=True):
        attributes = tuple(
            (name, _mixed(p, q, t) or p)
            for (name, p), (_, q) in zip(one.attributes, two.attributes, strict=True)
        )
        lengths = tuple(
            (name, tuple((1 - t) * p + t * q for p, q in zip(ps, qs, strict=True)))
            for (name, ps), (_, qs) in zip(one.lengths, two.lengths, strict=True)
        )
        children = _between_primitives(one.children, two.children, t)
        found.append(Primitive(one.tag, attributes, children, lengths))
    return tuple(found)


def _mixed(a: str, b: str, t: float) -> str | None:
    """A value between two: lists of as many numbers, or colours; None if there is none."""
    if a == b:
        return a
    if _COLOUR.fullmatch(a) and _COLOUR.fullmatch(b):
        parts = [
            round((1 - t) * int(a[k : k + 2], 16) + t * int(b[k : k + 2], 16)) for k in (1, 3, 5)
        ]
        return "#" + "".join(f"{part:02x}" for part in parts)
    ours, theirs = a.replace(",", " ").split(), b.replace(",", " ").split()
    if len(ours) != len(theirs) or not all(map(_NUMBER.fullmatch, (*ours, *theirs))):
        return None
    mix = (1 - t) * np.array(ours, np.float64) + t * np.array(theirs, np.float64)
    return " ".join(f"{value:.6g}" for value in mix.tolist())
