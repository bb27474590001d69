"""The first frame and the last, against resvg's own picture of the two files."""

import io

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from shapetween.model.fit import Fit
from shapetween.pipeline import Options, prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg

XMLNS = 'xmlns="http://www.w3.org/2000/svg"'
PAGE = f"<svg {XMLNS} viewBox='0 0 100 100'>"
SQUARE = f"{PAGE}<path fill='#069' d='M20 20H80V80H20Z'/></svg>"

#: Whole files, each of which is drawn as first and as last.
FILES = {
    "star": f"{PAGE}<path fill='#fc0' stroke='#600' stroke-width='3' "
    "d='M50 5L79 95L2 38H98L21 95Z'/></svg>",
    "loops": f"{PAGE}<path fill-rule='evenodd' d='M10 50C120 -40 120 140 10 50Z"
    "M50 10C-40 120 140 120 50 10Z'/></svg>",
    "overlapping": f"{PAGE}<path d='M30 50a20 20 0 1 1 40 0a20 20 0 1 1-40 0Z"
    "M50 50a20 20 0 1 0 40 0a20 20 0 1 0-40 0Z'/></svg>",
    "eight": f"{PAGE}<path d='M50 50C30 30 20 10 50 10S70 30 50 50ZM50 50C70 70 80 90 50 90"
    "S30 70 50 50Z'/></svg>",
    "keyhole": f"{PAGE}<path d='M10 10H90V90H10ZL30 30V70H70V30H30Z'/></svg>",
    "clipped": f"{PAGE}<clipPath id='c'><circle cx='40' cy='45' r='30'/></clipPath>"
    "<circle cx='60' cy='55' r='30' fill='#a06' clip-path='url(#c)'/></svg>",
    "nested": f"{PAGE}<svg x='10' y='20' width='60' height='60' viewBox='0 0 10 20'>"
    "<path d='M0 0L10 10L0 20Z'/></svg></svg>",
}

#: Share of what is drawn that may differ: resvg rounds edges of every path in its own way.
STRAY = 0.01


def picture(text: str) -> NDArray[np.float64]:
    """Colours times coverage of every pixel, and coverage, (200, 200, 4)."""
    resvg = pytest.importorskip("resvg_py", reason="resvg is not installed")
    data = resvg.svg_to_bytes(svg_string=text, width=200, height=200, skip_system_fonts=True)
    image = np.asarray(Image.open(io.BytesIO(bytes(data))).convert("RGBA"), np.float64) / 255
    image[..., :3] *= image[..., 3:]
    return image


def ends(first: str, last: str, fit: Fit = "view") -> list[str]:
    source, target = read_svg(first.encode(), "a"), read_svg(last.encode(), "b")
    movement = prepare(source, target, Options(folds="allow", fit=fit)).movement
    return [frame_svg(drawing) for drawing in movement.at(np.array([0.0, 1.0]))]


def difference(text: str, expected: str) -> float:
    one, other = picture(text), picture(expected)
    return float(np.abs(one - other).max(axis=-1).sum() / other[..., 3].sum())


@pytest.mark.parametrize("name", FILES)
def test_both_ends_look_as_the_files_do(name: str) -> None:
    text = FILES[name]
    first, last = ends(text, SQUARE)
    assert difference(first, text) < STRAY
    assert difference(last, SQUARE) < STRAY
    assert difference(ends(SQUARE, text)[1], text) < STRAY


MARK = "<path d='{}' fill='#093'/>"


@pytest.mark.parametrize(
    ("root", "data"),
    [
        ("viewBox='-20 5 400 100'", "M0 20L360 20L180 100Z"),
        ("width='40mm' height='20mm' viewBox='0 0 8 4'", "M1 1H7V3H1Z"),
        ("width='40mm' height='80mm'", "M20 20H130V280H20Z"),
        ("viewBox='0 0 20000 20000'", "M8000 9000L12000 9000L10000 12000Z"),
    ],
    ids=["wide", "millimetres", "no-view-box", "huge-page"],
)
def test_the_last_file_is_fitted_as_browsers_fit_it(root: str, data: str) -> None:
    inner = f"<svg {XMLNS} {root}>{MARK.format(data)}</svg>"
    # A browser fits a picture's whole page, whatever size the page asks for itself.
    page = root if "viewBox" in root else f"viewBox='0 0 {40 / 25.4 * 96} {80 / 25.4 * 96}'"
    shape = page[page.index("viewBox") :]
    fitted = f"{PAGE}<svg width='100' height='100' {shape}>{MARK.format(data)}</svg></svg>"
    assert difference(ends(SQUARE, inner)[1], fitted) < STRAY


def test_a_tiny_drawing_on_a_huge_page_fills_the_first_ones_box_if_asked() -> None:
    tiny = f"<svg {XMLNS} viewBox='0 0 20000 20000'><path d='M40 40H41V41H40Z' fill='#069'/></svg>"
    assert difference(ends(SQUARE, tiny, "geometry")[1], SQUARE) < STRAY
