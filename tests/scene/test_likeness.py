"""What is drawn alike becomes its like, wherever it lies and however large it is."""

from pathlib import Path

import numpy as np
import pytest

from shapetween.scene.items import items_of
from shapetween.scene.likeness import drawn_alike, scaled_groups
from shapetween.scene.relations import Scene, perceive
from shapetween.svg.read.reader import read_svg
from tests.scene.test_leaving import ICON, lone, morph

BOLT = '<path d="M13 2l-8 12h7l-1 8 8-12h-7z" transform="{}"/>'
CHECK = '<path d="M{}l{} {} {} -{}"/>'
RING = '<circle cx="12" cy="12" r="10"/>'
SMALL = "translate(6 6) scale(.5)"


def scene(inner: str) -> Scene:
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><g {ICON}>{inner}</g></svg>'
    )
    shapes = read_svg(text.encode(), "it").shapes
    return perceive(items_of(shapes, "it")[0], np.array([[0.0, 0.0], [24.0, 24.0]]))


def check(scale: float, x: float, y: float) -> str:
    return CHECK.format(f"{x} {y}", 5 * scale, 5 * scale, 10 * scale, 10 * scale)


@pytest.mark.parametrize(
    ("first", "second", "alike"),
    [
        (BOLT.format(""), BOLT.format(SMALL), 1.0),
        (BOLT.format(""), BOLT.format("rotate(90 12 12)"), 0.0),
        (BOLT.format(""), '<path d="M4 4h16l-8 16z"/>', 0.0),
        (check(1, 5, 12), check(0.4, 9, 12), 1.0),
        (check(1, 5, 12), '<path d="M20 7l-10 10 -5 -5"/>', 1.0),
        (check(1, 5, 12), '<path d="M5 12l5 -5 10 10"/>', 0.0),
        (RING, '<circle cx="12" cy="12" r="3"/>', 0.0),
    ],
)
def test_outlines_are_alike_in_any_size_and_place_but_not_turned(
    first: str, second: str, alike: float
) -> None:
    assert drawn_alike(scene(first), scene(second))[0, 0] == alike


@pytest.mark.parametrize("inner", [BOLT.format(""), check(1, 5, 12)])
def test_what_a_ring_comes_round_stays_what_it_is(tmp_path: Path, inner: str) -> None:
    small = BOLT.format(SMALL) if "13 2" in inner else check(0.4, 9, 12)
    found = morph(tmp_path, inner, RING + small, ICON)
    (ring,) = lone(found, arrives=True)
    assert np.ptp(ring.curves(np.array([1.0]))[0, :, :, 0]) == pytest.approx(20)
    assert not lone(found, arrives=False)


ARROW = '<path d="M{0} {1}h{2}M{3} {1}m-{4} -{4}l{4} {4}-{4} {4}"/>'


def test_a_drawing_that_is_in_the_other_one_becomes_that() -> None:
    arrow, small = ARROW.format(4, 12, 16, 20, 6), ARROW.format(8, 12, 8, 16, 3)
    assert scaled_groups(scene(arrow), scene(RING + small)) == [(0, 1), (1, 2)]
    assert scaled_groups(scene(RING + small), scene(arrow)) == [(1, 0), (2, 1)]


def test_what_stays_in_its_place_is_no_group() -> None:
    arrow = ARROW.format(4, 12, 16, 20, 6)
    assert scaled_groups(scene(arrow), scene(arrow + '<path d="M2 22h20"/>')) == []


def test_one_line_in_common_is_no_group() -> None:
    """Else any two drawings with a line in them would be told by that."""
    assert scaled_groups(scene('<path d="M4 4h16"/>'), scene('<path d="M4 8h8M4 12h6"/>')) == []


def test_half_of_a_drawing_is_no_group() -> None:
    lines = '<path d="M4 4h{0}m-{0} {1}h{0}"/>'
    rest = '<path d="M3 20c9-9 9 4 18 0"/>'
    one, other = scene(lines.format(16, 5) + rest), scene(lines.format(8, 2.5) + BOLT.format(""))
    assert scaled_groups(one, other) == []


def test_a_shaft_that_gets_shorter_at_both_ends_is_not_cut(tmp_path: Path) -> None:
    """Its ends would be seen to leave it."""
    found = morph(tmp_path, '<path d="M3 12h18"/>', '<path d="M8 12h8M12 3v4"/>', ICON)
    widths = [np.ptp(p.curves(np.array([0.5]))[0, :, :, 0]) for p in found.prepared.movement.parts]
    assert max(widths) == pytest.approx(13)
    assert not lone(found, arrives=False)
