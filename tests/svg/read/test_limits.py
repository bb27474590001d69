"""What is read of a drawing only up to a limit: it is told what was left out, and only then."""

import numpy as np
import pytest

from shapetween.model.drawing import Drawing
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke
from shapetween.pipeline import prepare
from shapetween.svg.read import filters, painting, properties, style
from shapetween.svg.read.reader import read_svg
from shapetween.svg.read.stroked import MOST_PIECES, stroke_rings

BOX = '<rect width="10" height="10" fill="red" {}/>'


def read(body: str, defs: str = "") -> Drawing:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20">{defs}{body}</svg>'
    return read_svg(text.encode(), "a.svg")


def blurred(effects: str) -> Drawing:
    return read(BOX.format('filter="url(#f)"'), f'<filter id="f">{effects}</filter>')


def shadowed(count: int) -> Drawing:
    return read(BOX.format(f'style="filter:{"blur(1px) " * count}"'))


def merged(count: int) -> Drawing:
    return blurred(f"<feMerge>{'<feMergeNode/>' * count}</feMerge>")


def table(count: int) -> Drawing:
    values = "1" * count
    part = f'<feFuncR type="table" tableValues="{values}"/>'
    return blurred(f"<feComponentTransfer>{part}</feComponentTransfer>")


def dashed(count: int) -> Drawing:
    return read(BOX.format(f'stroke="blue" stroke-dasharray="{"1 " * count}"'))


def named(count: int) -> Drawing:
    own = "".join(f"--v{k}:red;" for k in range(count))
    return read(BOX.format(f'style="{own}"'))


def long_dash(count: int) -> Drawing:
    return read(BOX.format(f'stroke="blue" stroke-dasharray="{"0" * count}"'))


@pytest.mark.parametrize(
    ("made", "most", "told"),
    [
        (lambda n: blurred("<feOffset/>" * n), filters.MOST_PRIMITIVES, filters.CUT_SHORT),
        (shadowed, filters.MOST_PRIMITIVES, filters.CUT_SHORT),
        (merged, filters.MOST_PRIMITIVES, filters.CUT_SHORT),
        (table, filters.MOST_CHARACTERS, filters.TOO_LONG),
        (dashed, painting.MOST_DASHES, "a pattern of too many dashes was cut short"),
        (named, style.MOST_PROPERTIES, "custom properties of its style were left out"),
        (long_dash, properties.MOST_CHARACTERS, "a value of stroke-dasharray that is too long"),
    ],
)
def test_what_passes_a_limit_is_told(made: object, most: int, told: str) -> None:
    assert callable(made)
    assert not [loss for loss in made(most).warnings if told in loss]
    assert [loss for loss in made(most + 1).warnings if told in loss]


def test_values_that_change_nothing_may_be_long() -> None:
    notes = "x" * 2 * properties.MOST_CHARACTERS
    assert read(BOX.format(f'style="-inkscape-font-specification:{notes}"')).warnings == ()


def test_the_notice_says_which_file_and_is_no_note() -> None:
    dashes = dashed(painting.MOST_DASHES + 1)
    found = prepare(dashes, dashed(2), names=("a.svg", "b.svg")).notices
    (notice,) = [each for each in found if "dashes" in each.message]
    assert (notice.kind, notice.severity) == ("file", "warning")
    assert "a.svg" in str(notice)


def test_a_line_of_too_many_dashes_is_not_drawn_whole() -> None:
    line = Outline(np.array([[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]]), closed=False)
    short = 3.0 / (MOST_PIECES + 10)
    stroke = Stroke(Colour(), 1.0, dashes=(short, short))
    assert stroke_rings([line], stroke) is None
