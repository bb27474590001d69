"""Groups of parts through a movement: what is done to them comes, goes and moves with them."""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.model.drawing import Shape
from shapetween.model.paint import Filter, Group, Mask, Primitive, Style
from shapetween.model.part import Leaf, Part
from shapetween.svg.write.animate import animate, animate_choice, animate_number
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import GradientDefs, alpha_text
from shapetween.svg.write.groups import (
    Nest,
    add_mixing,
    blending,
    faded_opacity,
    filter_region,
    filter_steps,
    in_filter,
    is_hidden,
    open_masks,
    primitive_attributes,
    soft_mask,
)

__all__ = ["Member", "add_parts", "group_tracks", "mask_parts", "members_of", "paths_of"]

AddPart = Callable[[ET.Element, Part, dict[str, str]], None]

#: How far a share, or a number of a filter, may be from its place between two keyframes.
SHARE_TOLERANCE = 1.5 / 255


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """A part, the groups it is in at every sample, and at which ends it is not seen."""

    part: Part
    name: dict[str, str]
    groups: tuple[tuple[Group, ...], ...]
    hidden: tuple[bool, bool]


def add_parts(
    parent: ET.Element,
    parts: Sequence[Part],
    names: Sequence[dict[str, str]],
    ends: tuple[Sequence[Shape], Sequence[Shape]],
    clock: Clock,
    times: Floats,
    defs: GradientDefs,
    tolerance: float,
    add_part: AddPart,
) -> None:
    """Write parts, those of a group within it.

    Parameters
    ----------
    parent : Element
    parts : sequence of Part
    names : sequence of dict
        Attributes of each.
    ends : (sequence of Shape, sequence of Shape)
        What the parts are at the start, and at the end.
    clock : Clock
        Of paint.
    times : (S,) float64
        Its samples, kept inside the movement.
    defs : GradientDefs
    tolerance : float
        How far lengths may be off between two keyframes.
    add_part : callable
        Writes a part by itself.
    """
    members = members_of(parts, ends, times, names)
    paths = paths_of(members)
    tracks = group_tracks(members)

    def open_group(inside: ET.Element, group: Group) -> ET.Element:
        track = tracks[group.key]
        return _open(inside, track, clock, times, defs, tolerance, add_part)

    nest = Nest(parent, open_group)
    for member, path in zip(members, paths, strict=True):
        add_part(nest.at(path), member.part, member.name)


def members_of(
    parts: Sequence[Part],
    ends: tuple[Sequence[Shape], Sequence[Shape]],
    times: Floats,
    names: Sequence[dict[str, str]] | None = None,
) -> list[Member]:
    """The groups of all parts at times kept inside the movement."""
    members = []
    for k, (part, first, last) in enumerate(zip(parts, *ends, strict=True)):
        groups: tuple[tuple[Group, ...], ...] = ()
        if part.style(float(times[len(times) // 2])).groups:
            groups = tuple(part.style(t).groups for t in times.tolist())
        name = {} if names is None else names[k]
        members.append(Member(part, name, groups, (is_hidden(first), is_hidden(last))))
    return members


def group_tracks(members: Sequence[Member]) -> dict[object, tuple[Group, ...]]:
    """Each group through time: as its first member has it, or who says that less is done."""
    tracks: dict[object, list[Group]] = {}
    for member in members:
        own: dict[object, list[Group]] = {}
        for sample in member.groups:
            for group in sample:
                own.setdefault(group.key, []).append(group)
        for key, groups in own.items():
            track = tracks.setdefault(key, groups)
            track[:] = [
                other if other.share < group.share else group
                for group, other in zip(track, groups, strict=True)
            ]
    return {key: tuple(track) for key, track in tracks.items()}


def paths_of(members: Sequence[Member]) -> list[tuple[Group, ...]]:
    """The groups of each part, where a part that is not seen joins those around it.

    What shows at one end only, between others that are one group at the other, must not part them.
    """
    paths = [list(m.groups[0]) if m.groups else [] for m in members]
    spans: dict[object, list[int]] = {}
    for k, path in enumerate(paths):
        for group in path:
            spans.setdefault(group.key, []).append(k)
    for key, found in spans.items():
        first = paths[found[0]]
        depth = next(k for k, group in enumerate(first) if group.key == key)
        shares = [next(g for g in m if g.key == key).share for m in _ends(members[found[0]])]
        for k in range(found[0] + 1, found[-1]):
            above = [group.key for group in paths[k][:depth]]
            if k in found or above != [group.key for group in first[:depth]]:
                continue
            seen = [s > 0.5 and not h for s, h in zip(shares, members[k].hidden, strict=True)]
            if not any(seen):
                paths[k].insert(depth, first[depth])
    return [tuple(path) for path in paths]


def _ends(member: Member) -> tuple[tuple[Group, ...], tuple[Group, ...]]:
    return member.groups[0], member.groups[-1]


def _open(
    parent: ET.Element,
    track: Sequence[Group],
    clock: Clock,
    times: Floats,
    defs: GradientDefs,
    tolerance: float,
    add_part: AddPart,
) -> ET.Element:
    """Write a group into an element; what its parts go into."""
    first = track[0]
    opacities = [faded_opacity(group) for group in track]
    styles = [blending(group) for group in track]

    def add_mask(mask: Mask) -> tuple[str, str]:
        index = next(k for k, each in enumerate(first.masks) if each is mask)
        return _mask(track, index, clock, times, defs, add_part)

    element = open_masks(parent, first, add_mask)
    outer = parent[-1]
    if any(styles):
        _animate_blending(outer, styles, clock, defs)
    animate_number(outer, "opacity", clock, np.array(opacities), SHARE_TOLERANCE, alpha_text)
    filters = [group.filter for group in track if group.filter is not None]
    if not filters:
        return element
    steps, name = filter_steps(filters[0], defs)
    _animate_filter(steps, filters, clock, defs, tolerance)
    shares = np.array([group.share for group in track])
    if (shares < 1).any():
        mix = {"k2": alpha_text(float(shares[0])), "k3": alpha_text(float(1 - shares[0]))}
        last = add_mixing(steps, mix)
        animate_number(last, "k2", clock, shares, SHARE_TOLERANCE, alpha_text)
        animate_number(last, "k3", clock, 1 - shares, SHARE_TOLERANCE, alpha_text)
    return in_filter(element, filters[0], name, defs)


def _animate_blending(
    element: ET.Element, styles: Sequence[str], clock: Clock, defs: GradientDefs
) -> None:
    """Ways to blend that change are classes, for SMIL cannot run through styles."""
    if len(set(styles)) == 1:
        element.set("style", styles[0])
        return
    names = {style: defs.style_class(style) for style in styles if style}
    track = [names.get(style, "") for style in styles]
    element.set("class", track[0])
    animate_choice(element, "class", clock, track)


def _mask(
    track: Sequence[Group],
    index: int,
    clock: Clock,
    times: Floats,
    defs: GradientDefs,
    add_part: AddPart,
) -> tuple[str, str]:
    """Write a mask that moves; the attribute that uses it, and its value."""
    shares = np.array([group.share for group in track])
    fades = bool((shares < 1).any())
    mask = track[0].masks[index]
    parts = mask_parts(track, index, times)
    if mask.plain and not fades:
        element, url = defs.reserve("clipPath", {})
        for part in parts:
            add_part(element, part, {"clip-rule": "evenodd"})
        return "clip-path", url
    element, inner, url = soft_mask(defs, fades=fades)
    if fades:
        inner.set("opacity", alpha_text(float(shares[0])))
        animate_number(inner, "opacity", clock, shares, SHARE_TOLERANCE, alpha_text)
    for part in parts:
        add_part(inner, part, {})
    return "mask", url


def mask_parts(track: Sequence[Group], index: int, times: Floats) -> list[Part]:
    """The shapes of one of a group's masks through time, the group being at samples (S,)."""
    parts = []
    for k in range(len(track[0].masks[index].shapes)):
        shapes = tuple(group.masks[index].shapes[k] for group in track)
        parts.append(Part("", (_MaskTrack(shapes, times),), _MaskPaint(shapes, times)))
    return parts


@dataclass(frozen=True, slots=True, eq=False)
class _MaskTrack(Leaf):
    """The rings of one shape of a mask, on straight lines between the samples."""

    shapes: tuple[Shape, ...]
    times: Floats

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(len(ring.curves) for ring in self.shapes[0].rings)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return tuple(ring.closed for ring in self.shapes[0].rings)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        stack = np.stack(
            [np.concatenate([ring.curves for ring in shape.rings]) for shape in self.shapes]
        )
        place = np.interp(t, self.times, np.arange(len(self.times)))
        low = np.minimum(place.astype(np.intp), len(self.times) - 1)
        high = np.minimum(low + 1, len(self.times) - 1)
        share = (place - low)[:, None, None, None]
        return np.asarray((1 - share) * stack[low] + share * stack[high])


@dataclass(frozen=True, slots=True, eq=False)
class _MaskPaint:
    """The paint of one shape of a mask; groups within masks stay as they are."""

    shapes: tuple[Shape, ...]
    times: Floats

    def at(self, t: float) -> Style:
        """How it is painted at one time."""
        return self.shapes[int(np.abs(self.times - t).argmin())].style


def _animate_filter(
    steps: ET.Element,
    track: Sequence[Filter],
    clock: Clock,
    defs: GradientDefs,
    tolerance: float,
) -> None:
    elements = list(steps)  # before any animation is put among them
    regions = [filter_region(each, defs.decimals) for each in track]
    close = SHARE_TOLERANCE if track[0].in_box else tolerance
    for name in regions[0]:
        _animate_list(steps, name, [region[name] for region in regions], clock, close)
    for k, element in enumerate(elements):
        _animate_primitive(element, [each.primitives[k] for each in track], clock, defs, tolerance)


def _animate_primitive(
    element: ET.Element,
    track: Sequence[Primitive],
    clock: Clock,
    defs: GradientDefs,
    tolerance: float,
) -> None:
    texts = [primitive_attributes(primitive, defs.decimals) for primitive in track]
    lengths = {name for name, _ in track[0].lengths}
    for name in texts[0]:
        close = tolerance if name in lengths else SHARE_TOLERANCE
        _animate_list(element, name, [each[name] for each in texts], clock, close)
    for k, child in enumerate(list(element)):
        if k < len(track[0].children):
            _animate_primitive(child, [each.children[k] for each in track], clock, defs, tolerance)


def _animate_list(
    element: ET.Element, name: str, texts: Sequence[str], clock: Clock, close: float
) -> None:
    """Let an attribute run through lists of numbers, or colours."""
    if len(set(texts)) == 1:
        return
    if texts[0].startswith("#"):
        rows = [[int(text[k : k + 2], 16) / 255 for k in (1, 3, 5)] for text in texts]
    else:
        rows = [[float(word) for word in text.replace(",", " ").split()] for text in texts]
    picks = clock.pick(np.array(rows)[:, None], close)
    animate(element, name, clock, picks, [texts[k] for k in picks])
