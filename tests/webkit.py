"""WebKitGTK, Safari's engine, driven by its WebDriver to show what Chromium is shown."""

import base64
import json
import os
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from tests.browser import Browser
from tests.firefox import CALL, PATIENCE

#: The browser that comes with the driver, told to be driven.
OPTIONS = {"browserName": "MiniBrowser", "webkitgtk:browserOptions": {"args": ["--automation"]}}

#: Its own sandbox needs more rights than a test has. And all tiles of a page are painted by one
#: rasteriser: a busy one hands some to the graphics processor's, which has coarser edges.
ENVIRONMENT = {
    "WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS": "1",
    "WEBKIT_SKIA_ENABLE_CPU_RENDERING": "1",
}


@contextmanager
def webkit() -> Iterator[Browser]:
    """Start WebKitGTK on a screen of its own; skips the test where there is none."""
    program, screen = shutil.which("WebKitWebDriver"), shutil.which("xvfb-run")
    if program is None or screen is None:
        pytest.skip("no WebKitGTK on this machine: apt-get install webkit2gtk-driver xvfb xauth")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with TemporaryDirectory() as folder:
        command = [screen, "-a", "-s", "-screen 0 2000x1200x24", program, f"--port={port}"]
        with subprocess.Popen(
            command,
            env=os.environ | ENVIRONMENT,
            start_new_session=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        ) as process:
            try:
                page = WebKitPage(f"http://127.0.0.1:{port}", Path(folder) / "page.html")
                yield Browser(page)
                page.close()
            finally:
                os.killpg(process.pid, 15)  # the screen and the driver with it


class WebKitPage:
    """What `tests.browser.Browser` needs of a page, as playwright has it."""

    def __init__(self, address: str, place: Path) -> None:
        self._place, self._session = place, address
        wanted = {"capabilities": {"alwaysMatch": OPTIONS}}
        since = time.monotonic()
        while True:
            try:
                session = self._command("POST", "/session", wanted)["sessionId"]
                break
            except (urllib.error.URLError, ConnectionError):
                assert time.monotonic() - since < PATIENCE, "WebKitGTK does not answer"
                time.sleep(0.1)
        self._session = f"{address}/session/{session}"

    def _command(self, method: str, path: str, body: Any = None) -> Any:
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self._session + path, data, method=method)
        with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
            return json.load(answer)["value"]

    def close(self) -> None:
        """End the browser."""
        self._command("DELETE", "")

    def set_viewport_size(self, size: dict[str, int]) -> None:
        """Make the inside of the window so large."""
        for _ in range(2):
            inner = self.evaluate("() => [innerWidth, innerHeight]")
            outer = self._command("GET", "/window/rect")
            width = outer["width"] + size["width"] - inner[0]
            height = outer["height"] + size["height"] - inner[1]
            rect = {"x": 0, "y": 0, "width": width, "height": height}
            self._command("POST", "/window/rect", rect)

    def set_content(self, text: str) -> None:
        """Show a page."""
        doctype = "" if text.lower().startswith("<!doctype") else "<!doctype html>"
        self._place.write_text(f'{doctype}<meta charset="utf-8">{text}', "utf-8")
        self._command("POST", "/url", {"url": self._place.as_uri()})

    def evaluate(self, function: str, argument: Any = None) -> Any:
        """What a function of the page gives, or promises."""
        body = {"script": CALL.format(function=function), "args": [argument]}
        told = self._command("POST", "/execute/async", body)
        assert "error" not in told, told["error"]
        return told.get("value")

    def screenshot(self) -> bytes:
        """A PNG of the window."""
        return base64.b64decode(self._command("GET", "/screenshot"))
