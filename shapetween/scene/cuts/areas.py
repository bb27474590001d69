"""One fill that becomes several: it is cut into the cells of its pieces, as a cell divides."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Index
from shapetween.fill.regions import Region
from shapetween.fill.splitting import split_alike
from shapetween.scene.asked import Group
from shapetween.scene.cuts.division import Division, Found
from shapetween.scene.forms import RoundedBox
from shapetween.scene.items import Item
from shapetween.scene.relations import Scene

__all__ = ["divided_areas", "families"]

#: Sum of differences of colours that are one.
COLOUR = 0.12

#: Gap that pieces are closed over, as a share of the drawing, and what the closed pieces have in
#: common with the whole.
CLOSING, LIKE = 0.12, 0.45

#: Share of the convex hull of a piece that may lie in that of another one. More, and what fills a
#: notch is cut off the body's side.
NESTED = 0.5

#: Most pieces that one divides into.
MOST = 6


def divided_areas(whole: Scene, parts: Scene, groups: Sequence[Group] = ()) -> Found:
    """Fills of a scene that several of the other one are pieces of, cut into as many."""
    found: Found = {}
    for k, pieces in families(whole, parts, groups, filled=True):
        item = whole.items[k]
        if not item.plain or _nested([parts.items[j] for j in pieces]):
            continue
        regions = [Region(parts.items[j].outer, parts.items[j].holes) for j in pieces]
        cells = split_alike(Region(item.outer, item.holes), regions)
        if cells is None or sum(len(cell.holes) for cell in cells) < len(item.holes):
            continue  # a hole that a cut runs through would come together from torn edges
        made = [replace(item, rings=(c.outer, *c.holes), cut=True) for c in cells]
        found[k] = Division(made, list(zip(made, pieces.tolist(), strict=True)))
    return found


def _nested(pieces: Sequence[Item]) -> bool:
    """Whether a piece lies in a notch of another one: no straight cut divides them."""
    hulls = [piece.enclosed.convex_hull for piece in pieces]
    return any(
        one.intersection(other).area > NESTED * min(one.area, other.area)
        for k, one in enumerate(hulls)
        for other in hulls[:k]
    )


def families(
    whole: Scene, parts: Scene, groups: Sequence[Group], *, filled: bool
) -> list[tuple[int, Index]]:
    """Outermost items, and those of the other drawing that each of them comes apart into.

    What is the only one of its colour comes apart into all of that. Boxes that are all there is
    come apart into as many boxes each as lie in their places, as rows do into tiles.

    Parameters
    ----------
    whole, parts : Scene
    groups : sequence of Group
        Shapes that a user says become each other, which is asked no more.
    filled : bool
        Whether areas are asked for, else closed lines.
    """
    import shapely

    ours, theirs = (
        np.array(
            [
                k
                for k, item in enumerate(s.items)
                if item.filled == filled
                and item.closed
                and not item.cut
                and not s.sheets[k]
                and s.parents[k] < 0
                and s.outlined[k] < 0
            ],
            dtype=np.intp,
        )
        for s in (whole, parts)
    )
    found = []
    shapes = [np.array([item.shape for item in s.items]) for s in (whole, parts)]
    for one, several in groups:
        own = np.flatnonzero(np.isin(shapes[0], one))
        pieces = np.flatnonzero(np.isin(shapes[1], several))
        kinds = {item.filled for item in (parts.items[j] for j in pieces)}
        if len(own) == 1 and 2 <= len(pieces) <= MOST and kinds == {filled}:
            found.append((int(own[0]), pieces))
    asked = {k for k, _ in found}
    for k, pieces in _shared_out(whole, parts, ours, theirs):
        if k in asked:
            continue
        reach = CLOSING * parts.scale
        union = shapely.union_all([parts.items[j].enclosed for j in pieces])
        closed = union.buffer(reach).buffer(-reach)
        own = whole.items[k].enclosed
        both = closed.intersection(own).area
        if both > LIKE * (closed.area + own.area - both):
            found.append((k, pieces))
    return found


def _shared_out(whole: Scene, parts: Scene, ours: Index, theirs: Index) -> list[tuple[int, Index]]:
    """Which of some items of both drawings belong together."""
    found = []
    for k in ours.tolist():
        alike = np.abs(whole.colours[ours] - whole.colours[k]).sum(axis=-1) < COLOUR
        pieces = theirs[np.abs(parts.colours[theirs] - whole.colours[k]).sum(axis=-1) < COLOUR]
        if alike.sum() == 1 and 2 <= len(pieces) <= MOST:
            found.append((k, pieces))
    if found or not 2 <= len(ours) < len(theirs):
        return found
    boxes = [
        all(isinstance(scene.forms[k], RoundedBox) for k in range(len(scene.items)))
        for scene in (whole, parts)
    ]
    colours = np.concatenate([whole.colours[ours], parts.colours[theirs]])
    if not all(boxes) or np.ptp(colours, axis=0).sum() > COLOUR:
        return []
    places = whole.box[0] + (parts.centres[theirs] - parts.box[0]) * (
        np.ptp(whole.box, axis=0) / np.ptp(parts.box, axis=0)
    )
    corners = np.array([whole.items[k].box for k in ours])
    off = np.maximum(corners[:, None, 0] - places, places - corners[:, None, 1]).max(axis=-1)
    own = np.round(off / whole.scale, 9).argmin(axis=0)
    counts = np.bincount(own, minlength=len(ours))
    if (off.min(axis=0) > 0).any() or counts.min() < 2 or counts.max() > MOST:
        return []
    return [(int(k), theirs[own == n]) for n, k in enumerate(ours)]
