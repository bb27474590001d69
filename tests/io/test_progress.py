"""Progress on a terminal once it takes long, none in a pipe; seconds for every stage."""

import io
import time

import pytest

from shapetween.io import progress
from shapetween.io.progress import Progress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.01)
    monkeypatch.setattr(progress, "BEAT", 0.01)


def worked(stream: io.StringIO, *, quiet: bool = False) -> Progress:
    with Progress(stream, quiet=quiet) as run:
        with run("match"), run("inner"):
            time.sleep(0.1)
        run.close()
    return run


@pytest.mark.usefixtures("_impatient")
def test_a_terminal_is_told_the_stage_and_left_clean() -> None:
    stream = Terminal()
    worked(stream)
    assert "inner ... 0 s" in stream.getvalue()
    assert stream.getvalue().endswith("\r\x1b[K")


@pytest.mark.usefixtures("_impatient")
@pytest.mark.parametrize(("stream", "quiet"), [(io.StringIO(), False), (Terminal(), True)])
def test_pipes_and_the_quiet_are_told_nothing(stream: io.StringIO, quiet: bool) -> None:
    worked(stream, quiet=quiet)
    assert not stream.getvalue()


def test_short_work_is_not_worth_a_word() -> None:
    stream = Terminal()
    worked(stream)
    assert stream.getvalue() == "\r\x1b[K"


def test_seconds_add_up_by_stage_even_when_one_fails() -> None:
    run = Progress(io.StringIO())

    def failing() -> None:
        with run("mesh"):
            time.sleep(0.01)
            raise ValueError("no")

    for _ in range(2):
        with pytest.raises(ValueError, match="no"):
            failing()
    assert run.seconds["mesh"] >= 0.02
    assert list(run.seconds) == ["mesh"]
