"""The README's commands and snippets do what it says, in the order it says them."""

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

import shapetween
from shapetween.cli import main
from tests.benchmarks import sizes

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text("utf-8")

COMMANDS = [line.strip() for line in README.splitlines() if line.startswith("    ")]
RUN = [line for line in COMMANDS if line.startswith("shapetween ") and " studio " not in line]
STUDIO = [line for line in COMMANDS if line.startswith("shapetween studio ")]
#: How far a median size may be from what the README says of it before it is to be written anew.
NEAR = 0.05

SETUPS = [line for line in COMMANDS if line.startswith("python3 -m venv .venv && ")]


def use(line: str, monkeypatch: pytest.MonkeyPatch) -> int:
    """Run a command line in this process; its exit code."""
    monkeypatch.setattr(sys, "argv", shlex.split(line))
    with pytest.raises(SystemExit) as stop:
        main()
    assert isinstance(stop.value.code, int)
    return stop.value.code


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the drawings of the README and nothing else; commands leave their files."""
    folder = tmp_path_factory.mktemp("checkout")
    (folder / "gallery").symlink_to(ROOT / "gallery")
    pairs = folder / "pairs"
    pairs.mkdir()
    for end, name in (("a", "horse"), ("b", "kangaroo")):
        shutil.copy(ROOT / "gallery" / "inputs" / f"{name}.svg", pairs / f"animal-{end}.svg")
    return folder


def test_there_are_commands() -> None:
    assert len(RUN) >= 6
    assert len(SETUPS) == 2


@pytest.mark.parametrize("line", RUN)
def test_commands_run(checkout: Path, monkeypatch: pytest.MonkeyPatch, line: str) -> None:
    monkeypatch.chdir(checkout)
    words = shlex.split(line)
    assert use(line, monkeypatch) == 0
    for option in ("-o", "--report"):
        if option in words:
            made = checkout / words[words.index(option) + 1]
            assert made.exists()
            if words[1] == "frames":
                assert len(list(made.iterdir())) == int(words[-1])


def test_the_studio_opens_until_it_is_stopped(checkout: Path) -> None:
    (line,) = STUDIO
    words = [sys.executable, "-m", *shlex.split(line), "--no-open"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    studio = subprocess.Popen(
        words,
        cwd=checkout,
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
        # Where the tests run in the background, interrupts are ignored, and so would they be here.
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.default_int_handler),
    )
    assert studio.stdout is not None
    said = studio.stdout.readline()
    studio.send_signal(signal.SIGINT)
    studio.communicate(timeout=30)
    assert "http://127.0.0.1:" in said
    assert studio.returncode == 0


def test_the_main_job_is_one_command_on_a_fresh_machine(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of it but the installation, which needs a network."""
    create, install, job = SETUPS[0].split(" && ")
    assert create == "python3 -m venv .venv"
    assert install == ".venv/bin/pip install -q ."
    monkeypatch.chdir(checkout)
    assert use(job.removeprefix(".venv/bin/"), monkeypatch) == 0
    made = checkout / "horse-to-kangaroo.svg"
    assert f"Open `{made.name}`" in README
    assert "<animate" in made.read_text("utf-8")


def test_the_tests_are_one_command_and_ci_uses_it() -> None:
    create, install, job = SETUPS[1].split(" && ")
    assert create == "python3 -m venv .venv"
    assert install == ".venv/bin/pip install -q -e '.[test]'"
    assert job == ".venv/bin/python -m pytest -n auto"
    # The script takes the line that ends so out of the README.
    assert SETUPS[1].endswith("python -m pytest -n auto")
    assert "grep -m1 'python -m pytest -n auto$' README.md" in (ROOT / ".ci" / "run").read_text(
        "utf-8"
    )
    assert re.search(r"^test = \[", (ROOT / "pyproject.toml").read_text("utf-8"), re.MULTILINE)


def test_python(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(checkout)
    (checkout / "out.svg").unlink(missing_ok=True)
    snippets = re.findall(r"^```python\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
    names: dict[str, object] = {}
    for snippet in snippets:
        exec(compile(snippet, "README.md", "exec"), names)
    morph = names["m"]
    assert isinstance(morph, shapetween.Morph)
    assert len(morph.frames(24)) == 24
    assert (checkout / "out.svg").read_text("utf-8") == morph.svg(duration=2.0, loop="alternate")
    assert "<svg" in morph._repr_html_()


@pytest.mark.parametrize("option", re.findall(r"^\| `(--.*?)` \|", README, re.MULTILINE))
def test_options_exist(
    option: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert use("shapetween morph --help", monkeypatch) == 0
    told = capsys.readouterr().out
    for name in re.findall(r"--[a-z]+", option):
        assert name in told


def test_files_that_are_shown_exist() -> None:
    text = re.sub(r"^```.*?^```", "", README, flags=re.MULTILINE | re.DOTALL)
    for path in re.findall(r'(?:src="|\]\()([^"):]+\.\w+)', text):
        assert (ROOT / path).is_file(), path


def test_sizes_are_those_of_what_is_written_today() -> None:
    """All of our own rows, and how many pairs they are the medians of."""
    assert f"Median of {len(list(sizes.pairs()))} pairs of the gallery" in README
    for name, *found, _ in sizes.table():
        (row,) = re.findall(rf"^\| {re.escape(name)} \| ([\d,]+) \| ([\d,]+) \|", README, re.M)
        told = [int(number.replace(",", "")) for number in row]
        assert told == pytest.approx(found, rel=NEAR), name
