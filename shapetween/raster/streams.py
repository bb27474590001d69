"""Frames drawn a few at a time and handed on in order."""

import os
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

from shapetween.base.observe import Observer
from shapetween.raster.light import Bytes

__all__ = ["counted", "in_order", "workers"]

#: Frames drawn at the same time, at most: each needs memory of its own.
MOST_WORKERS = 4

ItemT = TypeVar("ItemT")


def in_order(
    draw: Callable[[ItemT], Bytes], items: Iterable[ItemT], workers: int
) -> Generator[Bytes, None, None]:
    """Draw items, and hand on the frames in the items' order.

    Parameters
    ----------
    draw : callable
    items : iterable
    workers : int
        How many are drawn at once; one more than that are held.
    """
    with ThreadPoolExecutor(workers) as pool:
        waiting: deque[Future[Bytes]] = deque()
        try:
            for item in items:
                waiting.append(pool.submit(draw, item))
                if len(waiting) > workers:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


def workers() -> int:
    """How many frames to draw at once."""
    return min(MOST_WORKERS, os.cpu_count() or 1)


def counted(frames: Iterable[Bytes], count: int, observe: Observer) -> Iterator[Bytes]:
    """Frames, while an observer is told which one it is at."""
    for k, frame in enumerate(frames):
        with observe(f"frame {k + 1} of {count}"):
            yield frame
