import numpy as np

from shapetween.base.ranking import comparable


def test_what_rounding_parts_compares_equal_in_any_unit() -> None:
    values = np.array([0.3, 0.1 + 0.2, 0.2, 1.0])
    for unit in (1e-6, 1.0, 1e6):
        steps = comparable(values * unit)
        assert steps[0] == steps[1]
        assert steps[2] < steps[0] < steps[3]


def test_what_differs_by_a_millionth_compares_as_it_is() -> None:
    assert np.diff(comparable([1.0, 1.0 + 1e-6]))[0] > 0


def test_nothing_but_zeros_compares_equal() -> None:
    assert (comparable([0.0, -0.0]) == 0).all()
