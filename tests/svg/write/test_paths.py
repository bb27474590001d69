"""Relative path data: read again it is the curves, and sums of it are sums of points."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Curves, Floats
from shapetween.base.errors import OptionError
from shapetween.svg.write import paths
from shapetween.svg.write.paths import PathForm, on_grid, straight_curves
from tests.smil import commands_of, curves_of, numbers_of


def rings_of(sizes: list[tuple[int, bool]], seed: int) -> Curves:
    """Curves of rings whose points are whole hundredths, about half of them lines."""
    random = np.random.default_rng(seed)
    found = []
    for count, closed in sizes:
        joints = random.integers(-900, 900, (count + 1, 2)) / 100
        if closed:
            joints[-1] = joints[0]
        for start, end in pairwise(joints):
            handles = random.integers(-900, 900, (2, 2)) / 100
            if random.random() < 0.5:
                handles = start + (end - start) * np.array([[0.25], [0.5]])
            found.append([start, *handles, end])
    return np.array(found)


SIZES = st.lists(st.tuples(st.integers(1, 6), st.booleans()), min_size=1, max_size=4)


@given(SIZES, st.integers(0, 10_000))
def test_what_is_written_is_read_again(sizes: list[tuple[int, bool]], seed: int) -> None:
    curves = rings_of(sizes, seed)
    straight = straight_curves(curves[None], 1e-9, 1e-9)
    form = PathForm.of([n for n, _ in sizes], [c for _, c in sizes], straight)
    (text,) = form.texts(on_grid(form.points(curves[None]), 2), 2)
    again = curves_of(text)
    first = 0
    for (count, closed), (read, read_closed) in zip(sizes, again, strict=True):
        ring = curves[first : first + count]
        assert closed == read_closed
        # A closing line of no length is not drawn.
        np.testing.assert_allclose(read[:, [0, 3]], ring[: len(read), [0, 3]], atol=1e-9)
        bent = ~straight[first : first + len(read)]
        np.testing.assert_allclose(read[bent], ring[: len(read)][bent], atol=1e-9)
        first += count


@given(SIZES, st.integers(0, 10_000))
def test_sums_of_texts_are_sums_of_points(sizes: list[tuple[int, bool]], seed: int) -> None:
    curves = np.stack([rings_of(sizes, seed), rings_of(sizes, seed + 1)])
    form = PathForm.of(
        [n for n, _ in sizes], [c for _, c in sizes], straight_curves(curves, 1e-9, 1e-9)
    )
    points = on_grid(form.points(curves), 2)
    one, other, both = form.texts(np.concatenate([points, points.sum(0, keepdims=True)]), 2)
    assert commands_of(one) == commands_of(other) == commands_of(form.zero())
    np.testing.assert_allclose(numbers_of(one) + numbers_of(other), numbers_of(both), atol=1e-9)
    assert not numbers_of(form.zero()).any()


def test_a_line_is_one_at_all_times_or_none() -> None:
    line = np.array([[[0, 0], [1, 0], [2, 0], [3, 0]]], float)
    bulging = line + np.array([[0, 0], [0, 0.4], [0, 0.4], [0, 0]])
    beyond = np.array([[[0, 0], [-1, 0], [2, 0], [3, 0]]], float)
    stacks = {
        "line": ([line, line, line], True),
        "bulges a little on the way": ([line, bulging, line], True),
        "bulges at the end": ([line, line, bulging], False),
        "bulges much": ([line, line + 3 * (bulging - line), line], False),
        "runs back over itself": ([beyond, beyond, beyond], False),
        "of no length": ([line * 0, line, line * 0], True),
    }
    for name, (stack, expected) in stacks.items():
        assert straight_curves(np.array(stack), 0.5, 0.01).tolist() == [expected], name


def test_too_many_digits_are_refused() -> None:
    with pytest.raises(OptionError, match="expected a lower precision"):
        on_grid(np.array([[[1e9, 0.0]]]), 12)


def test_straight_curves_look_at_few_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """However many are looked at together, the same are lines; only the ends are seen whole."""
    rng = np.random.default_rng(5)
    lines = np.linspace(0, 1, 4)[:, None] * rng.normal(size=(7, 40, 1, 2))
    lines[:, ::3, 1] += 0.2
    whole = straight_curves(lines, 0.1, 0.1)
    assert 0 < whole.sum() < 40
    sizes: list[int] = []
    inner = paths._from_chords

    def noted(curves: Curves) -> Floats:
        sizes.append(curves[..., 0, 0].size)
        return inner(curves)

    monkeypatch.setattr(paths, "_from_chords", noted)
    monkeypatch.setattr(paths, "AT_ONCE", 35)
    assert (straight_curves(lines, 0.1, 0.1) == whole).all()
    assert sizes[0] == 2 * 40
    assert max(sizes[1:]) <= 35
