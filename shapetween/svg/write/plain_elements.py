"""Elements as plain values, for formats whose scripts build them anew."""

import re
import xml.etree.ElementTree as ET
from typing import Any, TypeAlias

from shapetween.model.drawing import Box
from shapetween.model.paint import Group
from shapetween.svg.write.elements import GradientDefs
from shapetween.svg.write.groups import open_group

__all__ = ["Element", "element_of", "group_elements", "numbered"]

#: An element's name, its attributes, and the elements in it.
Element: TypeAlias = tuple[str, dict[str, str], list[Any]]


def element_of(element: ET.Element) -> Element:
    """An element with all that is in it; what it refers to by number, and path data in words."""
    attributes = {
        name: _spaced(value) if name == "d" else numbered(value)
        for name, value in element.attrib.items()
        if name != "id"
    }
    return element.tag, attributes, [element_of(child) for child in element]


def numbered(value: str) -> str:
    """A reference to a definition as that to its place among all of them."""
    if not value.startswith("url("):
        return value
    return f"url(#{value.removesuffix(')').rsplit('-')[-1]})"


def _spaced(data: str) -> str:
    """Path data whose numbers are apart, so that only they differ from one time to another."""
    return " ".join(re.findall(r"[a-zA-Z]|-?(?:\d+\.?\d*|\.\d+)", data))


def group_elements(group: Group, box: Box, decimals: int, *, fades: bool) -> list[Element]:
    """A group at rest: what its shapes go into, innermost, and then all that it uses."""
    defs = GradientDefs(decimals, box=box)
    parent = ET.Element("g")
    open_group(parent, group, defs, fades=fades)
    return [element_of(parent[0]), *(element_of(each) for each in defs.element)]
