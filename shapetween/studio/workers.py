"""Processes that do the studio's work, so that it can be dropped half-way and harms nobody.

Two kinds of work: previews, quick and in their order; and full results, of which a newer one ends
the older one of the same page at once. A process that is ended, or that dies, is replaced by one
that has been made ready before.
"""

import multiprocessing
import os
import threading
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from shapetween.base.errors import ShapetweenError
from shapetween.batch.processes import begin_child, single_threaded

__all__ = ["Died", "Superseded", "Worker", "Workers"]

#: Full results that are worked on at once, for so many pages. More only make each other wait.
MOST_RUNS = 2


class Superseded(Exception):
    """A newer request has taken the place of this one."""


class Died(ShapetweenError):
    """A worker process has ended without an answer."""


class Worker:
    """One process, asked one thing at a time.

    Parameters
    ----------
    folder : Path
        Where it stands.
    """

    def __init__(self, folder: Path) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, str(folder)), daemon=True)
        with single_threaded():
            self._process.start()
        theirs.close()
        self._lock = threading.Lock()

    @property
    def alive(self) -> bool:
        """Whether it can still be asked."""
        return self._process.is_alive()

    def ask(self, task: str, *arguments: Any) -> Any:
        """The answer of one of `shapetween.studio.tasks.TASKS`.

        Raises
        ------
        ShapetweenError
            What the task says is wrong; `Died` if the process ended.
        """
        with self._lock:
            try:
                self._pipe.send((task, arguments))
                kind, answer = self._pipe.recv()
            except (EOFError, OSError) as error:
                self._process.join(1)
                raise Died("the work was cut off; try again, or with a simpler drawing") from error
        if kind == "error":
            raise answer
        return answer

    def stop(self) -> None:
        """End it, whatever it is doing."""
        self._process.kill()
        self._process.join()


class Workers:
    """All processes of one session.

    Parameters
    ----------
    folder : Path
        Where they stand.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._change = threading.Condition()
        self._busy: dict[str, Worker] = {}
        self._idle: list[Worker] = []
        self._closed = False
        self._live = Worker(folder)

    def warm(self) -> None:
        """Make ready for the first movement; until then the first drawings are read sooner."""
        _warm(self._live)
        self._top_up(1)

    def quick(self, task: str, *arguments: Any) -> Any:
        """Something that does not take long, in its turn."""
        with self._change:
            if not self._live.alive:
                self._live = Worker(self._folder)
            worker = self._live
        return worker.ask(task, *arguments)

    def run(self, page: str, task: str, *arguments: Any) -> Any:
        """A full result, unless the same page asks for another one meanwhile.

        Raises
        ------
        Superseded
            If it does.
        """
        with self._change:
            if page in self._busy:
                self._busy.pop(page).stop()
                self._change.notify_all()
            self._change.wait_for(lambda: len(self._busy) < MOST_RUNS)
            worker = self._taken()
            self._busy[page] = worker
        try:
            return worker.ask(task, *arguments)
        except Died:
            with self._change:
                if self._busy.get(page) is not worker:
                    raise Superseded from None
            raise
        finally:
            with self._change:
                if self._busy.get(page) is worker:
                    del self._busy[page]
                    self._idle.append(worker)
                self._change.notify_all()
            self._top_up(MOST_RUNS)

    def close(self) -> None:
        """End all of them."""
        with self._change:
            self._closed = True
            for worker in (self._live, *self._idle, *self._busy.values()):
                worker.stop()

    def _taken(self) -> Worker:
        """A worker that is ready, else a new one."""
        self._idle = [worker for worker in self._idle if worker.alive]
        return self._idle.pop() if self._idle else Worker(self._folder)

    def _top_up(self, count: int) -> None:
        """Make workers ready, until there are so many for full results."""
        with self._change:
            missing = count - len(self._idle) - len(self._busy)
            if self._closed or missing <= 0:
                return
            fresh = [Worker(self._folder) for _ in range(missing)]
            self._idle[:0] = fresh
        for worker in fresh:
            _warm(worker)


def _warm(worker: Worker) -> None:
    """Have a worker import what it will need, while others go on."""

    def warm() -> None:
        with suppress(Died):  # it may be ended before
            worker.ask("warm")

    threading.Thread(target=warm, daemon=True).start()


def _serve(pipe: Connection, folder: str) -> None:
    """The life of a worker process."""
    begin_child()
    os.chdir(folder)
    from shapetween.studio.tasks import TASKS

    while True:
        try:
            task, arguments = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            answer = "done", TASKS[task](*arguments)
        except ShapetweenError as error:
            answer = "error", ShapetweenError(str(error))
        except MemoryError:
            answer = "error", ShapetweenError("there is not enough memory for these drawings")
        pipe.send(answer)
