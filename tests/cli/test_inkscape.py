"""The command that puts the extension into Inkscape."""

import json
import sys
from pathlib import Path

from shapetween.inkscape import FILES
from tests.cli.commands import Command


def test_it_is_installed_and_uninstalled(run: Command, tmp_path: Path) -> None:
    done = run("inkscape --install --folder ext")
    assert done.code == 0
    assert {Path(name).name for name in done.made} == {*FILES, "shapetween_program.json"}
    call = json.loads((tmp_path / "ext" / "shapetween_program.json").read_text("utf-8"))
    assert call == [sys.executable, "-m", "shapetween"]
    done = run("inkscape --install --folder ext")
    assert done.code == 0  # over the old one


def test_without_a_task_the_folder_is_said(run: Command) -> None:
    done = run("inkscape --folder somewhere")
    assert done.code == 2
    assert "somewhere" in done.err


def test_a_folder_that_cannot_be_made(run: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    done = run("inkscape --install --folder file/ext")
    assert done.code == 2
    assert done.err.count("\n") == 1
