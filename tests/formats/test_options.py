"""What can be asked of a writer, and how what cannot be is answered."""

import re
from dataclasses import fields

import pytest

from shapetween.base.errors import OptionError
from shapetween.formats.options import WriteOptions, write_names, write_options
from shapetween.formats.table import FRAMES, WRITERS

#: Of every option, values that no format can use, and what is said of them.
BAD: list[tuple[dict[str, object], str]] = [
    ({"duration": 0.0}, "duration 0.0: expected seconds, at least 0.001"),
    ({"duration": float("nan")}, "expected seconds"),
    ({"loop": "forever"}, "expected once, repeat, alternate"),
    ({"hold": -0.1}, "hold -0.1: expected seconds"),
    ({"hold": float("inf")}, "hold inf: expected seconds"),
    ({"keyframes": 1}, "1 keyframes: expected 'auto', or from 2 to 1000"),
    ({"keyframes": 1001}, "1001 keyframes"),
    ({"keyframes": 2.5}, "2.5 keyframes"),
    ({"easing": "bouncy"}, "easing 'bouncy'"),
    ({"precision": 99}, "precision 99"),
    ({"precision": 1.5}, "precision 1.5"),
    ({"frames": 0}, "0 frames"),
    ({"fps": 0.0}, "fps 0.0"),
    ({"fps": float("inf")}, "fps inf"),
    ({"size": (0, 3)}, "size (0, 3)"),
    ({"size": (3, 3, 3)}, "size (3, 3, 3)"),
    ({"background": "lilac-ish"}, "background 'lilac-ish': expected a colour such as #fff"),
    ({"background": "none"}, "background 'none'"),
    ({"css": "clip"}, "css 'clip': expected path, shape, d"),
    ({"start": "wish"}, "start 'wish': expected load, click, hover, seen, scroll, drag"),
    ({"easing_over": "all"}, "easing_over 'all': expected leg, chain"),
    ({"stagger": -1.0}, "stagger -1.0"),
    ({"stagger_by": "size", "stagger": 1.0}, "stagger_by 'size'"),
    ({"stagger_by": "left"}, "stagger_by: changes nothing without stagger"),
    ({"speed": 3}, "speed: is no option of writing; expected duration, "),
]


@pytest.mark.parametrize(("given", "message"), BAD)
def test_options_that_cannot_be_used_are_refused(given: dict[str, object], message: str) -> None:
    with pytest.raises(OptionError, match=re.escape(message)):
        write_options(given)


def test_what_is_asked_is_what_is_not_by_default() -> None:
    assert WriteOptions().asked == ()
    assert WriteOptions(loop="repeat", duration=2.0, fps=30.0).asked == ("loop", "fps")


def test_every_writer_takes_options_that_there_are_and_every_option_is_taken() -> None:
    writers = [*WRITERS.values(), *FRAMES.values()]
    taken = {name for writer in writers for name in writer.takes}
    assert taken == set(write_names())
    assert all(len(set(writer.takes)) == len(writer.takes) for writer in writers)


@pytest.mark.parametrize("writer", [*WRITERS.values(), *FRAMES.values()], ids=lambda w: w.what)
def test_an_option_without_effect_is_refused(writer) -> None:  # type: ignore[no-untyped-def]
    other = {
        "duration": 1.0,
        "easing": "ease",
        "loop": "repeat",
        "hold": 1.0,
        "keyframes": 9,
        "precision": 2,
        "frames": 3,
        "easing_over": "chain",
        "stagger": 0.5,
        "start": "click",
        "css": "shape",
        "fps": 12.0,
        "size": (9, 9),
        "background": "#fff",
    }
    for field in fields(WriteOptions):
        if field.name == "stagger_by":  # which goes with stagger
            continue
        options = write_options({field.name: other[field.name]})
        if field.name in writer.takes:
            writer.check(options)
        else:
            with pytest.raises(OptionError, match=f"^{field.name}: changes nothing in "):
                writer.check(options)
