"""The gallery: what its scripts draw, and the page that shows it."""

import re
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapetween.base.errors import OptionError
from shapetween.cli import main
from shapetween.gallery import Exhibit, Picture, Room, exhibits, index_html, write_pictures

GALLERY = Path(__file__).resolve().parents[1] / "gallery"

INDEX = (GALLERY / "index.html").read_text("utf-8")

LARGEST = 6_000_000

#: Licences that allow what the gallery does with the drawings.
LICENCES = {"Apache-2.0", "CC BY 3.0", "CC BY 4.0", "CC0 1.0", "ISC", "MIT", "public domain"}


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5])
def test_figures_are_what_their_scripts_draw(number: int) -> None:
    """Those with meshes of their own, which no change of the matching touches."""
    (exhibit,) = exhibits.drawn(GALLERY / f"figure_{number}.py")
    texts = [picture for picture in exhibit.pictures if isinstance(picture.content, str)]
    assert texts
    for picture in texts:
        assert (GALLERY / picture.name).read_text("utf-8") == picture.content


def test_every_way_of_figure_2_ends_at_its_place() -> None:
    spec = spec_from_file_location("figure_2", GALLERY / "figure_2.py")
    assert spec is not None
    assert spec.loader is not None
    script: Any = module_from_spec(spec)
    spec.loader.exec_module(script)
    for _, _, way in script.rows():
        corners, _ = script.carried(way, script.SOURCE[:, :0], np.array([0.0, 1.0]))
        assert corners[0] == pytest.approx(script.SOURCE)
        assert corners[1] == pytest.approx(script.TARGET)


def test_the_page_shows_pictures_that_are_there() -> None:
    shown = re.findall(r'<img src="([^"]+)" alt="([^"]+)"', INDEX)
    assert len(shown) > 20
    assert all(alt for _, alt in shown)
    names = {name for name, _ in shown}
    assert len(names) == len(shown)
    assert all((GALLERY / name).is_file() for name in names)
    assert {path.name for path in GALLERY.glob("*.svg")} <= names


def test_all_figures_of_the_paper_are_shown() -> None:
    assert re.findall(r"<h3>Figure (\d):", INDEX) == list("1234567")


def test_inputs_name_their_source_and_licence() -> None:
    sources = (GALLERY / "inputs" / "SOURCES.md").read_text("utf-8")
    rows = [line.strip("| ").split(" | ") for line in sources.splitlines() if "`" in line]
    named = [re.findall(r"`([^`]+)`", row[0]) for row in rows]
    assert {row[-1] for row in rows} <= LICENCES
    for path in (GALLERY / "inputs").iterdir():
        patterns = [name for names in named for name in names if path.match(name)]
        assert patterns or path.name == "SOURCES.md", path.name


def test_it_stays_small() -> None:
    assert sum(path.stat().st_size for path in GALLERY.rglob("*.*")) < LARGEST


SCRIPT = """
from pathlib import Path
from shapetween.gallery import Exhibit, Picture

def draw():
    pictures = (Picture("drawn.svg", "<svg/>", "A < B"), Picture("old.webp", FILE, "old"))
    return [Exhibit("One & two", "Text.", pictures, table=(("", "a", "b"), ("row", "*1", "2")))]
"""


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A gallery of one script, in place of the real one."""
    folder = tmp_path / "gallery"
    (folder / "inputs").mkdir(parents=True)
    (folder / "inputs" / "SOURCES.md").touch()
    (folder / "old.webp").write_bytes(b"picture")
    script = SCRIPT.replace("FILE", 'Path(__file__).parent / "old.webp"')
    (folder / "figure_1.py").write_text(script, "utf-8")
    monkeypatch.setattr("shapetween.gallery.gallery_folder", lambda: folder)
    monkeypatch.chdir(tmp_path)
    return folder


def run(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    monkeypatch.setattr(sys, "argv", ["shapetween", "gallery", *words])
    with pytest.raises(SystemExit) as stop:
        main()
    assert isinstance(stop.value.code, int)
    return stop.value.code


@pytest.mark.usefixtures("small")
def test_the_command_draws_all_scripts_and_the_page(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "-o", "out") == 0
    assert capsys.readouterr().out == f"wrote {Path('out') / 'index.html'}\n"
    made = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    assert made.keys() == {"drawn.svg", "old.webp", "index.html"}
    assert (made["drawn.svg"], made["old.webp"]) == (b"<svg/>", b"picture")
    page = made["index.html"].decode()
    assert "One &amp; two" in page
    assert 'alt="A &lt; B"' in page
    assert '<td class="best">1</td><td>2</td>' in page
    assert run(monkeypatch, "-o", "out", "-q") == 0
    assert made == {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}


def test_it_may_be_drawn_into_its_own_folder(monkeypatch: pytest.MonkeyPatch, small: Path) -> None:
    assert run(monkeypatch, "-o", "gallery", "-q") == 0
    assert (small / "old.webp").read_bytes() == b"picture"
    assert (small / "index.html").exists()


@pytest.mark.usefixtures("small")
def test_what_is_no_folder_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    for place in ("file", "missing/folder"):
        assert run(monkeypatch, "-o", place) == 2
        assert capsys.readouterr().err.count("\n") == 1


def test_without_its_scripts_it_says_where_they_were_expected(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(exhibits, "__file__", str(tmp_path / "a" / "b" / "c.py"))
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    with pytest.raises(OptionError, match="not installed"):
        exhibits.gallery_folder()
    installed = tmp_path / "share" / "shapetween" / "gallery"
    (installed / "inputs").mkdir(parents=True)
    (installed / "inputs" / "SOURCES.md").touch()
    assert exhibits.gallery_folder() == installed


def test_pictures_are_not_written_where_the_page_is_only_made(tmp_path: Path) -> None:
    room = Room("a", "A", "", "x", (Exhibit("E", "T", (Picture("p.svg", "<svg/>", "p"),)),))
    assert 'src="p.svg"' in index_html([room])
    assert not list(tmp_path.iterdir())
    write_pictures([room], tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["p.svg"]
