"""One thread for the matrices, whose libraries would start one on every core."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

__all__ = ["ONE_THREAD", "one_thread"]

#: What keeps numpy's and scipy's matrices to one thread where it is set before they are imported.
ONE_THREAD = ("OPENBLAS_NUM_THREADS", "1")


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep matrices to the thread they are asked for in.

    All of them are small: more threads only wait for each other, up to ten times as long, and take
    sums in another order on every machine.
    """
    name, one = ONE_THREAD
    if os.environ.get(name) == one:
        yield
        return
    with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries(_modules: int) -> "ThreadpoolController":
    """The matrices' libraries, looked for again only once more modules are there."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
