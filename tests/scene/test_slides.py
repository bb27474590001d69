"""Bent lines that change places slide there as they are."""

import numpy as np
import pytest

from tests.scene.test_kept import T, prepared

STYLE = "fill='none' stroke='#000' stroke-width='6'"


def lines(*data: str) -> str:
    return "".join(f"<path d='{d}' {STYLE}/>" for d in data)


OUT = ("M10,30V10H30", "M70,10H90V30", "M90,70V90H70", "M30,90H10V70")
IN = ("M10,35H35V10", "M65,10V35H90", "M90,65H65V90", "M35,90V65H10")


def straying(first: str, second: str) -> float:
    """Greatest change of the distances between an item's points on its way."""
    worst = 0.0
    for part in prepared(first, second).movement.parts:
        curves = np.concatenate([track.curves(T) for track in part.tracks], axis=1)
        corners = curves[:, :, [0, 3]].reshape(len(T), -1, 2)
        sides = np.linalg.norm(corners[:, :, None] - corners[:, None], axis=-1)
        worst = max(worst, float(np.abs(sides - sides[0]).max()))
    return worst


def test_brackets_that_turn_inside_out_stay_as_they_are() -> None:
    short = [d.replace("35", "30").replace("65", "70") for d in IN]
    assert straying(lines(*OUT), lines(*short)) < 0.1
    assert straying(lines(*short), lines(*OUT)) < 0.1


@pytest.mark.parametrize("change", ["size", "straight", "still"])
def test_other_lines_go_by_what_they_are(change: str) -> None:
    """Brackets of another size, bars, and lines that only make room."""
    ends = {
        "size": (lines(*OUT), lines(*IN)),
        "straight": (lines("M10,20H40", "M60,20V50"), lines("M60,80H90", "M10,50V80")),
        "still": (lines(*OUT[:2]), lines("M12,30V10H32", "M72,10H92V30")),
    }[change]
    scene = prepared(*ends).scene
    assert scene is not None
    found = {(role.first, role.second) for role in scene.roles.pairs}
    near = {(0, 1), (1, 0)} if change == "straight" else {(k, k) for k in range(len(found))}
    assert found == near
