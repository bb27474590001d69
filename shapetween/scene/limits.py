"""What is not looked for where there is too much of it, each as a notice.

Only what is left out as a whole is told; stages that go on with the largest, or the plainest, of
what there is (corners of an outline, relations of pairs) are not.
"""

from collections.abc import Iterator, Sequence

from shapetween.base.notices import Notice
from shapetween.scene import attachments, borders, features, items, limbs
from shapetween.scene.assign import Roles
from shapetween.scene.items import Item
from shapetween.scene.relations import Scene
from shapetween.scene.strokes import outlined
from shapetween.scene.unmatched import presence

__all__ = ["limits_of_items", "limits_of_pairs"]


def limits_of_items(first: Sequence[Item], second: Sequence[Item]) -> tuple[Notice, ...]:
    """What is not looked for in two drawings' items before they are paired."""
    found = []
    sides = first, second
    if any(map(outlined.too_many_areas, sides)):
        found.append(f"of more than {outlined.MOST_AREAS} areas none is looked for strokes")
    if any(outlined.too_long(item) for side in sides for item in side):
        found.append(f"areas of more than {outlined.MOST_CURVES} curves are not looked for strokes")
    if max(map(len, sides)) > limbs.MOST_ITEMS and all(
        any(item.filled for item in side) for side in sides
    ):
        found.append(f"of more than {limbs.MOST_ITEMS} parts none is looked for strokes on bodies")
    if max(map(len, sides)) > features.MOST_ITEMS:
        found.append(f"of more than {features.MOST_ITEMS} parts none is looked for faces or wheels")
    sampled = items.MOST_CHORDS // items.CHORDS
    if any(len(ring.curves) > sampled for side in sides for item in side for ring in item.rings):
        found.append(f"outlines of more than {sampled} curves are seen by fewer places on each")
    return tuple(map(_note, found))


def limits_of_pairs(a: Scene, b: Scene, roles: Roles) -> tuple[Notice, ...]:
    """What is not looked for when pairs move."""
    found = []
    if len(roles.pairs) > attachments.MOST_ENDS:
        found.append(
            f"of more than {attachments.MOST_ENDS} pairs lines do not keep to what they end on"
        )
    if len(borders.bordered_areas(a, b, roles)) > borders.MOST:
        found.append(f"of more than {borders.MOST} areas it is not looked for common borders")
    carrying = (scene.items[k] for scene, k in _paired(a, b, roles))
    if len(roles.disappearing) + len(roles.appearing) and any(
        sum(len(ring.curves) for ring in item.rings) > presence.MANY_CURVES for item in carrying
    ):
        found.append(
            f"what an outline of more than {presence.MANY_CURVES} curves carries follows it at "
            f"{presence.EVEN_TIMES} times"
        )
    return tuple(map(_note, found))


def _paired(a: Scene, b: Scene, roles: Roles) -> Iterator[tuple[Scene, int]]:
    for role in roles.pairs:
        yield a, role.first
        yield b, role.second


def _note(text: str) -> Notice:
    return Notice("too-many-parts", text, severity="note")
