"""Groups of shapes in a document: opacity, blending, filters and masks, at rest.

Where a group does only a share of what it does, a filter's picture is mixed with the one that it
is made of, and a mask with one that shows all.
"""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence
from typing import Generic, TypeVar

import numpy as np

from shapetween.model.drawing import Shape
from shapetween.model.gradients import IDENTITY
from shapetween.model.paint import Colour, Filter, Group, Mask, Primitive
from shapetween.svg.write.elements import ALPHA_DECIMALS, GradientDefs, add_shape, alpha_text
from shapetween.svg.write.numbers import number

__all__ = [
    "Nest",
    "add_mixing",
    "add_shapes",
    "blending",
    "faded_opacity",
    "filter_region",
    "filter_steps",
    "in_filter",
    "is_hidden",
    "open_group",
    "open_masks",
    "primitive_attributes",
    "soft_mask",
]

#: From which share on a group blends: there is nothing between two ways to blend.
BLENDS = 0.5


#: Size in user units up to which nothing is seen of a shape, in a drawing of any honest size.
NO_SIZE = 1e-9


Place = TypeVar("Place")


class Nest(Generic[Place]):
    """Where shapes go that are in groups, as they are written one after another.

    Parameters
    ----------
    root : Element, or what stands for it
    open_group : callable
        Writes a group into an element, and tells into what its shapes go.
    """

    def __init__(self, root: Place, open_group: Callable[[Place, Group], Place]) -> None:
        self._stack: list[tuple[object, Place]] = [(None, root)]
        self._open_group = open_group

    def at(self, groups: Sequence[Group]) -> Place:
        """The element for the next shape, which is in these groups."""
        depth = 1
        for group in groups:
            if depth < len(self._stack) and self._stack[depth][0] == group.key:
                depth += 1
            else:
                break
        del self._stack[depth:]
        for group in groups[depth - 1 :]:
            element = self._open_group(self._stack[-1][1], group)
            self._stack.append((group.key, element))
        return self._stack[-1][1]


def add_shapes(
    root: ET.Element,
    shapes: Sequence[Shape],
    defs: GradientDefs,
    attributes: Sequence[Mapping[str, str]] | None = None,
) -> None:
    """Write shapes at rest, those of a group in a group.

    Parameters
    ----------
    root : Element
    shapes : sequence of Shape
    defs : GradientDefs
    attributes : sequence of Mapping, optional
        Of each shape, before its own.
    """
    nest = Nest(root, lambda parent, group: open_group(parent, group, defs))
    groups: tuple[Group, ...] = ()
    for k, shape in enumerate(shapes):
        # What is not seen may lie between shapes of one group, and must not part them.
        groups = groups if is_hidden(shape) else shape.style.groups
        parent = nest.at(groups)
        add_shape(parent, shape, defs, {} if attributes is None else attributes[k])


def is_hidden(shape: Shape) -> bool:
    """Whether nothing of a shape is seen: it has no size, or no colour."""
    style = shape.style
    if style.opacity <= 0:
        return True
    paints = [style.fill] if style.stroke is None else [style.fill, style.stroke.paint]
    if all(p is None or (isinstance(p, Colour) and p.alpha <= 0) for p in paints):
        return True
    if style.stroke is not None and style.stroke.width > 0:
        return False
    return all(np.ptp(r.curves.reshape(-1, 2), axis=0).max() <= NO_SIZE for r in shape.rings)


def open_group(
    parent: ET.Element, group: Group, defs: GradientDefs, *, fades: bool | None = None
) -> ET.Element:
    """Write a group at rest into an element; what its shapes go into.

    One that `fades` is written so that it may do any share of what it does; without a word, if it
    does a share now.
    """
    fades = group.share < 1 if fades is None else fades

    def add_mask(mask: Mask) -> tuple[str, str]:
        return _mask(mask, group.share, defs, fades=fades)

    element = open_masks(parent, group, add_mask, blending(group))
    if group.filter is None:
        return element
    steps, name = filter_steps(group.filter, defs)
    if fades:
        mix = {"k2": alpha_text(group.share), "k3": alpha_text(1 - group.share)}
        add_mixing(steps, mix)
    return in_filter(element, group.filter, name, defs)


def faded_opacity(group: Group) -> float:
    """The opacity of a group that does a share of what it does."""
    return 1 - group.share * (1 - group.opacity)


def blending(group: Group) -> str:
    """What the style of a group says of blending."""
    words = []
    if group.blend != "normal" and group.share >= BLENDS:
        words.append(f"mix-blend-mode:{group.blend}")
    if group.isolated:
        words.append("isolation:isolate")
    return ";".join(words)


def open_masks(
    parent: ET.Element,
    group: Group,
    add_mask: Callable[[Mask], tuple[str, str]],
    style: str = "",
) -> ET.Element:
    """An element with the group's opacity, style and masks, or several within one another."""
    opacity = alpha_text(faded_opacity(group))
    attributes = {} if opacity == "1" else {"opacity": opacity}
    if style:
        attributes["style"] = style
    elements = [ET.SubElement(parent, "g", attributes)]
    for mask in group.masks:
        name, value = add_mask(mask)
        if name in elements[-1].attrib:
            elements.append(ET.SubElement(elements[-1], "g"))
        elements[-1].set(name, value)
    return elements[-1]


def _mask(mask: Mask, share: float, defs: GradientDefs, *, fades: bool) -> tuple[str, str]:
    """Write a mask; the attribute that uses it, and its value."""
    if mask.plain and not fades:
        element, url = defs.reserve("clipPath", {})
        add_shapes(element, mask.shapes, defs, [{"clip-rule": "evenodd"}] * len(mask.shapes))
        return "clip-path", url
    element, inner, url = soft_mask(defs, fades=fades)
    if fades:
        inner.set("opacity", alpha_text(share))
    add_shapes(inner, mask.shapes, defs)
    return "mask", url


def soft_mask(defs: GradientDefs, *, fades: bool) -> tuple[ET.Element, ET.Element, str]:
    """An empty mask over all that is shown: it, what its shapes go into, and what names it.

    One that fades shows all where its shapes' group is transparent.
    """
    area = defs.around()
    element, url = defs.reserve("mask", {"maskUnits": "userSpaceOnUse", **area})
    if not fades:
        return element, element, url
    ET.SubElement(element, "rect", {"fill": "#fff", **area})
    inner = ET.SubElement(element, "g")
    ET.SubElement(inner, "rect", area)
    return element, inner, url


def filter_steps(found: Filter, defs: GradientDefs) -> tuple[ET.Element, str]:
    """Write a filter; its element, and what names it."""
    attributes = {"filterUnits": "objectBoundingBox" if found.in_box else "userSpaceOnUse"}
    if found.box_units:
        attributes["primitiveUnits"] = "objectBoundingBox"
    attributes |= filter_region(found, defs.decimals)
    element, name = defs.reserve("filter", attributes)
    for primitive in found.primitives:
        _add_primitive(element, primitive, defs.decimals)
    return element, name


def filter_region(found: Filter, decimals: int) -> dict[str, str]:
    """Attributes that say what a filter keeps."""
    places = ALPHA_DECIMALS if found.in_box else decimals
    names = ("x", "y", "width", "height")
    values = (number(value, places) for value in found.region)
    return dict(zip(names, values, strict=True))


def primitive_attributes(primitive: Primitive, decimals: int) -> dict[str, str]:
    """All attributes of a primitive as text."""
    lengths = {
        name: " ".join(number(value, decimals) for value in values)
        for name, values in primitive.lengths
    }
    return {**dict(primitive.attributes), **lengths}


def _add_primitive(parent: ET.Element, primitive: Primitive, decimals: int) -> None:
    element = ET.SubElement(parent, primitive.tag, primitive_attributes(primitive, decimals))
    for child in primitive.children:
        _add_primitive(element, child, decimals)


def add_mixing(steps: ET.Element, mix: Mapping[str, str]) -> ET.Element:
    """Let a filter end with its picture mixed with the one it is made of."""
    last = steps[-1]
    result = last.get("result") or "shapetween-all"
    last.set("result", result)
    return ET.SubElement(
        steps,
        "feComposite",
        {
            "in": result,
            "in2": "SourceGraphic",
            "operator": "arithmetic",
            "color-interpolation-filters": "sRGB",
            **mix,
        },
    )


def in_filter(parent: ET.Element, found: Filter, name: str, defs: GradientDefs) -> ET.Element:
    """What the shapes of a filtered group go into."""
    if found.matrix == IDENTITY:
        # The filter comes before all else that is done.
        if not {"mask", "clip-path", "filter", "opacity", "style"} & parent.attrib.keys():
            parent.set("filter", name)
            return parent
        return ET.SubElement(parent, "g", {"filter": name})
    a, b, c, d, e, f = found.matrix
    there = np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])
    outer = ET.SubElement(parent, "g", {"transform": _matrix(there), "filter": name})
    return ET.SubElement(outer, "g", {"transform": _matrix(np.linalg.inv(there))})


def _matrix(matrix: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]") -> str:
    return f"matrix({' '.join(f'{value:.12g}' for value in matrix[:2].T.ravel().tolist())})"
