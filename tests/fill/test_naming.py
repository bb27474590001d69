"""Names that people give are told from those of editors."""

import pytest

from shapetween.fill.naming import is_given


@pytest.mark.parametrize(
    "name",
    [
        "path4320",
        "path12-3-7",
        "g12",
        "rect7",
        "Layer_1",
        "XMLID_12_",
        "SVGID_1_",
        "Vector",
        "_17",
        "svg_5",
        "Combined-Shape",
        "Ebene_1",
        "Group-9",
        "path4_copy",
    ],
)
def test_editors_names(name: str) -> None:
    assert not is_given(name)


@pytest.mark.parametrize(
    "name", ["head", "left-leg", "arm2", "grass", "pathway", "layered", "eye_1", "G-clef", "sun"]
)
def test_given_names(name: str) -> None:
    assert is_given(name)
