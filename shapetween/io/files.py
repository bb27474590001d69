"""Files read and written whole, or not at all.

What is written appears under its name only when it is complete: it is made in a hidden folder
beside its place, and renamed. A run that fails half-way leaves what was there before.
"""

import os
import re
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from shapetween.base.errors import BudgetError, InputError, OptionError

__all__ = [
    "MAX_BYTES",
    "check_file",
    "check_form",
    "check_outputs",
    "fresh_file",
    "fresh_frames",
    "is_device",
    "read_bytes",
    "read_text",
    "same_file",
    "write_frames",
    "write_text",
]

#: Largest file that is read. Drawings of a few megabytes are rare; a larger limit lets a wrong
#: file fill the memory.
MAX_BYTES = 64 * 1024 * 1024

_FRAME = re.compile(r"frame_\d{4,}")


def read_bytes(path: Path, limit: int = MAX_BYTES) -> bytes:
    """Everything in a file.

    Raises
    ------
    InputError
        If there is no such file, it is a folder, or it may not be read.
    BudgetError
        If it is larger than `limit` bytes.
    """
    try:
        with path.open("rb") as file:
            data = file.read(limit + 1)
    except OSError as error:
        raise InputError(str(path), _reason(error)) from error
    except ValueError as error:  # a null character in the name
        raise InputError(repr(str(path)), "not the name of a file") from error
    if len(data) > limit:
        raise BudgetError(str(path), f"larger than the {limit} bytes that are read")
    return data


def read_text(path: Path, limit: int = MAX_BYTES) -> str:
    """Everything in a text file in UTF-8; a byte order mark is left out.

    Raises
    ------
    InputError
        As `read_bytes`, and if it is not UTF-8.
    """
    try:
        return read_bytes(path, limit).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(str(path), f"byte {error.start} is not UTF-8 text") from error


def check_outputs(outputs: Sequence[Path], inputs: Sequence[Path]) -> None:
    """Check before any work that what will be written overwrites no input, nor each other.

    An output that is a folder is one for frames, and may replace whatever is named like them.

    Raises
    ------
    OptionError
        If it would, or an output's folder is not there or may not be written to.
    """
    for k, output in enumerate(outputs):
        with _reported(output):
            if not is_device(output):
                _check_parent(output)
            for_frames = output.is_dir()
        for path in inputs:
            if same_file(output, path):
                raise OptionError(f"{output}: is an input; expected another name for the output")
            if for_frames and any(_is_frame(p, output) for p in (path, path.resolve())):
                raise OptionError(
                    f"{path}: is an input, and frames written to {output} would replace it; "
                    "expected another folder"
                )
        if any(same_file(output, path) for path in outputs[:k]):
            raise OptionError(f"{output}: is written twice; expected two names")


def check_file(path: Path) -> None:
    """Check before any work that what will be written there can be a file.

    Raises
    ------
    OptionError
        If a folder has that name.
    """
    with _reported(path):
        if path.is_dir():
            raise OptionError(f"{path}: is a folder; expected the name of a file")


def check_form(path: Path, what: str, endings: Sequence[str]) -> str:
    """Check before any work how a file is to be written, by its ending.

    Parameters
    ----------
    path : Path
        A pipe or a device may have any ending, or none.
    what : str
        What is written, for the message.
    endings : sequence of str
        At least one, with their points.

    Returns
    -------
    str
        The ending in lower case.

    Raises
    ------
    OptionError
        If it is none of `endings`, or a folder has that name.
    """
    check_file(path)
    form = path.suffix.lower()
    if form not in endings and not is_device(path):
        *others, last = endings
        accepted = f"{', '.join(others)} or {last}" if others else last
        raise OptionError(f"{path}: {what} is written as {accepted}")
    return form


def is_device(path: Path) -> bool:
    """Whether there is something of that name that is neither file nor folder, such as a pipe."""
    return path.exists() and not path.is_file() and not path.is_dir()


def _is_frame(path: Path, folder: Path) -> bool:
    """Whether a file is in the folder, and named as frames are."""
    return bool(_FRAME.fullmatch(path.stem)) and same_file(path.parent, folder)


def same_file(a: Path, b: Path) -> bool:
    """Whether two names are those of one file, be it there or not."""
    try:
        return a.samefile(b)
    except OSError:  # one of them is not there
        return a.resolve() == b.resolve()


def _check_parent(path: Path) -> None:
    folder = path.resolve().parent
    if not folder.is_dir():
        raise OptionError(f"{path}: there is no folder {folder}")
    if not os.access(folder, os.W_OK):
        raise OptionError(f"{path}: the folder {folder} may not be written to")


def write_text(path: Path, text: str) -> None:
    """Write a text file in UTF-8, replacing the one that was there.

    Raises
    ------
    OptionError
        If the file cannot be written; the old one is then still whole.
    """
    with fresh_file(path) as fresh:
        fresh.write_text(text, "utf-8", newline="\n")


@contextmanager
def fresh_file(path: Path) -> Iterator[Path]:
    """A file to write to, which takes the place of `path` once the context is left in peace.

    A symbolic link stays one, and the file it leads to is replaced. A device is written to.

    Raises
    ------
    OptionError
        If the file cannot be written; the old one is then still whole.
    """
    with _reported(path):
        check_file(path)
        if is_device(path):  # asked before links are followed: those to pipes lead nowhere
            yield path
            return
        place = path.resolve()
        with _beside(place) as folder:
            fresh = folder / place.name
            yield fresh
            if place.exists():
                fresh.chmod(place.stat().st_mode & 0o777)
            fresh.replace(place)


def write_frames(folder: Path, frames: Iterable[str]) -> int:
    """Write ``frame_0000.svg`` and so on into a folder, which is made if it is not there.

    Parameters
    ----------
    folder : Path
    frames : iterable of str
        The documents; they may be made while they are written.

    Returns
    -------
    int
        How many were written.

    Raises
    ------
    OptionError
        If they cannot be written; the folder is then as it was before.
    """
    count = 0
    with fresh_frames(folder, ".svg") as fresh:
        for count, text in enumerate(frames, start=1):
            name = f"frame_{count - 1:04}.svg"
            (fresh / name).write_text(text, "utf-8", newline="\n")
    return count


@contextmanager
def fresh_frames(folder: Path, suffix: str) -> Iterator[Path]:
    """A place for frames, which go into `folder` once the context is left in peace.

    The folder is made if it is not there. In it, frames of an earlier run with the same ending
    are replaced or removed; other files stay.

    Raises
    ------
    OptionError
        If they cannot be written; the folder is then as it was before.
    """
    with _reported(folder):
        place = folder.resolve()
        if place.exists() and not place.is_dir():
            raise OptionError(f"{folder}: is not a folder; expected one for the frames")
        with _beside(place) as scratch:
            fresh, old = scratch / "fresh", scratch / "old"
            fresh.mkdir()
            yield fresh
            if place.exists():
                old.mkdir()
                _exchange(fresh, place, old, suffix)
            else:
                fresh.rename(place)


def _exchange(fresh: Path, place: Path, old: Path, suffix: str) -> None:
    """Move frames out of `place` into `old`, and those in `fresh` into it; or nothing at all."""
    moved: list[tuple[Path, Path]] = []
    stale = [
        path for path in place.iterdir() if path.suffix == suffix and _FRAME.fullmatch(path.stem)
    ]
    steps = [(path, old / path.name) for path in stale]
    steps += [(path, place / path.name) for path in sorted(fresh.iterdir())]
    try:
        for source, target in steps:
            source.rename(target)
            moved.append((source, target))
    except BaseException:
        for source, target in reversed(moved):
            target.rename(source)
        raise


@contextmanager
def _beside(place: Path) -> Iterator[Path]:
    """A hidden folder next to `place`, so on the same disk, which is gone afterwards."""
    _check_parent(place)
    with tempfile.TemporaryDirectory(prefix=f".{place.name[:40]}.", dir=place.parent) as folder:
        yield Path(folder)


@contextmanager
def _reported(path: Path) -> Iterator[None]:
    """Errors of the system as one of ours that names the path."""
    try:
        yield
    except OSError as error:
        raise OptionError(f"{path}: cannot be written: {_reason(error)}") from error


def _reason(error: OSError) -> str:
    """What went wrong, as the system words it, without numbers and paths."""
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    if isinstance(error, IsADirectoryError):
        return "is a folder; expected a file"
    return (error.strerror or "cannot be read").lower()
