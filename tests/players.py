"""What players other than a browser's own show of a file at chosen moments."""

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shapetween.raster.resvg import drawn
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
    // Each shows its moment in a frame of its own, however late that comes.
    for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
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


def lottie_pictures(
    browser: Browser, library: Path, text: str, frames: Sequence[float]
) -> list[Picture]:
    """What lottie-web, in a folder of packages, shows of an animation at frames."""
    boxes(browser, len(frames))
    browser.page.add_script_tag(path=str(library / "lottie-web" / "build" / "player" / "lottie.js"))
    browser.page.evaluate(LOTTIE, [text, list(frames)])
    return screenshots(browser, len(frames))


#: Loads an animation into every box, stopped at its frame.
LOTTIE = """([text, frames]) => document.querySelectorAll(".box").forEach((box, k) => {
    const options = { container: box, renderer: "svg", loop: false, autoplay: false };
    const animation = lottie.loadAnimation({ ...options, animationData: JSON.parse(text) });
    animation.addEventListener("error", event => { throw event.nativeError ?? event; });
    animation.goToAndStop(frames[k], true);
})"""


def thorvg_pictures(data: bytes, frames: Sequence[float]) -> list[Picture]:
    """What ThorVG shows of an animation at frames, on white."""
    tvg = pytest.importorskip("thorvg_python", reason="ThorVG is not installed")
    shots = []
    for frame in frames:
        engine = tvg.Engine()
        canvas = tvg.SwCanvas(engine)
        canvas.set_target(SIZE, SIZE, cs=tvg.Colorspace.ABGR8888S)
        animation = tvg.LottieAnimation(engine)
        picture = animation.get_picture()
        assert picture.load_data(data, "lottie", None, True) == tvg.Result.SUCCESS
        picture.set_size(SIZE, SIZE)
        canvas.add(picture)
        done, last = animation.get_total_frame()
        assert done == tvg.Result.SUCCESS
        animation.set_frame(min(frame, last))
        canvas.update()
        canvas.draw(True)
        canvas.sync()
        drawn = canvas.get_pillow()
        white = Image.new("RGBA", drawn.size, "white")
        shots.append(np.asarray(Image.alpha_composite(white, drawn).convert("RGB"), np.int16))
    return shots


def resvg_pictures(frames: Sequence[str]) -> list[Picture]:
    """What resvg shows of frames, on white."""
    shots = []
    for frame in frames:
        picture = Image.fromarray(drawn(frame, SIZE, SIZE), "RGBA")
        white = Image.new("RGBA", picture.size, "white")
        shots.append(np.asarray(Image.alpha_composite(white, picture).convert("RGB"), np.int16))
    return shots


def css_pictures(
    browser: Browser, sheet: str, name: str, seconds: Sequence[float], body: str
) -> list[Picture]:
    """What a style sheet makes of elements at moments; `body` is the element, or has it inside."""
    count = len(seconds)
    browser.page.set_viewport_size({"width": SIZE * count, "height": SIZE})
    content = f"<div class=box>{body}</div>" * count
    page = BOXES.format(size=SIZE, boxes=content)
    browser.page.set_content(f"{page}<style>{sheet}</style>")
    browser.page.evaluate(
        """([name, seconds]) => document.querySelectorAll("." + name).forEach((element, k) => {
            for (const animation of element.getAnimations()) {
                animation.pause();
                animation.currentTime = 1000 * seconds[k];
            }
        })""",
        [name, list(seconds)],
    )
    return screenshots(browser, count)
