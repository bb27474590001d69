"""The two ends of a movement."""

from enum import IntEnum

__all__ = ["End"]


class End(IntEnum):
    """Where something exists, or is measured: at the source, time 0, or the target, time 1."""

    SOURCE = 0
    TARGET = 1
