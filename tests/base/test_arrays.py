"""Sums along short rows are what numpy's own are, to the bit."""

import numpy as np
import pytest

from shapetween.base.arrays import row_lengths, row_sums


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("unit", [1.0, 1.0 + 0.5j])
def test_sums_of_rows_are_numpys_to_the_bit(count: int, unit: complex) -> None:
    rng = np.random.default_rng(count)
    values = unit * rng.standard_normal((7, 50, count)) * 10.0 ** rng.integers(-8, 8, count)
    assert np.array_equal(row_sums(values), values.sum(axis=-1))


def test_lengths_of_rows_are_numpys_to_the_bit() -> None:
    vectors = np.random.default_rng(0).standard_normal((9, 40, 2)) * [1e-7, 1e3]
    assert np.array_equal(row_lengths(vectors), np.linalg.norm(vectors, axis=-1))
