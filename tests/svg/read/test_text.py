"""Text as outlines: which letters, where, and from which font."""

from pathlib import Path

import numpy as np
import pytest

from shapetween.base.errors import InputError, OptionError
from shapetween.io.fonts import fonts_in
from shapetween.model.drawing import Drawing
from shapetween.model.paint import Colour
from shapetween.svg.read import textruns
from shapetween.svg.read.document import Fonts
from shapetween.svg.read.properties import unfolded
from shapetween.svg.read.reader import read_svg

SIZE = 100.0


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A font whose letters are squares: "a" to "z" half as wide as the size, with one kern."""
    builder = pytest.importorskip("fontTools.fontBuilder")
    pytest.importorskip("uharfbuzz")
    pens = pytest.importorskip("fontTools.pens.ttGlyphPen")
    letters = "abcdefghijklmnopqrstuvwxyz"
    names = [".notdef", "space", *letters]
    font = builder.FontBuilder(1000, isTTF=True)
    font.setupGlyphOrder(names)
    font.setupCharacterMap({32: "space", **{ord(letter): letter for letter in letters}})
    glyphs = {}
    for name in names:
        pen = pens.TTGlyphPen(None)
        if name in letters:
            pen.moveTo((0, 0))
            for point in ((400, 0), (400, 400), (0, 400)):
                pen.lineTo(point)
            pen.closePath()
        glyphs[name] = pen.glyph()
    font.setupGlyf(glyphs)
    font.setupHorizontalMetrics(dict.fromkeys(names, (500, 0)))
    font.setupHorizontalHeader(ascent=800, descent=-200)
    font.setupNameTable({"familyName": "Squares", "styleName": "Regular", "fullName": "Squares"})
    font.setupOS2(sTypoAscender=800, sTypoDescender=-200, sxHeight=400, usWeightClass=400)
    font.setupPost(underlinePosition=-100, underlineThickness=50)
    place = tmp_path_factory.mktemp("fonts")
    font.save(place / "squares.ttf")
    return place


@pytest.fixture(scope="module")
def fonts(folder: Path) -> Fonts:
    found = fonts_in(folder)
    assert found is not None
    return found


def read(fonts: Fonts | None, body: str, attributes: str = "") -> Drawing:
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 1000" font-family="Squares" '
        f'font-size="{SIZE}" {attributes}>{body}</svg>'
    )
    return read_svg(text.encode(), "a.svg", fonts=fonts)


def lefts(drawing: Drawing) -> list[float]:
    return [round(float(shape.rings[0].box[0, 0]), 6) for shape in drawing.shapes]


def bottoms(drawing: Drawing) -> list[float]:
    return [round(float(shape.rings[0].box[1, 1]), 6) for shape in drawing.shapes]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<text x="10" y="200">abc</text>', [10, 60, 110]),
        ('<text x="10" y="200">a c</text>', [10, 110]),
        ('<text x="10" y="200">  a\n  c </text>', [10, 110]),
        ('<text x="10" y="200" xml:space="preserve"> a</text>', [60]),
        ('<text x="10 300" y="200">abc</text>', [10, 300, 350]),
        ('<text x="10" y="200" dx="0 5">abc</text>', [10, 65, 115]),
        ('<text x="10" y="200">a<tspan dx="5">b</tspan>c</text>', [10, 65, 115]),
        ('<text x="10" y="200">a<tspan x="90">b</tspan>c</text>', [10, 90, 140]),
        ('<text x="500" y="200" text-anchor="middle">ab</text>', [450, 500]),
        ('<text x="500" y="200" text-anchor="end">ab</text>', [400, 450]),
        ('<text x="500 800" y="200" text-anchor="end">ab</text>', [450, 750]),
        ('<text x="10" y="200" letter-spacing="7">abc</text>', [10, 67, 124]),
        ('<text x="10" y="200" word-spacing="7">a c</text>', [10, 117]),
        ('<text x="10" y="200" textLength="300">abc</text>', [10, 135, 260]),
        (
            '<text x="10" y="200" textLength="300" lengthAdjust="spacingAndGlyphs">abc</text>',
            [10, 110, 210],
        ),
        ('<text x="10" y="200">a<tspan font-size="200">b</tspan>c</text>', [10, 60, 160]),
        ('<text x="10" y="200">a<tspan display="none">b</tspan>c</text>', [10, 60]),
        ('<text x="10" y="200">a<title>hidden</title>c</text>', [10, 60]),
    ],
)
def test_where_letters_stand(fonts: Fonts, body: str, expected: list[float]) -> None:
    drawing = read(fonts, body)
    assert drawing.warnings == ()
    assert lefts(drawing) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("attributes", "bottom"),
    [
        ("", 200),
        ('dy="5"', 205),
        ('dominant-baseline="middle"', 220),
        ('dominant-baseline="hanging"', 264),
        ('dominant-baseline="central"', 230),
        ('dominant-baseline="text-before-edge"', 280),
    ],
)
def test_on_which_line_letters_stand(fonts: Fonts, attributes: str, bottom: float) -> None:
    assert bottoms(read(fonts, f'<text y="200" {attributes}>a</text>')) == pytest.approx([bottom])


def test_letters_along_a_path(fonts: Fonts) -> None:
    body = (
        '<path id="p" fill="none" d="M100 900V100"/><text><textPath href="#p">ab</textPath></text>'
    )
    first, second = read(fonts, body).shapes
    np.testing.assert_allclose(first.rings[0].box, [[60, 860], [100, 900]], atol=1e-6)
    np.testing.assert_allclose(second.rings[0].box, [[60, 810], [100, 850]], atol=1e-6)


def test_each_letter_has_its_style(fonts: Fonts) -> None:
    drawing = read(fonts, '<text fill="red" y="99">a<tspan fill="blue">b</tspan></text>')
    fills = [shape.style.fill for shape in drawing.shapes]
    assert fills == [Colour(1, 0, 0), Colour(0, 0, 1)]


def test_a_gradient_runs_over_the_whole_text(fonts: Fonts) -> None:
    gradient = '<linearGradient id="g"><stop/><stop offset="1" stop-color="red"/></linearGradient>'
    one, two = read(fonts, gradient + '<text y="99" fill="url(#g)">ab</text>').shapes
    assert one.style.fill == two.style.fill


def test_text_clips(fonts: Fonts) -> None:
    body = '<clipPath id="c"><text y="100">ab</text></clipPath>'
    drawing = read(fonts, body + '<rect width="1000" height="1000" clip-path="url(#c)"/>')
    assert abs(sum(r.area for s in drawing.shapes for r in s.rings)) == pytest.approx(2 * 40 * 40)


def test_an_underline_is_drawn(fonts: Fonts) -> None:
    drawing = read(fonts, '<text y="100" text-decoration="underline">ab</text>')
    line = drawing.shapes[-1].rings[0].box
    np.testing.assert_allclose(line, [[0, 105], [100, 115]], atol=1e-6)


def test_a_missing_font_is_named(fonts: Fonts) -> None:
    drawing = read(fonts, '<text y="100" font-family="Nowhere Sans, Squares">ab</text>')
    (warning,) = drawing.warnings
    assert "'Nowhere Sans' is not installed, 'Squares' was taken" in warning
    assert "--font" in warning


def test_letters_that_no_font_has_are_named(fonts: Fonts) -> None:
    for letters in ("a\U000e0fff", "\U000e0fff"):
        drawing = read(fonts, f'<rect width="9" height="9"/><text y="100">{letters}</text>')
        (warning,) = drawing.warnings
        assert "no font here has" in warning


def test_without_fonts_text_is_left_out_with_a_word() -> None:
    with pytest.raises(InputError, match=r"shapetween\[text\]"):
        read(None, '<text y="100">ab</text>')


def test_a_folder_that_is_none_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="folder"):
        fonts_in(tmp_path / "none")


def test_a_folder_without_a_sound_font_is_refused(tmp_path: Path, folder: Path) -> None:
    for cut in (0, 200):
        (tmp_path / "a.ttf").write_bytes((folder / "squares.ttf").read_bytes()[:cut])
        with pytest.raises(OptionError, match="no font that can be read"):
            read(fonts_in(tmp_path), '<text y="100">ab</text>')
        fonts_in(tmp_path)  # nobody asks for one


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("12px serif", {"font-size": "12px", "font-family": "serif", "font-weight": "normal"}),
        ("italic bold 2em/1.5 'A B', c", {"font-family": "'A B', c", "font-style": "italic"}),
        ("700 9px x", {"font-weight": "700"}),
        ("small-caps 9px x", {"font-variant": "small-caps"}),
    ],
)
def test_the_shorthand_of_fonts(text: str, expected: dict[str, str]) -> None:
    assert unfolded("font", text).items() >= expected.items()
    assert unfolded("font", "nonsense") == {"font": "nonsense"}


def test_of_too_long_a_text_it_is_told_what_is_cut(
    fonts: Fonts, monkeypatch: pytest.MonkeyPatch
) -> None:
    most = 4
    monkeypatch.setattr(textruns, "MOST_CHARACTERS", most)
    for count, lost in ((most, 0), (most + 1, 1)):
        losses = read(fonts, f'<text id="t">{"a" * count}</text>').warnings
        assert [loss for loss in losses if "too many characters" in loss and "t" in loss] == (
            ["a text of too many characters was cut short: t"] * lost
        )


def test_of_too_many_places_of_letters_it_is_told(fonts: Fonts) -> None:
    most = textruns.MOST_VALUES
    for count, lost in ((most, 0), (most + 1, 1)):
        losses = read(fonts, f'<text x="{"1 " * count}">a</text>').warnings
        assert losses == ("a list of too many places of letters was cut short",) * lost
