"""The command line, run in this process as the installed program would be."""

import sys
from pathlib import Path

import pytest

from shapetween.cli import main
from tests.cli.commands import SQUARE, TRIANGLE, Command, Run, listing, svg


@pytest.fixture
def run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Command:
    """Run a command line in a folder that holds ``a.svg``, a square, and ``b.svg``, a triangle."""
    (tmp_path / "a.svg").write_text(svg(SQUARE), "utf-8")
    (tmp_path / "b.svg").write_text(svg(TRIANGLE, "0 0 20 20"), "utf-8")
    monkeypatch.chdir(tmp_path)

    def command(line: str) -> Run:
        before = listing(tmp_path)
        monkeypatch.setattr(sys, "argv", ["shapetween", *line.split()])
        with pytest.raises(SystemExit) as stop:
            main()
        said = capsys.readouterr()
        after = listing(tmp_path)
        made = frozenset(name for name, data in after.items() if before.get(name) != data)
        assert set(before) <= set(after), "a file has gone"
        assert isinstance(stop.value.code, int)
        return Run(stop.value.code, said.out, said.err, made)

    return command
