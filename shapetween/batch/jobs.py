"""What a batch is to make: one job a pair, from a table or from the files of a folder."""

import csv
import difflib
import os
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path
from typing import Any

from shapetween.base.errors import InputError, OptionError, ShapetweenError

__all__ = ["Job", "all_pairs_in", "check_jobs", "pairs_in", "read_table"]

_DRAWINGS = (".svg", ".svgz")
_SIDE = re.compile(r"(?P<name>.+)[-_.](?P<side>[ab])")


@dataclass(frozen=True, slots=True)
class Job:
    """One pair of drawings and the animated SVG that is to come of it.

    Attributes
    ----------
    a, b : Path
        The drawings.
    out : Path
        What to write, in the folder of the batch.
    mesh : Path, optional
        A mesh to use.
    options : mapping of str to plain values
        Other arguments of `shapetween.morph` and `shapetween.Morph.svg`, by name.
    """

    a: Path
    b: Path
    out: Path
    mesh: Path | None = None
    options: Mapping[str, Any] = field(default_factory=dict)


def read_table(
    text: str,
    name: str,
    folder: Path,
    columns: Mapping[str, tuple[str, Callable[[str], Any]]],
    defaults: Mapping[str, Any] | None = None,
) -> list[Job]:
    """Jobs from a table of comma-separated values with the columns a, b and perhaps others.

    Parameters
    ----------
    text : str
    name : str
        What errors call the table.
    folder : Path
        What paths of drawings and meshes are relative to.
    columns : mapping of str to (str, callable)
        Further columns: the option each one is, and what reads a cell; it raises
        `ShapetweenError` or ValueError, whose text says what would be accepted.
    defaults : mapping of str to Any, optional
        Options of a row whose cell is empty or missing.

    Returns
    -------
    list of Job
        One for each row that is not empty, ``A-to-B.svg`` where the column out names no file.

    Raises
    ------
    InputError
        If anything is not as it should be; the message names the row, counted from 1 with the
        header, and the column.
    """
    if "\0" in text:
        raise InputError(name, "holds a null character; expected comma-separated text")
    known = ("a", "b", "out", "mesh", *columns)
    header: list[str] = []
    jobs: list[Job] = []
    outs: dict[Path, int] = {}
    row = 0
    try:
        for row, cells in enumerate(csv.reader(text.splitlines(keepends=True), strict=True), 1):
            values = [cell.strip() for cell in cells]
            if not any(values):
                continue
            if not header:
                header = _header(values, known, name, row)
                continue
            if len(values) > len(header):
                raise InputError(
                    name, f"row {row}: {len(values)} cells; the header has {len(header)}"
                )
            filled = {key: value for key, value in zip(header, values, strict=False) if value}
            job = _job(filled, folder, columns, defaults or {}, f"{name}: row {row}")
            if job.out in outs:
                raise InputError(
                    name, f"row {row}, column out: {job.out} is that of row {outs[job.out]} too"
                )
            outs[job.out] = row
            jobs.append(job)
    except csv.Error as error:
        raise InputError(name, f"row {row + 1}: not comma-separated values: {error}") from error
    if not jobs:
        raise InputError(name, "has no pairs; expected a header such as a,b,out and a row a pair")
    return jobs


def _header(values: list[str], known: tuple[str, ...], name: str, row: int) -> list[str]:
    for k, value in enumerate(values):
        if value not in known and ";" in value:
            raise InputError(name, f"row {row}: has semicolons; expected commas between cells")
        if value not in known:
            near = difflib.get_close_matches(value, known, n=1)
            hint = f"did you mean {near[0]}?" if near else f"expected {', '.join(known)}"
            raise InputError(name, f"row {row}, column {value or k + 1}: not known; {hint}")
        if value in values[:k]:
            raise InputError(name, f"row {row}, column {value}: stands twice")
    for needed in ("a", "b"):
        if needed not in values:
            raise InputError(name, f"row {row}: no column {needed}; expected such as a,b,out")
    return values


def _job(
    filled: Mapping[str, str],
    folder: Path,
    columns: Mapping[str, tuple[str, Callable[[str], Any]]],
    defaults: Mapping[str, Any],
    place: str,
) -> Job:
    for side in ("a", "b"):
        if side not in filled:
            raise InputError(f"{place}, column {side}", "empty; expected the name of a file")
    options = dict(defaults)
    for key, (option, read) in columns.items():
        if key in filled:
            try:
                options[option] = read(filled[key])
            except (ShapetweenError, ValueError) as error:
                raise InputError(f"{place}, column {key}", str(error)) from error
    a, b = folder / filled["a"], folder / filled["b"]
    out = Path(filled["out"]) if "out" in filled else _named(a, b)
    if out.suffix.lower() != ".svg":
        raise InputError(f"{place}, column out", f"{out}: expected a name that ends in .svg")
    return Job(a, b, out, folder / filled["mesh"] if "mesh" in filled else None, options)


def _named(a: Path, b: Path) -> Path:
    return Path(f"{a.stem}-to-{b.stem}.svg")


def pairs_in(folder: Path, options: Mapping[str, Any] | None = None) -> list[Job]:
    """One job for each pair of files that are named as one.

    These are ``NAME-a.svg`` and ``NAME-b.svg`` (or with ``_`` or ``.`` before the letter), and
    the files ``a.svg`` and ``b.svg`` of a folder ``NAME``. What is written is ``NAME.svg``.

    Raises
    ------
    OptionError
        If a file lacks its partner, two pairs have one name, or there is none.
    """
    sides: dict[tuple[str, str], dict[str, Path]] = {}
    for path in _drawings(folder):
        if found := _SIDE.fullmatch(path.stem):
            key = found["name"], path.name[len(found["name"])]
            _place(sides.setdefault(key, {}), found["side"], path)
    for inner in sorted(path for path in _listed(folder) if path.is_dir()):
        for path in _drawings(inner):
            if path.stem in ("a", "b"):
                _place(sides.setdefault((inner.name, "/"), {}), path.stem, path)
    jobs = []
    for (name, _), pair in sorted(sides.items()):
        if len(pair) == 1:
            ((side, path),) = pair.items()
            raise OptionError(f"{path}: has no partner {'b' if side == 'a' else 'a'} of its name")
        jobs.append(Job(pair["a"], pair["b"], Path(f"{name}.svg"), None, dict(options or {})))
    if not jobs:
        raise OptionError(
            f"{folder}: has no pairs; expected files such as cat-a.svg and cat-b.svg, "
            "or folders with a.svg and b.svg"
        )
    return jobs


def _place(pair: dict[str, Path], side: str, path: Path) -> None:
    if side in pair:
        raise OptionError(f"{path}: {pair[side].name} is {side} of this pair already")
    pair[side] = path


def all_pairs_in(folder: Path, options: Mapping[str, Any] | None = None) -> list[Job]:
    """One job for every two drawings of a folder, from the one whose name comes first.

    Raises
    ------
    OptionError
        If there are not two.
    """
    drawings = _drawings(folder)
    if len(drawings) < 2:
        raise OptionError(f"{folder}: has {len(drawings)} drawings; expected two or more")
    return [
        Job(a, b, _named(a, b), None, dict(options or {})) for a, b in combinations(drawings, 2)
    ]


def _drawings(folder: Path) -> list[Path]:
    return sorted(
        path for path in _listed(folder) if path.suffix.lower() in _DRAWINGS and path.is_file()
    )


def _listed(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except OSError as error:
        raise OptionError(f"{folder}: not a folder that can be read") from error


def check_jobs(jobs: Iterable[Job], folder: Path, reserved: Iterable[Path]) -> None:
    """Check that what will be written is in its folder, and overwrites no input nor each other.

    Parameters
    ----------
    jobs : iterable of Job
    folder : Path
        Where they are written.
    reserved : iterable of Path
        Files that the batch itself writes.

    Raises
    ------
    OptionError
        If it would not be so.
    """
    listed = list(jobs)
    inputs = {path.resolve() for job in listed for path in (job.a, job.b, job.mesh) if path}
    own = {path.resolve() for path in reserved}
    seen: set[Path] = set()
    home = Path(os.path.normpath(folder.absolute()))  # links in it may lead where they like
    for place in own & inputs:
        raise OptionError(f"{place}: is an input; expected another folder for the output")
    for job in listed:
        place = (folder / job.out).resolve()
        if not Path(os.path.normpath(home / job.out)).is_relative_to(home):
            raise OptionError(f"{job.out}: is not in {folder}; expected a name inside")
        if place in inputs:
            raise OptionError(f"{job.out}: is an input; expected another name for the output")
        if place in seen or place in own:
            raise OptionError(f"{job.out}: is written twice; expected two names")
        seen.add(place)
