"""Processes of this machine that work on tasks."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager

__all__ = ["begin_child", "process_pool", "single_threaded"]

#: How the libraries under numpy are told how many threads to use. One each: processes share the
#: cores, and sums are then always taken in the same order.
THREADS = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMEXPR_NUM_THREADS",
)


@contextmanager
def process_pool(processes: int) -> Iterator[ProcessPoolExecutor]:
    """Processes, begun afresh, each with one thread of arithmetic.

    They are ended with the context: at once if it is left by an exception, Ctrl-C among them.
    Functions and arguments must be picklable, and a script that calls this needs the usual
    ``if __name__ == "__main__"``.
    """
    others = set(multiprocessing.active_children())
    context = multiprocessing.get_context("spawn")
    executor = ProcessPoolExecutor(processes, context, initializer=begin_child)
    try:
        with single_threaded():
            for _ in range(processes):
                executor.submit(_warm)
        yield executor
    except BaseException:
        for child in set(multiprocessing.active_children()) - others:
            child.terminate()
        raise
    finally:
        executor.shutdown(cancel_futures=True)


def begin_child() -> None:
    """Leave Ctrl-C to the parent, and do not outlive it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_follow_parent, daemon=True).start()


def _follow_parent() -> None:
    """End with the parent, even where that is ended without a chance to say so."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)


def _warm() -> None:
    """Import what every task needs."""
    import shapetween.api
    import shapetween.svg.write.smil  # noqa: F401


@contextmanager
def single_threaded() -> Iterator[None]:
    """Processes begun meanwhile have one thread of arithmetic each, and leave Ctrl-C to us."""
    with _environment(dict.fromkeys(THREADS, "1")), _uninterrupted():
        yield


@contextmanager
def _environment(values: dict[str, str]) -> Iterator[None]:
    """Variables that processes begun meanwhile inherit."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Put Ctrl-C off; processes begun meanwhile never see it, not even before `begin_child`."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
