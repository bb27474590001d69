import xml.etree.ElementTree as ET

import numpy as np
import pytest

from shapetween.base.arrays import Curves, Floats
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.part import Part
from shapetween.svg.write.shape import MOST_LOOKED
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.easing import easing_function
from tests.movements import circle, formula_part
from tests.smil import SVG, curves_of, path_at


@pytest.mark.parametrize("curves", [4, MOST_LOOKED // 20])
@pytest.mark.parametrize("meshed", [True, False])
def test_corners_of_very_many_curves_that_meshes_move_are_not_looked_for(
    curves: int, meshed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """That would take minutes; all else is looked at in some of its points, some times at once."""
    asked: list[int] = []

    def move(t: Floats, start: Curves) -> Curves:
        asked.append(len(t))
        there = np.abs(t - 0.37)[:, None, None, None] * np.array([20.0, 7.0])
        return np.asarray(start + there)

    ring = np.tile(circle(np.array([50.0, 50.0]), 9.0), (curves // 4, 1, 1))
    rings = (4,) * (curves // 4)
    part = formula_part(ring, move, rings=rings, closed=(True,) * len(rings))
    if meshed:
        monkeypatch.setattr(Part, "areas", property(lambda part: (part,)))
    text = smil_svg(Movement((part,), Box(0, 0, 100, 100)))
    looked = curves == 4 or not meshed
    assert (sum(asked) > 300) == looked
    assert (text.count("<animate ") == 2) == looked  # two easings that meet, or keyframes
    # All at once are only the samples, with corners and without.
    assert sum(count * curves > 2 * MOST_LOOKED for count in asked) <= 2


#: When each of many rings sets off and arrives: slowly at first, and quickly at last.
WINDOWS = [(0.03 + 0.107 * k, 0.21 + 0.107 * k) for k in range(8)]


def in_turn(t: Floats, start: Curves) -> Curves:
    """Rings of four curves that go aside, each in a window of its own, and jump a little at last.

    The last of them turns smoothly all the while.
    """
    moved = np.tile(start, (len(t), 1, 1, 1))
    for k, (low, high) in enumerate(WINDOWS):
        way = np.clip((t - low) / (high - low), 0, 1) * 3 + np.clip((t - high) / 0.008, 0, 1) * 1
        moved[:, 4 * k : 4 * k + 4, ..., 1] += way[:, None, None]
    turn = np.stack([np.cos(t), np.sin(t)], axis=-1)[:, None, None]
    moved[:, 4 * len(WINDOWS) :] += 8 * turn
    return moved


@pytest.mark.parametrize("easing", ["linear", "cubic-bezier(.3,0,.6,1)"])
def test_rings_that_move_in_windows_of_their_own_take_easings_over_those(easing: str) -> None:
    """All together each window has to tell of all of them: a file half as long again."""
    rings = [circle(np.array([5 + 10 * k, 20]), 4.0) for k in range(len(WINDOWS) + 1)]
    counts = (4,) * len(rings)
    part = formula_part(np.concatenate(rings), in_turn, rings=counts, closed=(True,) * len(counts))
    text = smil_svg(Movement((part,), Box(0, 0, 100, 100)), duration=1000.0, easing=easing)
    path = next(p for p in ET.fromstring(text).iter(f"{SVG}path") if len(p))
    assert len(text) < 20_500
    for u in np.linspace(0, 0.999, 150):
        exact = part.curves(easing_function(easing)(np.array([u])))[0]
        shown = np.concatenate([curves for curves, _ in curves_of(path_at(path, 1000 * u))])
        assert np.linalg.norm(shown - exact, axis=-1).max() < 0.025 / 0.75
