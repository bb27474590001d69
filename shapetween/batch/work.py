"""What a worker does with one pair: contents in, contents out, no files.

Workers read and write nothing, so that they may run anywhere and be ended at any time.
"""

import time
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from json import dumps
from typing import TYPE_CHECKING, Any

from shapetween.base.errors import ShapetweenError
from shapetween.base.version import installed_version

if TYPE_CHECKING:
    from shapetween.model.drawing import Drawing

__all__ = ["Made", "Task", "Unmade", "make"]

#: Drawings that a worker keeps. With fewer, each against each of a folder reads every drawing anew
#: for every pair; with more, a worker holds that many large ones in memory.
KEPT = 32


@dataclass(frozen=True, slots=True)
class Task:
    """All that a worker needs.

    Attributes
    ----------
    names : tuple of str
        What messages call the two drawings and the mesh.
    drawings : tuple of bytes
        The two files.
    mesh : str, optional
        The text of the mesh file.
    options : mapping of str to plain values
    """

    names: tuple[str, str, str]
    drawings: tuple[bytes, bytes]
    mesh: str | None
    options: Mapping[str, Any]

    def digest(self, out: str) -> str:
        """A name for this task as it is, and for where its result goes."""
        plain = [installed_version(), out, self.names, self.mesh, dict(self.options)]
        total = sha256(dumps(plain, sort_keys=True).encode())
        for data in self.drawings:
            total.update(sha256(data).digest())
        return total.hexdigest()


@dataclass(frozen=True, slots=True)
class Made:
    """What came of a task: the SVG, the report, and the seconds of every stage."""

    svg: str
    report: dict[str, Any]
    seconds: dict[str, float]


@dataclass(frozen=True, slots=True)
class Unmade:
    """Why nothing came of a task; the traceback is empty where the user can mend it."""

    error: str
    traceback: str = ""


def make(task: Task) -> Made | Unmade:
    """Prepare and write one movement.

    What goes wrong is returned, as not every exception survives the way between processes.
    """
    try:
        return _made(task)
    except ShapetweenError as error:
        return Unmade(str(error))
    except Exception as error:  # a bug or a lack of memory must not cost the other pairs
        last = traceback.format_exception_only(error)[-1].strip()
        return Unmade(f"internal error: {last}", traceback.format_exc())


def _made(task: Task) -> Made:
    from shapetween.api import Morph
    from shapetween.formats.options import write_names
    from shapetween.mesh.file import load_meshes
    from shapetween.pipeline import Options, prepare

    seconds: dict[str, float] = {}

    @contextmanager
    def timed(stage: str) -> Iterator[None]:
        start = time.perf_counter()
        yield
        seconds[stage] = seconds.get(stage, 0.0) + time.perf_counter() - start

    writing = {name: task.options[name] for name in write_names() if name in task.options}
    given = {name: value for name, value in task.options.items() if name not in writing}
    meshes = load_meshes(task.mesh, task.names[2]) if task.mesh is not None else []
    options = Options(meshes=tuple(meshes), **given)
    with timed("read"):
        a, b = (_drawing(*both) for both in zip(task.drawings, task.names[:2], strict=True))
    prepared = prepare(a, b, options, names=task.names[:2], observe=timed)
    result = Morph(prepared, options.method)
    with timed("write"):
        svg = result.svg(**writing)
    return Made(svg, result.report(), seconds)


@lru_cache(maxsize=KEPT)
def _drawing(data: bytes, name: str) -> "Drawing":
    """A drawing, read once for all of a worker's pairs in a row that it is in."""
    from shapetween.io.fonts import fonts_in
    from shapetween.svg.read.reader import read_svg

    return read_svg(data, name, fonts=fonts_in())
