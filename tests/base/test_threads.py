"""Matrices keep to one thread while a movement is prepared."""

import os
import subprocess
import sys
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


#: Code of a process of its own, in which scipy's matrices are not loaded at first.
LOADED_WITHIN = """
from threadpoolctl import threadpool_info
from shapetween.base.threads import one_thread

def counts():
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}

with one_thread():
    import scipy.linalg
    within = counts()
print(within == {1}, counts() == {2})
"""


def test_what_is_loaded_within_keeps_to_one_thread_too() -> None:
    environment = {**os.environ, ONE_THREAD[0]: "2"}
    command = [sys.executable, "-c", LOADED_WITHIN]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "True"]


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
