"""Transform lists as attributes and as CSS."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.geometry.affine import affine, compose, mapped
from shapetween.svg.read.transform import parse_transform

numbers = st.floats(-100, 100).map(lambda value: round(value, 4))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", (1, 0, 0, 1, 0, 0)),
        ("none", (1, 0, 0, 1, 0, 0)),
        ("translate(3)", (1, 0, 0, 1, 3, 0)),
        ("translate( 3 , -4 )", (1, 0, 0, 1, 3, -4)),
        ("scale(2)", (2, 0, 0, 2, 0, 0)),
        ("scale(2-3)", (2, 0, 0, -3, 0, 0)),
        ("rotate(90)", (0, 1, -1, 0, 0, 0)),
        ("rotate(90 5 5)", (0, 1, -1, 0, 10, 0)),
        ("skewX(45)", (1, 0, 1, 1, 0, 0)),
        ("skewY(45)", (1, 1, 0, 1, 0, 0)),
        ("matrix(1 2 3 4 5 6)", (1, 2, 3, 4, 5, 6)),
        ("translate(1,2),scale(3)", (3, 0, 0, 3, 1, 2)),
        ("scale(3)translate(1,2)", (3, 0, 0, 3, 3, 6)),
    ],
)
def test_functions(text: str, expected: tuple[float, ...]) -> None:
    matrix = parse_transform(text)
    assert matrix is not None
    np.testing.assert_allclose(matrix, affine(*expected), atol=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "foo(1)",
        "scale()",
        "rotate(1 2)",
        "translate(1 2 3)",
        "scale(2",
        "2",
        "scale(1e999)",
        "rotate(1e999)",
        "translate(1e10)translate(3e9e)",
        "scale(x)",
    ],
)
def test_malformed_lists_are_refused(text: str) -> None:
    assert parse_transform(text) is None


@given(st.lists(numbers, min_size=6, max_size=6), st.lists(numbers, min_size=6, max_size=6))
def test_a_list_maps_the_last_function_first(outer: list[float], inner: list[float]) -> None:
    text = f"matrix({' '.join(map(repr, outer))}) matrix({','.join(map(repr, inner))})"
    matrix = parse_transform(text)
    assert matrix is not None
    point = np.array([1.5, -2.5])
    expected = mapped(mapped(point, affine(*inner)), affine(*outer))
    np.testing.assert_allclose(mapped(point, matrix), expected, atol=1e-6)
    np.testing.assert_allclose(compose(affine(*outer), affine(*inner)), matrix)


def test_white_space_is_run_through_once() -> None:
    """A pattern that could match it in many ways took minutes, and more with every character."""
    gap = " " * 100_000
    assert (
        parse_transform(f"scale({gap}2{gap},{gap}3{gap}){gap},{gap}scale({gap}1{gap}){gap}")
        is not None
    )
    assert parse_transform(f"scale(1){gap}x") is None
    assert parse_transform(f"scale(1{gap}x)") is None
