"""Work that is saved and opened again: one JSON file with everything in it.

::

    {
      "shapetween": "project",
      "version": 1,
      "drawings": [{"name": "horse.svg", "svg": "<svg ...>"},
                   {"name": "cow.svg", "file": "cow.svg"}],
      "order": ["horse.svg", "cow.svg"],
      "legs": [{"pins": [[22, 9.5, 22, 7]], "matches": ["tail:tail"], "matching": 2}],
      "options": {"duration": 1.5, "loop": "alternate"}
    }

A drawing is in the file, or in one beside it. `order` may be left out where each drawing comes
once. A leg says what is settled of one drawing and the next; what is as usual may be left out.
"""

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapetween.base.errors import OptionError
from shapetween.io.jsonfile import parse
from shapetween.studio.job import Job, job_of

__all__ = ["Project", "plain_name", "project_of", "project_text"]

VERSION = 1

#: Letters of a drawing's name: what file systems take whatever is put before and behind it.
MOST_LETTERS = 80

#: What a drawing may not be called: all but letters and digits of any script, and what no shell or
#: folder gives a meaning.
_STRANGE = re.compile(r"[^\w.\- ]+")


@dataclass(frozen=True, slots=True)
class Project:
    """A project that has been read.

    Attributes
    ----------
    files : dict of str to bytes
        The drawings, by name.
    job : Job
    """

    files: dict[str, bytes]
    job: Job


def project_text(job: Job, files: Mapping[str, bytes]) -> str:
    """A project as the text of a file, with the drawings in it."""
    used = dict.fromkeys(job.drawings)
    drawings = [{"name": name, "svg": files[name].decode("utf-8-sig")} for name in used]
    plain = job.plain()
    whole = {
        "shapetween": "project",
        "version": VERSION,
        "order": plain["drawings"],
        "legs": plain["legs"],
        "options": plain["options"],
        "drawings": drawings,
    }
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


def project_of(text: str, name: str, beside: Callable[[str], bytes] | None = None) -> Project:
    """Read a project.

    Parameters
    ----------
    text : str
    name : str
        What errors call the file.
    beside : callable, optional
        Reads a file beside the project; without it everything must be in the project.

    Raises
    ------
    ShapetweenError
        If it is none; one line that names the place.
    """
    data = parse(text, name)
    if not isinstance(data, dict) or data.get("shapetween") != "project":
        raise OptionError(f'{name}: no project; expected an object with "shapetween": "project"')
    if data.get("version") != VERSION:
        raise OptionError(f"{name}: version {data.get('version')!r}; expected {VERSION}")
    drawings = data.get("drawings")
    if not isinstance(drawings, list):
        raise OptionError(f"{name}: drawings: expected a list")
    files: dict[str, bytes] = {}
    for k, drawing in enumerate(drawings):
        known, content = _drawing(drawing, f"{name}: drawings[{k}]", beside)
        if known in files:
            raise OptionError(f"{name}: drawings[{k}]: {known!r} comes twice")
        files[known] = content
    allowed = {"shapetween", "version", "drawings", "order", "legs", "options"}
    unknown = sorted(set(data) - allowed)
    if unknown:
        raise OptionError(
            f"{name}: unknown key {unknown[0]!r}; expected {', '.join(sorted(allowed))}"
        )
    wanted = {key: data[key] for key in ("legs", "options") if key in data}
    try:
        job = job_of({"drawings": data.get("order", list(files)), **wanted}, files)
    except OptionError as error:
        raise OptionError(f"{name}: {error}") from error
    return Project(files, job)


def _drawing(data: Any, place: str, beside: Callable[[str], bytes] | None) -> tuple[str, bytes]:
    if not isinstance(data, dict) or not set(data) <= {"name", "svg", "file"}:
        raise OptionError(f"{place}: expected an object with name, and svg or file")
    inside, file = data.get("svg"), data.get("file")
    if (inside is None) == (file is None):
        raise OptionError(f"{place}: expected either svg or file")
    known = data.get("name", file)
    if not isinstance(known, str) or not known:
        raise OptionError(f"{place}.name: expected the name of a drawing")
    if inside is not None:
        if not isinstance(inside, str):
            raise OptionError(f"{place}.svg: expected the text of an SVG file")
        return known, inside.encode()
    if not isinstance(file, str) or beside is None:
        raise OptionError(f"{place}.file: expected a drawing in the project itself, as svg")
    return known, beside(file)


def plain_name(name: str) -> str:
    """What a drawing is kept as: a name that is no path, and says nothing to a shell."""
    last = re.split(r"[/\\]", name)[-1]
    kept = _STRANGE.sub("-", last).strip(" .-")[-MOST_LETTERS:].strip(" .-")
    stem = Path(kept).stem if Path(kept).suffix.lower() == ".svg" else kept
    return f"{stem or 'drawing'}.svg"
