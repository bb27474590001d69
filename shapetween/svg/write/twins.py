"""Twins that stand still, for readers who ask for less motion.

A style sheet cannot stop SMIL; but it can show something else in its place. What moves is put into
groups of its own, each behind a group that shows its first frame; what stands still is in neither,
and is written once.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterable

from shapetween.model.drawing import Shape
from shapetween.svg.write.elements import GradientDefs, url_of
from shapetween.svg.write.groups import add_shapes, is_hidden

__all__ = ["MOVING", "REDUCED_MOTION", "WAITING_RULE", "add_twins", "runs_of_moving"]

#: Attributes of what moves, and of its twin. The class names are ours alone, because a page that
#: holds the drawing shares its style sheet; and without any style sheet the twin stays hidden.
MOVING = {"class": "shapetween-moving"}
STILL = {"class": "shapetween-still", "display": "none"}

#: Shows the twin instead of the movement.
REDUCED_MOTION = (
    "@media (prefers-reduced-motion:reduce){"
    ".shapetween-moving{display:none}.shapetween-still{display:inline}}"
)

#: The same, for what waits for its turn. It is hidden without this rule too; but an optimiser that
#: sees none takes what is hidden for something that is never seen, and throws it away.
WAITING_RULE = (
    "@media (prefers-reduced-motion:reduce){.shapetween-later{display:none;visibility:hidden}}"
)


def runs_of_moving(root: ET.Element, first: int, defs: GradientDefs) -> list[ET.Element]:
    """Put what moves, and follows what moves, into a group; what stands still stays outside.

    Parameters
    ----------
    root : Element
    first : int
        Its first child that is drawn.
    defs : GradientDefs
        What is drawn with; what uses something in it that moves, moves.

    Returns
    -------
    list of Element
        The groups.
    """
    running = [url_of(each) for each in defs.element if _has_animation(each)]
    drawn = list(root)[first:]
    del root[first:]
    runs: list[ET.Element] = []
    going = False
    for element in drawn:
        moves = _has_animation(element) or _uses(element, running)
        if moves and not going:
            runs.append(ET.SubElement(root, "g", MOVING))
        (runs[-1] if moves else root).append(element)
        going = moves
    return runs


def add_twins(
    root: ET.Element,
    run: ET.Element,
    parts: Iterable[tuple[ET.Element, Shape]],
    defs: GradientDefs,
) -> None:
    """Put the twin of a group of what moves before it.

    Parameters
    ----------
    root, run : Element
        The group, and what it is in.
    parts : iterable of (Element, Shape)
        The first path of every part, and what it shows at first.
    defs : GradientDefs
    """
    moving = set(run.iter("path"))
    shown = [both for both in parts if both[0] in moving and not is_hidden(both[1])]
    twins = ET.Element("g", STILL)
    add_shapes(twins, [Shape(shape.rings, shape.style) for _, shape in shown], defs)
    drawn = list(twins.iter("path"))
    for twin, (path, _) in zip(drawn, shown, strict=True):
        twin.set("d", path.get("d", ""))
    _share_paint(twins)
    root.insert(list(root).index(run), twins)


def _share_paint(group: ET.Element) -> None:
    """Say once for a group what of fill and stroke is the same in all of it: icons say much."""
    paths = list(group)
    if len(paths) < 2 or any(path.tag != "path" for path in paths):
        return
    for name, value in list(paths[0].attrib.items()):
        own = name.startswith(("fill", "stroke"))
        if own and all(path.get(name) == value for path in paths):
            group.set(name, value)
            for path in paths:
                del path.attrib[name]


def _has_animation(element: ET.Element) -> bool:
    return any(each.tag in ("animate", "animateTransform", "set") for each in element.iter())


def _uses(element: ET.Element, urls: list[str]) -> bool:
    values = [value for each in element.iter() for value in each.attrib.values()]
    return any(url in value for url in urls for value in values)
