"""What is not looked for where there is too much of it, each as a notice.

Only what is left out as a whole is told; stages that go on with the largest, or the plainest, of
what there is (corners of an outline, relations of pairs) are not.
"""

from collections.abc import Sequence

from shapetween.base.notices import Notice
from shapetween.scene import attachments, borders, features, limbs
from shapetween.scene.assign import Roles
from shapetween.scene.items import Item
from shapetween.scene.relations import Scene
from shapetween.scene.strokes import outlined

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
    return tuple(map(_note, found))


def _note(text: str) -> Notice:
    return Notice("too-many-parts", text, severity="note")
