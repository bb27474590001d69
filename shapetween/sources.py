"""What a drawing may be given as: a file, SVG text, bytes, or what was read already."""

from os import PathLike
from pathlib import Path
from typing import TypeAlias

from shapetween.io import files
from shapetween.io.fonts import fonts_in
from shapetween.io.linked import pictures_beside
from shapetween.model.drawing import Drawing
from shapetween.svg.read.reader import read_svg

__all__ = ["Source", "key_of", "name_of", "opened"]

Source: TypeAlias = str | bytes | PathLike[str] | Drawing
"""An SVG file, the text or the bytes of one, or a drawing already read."""


def opened(source: Source, pictures: bool, font: str | PathLike[str] | None) -> Drawing:
    """The drawing, read from its file if need be, with patterns and pictures or without."""
    if isinstance(source, Drawing):
        return source
    text = _text_of(source)
    if text is not None:
        # What it names lies beside no file.
        nowhere = (lambda address: None) if pictures else None
        return read_svg(text, "SVG text", pictures=nowhere, fonts=fonts_in(font))
    assert not isinstance(source, bytes)  # it is text
    path = Path(source)
    beside = pictures_beside(path) if pictures else None
    return read_svg(files.read_bytes(path), str(source), pictures=beside, fonts=fonts_in(font))


def name_of(source: Source, default: str) -> str:
    """What messages call a drawing: its file, or some other name."""
    told = isinstance(source, Drawing) or _text_of(source) is not None
    return default if told else str(source)


def _text_of(source: Source) -> bytes | None:
    """The bytes of what is SVG itself; None if it is a path or a drawing: no path begins so."""
    if isinstance(source, bytes):
        return source
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("<"):
        return source.encode()
    return None


def key_of(source: Source) -> str | int:
    """The same for the same drawing."""
    if isinstance(source, Drawing):
        return id(source)
    text = _text_of(source)
    if text is not None:
        return text.decode("utf-8", "surrogateescape")
    assert not isinstance(source, bytes)  # it is text
    return str(Path(source).absolute())
