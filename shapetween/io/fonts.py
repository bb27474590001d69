"""Fonts on this machine, or in a folder that the user names, by family, weight and slant."""

import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from shapetween.base.errors import OptionError
from shapetween.io import files

__all__ = ["fonts_in"]

ENDINGS = frozenset({".ttf", ".otf", ".ttc", ".otc", ".woff", ".woff2"})

#: Most font files that are looked at; more are no collection of fonts but a mirror of one.
MOST_FILES = 20_000

#: What stands for the families that name a kind of font, the first that is there.
GENERIC = {
    "serif": ("times new roman", "times", "liberation serif", "dejavu serif", "noto serif"),
    "sans-serif": ("arial", "helvetica", "liberation sans", "dejavu sans", "noto sans"),
    "monospace": ("courier new", "courier", "liberation mono", "dejavu sans mono"),
    "cursive": ("comic sans ms", "dejavu sans"),
    "fantasy": ("impact", "dejavu sans"),
    "system-ui": ("segoe ui", "sf pro text", "cantarell", "dejavu sans", "arial"),
}
GENERIC |= {"ui-sans-serif": GENERIC["system-ui"], "ui-serif": GENERIC["serif"]}
GENERIC |= {"ui-monospace": GENERIC["monospace"], "-apple-system": GENERIC["system-ui"]}

#: Families that are drawn alike, letter by letter as wide.
ALIKE = {
    "arial": ("liberation sans",),
    "helvetica": ("arial", "liberation sans"),
    "times": ("times new roman", "liberation serif"),
    "times new roman": ("liberation serif",),
    "courier": ("courier new", "liberation mono"),
    "courier new": ("liberation mono",),
}


@dataclass(frozen=True, slots=True)
class _Face:
    """One font of a file."""

    place: Path
    index: int
    families: frozenset[str]
    name: str
    weight: int
    width: int
    slanted: bool


def fonts_in(
    folder: str | os.PathLike[str] | None = None,
) -> Callable[[str, int, bool], tuple[str, bytes, int] | None] | None:
    """Where fonts are found: a folder first, then those installed.

    Parameters
    ----------
    folder : path, optional

    Returns
    -------
    callable or None
        From a family in lower case (empty for any), a weight, and whether it is slanted, to a
        font's name, its file and which of the file's fonts it is; None if there is no such
        family. None in place of the callable where fontTools or uharfbuzz are not installed.

    Raises
    ------
    OptionError
        If there is no such folder; from the callable, if it holds no font.
    """
    if folder is not None and not Path(folder).is_dir():
        raise OptionError(f"font {folder}: expected a folder that holds fonts")
    if not all(map(find_spec, ("fontTools", "uharfbuzz"))):
        if folder is not None:
            raise OptionError("font: needs fontTools and uharfbuzz; install shapetween[text]")
        return None

    def found(family: str, weight: int, slanted: bool) -> tuple[str, bytes, int] | None:
        own = _faces(Path(folder)) if folder is not None else ()
        if folder is not None and not own:
            raise OptionError(f"font {folder}: holds no font that can be read")
        for faces in (own, _installed()):
            for name in (family, *ALIKE.get(family, ()), *GENERIC.get(family, ())):
                known = [face for face in faces if name in face.families or not family]
                if known:
                    best = min(known, key=lambda face: _distance(face, weight, slanted))
                    return best.name, _data(best.place), best.index
        return None

    return found


def _distance(face: _Face, weight: int, slanted: bool) -> tuple[float, ...]:
    """How far a font is from what is asked for (CSS Fonts Level 4, section 5.2)."""
    lighter = face.weight < weight
    wanted = lighter if weight < 400 else not lighter
    if 400 <= weight <= 500:
        wanted = weight <= face.weight <= 500
    away = abs(face.weight - weight)
    return (abs(face.width - 5), face.slanted != slanted, not wanted and away > 0, away)


@lru_cache(maxsize=32)
def _data(place: Path) -> bytes:
    return files.read_bytes(place)


@lru_cache(maxsize=1)
def _installed() -> tuple[_Face, ...]:
    return tuple(face for folder in _folders() for face in _faces(folder))


def _folders() -> Iterator[Path]:
    """Where systems keep fonts."""
    home = Path.home()
    if sys.platform == "win32":
        yield Path(os.environ.get("WINDIR", r"C:\Windows")) / "Fonts"
        yield home / "AppData/Local/Microsoft/Windows/Fonts"
    elif sys.platform == "darwin":
        yield from (Path("/System/Library/Fonts"), Path("/Library/Fonts"), home / "Library/Fonts")
    else:
        yield from (Path("/usr/share/fonts"), Path("/usr/local/share/fonts"))
        yield from (home / ".local/share/fonts", home / ".fonts")


@lru_cache(maxsize=64)
def _faces(folder: Path) -> tuple[_Face, ...]:
    """All fonts in a folder and below, in the order of their names."""
    places = []
    for root, _, names in os.walk(folder):
        places += [Path(root, name) for name in names if Path(name).suffix.lower() in ENDINGS]
        if len(places) > MOST_FILES:
            break
    return tuple(face for place in sorted(places) for face in _faces_of(place))


def _faces_of(place: Path) -> list[_Face]:
    """The fonts in one file; none if it is damaged."""
    from fontTools.ttLib import TTCollection, TTFont

    try:
        with place.open("rb") as file:  # fontTools leaves open what it fails to read
            if place.suffix.lower() in (".ttc", ".otc"):
                fonts = TTCollection(file, lazy=True).fonts
            else:
                fonts = [TTFont(file, lazy=True)]
            return [_face(place, k, font) for k, font in enumerate(fonts)]
    except Exception:  # a damaged table leads fontTools to anything
        return []


def _face(place: Path, index: int, font: Any) -> _Face:
    names = font["name"]
    families = {str(n).strip().lower() for n in names.names if n.nameID in (1, 16)}
    style = font.get("OS/2")
    weight = int(getattr(style, "usWeightClass", 400))
    width = int(getattr(style, "usWidthClass", 5))
    slanted = bool(getattr(style, "fsSelection", 0) & 0b1000000001)
    full = names.getDebugName(4) or place.stem
    return _Face(place, index, frozenset(families), full, weight, width, slanted)
