"""Frames drawn a few at a time and handed on in order."""

from collections import deque
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TypeVar

from shapetween.raster.light import Bytes

__all__ = ["in_order"]

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
