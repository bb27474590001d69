"""The extension for Inkscape: installed, and run by Inkscape's own Python and by Inkscape."""

import os
import re
import shutil
import signal
import subprocess
import venv
from pathlib import Path

import pytest
import shapely

from shapetween.geometry.bezier import flatten
from shapetween.inkscape import FILES, extensions_folder, install
from shapetween.svg.read.reader import read_svg

SYSTEM = Path("/usr/share/inkscape/extensions")
INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"

#: What Inkscape's library needs of a Python. Debian only recommends these beside Inkscape.
NEEDED = ("lxml", "cssselect", "numpy", "tinycss2", "pyserial", "requests")

#: Seconds that the whole of Inkscape may take: some 3 on an idle machine.
PATIENCE = 240


def can_inkex(program: Path) -> bool:
    """Whether a Python can run extensions of the installed Inkscape."""
    if not program.exists():
        return False
    environment = {**os.environ, "PYTHONPATH": str(SYSTEM)}
    words = [str(program), "-c", "import inkex"]
    return not subprocess.run(words, env=environment, capture_output=True, check=False).returncode


@pytest.fixture(scope="session")
def inkex(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A Python that can run extensions: the system's, else one with what its Inkscape lacks."""
    if not (SYSTEM / "inkex").is_dir():
        pytest.skip("no Inkscape on this machine")
    system = Path("/usr/bin/python3")
    if can_inkex(system):
        return system
    folder = tmp_path_factory.mktemp("inkex")
    venv.create(folder, with_pip=True)
    program = folder / "bin" / "python3"
    words = [str(program), "-m", "pip", "install", "--quiet", *NEEDED]
    try:
        subprocess.run(words, capture_output=True, timeout=180, check=False)
    except subprocess.TimeoutExpired:
        pytest.skip("Inkscape's Python lacks lxml, and it cannot be fetched")
    if not can_inkex(program):
        pytest.skip("Inkscape's Python lacks lxml, and it cannot be fetched")
    return program


def data(name: str) -> str:
    found = re.search(r'\sd="([^"]+)"', (INPUTS / f"{name}.svg").read_text("utf-8"))
    assert found is not None
    return found[1]


@pytest.fixture
def drawing(tmp_path: Path) -> Path:
    """Two silhouettes in layers of their own, one with a gradient, one hidden and moved."""
    text = f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 30"
     xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">
      <defs><linearGradient id="glow"><stop offset="0" stop-color="#f00"/>
        <stop offset="1" stop-color="#00f"/></linearGradient></defs>
      <rect id="ground" width="60" height="30" fill="#eee"/>
      <g id="one" inkscape:label="One" inkscape:groupmode="layer">
        <path id="horse" fill="url(#glow)" d="{data("horse")}"/></g>
      <g id="two" inkscape:label="Two" inkscape:groupmode="layer" style="display:none"
         transform="translate(30 2)"><path id="kangaroo" fill="#080" d="{data("kangaroo")}"/></g>
    </svg>"""
    path = tmp_path / "drawing.svg"
    path.write_text(text, "utf-8")
    return path


def extension(
    python: Path, folder: Path, drawing: Path, *words: str, **variables: str
) -> subprocess.CompletedProcess[str]:
    """Run the script as Inkscape does, without its window."""
    install(folder)
    environment = {**os.environ, "PYTHONPATH": str(SYSTEM), **variables}
    return subprocess.run(
        [str(python), str(folder / FILES[1]), *words, str(drawing)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def test_uninstalling_takes_only_what_is_ours(tmp_path: Path) -> None:
    from shapetween.inkscape import uninstall

    install(tmp_path)
    (tmp_path / "other.inx").write_text("theirs", "utf-8")
    assert len(uninstall(tmp_path)) == 3
    assert [path.name for path in tmp_path.iterdir()] == ["other.inx"]
    assert uninstall(tmp_path) == ()


def test_the_folder_is_inkscapes_own(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("INKSCAPE_PROFILE_DIR", str(tmp_path))
    assert extensions_folder() == tmp_path / "extensions"


def test_in_betweens_as_groups(inkex: Path, drawing: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.svg"
    words = ("--id=horse", "--id=kangaroo", "--steps=4", f"--output={out}")
    done = extension(inkex, tmp_path / "ext", drawing, *words)
    assert done.returncode == 0, done.stderr
    text = out.read_text("utf-8")
    assert text.count('inkscape:label="In-between ') == 4
    ids = re.findall(r'\sid="([^"]+)"', text)
    assert len(set(ids)) == len(ids)
    shown = read_svg(text.replace("display:none", "").encode(), "out.svg")
    areas = shown.shapes[-4:]
    for shape in areas:  # none of them crosses itself, unlike those of Inkscape's Interpolate
        polygon = shapely.Polygon(flatten(shape.rings[0].curves, 16))
        assert polygon.is_valid
    left = [float(shape.rings[0].box[0, 0]) for shape in areas]
    assert left == sorted(left)  # from the left one to the right one, in the document's own units
    assert left[-1] - left[0] > 10


def test_layers_by_name_even_a_hidden_one(inkex: Path, drawing: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.svg"
    names = ("--first_layer=One", "--second_layer=Two", "--make=layers", "--steps=2")
    done = extension(inkex, tmp_path / "ext", drawing, *names)
    assert done.returncode == 0, done.stderr
    text = done.stdout
    assert (
        len(
            re.findall(
                r'groupmode="layer"[^>]*label="In-between|label="In-between[^>]*groupmode="layer"',
                text,
            )
        )
        == 2
    )
    assert not out.exists()


def test_an_animated_file(inkex: Path, drawing: Path, tmp_path: Path) -> None:
    made = tmp_path / "moving.svg"
    words = ("--id=horse", "--id=kangaroo", "--make=file", f"--file={made}", "--loop=alternate")
    done = extension(inkex, tmp_path / "ext", drawing, *words)
    assert done.returncode == 0, done.stderr
    assert "<animate" in made.read_text("utf-8")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--id=horse",), "Select two objects"),
        (("--first_layer=One", "--second_layer=Three"), "no layer 'Three'"),
        (("--id=horse", "--id=kangaroo", "--make=file"), "which file to write"),
        (("--id=horse", "--id=kangaroo", "--program=/no/such/shapetween"), "pip install"),
        (("--id=horse", "--id=kangaroo", "--steps=0"), "frames"),
    ],
)
def test_what_cannot_be_done_is_said(
    inkex: Path, drawing: Path, tmp_path: Path, words: tuple[str, ...], said: str
) -> None:
    done = extension(inkex, tmp_path / "ext", drawing, *words)
    if "--steps=0" in words:  # two frames, the ends: nothing in between, and no fault
        assert done.returncode == 0
        return
    assert done.returncode != 0
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_warnings_are_said_unless_nobody_looks_on(
    inkex: Path, drawing: Path, tmp_path: Path
) -> None:
    # A kangaroo is matched with some certainty, an elephant with little.
    text = drawing.read_text("utf-8").replace(data("kangaroo"), data("elephant"))
    drawing.write_text(text, "utf-8")
    words = ("--id=horse", "--id=kangaroo", "--steps=1")
    said = [
        extension(inkex, tmp_path / "ext", drawing, *words, **quiet).stderr
        for quiet in ({}, {"SHAPETWEEN_QUIET": "1"})
    ]
    assert "little certainty" in said[0]
    assert said[1] == ""


def test_inkscape_itself_runs_it(inkex: Path, drawing: Path, tmp_path: Path) -> None:
    """The whole program: it lists the extension, and runs it on what is selected."""
    if shutil.which("xvfb-run") is None or shutil.which("inkscape") is None:
        pytest.skip("no xvfb-run, which gives Inkscape a screen to start on")
    profile = tmp_path / "profile"
    install(profile / "extensions")
    out = tmp_path / "out.svg"
    actions = (
        f"select-by-id:horse,kangaroo;org.shapetween.tween.noprefs;export-filename:{out};export-do"
    )
    (profile / "preferences.xml").write_text(
        f'<inkscape version="1"><group id="extensions" python-interpreter="{inkex}"/></inkscape>'
    )
    variables = {"INKSCAPE_PROFILE_DIR": str(profile), "SHAPETWEEN_QUIET": "1"}
    done = subprocess.Popen(
        ["xvfb-run", "-a", "inkscape", "--batch-process", f"--actions={actions}", str(drawing)],
        env={**os.environ, **variables},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        _, said = done.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(done.pid, signal.SIGKILL)  # the screen and Inkscape with it
        done.communicate()
        pytest.fail("Inkscape waits: does the extension say something, which it shows in a window?")
    assert out.exists(), said
    assert out.read_text("utf-8").count('inkscape:label="In-between ') == 5
