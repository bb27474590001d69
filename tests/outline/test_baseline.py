"""How one outline becomes another that it is matched with, in figures that are known."""

from functools import cache

import numpy as np
import pytest

from shapetween.base.observe import unobserved
from shapetween.outline.alone import moved_alone
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.matching import match_outer
from tests.baseline import assert_known
from tests.match.shapes import disc, polygon, rounded, star

TIMES = np.array([0.1, 0.3, 0.5, 0.9])

FLAG = np.array([[0, 0], [4, 0], [4, 3], [1, 3], [1, 9], [0, 9]], dtype=float)
LOW = np.array([[0, 0], [1, 0], [1, 3], [6, 3], [6, 5], [1, 5], [1, 9], [0, 9]], dtype=float)
U = np.array([[0, 0], [2, 0], [2, 6], [3, 6], [3, 0], [5, 0], [5, 8], [0, 8]], dtype=float)
SHUT = U + 0.44 * np.array([[1, 0], [1, 0], [0, 0], [0, 0], [-1, 0], [-1, 0], [0, 0], [0, 0]])

CASES = {
    "a flag that comes down": (polygon(FLAG), polygon(LOW)),
    "a star that becomes round": (polygon(star(3)), rounded(star(40, 6))),
    "round and round": (rounded(star(11, 7)), rounded(star(12, 7))),
    "a disc that becomes a star": (disc(), rounded(star(21, 5))),
    "arms that lean": (polygon(U), polygon(SHUT)),
}


@cache
def ring(case: str) -> RingMatch:
    first, second = CASES[case]
    pins = np.zeros((0, 4))
    return match_outer(
        first, second, quads=None, pins=pins, mesh=None, upright=True, observe=unobserved
    )


def moved(case: str) -> Carried:
    return moved_alone([ring(case)], "projective", None, unobserved, rough=False, decided=False)


@pytest.mark.parametrize("case", CASES)
def test_the_movement_is_known(case: str) -> None:
    body = moved(case)
    curves = body.curves(TIMES)
    step = max(1, curves.shape[1] // 6)
    figures = [
        curves.shape[1],
        len(body.nodes.ends[0]),
        body.crossing,
        body.quad_share,
        float(body.parted),
        *curves[:, ::step, 1].ravel().tolist(),
    ]
    assert_known("outline", case, figures)
