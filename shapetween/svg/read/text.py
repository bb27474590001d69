"""Text as the outlines of its letters.

.. [SVG2] *Scalable Vector Graphics 2*, chapter 11.
"""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Affine, Points
from shapetween.geometry.affine import affine, compose, mapped
from shapetween.geometry.bezier import flatten
from shapetween.svg.read.document import Document
from shapetween.svg.read.fontface import Face, Glyph, face_of
from shapetween.svg.read.frames import Frame, Placed
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.paths import path_of
from shapetween.svg.read.shapes import SHAPES, basic_shape
from shapetween.svg.read.textruns import (
    Character,
    characters_of,
    families_of,
    is_slanted,
    weight_of,
)
from shapetween.svg.read.transform import parse_transform
from shapetween.svg.read.units import number
from shapetween.svg.read.xml import local_name

__all__ = ["Letter", "letters_of"]

#: What is told of letters that no font has.
LOST_LETTERS = "letters that no font here has were left out"

#: What browsers take where no family is named, or none of those named is there.
USUAL = ("times new roman", "sans-serif", "serif", "")

#: Chords of a curve of a path that text stands on: places on it are off by less than is seen.
CHORDS = 32


#: Lines with text as Chromium draws them, whatever the font asks for: where their upper edge is
#: above that of the text, in shares of the size and of how far the font ascends; and how thick.
DECORATIONS = (("underline", -0.05, 0.0), ("overline", 0.1, 1.0), ("line-through", 0.05, 1 / 3))
THICK = 0.1

#: How far a font ascends that does not say so, as a share of its size.
ASCENT = 0.8


@dataclass(frozen=True, slots=True, eq=False)
class Letter:
    """One glyph in the coordinates of its text, with the style of what holds it."""

    frame: Frame
    subpaths: tuple[Subpath, ...]


@dataclass(slots=True, eq=False)
class _Set:
    """A glyph as it is set: what it is, and where the pen is for it."""

    character: Character
    face: Face
    glyph: Glyph
    size: float
    x: float = 0.0
    y: float = 0.0
    turn: float = 0.0
    advance: float = 0.0
    starts: bool = False
    matrix: Affine | None = None
    opens: Character | None = None


def letters_of(document: Document, placed: Placed) -> list[Letter]:
    """The glyphs of a ``text`` in the order of its characters; empty ones are left out.

    Raises
    ------
    BudgetError
    """
    characters = characters_of(document, placed.element, placed.frame)
    if not characters:
        return []
    document.spend("path_commands", len(characters))
    glyphs = _shaped(document, characters)
    _placed(glyphs)
    _anchored(placed, glyphs)
    _on_paths(document, placed, glyphs)
    letters = []
    for glyph in glyphs:
        outline = glyph.face.outline(glyph.glyph.number)
        document.spend("path_commands", sum(len(sub.curves) for sub in outline))
        if not outline or glyph.matrix is None:
            continue
        scale = affine(glyph.size, 0, 0, glyph.size, 0, 0)
        whole = compose(glyph.matrix, scale)
        subpaths = tuple(
            Subpath(mapped(sub.curves, whole), mapped(sub.start, whole), sub.closed)
            for sub in outline
        )
        letters.append(Letter(glyph.character.frame, subpaths))
    return letters + _decorations(glyphs)


def _decorations(glyphs: Sequence[_Set]) -> list[Letter]:
    """Lines under, over and through text, one for each run."""
    letters = []
    runs: list[list[_Set]] = []
    for glyph in glyphs:
        if runs and glyph.opens is None and not glyph.turn and glyph.character.path is None:
            runs[-1].append(glyph)
        else:
            runs.append([glyph])
    for run in runs:
        first = run[0]
        words = first.character.frame.properties.get("text-decoration", "none").lower().split()
        ascent = first.face.metric("HORIZONTAL_ASCENDER", ASCENT)
        for word, above, of_ascent in DECORATIONS:
            if word in words and first.matrix is not None:
                end = run[-1].x + run[-1].advance
                values = {"x": first.x, "y": first.y - (above + of_ascent * ascent) * first.size}
                values |= {"width": end - first.x, "height": THICK * first.size}
                texts = {name: f"{value!r}" for name, value in values.items()}
                drawn = basic_shape("rect", texts, first.character.frame.viewport, 10)
                letters.append(Letter(first.character.frame, drawn.subpaths))
    return letters


def _faces(document: Document, frame: Frame) -> list[Face]:
    """The fonts for a style, the best first, and at last whichever there is."""
    assert document.fonts is not None  # else there is no text
    weight, slanted = weight_of(frame), is_slanted(frame)
    faces: list[Face] = []
    missing = []
    for family in families_of(frame):
        found = document.fonts(family.lower(), weight, slanted)
        if found is not None:
            faces.append(face_of(*found, weight))
        elif not faces:
            missing.append(family)
    for family in USUAL:
        found = document.fonts(family, weight, slanted)
        if found is not None:
            faces.append(face_of(*found, weight))
    if missing and faces:
        document.losses.add(
            "text is set in another font than it names",
            f"{missing[0]!r} is not installed, {faces[0].name!r} was taken; "
            "give a folder with it as --font",
        )
    return faces


def _shaped(document: Document, characters: Sequence[Character]) -> list[_Set]:
    """Characters as glyphs, in visual order within each run."""
    glyphs: list[_Set] = []
    known: dict[int, list[Face]] = {}
    faces: list[Face | None] = []
    for character in characters:
        key = id(character.element)
        if key not in known:
            known[key] = _faces(document, character.frame)
        if not known[key]:
            document.losses.add("text was left out: no font is installed; give one as --font")
            return []
        blank = character.text.isspace() or unicodedata.category(character.text[:1]) in ("Mn", "Cf")
        before = faces[-1] if faces and blank else None
        face = before or next((f for f in known[key] if f.has(character.text[0])), None)
        if face is None and blank:
            face = known[key][0]
        if face is None:
            document.losses.add(LOST_LETTERS, repr(character.text))
        faces.append(face)
    start = 0
    while start < len(characters):
        end = start + 1
        while end < len(characters) and _goes_on(characters, faces, end):
            end += 1
        face = faces[start]
        if face is not None:
            glyphs += _run(characters[start:end], face)
        start = end
    return glyphs


def _goes_on(characters: Sequence[Character], faces: Sequence[Face | None], k: int) -> bool:
    """Whether a character is set in one run with the one before it."""
    return (
        faces[k] is faces[k - 1]
        and characters[k].element is characters[k - 1].element
        and not characters[k].places.keys() & {"x", "y"}
    )


def _run(characters: Sequence[Character], face: Face) -> list[_Set]:
    first = characters[0]
    properties = first.frame.properties
    text = "".join(character.text for character in characters)
    at = [k for k, character in enumerate(characters) for _ in character.text]
    spacing = _spacing(first.frame, "letter-spacing")
    features = {"liga": False, "clig": False} if spacing else {}
    if properties.get("font-kerning") == "none":
        features["kern"] = False
    if "small-caps" in properties.get("font-variant", ""):
        features["smcp"] = True
    rtl = properties.get("direction") == "rtl"
    size = first.frame.viewport.font_size
    found = []
    for glyph in face.shaped(text, rtl, features):
        character = characters[at[min(glyph.cluster, len(at) - 1)]]
        advance = glyph.advance * size
        if glyph.advance:
            advance += spacing
            if character.text == " ":
                advance += _spacing(character.frame, "word-spacing")
        found.append(_Set(character, face, glyph, size, advance=advance))
    if found:
        found[0].opens = first
    return found


def _spacing(frame: Frame, name: str) -> float:
    return frame.viewport.length(frame.properties.get(name, "0"), 0.0) or 0.0


def _placed(glyphs: Sequence[_Set]) -> None:
    """Move the pen from glyph to glyph, and to where characters say.

    Where a run starts the pen goes to the place of its first character, whichever glyph comes
    first: what runs from right to left is set from its left end.
    """
    x = y = 0.0
    shifted: set[int] = set()
    for glyph in glyphs:
        if glyph.opens is not None:
            opens = glyph.opens.places
            glyph.starts = "x" in opens or "y" in opens
            x, y = opens.get("x", x), opens.get("y", y)
        places = glyph.character.places
        if id(glyph.character) not in shifted:
            shifted.add(id(glyph.character))
            x, y = x + places.get("dx", 0.0), y + places.get("dy", 0.0)
        glyph.x, glyph.y, glyph.turn = x, y, places.get("rotate", 0.0)
        x += glyph.advance


def _anchored(placed: Placed, glyphs: Sequence[_Set]) -> None:
    """Shift each chunk of text to its anchor, stretch it to its length, and set the glyphs."""
    starts = [k for k, glyph in enumerate(glyphs) if glyph.starts or k == 0]
    for start, end in pairwise([*starts, len(glyphs)]):
        chunk = glyphs[start:end]
        first = chunk[0]
        left = min(glyph.x for glyph in chunk)
        width = max(glyph.x + glyph.advance for glyph in chunk) - left
        wanted = placed.frame.viewport.length(
            placed.element.get("textLength"), placed.frame.viewport.width
        )
        stretch = 1.0
        if wanted and wanted > 0 and width > 0 and len(starts) == 1:
            if placed.element.get("lengthAdjust") == "spacingAndGlyphs":
                stretch = wanted / width
            elif len(chunk) > 1:
                more = (wanted - width) / (len(chunk) - 1)
                for k, glyph in enumerate(chunk):
                    glyph.x += k * more
            width = wanted
        properties = first.character.frame.properties
        anchor = properties.get("text-anchor", "start")
        share = {"middle": 0.5, "end": 1.0}.get(anchor, 0.0)
        if properties.get("direction") == "rtl" and anchor != "middle":
            share = 1.0 - share
        for glyph in chunk:
            c, s = math.cos(math.radians(glyph.turn)), math.sin(math.radians(glyph.turn))
            x = left + (glyph.x - left) * stretch - share * width
            y = glyph.y + _baseline(glyph)
            shift = affine(stretch, 0, 0, 1, glyph.glyph.x * glyph.size * stretch, 0)
            shift[1, 2] = glyph.glyph.y * glyph.size
            glyph.x = x
            glyph.matrix = compose(affine(c, s, -s, c, x, y), shift)


def _baseline(glyph: _Set) -> float:
    """How far down a glyph is drawn from its line ([SVG2]_, section 11.10.2)."""
    properties = glyph.character.frame.properties
    face, size = glyph.face, glyph.size
    up, down = face.metric("HORIZONTAL_ASCENDER", 0.8), face.metric("HORIZONTAL_DESCENDER", -0.2)
    name = properties.get("alignment-baseline", "auto")
    if name in ("auto", "baseline"):
        name = properties.get("dominant-baseline", "auto")
    shares = {
        "middle": face.metric("X_HEIGHT", 0.5) / 2,
        "central": (up + down) / 2,
        "hanging": 0.8 * up,
        "mathematical": 0.5 * up,
        "text-before-edge": up,
        "before-edge": up,
        "text-top": up,
        "text-after-edge": down,
        "after-edge": down,
        "text-bottom": down,
        "ideographic": down,
    }
    moved = shares.get(name, 0.0) * size
    shift = properties.get("baseline-shift", "baseline")
    if shift == "sub":
        return moved + 0.2 * size
    if shift == "super":
        return moved - 0.4 * size
    return moved - (glyph.character.frame.viewport.length(shift, size) or 0.0)


def _on_paths(document: Document, placed: Placed, glyphs: Sequence[_Set]) -> None:
    """Set glyphs of a ``textPath`` along its path, and hide those beyond its ends."""
    by_path: dict[int, list[_Set]] = {}
    for glyph in glyphs:
        if glyph.character.path is not None:
            by_path.setdefault(id(glyph.character.path), []).append(glyph)
    for found in by_path.values():
        element = found[0].character.path
        assert element is not None  # only such were collected
        target = document.target(element)
        line = _line(document, placed, target) if target is not None else None
        if line is None:
            for glyph in found:
                glyph.matrix = None
            continue
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
        total = float(along[-1])
        text = element.get("startOffset", "0")
        share = number(text) if "%" in text else None
        offset = (
            share * total if share is not None else placed.frame.viewport.length(text, total) or 0.0
        )
        for glyph in found:
            middle = offset + glyph.x + glyph.advance / 2
            if not 0 <= middle <= total:
                glyph.matrix = None
                continue
            k = min(int(np.searchsorted(along, middle, side="right")) - 1, len(line) - 2)
            step = line[k + 1] - line[k]
            length = max(float(np.linalg.norm(step)), 1e-300)
            c, s = (step / length).tolist()
            x, y = (line[k] + step * (middle - along[k]) / length).tolist()
            down = glyph.y + _baseline(glyph)
            back = affine(1, 0, 0, 1, -glyph.advance / 2, down)
            glyph.matrix = compose(affine(c, s, -s, c, x, y), back)


def _line(document: Document, placed: Placed, target: Element) -> Points | None:
    """The points of the path that text stands on, in the text's own coordinates."""
    if local_name(target) not in SHAPES:
        return None
    shape = Placed(target, local_name(target), placed.frame)
    own = parse_transform(shape.element.get("transform", ""))
    lines = []
    for subpath in path_of(document, shape):
        if len(subpath.curves):
            points = [flatten(subpath.curves, CHORDS), subpath.curves[-1:, 3]]
            lines.append(np.concatenate(points))
            if subpath.closed:
                lines.append(subpath.start[None])
    if not lines:
        return None
    line = np.concatenate(lines)
    line = line if own is None else mapped(line, own)
    fresh = np.concatenate([[True], (np.diff(line, axis=0) != 0).any(axis=1)])
    return line[fresh] if fresh.sum() > 1 else None
