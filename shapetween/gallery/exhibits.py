"""Exhibits, and where the scripts are that draw them.

A script is a module such as ``figure_1.py`` or ``showcase.py`` in the gallery's folder, with a
function ``draw`` that takes nothing and gives a list of `Exhibit`. The folder lies beside the
package in a checkout; a wheel brings it along as data.
"""

import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer, unobserved
from shapetween.io import files

__all__ = ["Exhibit", "Picture", "Room", "draw_rooms", "gallery_folder", "write_pictures"]

#: Where a wheel keeps the folder, below the environment's own.
INSTALLED = Path("share", "shapetween", "gallery")


@dataclass(frozen=True, slots=True)
class Picture:
    """A file to show.

    Attributes
    ----------
    name : str
        Of the file.
    content : str or Path
        Its text; or where it is already, to be copied.
    shows : str
        What is in it, for who cannot see it.
    """

    name: str
    content: str | Path
    shows: str


@dataclass(frozen=True, slots=True)
class Exhibit:
    """What is shown under one heading.

    Attributes
    ----------
    title : str
    text : str
        What to see in it.
    pictures : tuple of Picture
    table : tuple of tuple of str
        Rows, the first of them the heads; what starts with a star is the best of its row.
    wide : bool
        Whether it takes a whole row of the page.
    credit : str
        Whose drawings were used.
    """

    title: str
    text: str
    pictures: tuple[Picture, ...] = ()
    table: tuple[tuple[str, ...], ...] = ()
    wide: bool = True
    credit: str = ""


@dataclass(frozen=True, slots=True)
class Room:
    """Exhibits that belong together.

    Attributes
    ----------
    key : str
        Its name in links.
    title, text : str
    scripts : str
        Pattern of the names of the scripts that draw it.
    exhibits : tuple of Exhibit
        Once they are drawn.
    """

    key: str
    title: str
    text: str
    scripts: str
    exhibits: tuple[Exhibit, ...] = ()


ROOMS = (
    Room(
        "paper",
        "The paper, figure by figure",
        "What the method is, and beside it what triangles do, as published and as fair as they "
        "can be.",
        "figure_*.py",
    ),
    Room(
        "truth",
        "Against what really happens",
        "Scenes made by the computer, in which the in-betweens are known.",
        "truth.py",
    ),
    Room(
        "showcase",
        "As they come",
        "Two drawings each, no pins, no mesh drawn by hand, and default settings, but for --fit "
        "geometry where one drawing leaves most of its view box empty.",
        "showcase.py",
    ),
    Room(
        "drawings",
        "Drawings of many parts",
        "Icons, letters, emoji and illustrations as they come, by default settings: parts go to "
        "their like, what both have stands still.",
        "drawings.py",
    ),
    Room(
        "limits",
        "Where it fails",
        "What looks wrong, and why. Pins, ids and meshes drawn by hand help with some of it.",
        "limits.py",
    ),
)


def gallery_folder() -> Path:
    """The folder with the gallery's scripts and their inputs.

    Raises
    ------
    OptionError
        If it is neither beside the package nor where a wheel puts it.
    """
    places = [Path(__file__).parents[2] / "gallery", Path(sys.prefix) / INSTALLED]
    for place in places:
        if (place / "inputs" / "SOURCES.md").is_file():
            return place
    raise OptionError(
        f"the gallery's scripts are not installed: expected them in {places[0]} or {places[1]}"
    )


def draw_rooms(folder: Path, observe: Observer = unobserved) -> list[Room]:
    """Run all scripts of a gallery's folder.

    Parameters
    ----------
    folder : Path
    observe : Observer, optional
        Told of every script as it begins and ends.
    """
    rooms = []
    for room in ROOMS:
        exhibits: list[Exhibit] = []
        for script in sorted(folder.glob(room.scripts)):
            with observe(script.stem.replace("_", " ")):
                exhibits += drawn(script)
        rooms.append(Room(room.key, room.title, room.text, room.scripts, tuple(exhibits)))
    return rooms


def drawn(script: Path) -> Sequence[Exhibit]:
    """What a script draws."""
    spec = spec_from_file_location(f"shapetween_gallery_{script.stem}", script)
    assert spec is not None  # it is a file that ends in .py
    assert spec.loader is not None
    module: Any = module_from_spec(spec)
    spec.loader.exec_module(module)
    exhibits: Sequence[Exhibit] = module.draw()
    return exhibits


def write_pictures(rooms: Iterable[Room], folder: Path) -> None:
    """Write all pictures of some rooms."""
    for picture in (p for room in rooms for exhibit in room.exhibits for p in exhibit.pictures):
        path = folder / picture.name
        if isinstance(picture.content, str):
            files.write_text(path, picture.content)
        elif not (path.exists() and path.samefile(picture.content)):
            with files.fresh_file(path) as fresh:
                fresh.write_bytes(picture.content.read_bytes())
