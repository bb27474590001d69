"""Words: no letter becomes another one."""

from pathlib import Path

import numpy as np
import pytest

from shapetween import morph
from shapetween.scene.items import items_of
from shapetween.scene.letters import other_letters
from shapetween.scene.relations import Scene, perceive
from shapetween.svg.read.reader import read_svg

VIEW = "0 0 100 40"
#: Letters in a box of 14 by 20.
LETTERS = {
    "L": "M{x} 10h5v15h9v5h-14z",
    "T": "M{x} 10h14v5h-4.5v15h-5v-15h-4.5z",
    "O": "M{x} 10h14v20h-14zM{i} 15v10h4v-10z",
    "I": "M{x} 10h5v20h-5z",
    "i": "M{x} 16h5v14h-5zM{x} 8h5v5h-5z",
    ".": "M{x} 17h6v6h-6z",
}


def word(letters: str, left: float = 4.0, step: float = 18.0) -> str:
    d = "".join(
        LETTERS[one].format(x=left + k * step, i=left + k * step + 5)
        for k, one in enumerate(letters)
    )
    return f'<path d="{d}"/>'


def scene_of(inner: str) -> Scene:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{inner}</svg>'
    items, _ = items_of(read_svg(text.encode(), "x").shapes, "x")
    return perceive(items, np.array([[0.0, 0.0], [100.0, 40.0]]))


def pairs(tmp_path: Path, first: str, second: str) -> list[tuple[str, float, float]]:
    paths = [tmp_path / "a.svg", tmp_path / "b.svg"]
    for path, inner in zip(paths, (first, second), strict=True):
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{inner}</svg>')
    scene = morph(*paths).prepared.scene
    assert scene is not None
    a, b = scene.scenes
    return [
        (role.reason, float(a.centres[role.first, 0]), float(b.centres[role.second, 0]))
        for role in scene.roles.pairs
    ]


def test_letters_stay_what_they_are(tmp_path: Path) -> None:
    found = pairs(tmp_path, word("LOT"), word("TOL"))
    assert len(found) == 1  # the O between them, that neither passes
    assert found[0][1:] == pytest.approx((29.0, 29.0))


def test_a_letter_that_both_have_slides(tmp_path: Path) -> None:
    found = pairs(tmp_path, word("LTO"), word("TOL", left=9.0))
    assert [round(other - one) for _, one, other in found] == [-13] * 3  # the T is two lines


def test_a_dot_is_part_of_its_letter() -> None:
    a, b = scene_of(word("LiT")), scene_of(word("TiLO"))
    other = other_letters(a, b)
    assert other.shape == (4, 5)
    assert (~other).sum() == 2  # the stem and the dot of the i


@pytest.mark.parametrize(
    ("first", "second"),
    [("III", "IIII"), ("...", "...."), ("LO", "OT")],
    ids=["bars", "dots", "two-halves"],
)
def test_what_is_no_word_moves(first: str, second: str) -> None:
    assert not other_letters(scene_of(word(first)), scene_of(word(second))).any()


def test_what_is_far_apart_is_no_word() -> None:
    assert not other_letters(scene_of(word("LOT", step=35.0)), scene_of(word("TOL"))).any()
    uneven = '<path d="M4 2h14v8h-5v2h-9z"/><path d="M22 10h14v5h-4v9h-10z"/>'
    uneven += '<path d="M40 26h14v5h-4v3h-10z"/>'
    assert not other_letters(scene_of(uneven), scene_of(word("TOL"))).any()


def test_letters_of_other_colours_are_no_word() -> None:
    painted = word("LO") + word("T", left=40.0).replace("/>", ' fill="#c00"/>')
    assert not other_letters(scene_of(painted), scene_of(word("TOL"))).any()
