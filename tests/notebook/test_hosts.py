"""The notebook's widget in real notebooks: moved with the mouse, read back in the next cell."""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.browser import chromium

pytestmark = pytest.mark.browser

ROOT = Path(__file__).resolve().parents[2]
INPUTS = ROOT / "gallery" / "inputs"

#: Makes the widget of a pair.
MAKE = f"""from shapetween.notebook import Tween
w = Tween({str(INPUTS / "horse.svg")!r}, {str(INPUTS / "kangaroo.svg")!r})"""

#: Seconds for a notebook to start and to answer: some 10 on an idle machine.
PATIENCE = 120

MARIMO = f"""import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo
    {MAKE.replace(chr(10), chr(10) + "    ")}
    widget = mo.ui.anywidget(w)
    widget
    return mo, w, widget


@app.cell
def _(mo, w, widget):
    widget.value
    mo.md(f"read t={{w.t}} pins={{w.pins}} morph={{len(w.morph.svg())}}")
    return


if __name__ == "__main__":
    app.run()
"""


def program(name: str) -> str:
    """A notebook's program beside this Python or on the path, with what the widget needs."""
    beside = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    found = shutil.which(name, path=beside)
    if found is None:
        pytest.skip(f"{name} is not installed")
    python = Path(found).parent / "python"
    words = [str(python), "-c", "import anywidget, numpy, scipy, shapely"]
    if subprocess.run(words, capture_output=True, check=False).returncode:
        pytest.skip(f"the Python of {name} has no anywidget, or not what shapetween needs")
    return found


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


@contextmanager
def served(words: list[str], port: int, folder: Path) -> Iterator[None]:
    """A server that runs, of this very shapetween."""
    home = {name: str(folder / name) for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR")}
    own = {"PYTHONPATH": str(ROOT), "HOME": str(folder), "JUPYTER_RUNTIME_DIR": str(folder / "run")}
    running = subprocess.Popen(
        words,
        cwd=folder,
        env={**os.environ, **home, **own},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and running.poll() is None:
            with socket.socket() as knock:
                if knock.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.2)
        else:
            pytest.fail(f"{words[0]} does not answer")
        yield
    finally:
        running.terminate()
        running.wait(30)


@pytest.fixture
def page() -> Iterator[Any]:
    with chromium() as browser:
        browser.page.set_default_timeout(PATIENCE * 1000)
        browser.page.set_viewport_size({"width": 1300, "height": 900})
        yield browser.page


def move(page: Any) -> None:
    """A pin by a click on the first outline, dragged a little, and the slider half-way."""
    page.locator(".hue").nth(10).wait_for(state="attached")
    x, y = (
        page.locator(".hue")
        .nth(10)
        .evaluate(
            """(path) => {
            const p = path.getPointAtLength(path.getTotalLength() / 2);
            const q = p.matrixTransform(path.ownerSVGElement.getScreenCTM());
            return [q.x, q.y];
        }"""
        )
    )
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 8, y + 8, steps=6)
    page.mouse.up()
    page.locator("input[aria-label=Time]").fill("0.5")


def told(text: str) -> tuple[float, list[list[float]]]:
    """What the next cell has read."""
    found = re.search(r"t=([\d.]+) pins=(\[.*?\]\])", text)
    assert found is not None, text
    return float(found[1]), json.loads(found[2])


def test_jupyterlab(page: Any, tmp_path: Path) -> None:
    lab, port = program("jupyter-lab"), free_port()
    code = [f"{MAKE}\nw", 'print(f"read t={w.t} pins={w.pins} morph={len(w.morph.svg())}")']
    cells: list[dict[str, object]] = [
        {"cell_type": "code", "id": f"c{k}", "metadata": {}, "outputs": [], "source": text,
         "execution_count": None}
        for k, text in enumerate(code)
    ]  # fmt: skip
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    work = {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
    (tmp_path / "work.ipynb").write_text(json.dumps(work), "utf-8")
    words = [
        lab, "--no-browser", f"--port={port}", "--ServerApp.port_retries=0", "--allow-root",
        "--IdentityProvider.token=tests", "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]  # fmt: skip
    with served(words, port, tmp_path):
        page.goto(f"http://127.0.0.1:{port}/lab/tree/work.ipynb?token=tests")
        page.locator(".jp-CodeCell .cm-content").first.click()
        page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for()
        page.keyboard.press("Shift+Enter")
        move(page)
        # What is moved while the kernel works waits for it, and would come after the next cell.
        page.wait_for_timeout(1000)
        page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for()
        page.wait_for_timeout(500)
        page.locator(".jp-CodeCell .cm-content").nth(1).click()
        page.keyboard.press("Shift+Enter")
        page.locator(".jp-OutputArea-output pre", has_text="read t=").wait_for()
        t, pins = told(page.locator(".jp-OutputArea-output pre", has_text="read t=").inner_text())
    assert t == 0.5
    assert len(pins) == 1
    assert len(pins[0]) == 4


def test_marimo(page: Any, tmp_path: Path) -> None:
    """The cell that depends on the widget runs by itself."""
    marimo, port = program("marimo"), free_port()
    (tmp_path / "work.py").write_text(MARIMO, "utf-8")
    words = [marimo, "run", "work.py", "--headless", "--no-token", "--port", str(port)]
    with served(words, port, tmp_path):
        page.goto(f"http://127.0.0.1:{port}/")
        move(page)
        read = page.get_by_text(re.compile(r"read t=0\.5 pins=\[\[")).first
        read.wait_for()
        t, pins = told(read.inner_text())
    assert t == 0.5
    assert len(pins) == 1
