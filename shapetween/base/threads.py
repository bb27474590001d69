"""One thread for the matrices, whose libraries would start one on every core."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

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
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1, user_api="blas"):
        yield
