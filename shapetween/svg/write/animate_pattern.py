"""Patterns through time: one that stays goes along, one that goes is covered by what comes.

A pattern cannot run to another paint. It is painted by a path of its own under the one that moves,
whose fill comes over it in the first half, or goes from it in the second.
"""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.model.blend import faded
from shapetween.model.paint import Pattern, Style
from shapetween.model.part import Part
from shapetween.svg.write.animate import animate_number, animate_transform
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import ALPHA_DECIMALS, GradientDefs, add_pattern, alpha_text
from shapetween.svg.write.numbers import number
from shapetween.svg.write.shape import ShapeMotion, add_motion

__all__ = ["add_ends", "fills_of", "keep_pattern"]

#: How far a share may be from its place between two keyframes.
SHARE_TOLERANCE = 1.5 / 255


def fills_of(part: Part, styles: Sequence[Style], times: Floats) -> list[Style]:
    """Styles with fills that come over a pattern, or go from it, where a part ends in one."""
    if _goes_on(styles):
        return list(styles)
    shares = _covered(part, styles, times)
    return [
        style if share >= 1 or style.fill is None else replace(style, fill=faded(style.fill, share))
        for style, share in zip(styles, shares.tolist(), strict=True)
    ]


def _goes_on(styles: Sequence[Style]) -> bool:
    """Whether one pattern fills a part all the time."""
    return all(style.pattern is not None for style in styles)


def _ends(part: Part, styles: Sequence[Style]) -> list[tuple[bool, Pattern]]:
    """Patterns that a part begins or ends with, but does not keep."""
    if _goes_on(styles):
        return []
    found = [(last, part.style(float(last)).pattern) for last in (False, True)]
    return [(last, pattern) for last, pattern in found if pattern is not None]


def _covered(part: Part, styles: Sequence[Style], times: Floats) -> Floats:
    """How much of the fill is there, (S,)."""
    shares = np.ones(len(times))
    for last, _ in _ends(part, styles):
        shares = np.minimum(shares, np.clip(2 * (1 - times if last else times), 0.0, 1.0))
    return shares


def add_ends(
    parent: ET.Element,
    part: Part,
    styles: Sequence[Style],
    times: Floats,
    clock: Clock,
    defs: GradientDefs,
    motion: ShapeMotion,
) -> None:
    """Write the patterns that a part begins or ends with, before the part itself."""
    for last, pattern in _ends(part, styles):
        path = ET.SubElement(parent, "path", {"fill": add_pattern(pattern, defs)[1]})
        if styles[0].fill_rule != "nonzero":
            path.set("fill-rule", styles[0].fill_rule)
        shares = np.clip(2 * (times if last else 1 - times) - 1, 0.0, 1.0)
        opaque = pattern_is_opaque(part, last)
        if opaque:  # it lies below until it is covered
            shares = np.ceil(np.round(shares, 9))
        opacities = shares * np.array([style.opacity for style in styles])
        path.set("opacity", alpha_text(float(opacities[0])))
        animate_number(path, "opacity", clock, opacities, SHARE_TOLERANCE, alpha_text)
        add_motion(path, motion)


def pattern_is_opaque(part: Part, last: bool) -> bool:
    """Whether nothing is seen through the pattern at an end."""
    fill = part.style(float(last)).fill
    return fill is not None and getattr(fill, "alpha", 0.0) > 1 - SHARE_TOLERANCE


def keep_pattern(
    path: ET.Element, styles: Sequence[Style], clock: Clock, defs: GradientDefs, tolerance: float
) -> None:
    """Fill a path by the pattern that its part keeps, if it does, along with its shape."""
    track = [style.pattern for style in styles if style.pattern is not None]
    if len(track) < len(styles):
        return
    for child in list(path):
        if child.get("attributeName") in ("fill", "fill-opacity"):
            path.remove(child)
    path.attrib.pop("fill-opacity", None)
    element, url = add_pattern(track[0], defs)
    path.set("fill", url)
    matrices = np.array([pattern.matrix for pattern in track])
    if not np.ptp(np.round(matrices, defs.decimals + ALPHA_DECIMALS), axis=0).any():
        return
    a, b, c, d, e, f = matrices.T
    turn = np.unwrap(np.arctan2(b, a))
    wide = np.hypot(a, b)
    lean = np.degrees(np.arctan((a * c + b * d) / (a * d - b * c)))
    moves = (
        ("translate", np.stack([e, f], axis=1), tolerance, defs.decimals),
        ("rotate", np.degrees(turn)[:, None], 0.05, ALPHA_DECIMALS),
        ("skewX", lean[:, None], 0.05, ALPHA_DECIMALS),
        ("scale", np.stack([wide, (a * d - b * c) / wide], axis=1), 1e-3, 2 * ALPHA_DECIMALS),
    )
    at_rest = []
    for kind, values, allowed, places in moves:
        picks = clock.pick(values[:, None], allowed)
        texts = [" ".join(number(v, places) for v in row) for row in values[picks].tolist()]
        animate_transform(element, "patternTransform", kind, clock, picks, texts)
        at_rest.append(f"{kind}({texts[0]})")
    element.set("patternTransform", "".join(at_rest))
