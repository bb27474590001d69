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
    before = os.environ.get(name)
    if before == one:
        yield
        return
    loaded = _libraries(len(sys.modules))
    known = {library.filepath for library in loaded.lib_controllers}
    os.environ[name] = one  # for what is only loaded meanwhile
    try:
        with loaded.limit(limits=1, user_api="blas"):
            yield
    finally:
        if before is None:
            del os.environ[name]
        else:
            os.environ[name] = before
        for library in _libraries(len(sys.modules)).select(user_api="blas").lib_controllers:
            if library.filepath not in known:
                library.set_num_threads(int(before or os.cpu_count() or 1))


@lru_cache(maxsize=1)
def _libraries(_modules: int) -> "ThreadpoolController":
    """The matrices' libraries, looked for again only once more modules are there."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
