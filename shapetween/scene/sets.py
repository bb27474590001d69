"""Repeated sets: drawings of one thing several times, whose members go in order of place."""

import numpy as np

from shapetween.geometry.assignment import cheapest_pairs
from shapetween.scene.relations import Scene, in_common

__all__ = ["paired_sets"]

#: How much members may differ: logarithm of sizes, sum of colours, and their pictures' likeness.
SIZES, COLOURS, LIKE = 0.15, 0.15, 0.8

#: Extent across, as a share of that along, up to which a set is a row.
ROW = 0.15


def paired_sets(a: Scene, b: Scene) -> list[tuple[int, int]]:
    """Pairs of two drawings that are one repeated set each, of as many members; else none."""
    members = _members(a), _members(b)
    if not 2 <= len(members[0]) == len(members[1]):
        return []
    rows = [_in_row(scene, own) for scene, own in zip((a, b), members, strict=True)]
    if rows[0] is not None and rows[1] is not None:
        return list(zip(rows[0], rows[1], strict=True))
    places = []
    for scene, own in zip((a, b), members, strict=True):
        centres = scene.centres[own]
        low, size = centres.min(axis=0), np.ptp(centres, axis=0)
        places.append((centres - low) / np.where(size > 0, size, 1.0))
    cost = np.round(np.linalg.norm(places[0][:, None] - places[1], axis=-1), 6)
    first, second = cheapest_pairs(cost)
    return [(members[0][i], members[1][j]) for i, j in zip(first, second, strict=True)]


def _members(scene: Scene) -> list[int]:
    """All items but sheets, if they are one thing several times."""
    own = np.flatnonzero(~scene.sheets)
    if len(own) < 2:
        return []
    sizes, colours = np.log(scene.sizes[own]), scene.colours[own]
    alike = np.ptp(sizes) < SIZES and np.ptp(colours, axis=0).sum() < COLOURS
    pictures = in_common(scene.pictures[own], scene.pictures[own[:1]])
    return own.tolist() if alike and pictures.min() > LIKE else []


def _in_row(scene: Scene, members: list[int]) -> list[int] | None:
    """Members of a row from left to right, or of a column from above; None of other sets."""
    centres = scene.centres[members]
    width, height = np.ptp(centres, axis=0)
    if min(width, height) > ROW * max(width, height):
        return None
    along = centres[:, 0] if width >= height else centres[:, 1]
    return [members[k] for k in np.argsort(along, kind="stable")]
