"""Help, exit codes, and what is told of what went wrong."""

import gc
import re
import subprocess
import sys
from pathlib import Path

import click
import pytest

from shapetween.cli import main
from shapetween.cli.main import COMMANDS, cli
from tests.cli.commands import Command


def test_help_lists_every_command(run: Command) -> None:
    result = run("--help")
    assert result.code == 0
    for name, (_, line) in COMMANDS.items():
        assert name in result.out
        assert line.split()[0] in result.out
    assert "Example:" in result.out
    assert run("-h").out == result.out


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_shows_an_example(run: Command, name: str) -> None:
    result = run(f"{name} --help")
    assert result.code == 0
    assert f"shapetween {name} " in re.split("Examples?:", result.out)[1]


def test_no_command_shows_the_help(run: Command) -> None:
    result = run("")
    assert result.code == 2
    assert result.err.startswith("Usage:")
    assert "\n  morph " in result.err


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("moprh a.svg b.svg", "No such command 'moprh'; did you mean morph?"),
        ("zzz", "expected morph, frames, mesh"),
        ("inkscape --install --uninstall --folder .", "either --install or --uninstall"),
        ("--nope", "No such option"),
        ("morph a.svg", "Missing argument 'B'"),
        ("morph a.svg b.svg --durration 3", "--duration"),
    ],
)
def test_a_wrong_command_line_is_one_line(run: Command, line: str, said: str) -> None:
    result = run(line)
    assert result.code == 2
    assert result.err.startswith("shapetween: error: ")
    assert result.err.count("\n") == 1
    assert said in result.err
    assert not result.made


@pytest.mark.parametrize("stop", [KeyboardInterrupt, click.Abort])
def test_stopping_is_no_error(
    run: Command, monkeypatch: pytest.MonkeyPatch, stop: type[BaseException]
) -> None:
    def stopped(*_: object, **__: object) -> None:
        raise stop

    monkeypatch.setattr(cli, "main", stopped)
    result = run("morph a.svg b.svg")
    assert result.code == 130
    assert result.err == "shapetween: stopped\n"


def test_a_bug_keeps_its_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr(cli, "main", broken)
    with pytest.raises(ZeroDivisionError):
        main()


def test_as_a_module(tmp_path: Path) -> None:
    """As a program of its own, from another folder: exit code, one line, no traceback."""
    root = str(Path(__file__).resolve().parents[2])
    line = [sys.executable, "-m", "shapetween", "morph", "none.svg", "b.svg"]
    done = subprocess.run(
        line,
        cwd=tmp_path,
        env={"PYTHONPATH": root, "PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr == "shapetween: error: none.svg: there is no such file\n"
    assert not done.stdout
    assert not list(tmp_path.iterdir())


def test_wrong_options_are_answered_before_heavy_imports() -> None:
    """Help and a wrong option come at once: none of what the work needs is imported."""
    root = str(Path(__file__).resolve().parents[2])
    code = (
        "import sys\nfrom shapetween.cli import main\nsys.argv = sys.argv[:1] + ['morph', '-h']\n"
        "try:\n main()\nexcept SystemExit:\n pass\n"
        "bad = {'numpy', 'scipy', 'shapely'} & set(sys.modules)\nassert not bad, bad"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={"PYTHONPATH": root, "PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_circles_are_looked_for_seldom_but_they_are(
    run: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Hardly while modules are imported, of which each leaves hundreds of objects."""
    told: list[int] = []
    monkeypatch.setattr(gc, "set_threshold", told.append)
    run("--version")
    assert len(told) == 1
    assert 10_000 < told[0] < 100_000
