"""Corners in common that are chance do not draw what is even aslant."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.model.drawing import Shape
from shapetween.model.paint import Style
from shapetween.scene.items import Item, items_of
from shapetween.scene.motion import anchors
from tests.match.shapes import polygon

#: The right halves of a candy and of two bats, from the top down, with corners in common.
CANDY = np.array([[1, 2], [2, 3], [4, 2], [4, 6], [2, 5], [1, 6.0]])
BAT = np.array([[1, 1], [1, 3], [2, 2], [4, 2], [3, 4], [3, 6], [1.5, 5.5], [0.0, 7]])
BROAD = np.array([[1, 1], [1, 3], [2, 3], [2, 2], [4, 2], [3, 3.5], [3, 6], [1, 5.5], [0, 7.0]])


def item(half: Points) -> Item:
    below = half[half[:, 0] > 0]
    outline = polygon(np.concatenate([half, below[::-1] * [-1, 1]]))
    (found,), _ = items_of([Shape((outline,), Style())], "test")
    return found


@pytest.mark.parametrize(
    ("half", "most", "kept"),
    [(BAT, 0.006, True), (BAT, 0.003, False), (BROAD, 0.006, False), (BROAD, 0.012, True)],
)
def test_corners_in_common_stay_where_both_sides_stay_alike(
    monkeypatch: pytest.MonkeyPatch, half: Points, most: float, kept: bool
) -> None:
    monkeypatch.setattr(anchors, "SAME_MATCHING", most)
    assert (anchors.anchors(item(CANDY), item(half), 0.02) is not None) == kept
