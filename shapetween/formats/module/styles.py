"""Styles through time as attributes of SVG elements, for a script to set.

A node is ``[name, attributes, moving attributes, nodes in it]``, empty ends left out. A moving
attribute is ``[form, times, values]``: at each time as many numbers as the form has places, or,
where the form is empty, the word that holds from then on.
"""

import re
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.model.paint import Style
from shapetween.model.tracks import StyleTrack
from shapetween.svg.write.animate_style import COLOUR_TOLERANCE
from shapetween.svg.write.elements import GradientDefs, paint_attributes, style_attributes
from shapetween.svg.write.plain_elements import Element, element_of, numbered
from shapetween.timing.keyframes import keyframes

__all__ = ["Node", "moving_node", "track_nodes"]

Node: TypeAlias = list[Any]

Attributes: TypeAlias = dict[str, str]

#: What an attribute is where it is not written.
USUAL = {
    "fill-rule": "nonzero",
    "fill-opacity": "1",
    "opacity": "1",
    "spreadMethod": "pad",
    "stop-opacity": "1",
    "stroke-dashoffset": "0",
    "stroke-linecap": "butt",
    "stroke-linejoin": "miter",
    "stroke-miterlimit": "4",
    "stroke-opacity": "1",
}

#: Attributes measured in shares of one, whatever the size of the drawing.
SHARES = {"fill-opacity", "offset", "opacity", "stop-opacity", "stroke-miterlimit"} | {
    "stroke-opacity"
}

_NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
_COLOUR = re.compile(r"#([0-9a-f]{3}|[0-9a-f]{6})\Z")


def track_nodes(track: StyleTrack, times: Floats, decimals: int, tolerance: float) -> list[Node]:
    """The path's node, and those of the gradients it uses, in order.

    Parameters
    ----------
    track : StyleTrack
    times : (S,) float64
        Of the movement, of each of its styles.
    decimals : int
        For lengths.
    tolerance : float
        How far lengths may be off between two keyframes, in user units.

    Notes
    -----
    A path refers to a gradient as ``url(#0)`` or ``url(#1)``: its place among them.
    """
    distinct: list[Style] = []
    for style in track.styles:
        if not distinct or style is not distinct[-1]:
            distinct.append(style)
    still = all(style == distinct[0] for style in distinct)
    styles = track.styles[:1] if still else track.styles
    samples = [_elements(style, decimals) for style in styles]
    return [
        moving_node([sample[k] for sample in samples], times, tolerance)
        for k in range(len(samples[0]))
    ]


def _elements(style: Style, decimals: int) -> list[Element]:
    """The path of a style, and the gradients it uses."""
    defs = GradientDefs(decimals)
    attributes = paint_attributes("fill", style.fill, defs)
    if style.stroke is not None:
        attributes |= paint_attributes("stroke", style.stroke.paint, defs)
    attributes |= style_attributes(style, decimals)
    attributes = {name: numbered(value) for name, value in attributes.items()}
    return [("path", attributes, []), *(element_of(each) for each in defs.element)]


def moving_node(samples: Sequence[Element], times: Floats, tolerance: float) -> Node:
    """One element through time."""
    names = list(dict.fromkeys(name for _, attributes, _ in samples for name in attributes))
    fixed: Attributes = {}
    moving: dict[str, Any] = {}
    for name in names:
        texts = [attributes.get(name, USUAL.get(name, "")) for _, attributes, _ in samples]
        if len(set(texts)) == 1:
            if texts[0] != USUAL.get(name):
                fixed[name] = texts[0]
        else:
            moving[name] = _move(name, texts, times, tolerance)
    inner = [
        moving_node([children[k] for _, _, children in samples], times, tolerance)
        for k in range(len(samples[0][2]))
    ]
    node: Node = [samples[0][0], fixed, moving, inner]
    while not node[-1]:
        node.pop()
    return node


def _move(name: str, texts: Sequence[str], times: Floats, tolerance: float) -> list[Any]:
    """An attribute that is not the same at all times."""
    texts = [_in_numbers(text) for text in texts]
    forms = {_NUMBER.sub("$", text) for text in texts}
    if len(forms) > 1 or "$" not in next(iter(forms)):
        changes = [0, *(k for k in range(1, len(texts)) if texts[k] != texts[k - 1])]
        return ["", [_time(times[k]) for k in changes], [texts[k] for k in changes]]
    form = forms.pop()
    values = np.array([[float(number) for number in _NUMBER.findall(text)] for text in texts])
    allowed = COLOUR_TOLERANCE if name in SHARES else tolerance
    if form.startswith("rgb("):
        allowed = 255 * COLOUR_TOLERANCE
    picks = keyframes(values[:, :, None], times, allowed)
    rows = [[int(v) if v == int(v) else v for v in row] for row in values[picks].tolist()]
    return [form, [_time(times[k]) for k in picks], rows]


def _in_numbers(text: str) -> str:
    """A colour in decimal numbers; any other text as it is."""
    found = _COLOUR.match(text)
    if not found:
        return text
    digits = found[1]
    step = len(digits) // 3
    parts = [digits[k : k + step] * (3 - step) for k in range(0, len(digits), step)]
    return f"rgb({','.join(str(int(part, 16)) for part in parts)})"


def _time(time: float) -> float:
    rounded = round(float(time), 4)
    return int(rounded) if rounded == int(rounded) else rounded
