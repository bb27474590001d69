"""What a format cannot hold is told as data, in the report and as a line of text."""

from dataclasses import replace

import pytest

import shapetween as st
from shapetween.formats import keyed
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import WRITERS, Segments
from shapetween.svg.write import shape
from tests.movements import sample_movement

STAR = "<path d='M12 2l3 7 7 1-5 5 1 7-6-3-6 3 1-7-5-5 7-1z' fill='{fill}'/>"
SVG = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 24 24'>{}</svg>"


@pytest.mark.parametrize("ending", [".svg", ".json", ".lottie", ".css", ".xml"])
def test_keyframes_left_out_of_long_outlines_are_told(
    ending: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    movement = sample_movement()
    segments = Segments((replace(movement, parts=movement.parts[1:]),))
    if ending == ".svg":
        monkeypatch.setattr(shape, "sum_of_easings", lambda *_, **__: None)
    assert not WRITERS[ending].write(segments, WriteOptions()).notices
    for module in (shape, keyed):
        monkeypatch.setattr(module, "MOST_WRITTEN", 0)
        monkeypatch.setattr(module, "LEAST_KEYFRAMES", 3)
    (notice,) = WRITERS[ending].write(segments, WriteOptions()).notices
    assert (notice.kind, notice.severity) == ("format", "warning")
    assert "times as far off" in notice.message


def test_a_chain_has_the_notices_of_its_legs() -> None:
    fold = SVG.format("<path d='M2 2l20 20v-20l-20 20z'/>")
    star = SVG.format(STAR.format(fill="#000"))
    chain = st.chain([star, fold, star])
    assert [notice["kind"] for notice in chain.report()["notices"]].count("outlined-anew") == 1
