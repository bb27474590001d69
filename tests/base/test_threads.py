"""Matrices keep to one thread while a movement is prepared."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from shapetween.base.threads import ONE_THREAD
from shapetween.pipeline import prepare
from tests.drawings import area, drawing, square


def threads() -> set[int]:
    """How many threads the matrix libraries may use now."""
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}


def test_a_movement_is_prepared_on_one_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(ONE_THREAD[0])
    seen = []

    @contextmanager
    def look(stage: str) -> Iterator[None]:
        seen.append(threads())
        yield

    with threadpool_limits(2, user_api="blas"):
        prepare(drawing(area(square(0, 0, 2))), drawing(area(square(0, 0, 3))), observe=look)
        after = threads()
    assert seen
    assert all(count == {1} for count in seen)
    assert after == {2}
