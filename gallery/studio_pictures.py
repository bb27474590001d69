"""Pictures of the studio for the README and the first steps, taken of the real thing.

Run it in a checkout: ``python gallery/studio_pictures.py``. It needs playwright and a Chromium.
"""

import io
import os
import shutil
import tempfile
import time
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import sync_playwright

from shapetween.studio.server import Server
from shapetween.studio.session import Session

GALLERY = Path(__file__).resolve().parent
INPUTS = Path("gallery") / "inputs"

#: Where a stretch of an outline is on the page.
PLACE = """([side, stretch]) => {
    const svg = document.getElementById(side), path = svg.querySelectorAll(".hue")[stretch];
    const p = path.getPointAtLength(path.getTotalLength() / 2).matrixTransform(svg.getScreenCTM());
    return [p.x, p.y];
}"""

#: Moves the slider of time.
SCRUB = """(share) => {
    const time = document.getElementById("time");
    time.value = share;
    time.dispatchEvent(new Event("input"));
}"""


def rest(page: Any) -> None:
    """Wait until the full result is shown."""
    time.sleep(0.5)
    for _ in range(300):
        if page.evaluate(
            "document.getElementById('state').textContent === ''"
            " && Boolean(document.getElementById('stage').shadowRoot.firstChild)"
        ):
            break
        time.sleep(0.1)
    time.sleep(0.3)


def keep(page: Any, name: str) -> None:
    """A picture, half as large as a fine screen shows it."""
    picture = Image.open(io.BytesIO(page.screenshot()))
    picture.save(GALLERY / name, quality=82, method=6)


def opened(browser: Any, session: Session, files: list[str], scheme: str) -> tuple[Any, Server]:
    session.open_paths([INPUTS / file for file in files])
    server = Server(session, "pictures")
    server.start()
    context = browser.new_context(
        viewport={"width": 1280, "height": 720}, color_scheme=scheme, reduced_motion="reduce"
    )
    page = context.new_page()
    page.goto(server.address)
    rest(page)
    return page, server


def take(browser: Any, session: Session) -> None:
    page, server = opened(browser, session, ["horse.svg", "kangaroo.svg"], "light")
    for stretch in (5, 13):
        page.mouse.click(*page.evaluate(PLACE, ["a", stretch]))
        rest(page)
    box = page.locator("#b [aria-label^='Pin 2']").bounding_box()
    start = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(*start)
    page.mouse.down()
    for k in range(1, 9):
        page.mouse.move(start[0] + 2 * k, start[1] + k)
        time.sleep(0.05)
    page.mouse.up()
    rest(page)
    page.evaluate(SCRUB, 0.5)
    page.mouse.move(5, 5)
    keep(page, "studio.webp")
    page.click("#export")
    keep(page, "studio-export.webp")
    server.shutdown()
    page, server = opened(browser, session, ["man-dancing.svg", "woman-dancing.svg"], "dark")
    page.click("#mode-parts")
    page.evaluate(SCRUB, 0.4)
    keep(page, "studio-parts.webp")
    server.shutdown()


if __name__ == "__main__":
    os.chdir(GALLERY.parent)  # the command line in the picture names no place of this machine
    program = shutil.which("chromium") or shutil.which("google-chrome")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        session = Session(Path(folder))
        try:
            take(driver.chromium.launch(executable_path=program), session)
        finally:
            session.close()
