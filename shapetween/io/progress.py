"""What the command line tells while it works: which stage, and how long each one took."""

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

__all__ = ["Progress"]

#: Seconds of work before anything is shown, and between two looks.
PATIENCE, BEAT = 1.0, 0.2


class Progress:
    """Times every stage, and names the present one on a terminal once work takes over a second.

    An instance is an observer (`shapetween.base.observe.Observer`) and a context manager; leaving
    it clears the line.

    Parameters
    ----------
    stream : text stream, optional
        Where to show it, the error stream if left out; nothing is shown unless it is a terminal.
    quiet : bool
        Show nothing at all.

    Attributes
    ----------
    seconds : dict of str to float
        Time spent in each stage so far.
    """

    def __init__(self, stream: TextIO | None = None, *, quiet: bool = False) -> None:
        self.seconds: dict[str, float] = {}
        stream = sys.stderr if stream is None else stream
        self._stream = stream
        # A program that is started without an error stream has None in its place.
        self._shown = not quiet and stream is not None and stream.isatty()
        self._stage = ""
        self._done = threading.Event()
        self._start = time.perf_counter()
        self._thread = threading.Thread(target=self._show, daemon=True)

    def __enter__(self) -> "Progress":
        """Start watching."""
        if self._shown:
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        """Stop watching and clear the line."""
        self.close()

    def close(self) -> None:
        """Stop watching and clear the line; a second time does nothing."""
        if self._shown and not self._done.is_set():
            self._done.set()
            self._thread.join()
            self._stream.write("\r\x1b[K")
            self._stream.flush()

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        """Count the time until the context is left as this stage's."""
        before, self._stage = self._stage, stage
        start = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[stage] = self.seconds.get(stage, 0.0) + time.perf_counter() - start
            self._stage = before

    def _show(self) -> None:
        if self._done.wait(PATIENCE):
            return
        while not self._done.wait(BEAT):
            seconds = time.perf_counter() - self._start
            self._stream.write(f"\r\x1b[K{self._stage or 'working'} ... {seconds:.0f} s")
            self._stream.flush()
