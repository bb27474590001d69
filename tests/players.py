"""What players other than a browser's own show of a file at chosen moments."""

import io
from collections.abc import Sequence

import numpy as np
from PIL import Image

from tests.browser import SIZE, Browser, Picture

#: A page of boxes side by side, one for each moment.
BOXES = (
    "<!doctype html><style>body{{margin:0;display:flex}}"
    ".box{{width:{size}px;height:{size}px;overflow:hidden;flex:none}}.box svg{{display:block}}"
    "</style>{boxes}"
)

#: Mounts a module's player in every box, stopped at its moment in seconds.
PLAY = """async ([text, seconds, options]) => {
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    const { play } = await import(url);
    document.querySelectorAll(".box").forEach((box, k) => {
        const animation = play(box, options);
        animation.pause();
        animation.currentTime = 1000 * seconds[k];
    });
    await new Promise(done => setTimeout(done, 50));
}"""


def boxes(browser: Browser, count: int) -> None:
    """Show a page with so many empty boxes."""
    browser.page.set_viewport_size({"width": SIZE * count, "height": SIZE})
    content = "<div class=box></div>" * count
    browser.page.set_content(BOXES.format(size=SIZE, boxes=content))


def screenshots(browser: Browser, count: int) -> list[Picture]:
    """What is in the boxes, as (SIZE, SIZE, 3) each."""
    image = Image.open(io.BytesIO(browser.page.screenshot())).convert("RGB")
    return list(np.split(np.asarray(image, np.int16), count, axis=1))


def module_pictures(
    browser: Browser, text: str, seconds: Sequence[float], options: dict[str, object] | None = None
) -> list[Picture]:
    """What a module's player shows at each of the moments."""
    boxes(browser, len(seconds))
    browser.page.evaluate(PLAY, [text, list(seconds), options or {}])
    return screenshots(browser, len(seconds))
