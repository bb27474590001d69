"""What is saved: made by the tool's own command, in a folder of its own."""

import os
import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from shapetween.base.errors import OptionError, ShapetweenError
from shapetween.studio.command import arguments, default_name
from shapetween.studio.job import Job
from shapetween.studio.settings import SETTINGS

__all__ = ["OUTPUT", "Export", "Form", "export", "forms", "output_words"]

#: Longest export in seconds: a film of a long chain takes minutes, and what hangs should end.
MOST_SECONDS = 1800


@dataclass(frozen=True, slots=True)
class Form:
    """A kind of file that a movement is saved as.

    Attributes
    ----------
    ending : str
        Of the file.
    label : str
        What the page calls it.
    command : str
        That makes it.
    extra : tuple of str
        What that command is told besides.
    folder : bool
        Whether the command writes a folder, which is packed into one file.
    takes : tuple of str
        Options that it has a use for, by the names of the writers.
    """

    ending: str
    label: str
    command: str = "morph"
    extra: tuple[str, ...] = ()
    folder: bool = False
    takes: tuple[str, ...] = ()


@cache
def forms() -> dict[str, Form]:
    """Every kind of file, by what the page asks for: those of the command line's own tables."""
    from shapetween.formats.table import FRAMES, WRITERS

    written = {
        ending.removeprefix("."): Form(ending, _titled(writer.what), takes=writer.takes)
        for ending, writer in WRITERS.items()
    }
    frames = {
        f"frames{ending}": Form(
            f"-frames{ending.replace('.', '-')}.zip",
            _titled(writer.what),
            "frames",
            ("--png",) if ending == ".png" else (),
            folder=True,
            takes=writer.takes,
        )
        for ending, writer in FRAMES.items()
    }
    mesh = {
        "mesh": Form("-mesh.svg", "Picture of the mesh", "mesh"),
        "mesh.json": Form("-mesh.json", "Mesh as JSON", "mesh"),
    }
    return written | frames | mesh


def _titled(what: str) -> str:
    """What a file is, as a choice in a list."""
    plain = re.sub(r"^an? ", "", re.sub(r" *\(.*\)", "", what))
    return plain[:1].upper() + plain[1:]


#: What may be said of the output alone: a number within bounds, or a colour.
OUTPUT = {
    "size": ("--size", 16, 8000),
    "fps": ("--fps", 1, 240),
    "frames": ("--frames", 2, 10_000),
    "background": ("--background", 0, 0),
}


def output_words(form: str, given: Mapping[str, Any]) -> tuple[str, ...]:
    """Options of the output, for the command line.

    Raises
    ------
    OptionError
        If one is unknown, concerns other files, or has no value that it may have.
    """
    words: list[str] = []
    for name, value in given.items():
        if name not in forms()[form].takes or name not in OUTPUT:
            raise OptionError(f"output: {name!r} does not concern this kind of file")
        flag, low, high = OUTPUT[name]
        if name == "background":
            if not isinstance(value, str) or len(value) > 64:
                raise OptionError(f"{flag}: {value!r} is no colour")
        elif isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            raise OptionError(f"{flag}: {value!r} is not a whole number from {low} to {high}")
        words += [flag, str(value)]
    return tuple(words)


@dataclass(frozen=True, slots=True)
class Export:
    """A file that is ready, and what there is to warn of."""

    name: str
    data: bytes
    warnings: tuple[str, ...]


def export(job: Job, form: str, extra: tuple[str, ...], folder: Path) -> Export:
    """Make a file.

    Parameters
    ----------
    job : Job
    form : str
        One of `forms`.
    extra : tuple of str
        Options of the output alone.
    folder : Path
        Where the drawings are.

    Raises
    ------
    ShapetweenError
        What the command says, or that there is no room for the file.
    """
    kind = forms()[form]
    paths = {name: name for name in job.drawings}
    name = default_name(job, kind.ending)
    try:
        with tempfile.TemporaryDirectory(prefix="shapetween-export-") as place:
            out = Path(place) / (Path(name).stem if kind.folder else name)
            words = [
                *arguments(job, paths, kind.command, kind.takes),
                *kind.extra,
                *extra,
                "-o",
                str(out),
            ]
            warnings = (*_left_out(job, kind), *_ran(words, folder, {str(out): name}))
            return Export(name, _packed(out) if kind.folder else out.read_bytes(), warnings)
    except OSError as error:
        reason = (error.strerror or "it cannot be written").lower()
        raise ShapetweenError(f"{name}: not saved: {reason}") from error


def _left_out(job: Job, kind: Form) -> tuple[str, ...]:
    """Settings of how it plays that a kind of file has no use for, though it plays."""
    if kind.command != "morph":
        return ()
    unused = [
        setting.label
        for setting in SETTINGS
        if setting.stage == "write"
        and setting.name in job.options
        and setting.name not in kind.takes
    ]
    return (f"Not in such a file: {', '.join(unused)}.",) if unused else ()


def _ran(words: list[str], folder: Path, names: Mapping[str, str]) -> tuple[str, ...]:
    """Run the command; its warnings."""
    try:
        done = subprocess.run(
            [sys.executable, "-m", "shapetween", *words],
            cwd=folder,
            env=_environment(),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            encoding="utf-8",
            errors="replace",
            timeout=MOST_SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        raise ShapetweenError("the export took too long and was ended") from error
    stderr = done.stderr
    for path, name in names.items():
        stderr = stderr.replace(path, name)
    lines = [line.removeprefix("shapetween: ") for line in stderr.splitlines() if line.strip()]
    if done.returncode:
        last = lines[-1] if lines else "the command was cut off"
        raise ShapetweenError(last.removeprefix("error: "))
    return tuple(line.removeprefix("warning: ") for line in lines if line.startswith("warning: "))


def _environment() -> dict[str, str]:
    """Variables with which the command is this very package, wherever it stands."""
    own = str(Path(__file__).resolve().parents[2])
    others = os.environ.get("PYTHONPATH")
    return {**os.environ, "PYTHONPATH": os.pathsep.join([own, others] if others else [own])}


def _packed(folder: Path) -> bytes:
    """A folder of frames as one ZIP file, the same for the same frames."""
    from io import BytesIO

    made = BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(folder.iterdir()):
            archive.writestr(zipfile.ZipInfo(path.name), path.read_bytes(), zipfile.ZIP_DEFLATED)
    return made.getvalue()
