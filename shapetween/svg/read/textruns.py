"""What a ``text`` element holds, character by character, with the style and the place of each.

.. [SVG2] *Scalable Vector Graphics 2*, chapter 11.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from xml.etree.ElementTree import Element

from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Frame
from shapetween.svg.read.placing import conditions_met, font_size
from shapetween.svg.read.xml import label, local_name

__all__ = ["Character", "characters_of", "families_of", "is_slanted", "weight_of"]

#: Elements within text that set text.
SPANS = frozenset({"tspan", "a", "textPath"})

#: Characters of one text that are read.
MOST_CHARACTERS = 5000

#: Values of one list of places that are read.
MOST_VALUES = 5000


@dataclass(slots=True, eq=False)
class Character:
    """One character with what its elements say of it.

    Attributes
    ----------
    text : str
    frame : Frame
        Its style, and the units it is in.
    element : Element
        The innermost that holds it.
    path : Element or None
        The ``textPath`` it is on.
    places : dict
        Of x, y, dx, dy and rotate those that are given for it.
    """

    text: str
    frame: Frame
    element: Element
    path: Element | None
    places: dict[str, float]


def characters_of(document: Document, element: Element, frame: Frame) -> list[Character]:
    """The characters of a text as they are shown, white space folded.

    Parameters
    ----------
    document : Document
    element : Element
        The ``text``.
    frame : Frame
        Its own.
    """
    found: list[Character] = []
    _collect(document, element, frame, None, found)
    if len(found) > MOST_CHARACTERS:
        document.losses.add("a text of too many characters was cut short", label(element))
    return _folded(element, found[:MOST_CHARACTERS])


def _collect(
    document: Document,
    element: Element,
    frame: Frame,
    path: Element | None,
    found: list[Character],
    depth: int = 0,
) -> None:
    document.limits.check("nesting", depth, document.name)
    start = len(found)
    _add(element.text, element, frame, path, found)
    for child in element:
        tag = local_name(child)
        if tag in SPANS and conditions_met(child):
            properties = document.cascade.properties(child, frame.properties)
            if properties.get("display") != "none":
                size = font_size(properties, frame)
                viewport = replace(frame.viewport, font_size=size)
                inner = replace(frame, properties=properties, viewport=viewport)
                on = child if tag == "textPath" else path
                _collect(document, child, inner, on, found, depth + 1)
        _add(child.tail, element, frame, path, found)
    for name in ("x", "y", "dx", "dy", "rotate"):
        values = _values(document, element.get(name), name, frame)
        for k, value in enumerate(values):
            if start + k < len(found):
                found[start + k].places.setdefault(name, value)
        if name == "rotate" and values:
            for character in found[start + len(values) :]:
                character.places.setdefault(name, values[-1])


def _add(
    text: str | None,
    element: Element,
    frame: Frame,
    path: Element | None,
    found: list[Character],
) -> None:
    for letter in (text or "")[: MOST_CHARACTERS + 1]:
        if len(found) <= 2 * MOST_CHARACTERS:
            found.append(Character(letter, frame, element, path, {}))


def _values(document: Document, text: str | None, name: str, frame: Frame) -> list[float]:
    if text is None:
        return []
    of = frame.viewport.width if name in ("x", "dx") else frame.viewport.height
    values = []
    words = text.replace(",", " ").split()
    if len(words) > MOST_VALUES:
        document.losses.add("a list of too many places of letters was cut short")
    for word in words[:MOST_VALUES]:
        value = frame.viewport.length(word, of)
        if value is None:
            break
        values.append(value)
    return values


def _folded(element: Element, found: list[Character]) -> list[Character]:
    """Characters with runs of white space made one space, and none at the ends.

    Places are counted in what remains ([SVG2]_, section 11.4.2): those of what goes pass on.
    """
    kept: list[Character] = []
    waiting: dict[str, float] = {}
    for character in found:
        style = character.frame.properties.get("white-space", "")
        space = _space(character.element, element)
        keeps = style.startswith(("pre", "break-spaces")) or (not style and space == "preserve")
        if character.text in "\n\r\t ":
            character.text = " "
            if not keeps and (not kept or kept[-1].text == " "):
                waiting = {**character.places, **waiting}
                continue
        for name, value in waiting.items():
            character.places.setdefault(name, value)
        waiting = {}
        kept.append(character)
    while kept and kept[-1].text == " ":
        kept.pop()
    case = {"uppercase": str.upper, "lowercase": str.lower}
    for k, character in enumerate(kept):
        wanted = character.frame.properties.get("text-transform", "none")
        if wanted in case:
            character.text = case[wanted](character.text)
        elif wanted == "capitalize" and (k == 0 or kept[k - 1].text == " "):
            character.text = character.text.upper()
    return kept


def _space(element: Element, outer: Element) -> str:
    name = "{http://www.w3.org/XML/1998/namespace}space"
    return element.get(name) or outer.get(name) or ""


def families_of(frame: Frame) -> list[str]:
    """The families that are asked for, as they are written, the best first."""
    text = frame.properties.get("font-family", "")
    names = re.findall(r"\s*(?:\"([^\"]*)\"|'([^']*)'|([^,]+))\s*,?", text)
    return [name.strip() for parts in names for name in parts if name.strip()][:20]


def weight_of(frame: Frame) -> int:
    """The weight that is asked for, from 1 to 1000."""
    word = frame.properties.get("font-weight", "").lower()
    if word.isdecimal() and 1 <= int(word[:5]) <= 1000:
        return int(word)
    return {"bold": 700, "bolder": 700, "lighter": 300}.get(word, 400)


def is_slanted(frame: Frame) -> bool:
    """Whether an italic or an oblique is asked for."""
    style = frame.properties.get("font-style", "").lower()
    return style.startswith(("italic", "oblique"))
