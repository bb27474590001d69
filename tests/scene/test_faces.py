"""A face is known by the other drawing's, and its features become that one's."""

from pathlib import Path

import numpy as np
import pytest

from shapetween.scene.evidence import Evidence, mouths_saving
from shapetween.scene.faces import features_of_both, have_faces
from shapetween.scene.features import Feature
from shapetween.scene.items import items_of
from shapetween.scene.relations import Scene, perceive
from shapetween.svg.read.reader import read_svg
from tests.scene.test_exchange import is_exchanged, made

HEAD = '<circle cx="50" cy="50" r="40" fill="{}"/>'
YELLOW, BROWN = "#ffdd44", "#663300"
MOUTH = '<path d="M{0} {1}h{2}a{3} {3} 0 0 1 -{2} 0z" fill="{4}"/>'


def scene(inner: str) -> Scene:
    page = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{inner}</svg>'
    items = items_of(read_svg(page.encode(), "a").shapes, "a")[0]
    return perceive(items, np.array([[0.0, 0.0], [100.0, 100.0]]))


def eye(x: float, y: float, r: float = 5, fill: str = BROWN) -> str:
    return f'<circle cx="{x}" cy="{y}" r="{r}" fill="{fill}"/>'


def mouth(x: float = 38, y: float = 66, width: float = 24, fill: str = BROWN) -> str:
    return MOUTH.format(x, y, width, width / 2, fill)


FACE = HEAD.format(YELLOW) + eye(35, 40) + eye(65, 40) + mouth()


def seen_in(inner: str, fill: str = YELLOW) -> list[Feature]:
    """What the things on a head are beside the plain face."""
    kinds = features_of_both(scene(FACE), scene(HEAD.format(fill) + inner))[1].kinds
    return [Feature(int(kind)) for kind in kinds[1:]]


NOTHING = Feature(0)


@pytest.mark.parametrize(
    ("inner", "seen"),
    [
        # Cast down, with no mouth below them: no face by themselves, but one beside the other.
        (eye(35, 58) + eye(65, 58), Feature.EYE),
        (eye(35, 67) + eye(65, 67), NOTHING),
        # An eye half closed, and one that is a patch.
        (eye(35, 40, 5) + eye(65, 40, 9), Feature.EYE),
        (eye(35, 40, 5) + eye(65, 40, 12), NOTHING),
        (eye(35, 58, 5, "#664422") + eye(65, 58, 5, "#664422"), Feature.EYE),
        (eye(35, 58, 5, "#ff9900") + eye(65, 58, 5, "#ff9900"), NOTHING),
    ],
)
def test_eyes_are_where_the_other_face_has_them(inner: str, seen: Feature) -> None:
    eyes = [feature & Feature.EYE for feature in seen_in(inner)]
    assert eyes == [seen, seen]


@pytest.mark.parametrize(
    ("inner", "seen"),
    [
        (mouth(58, 66), True),
        (mouth(70, 66, 18), False),  # too far aside
        (mouth(38, 66, 14), True),
        (mouth(46, 66, 6), False),
        (mouth(44, 52, 12), True),
        (mouth(44, 49, 12), False),  # in the middle of the head
        (mouth(fill="#664422"), True),
        (mouth(fill="#3399ff"), False),
    ],
)
def test_a_mouth_is_where_the_other_face_has_it(inner: str, seen: bool) -> None:
    assert seen_in(inner) == [Feature.MOUTH if seen else NOTHING]


@pytest.mark.parametrize(
    ("fill", "same"), [("#ffdd44", True), ("#ffcc44", True), ("#dd4433", False)]
)
def test_a_head_of_another_colour_is_none(fill: str, same: bool) -> None:
    assert seen_in(mouth(), fill) == [Feature.MOUTH if same else NOTHING]
    one, other = have_faces(scene(FACE), scene(HEAD.format(fill) + mouth()))
    assert one[0]
    assert other[0] == same


def test_two_alike_at_one_height_are_eyes_rather_than_what_is_nearer() -> None:
    """The snoring beside a sleeping face is no eye of it."""
    snore = '<path d="M62 34h8l-8 8h8" stroke="#663300" stroke-width="3" fill="none"/>'
    assert seen_in(eye(35, 52) + eye(65, 52) + snore) == [Feature.EYE, Feature.EYE, NOTHING]


def test_a_face_known_by_the_other_does_not_leave_as_a_sign(tmp_path: Path) -> None:
    """Each goes at its own place, and the mouth becomes the mouth."""
    glasses = '<path d="M22 34h56v10q-14 20 -26 0h-4q-12 20 -26 0z" fill="#222"/>'
    found = made(tmp_path, FACE, HEAD.format(YELLOW) + glasses + mouth(50, 66))
    assert not is_exchanged(found)
    assert found.prepared.scene is not None
    pairs = {(role.first, role.second) for role in found.prepared.scene.roles.pairs}
    assert pairs == {(0, 0), (3, 2)}


@pytest.mark.parametrize(("fill", "saves"), [(BROWN, True), ("#664433", True), ("#f77777", False)])
def test_the_only_mouth_becomes_the_only_mouth_of_its_colour(fill: str, saves: bool) -> None:
    one = scene(FACE)
    other = scene(FACE.replace(mouth(), mouth(fill=fill)))
    saved = mouths_saving(one, other, Evidence.of(one, other))
    assert (saved[3, 3] > 0) == saves
    assert np.count_nonzero(saved) == saves
    two = scene(FACE + mouth(44, 74, 12) + mouth(44, 82, 12))  # one of the three is the nose
    assert not mouths_saving(one, two, Evidence.of(one, two)).any()
