"""Firefox, driven by its own remote protocol to show what Chromium is shown.

Marionette is what geckodriver speaks to Firefox: commands as JSON over TCP, each message with its
length before it. So nothing is needed but the browser.
"""

import base64
import json
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from tests.browser import Browser

#: Any free port, pixels as large as CSS has them, and nothing that opens by itself.
PREFERENCES = {
    "marionette.port": 0,
    "layout.css.devPixelsPerPx": "1.0",
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "app.update.enabled": False,
    "network.captive-portal-service.enabled": False,
}

#: Seconds that a browser may take to answer on a busy machine.
PATIENCE = 120

#: Evaluates a function with its argument, and what it promises.
CALL = """const done = arguments[arguments.length - 1];
new Promise(resolve => resolve(({function})(arguments[0])))
    .then(value => done({{ value }}), error => done({{ error: String(error) }}));"""


@contextmanager
def firefox() -> Iterator[Browser]:
    """Start Firefox; skips the test where there is none."""
    program = shutil.which("firefox-esr") or shutil.which("firefox")
    if program is None:
        pytest.skip("no Firefox on this machine")
    with TemporaryDirectory() as folder:
        home = Path(folder)
        told = [f"user_pref({json.dumps(k)}, {json.dumps(v)});" for k, v in PREFERENCES.items()]
        (home / "user.js").write_text("\n".join(told), "utf-8")
        command = [program, "--headless", "--marionette", "--no-remote", "--profile", folder]
        with subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        ) as process:
            try:
                with socket.create_connection(
                    ("127.0.0.1", _port(home, process)), timeout=PATIENCE
                ) as connection:
                    page = FirefoxPage(connection, home / "page.html")
                    yield Browser(page)
                    page.command("Marionette:Quit", flags=["eForceQuit"])
                    process.wait(PATIENCE)
            finally:
                process.kill()


def _port(home: Path, process: "subprocess.Popen[bytes]") -> int:
    """The port that the browser has chosen, once it has written it down."""
    told = home / "MarionetteActivePort"
    since = time.monotonic()
    while not (told.is_file() and told.read_text("utf-8").strip()):
        assert process.poll() is None, "Firefox has ended"
        assert time.monotonic() - since < PATIENCE, "Firefox does not answer"
        time.sleep(0.05)
    return int(told.read_text("utf-8"))


class FirefoxPage:
    """What `tests.browser.Browser` needs of a page, as playwright has it."""

    def __init__(self, connection: socket.socket, place: Path) -> None:
        self._connection, self._stream = connection, connection.makefile("rb")
        self._place, self._count = place, 0
        self._answer()  # its greeting
        self.command("WebDriver:NewSession")

    def command(self, name: str, **arguments: Any) -> Any:
        """Do something, and tell what came of it."""
        self._count += 1
        text = json.dumps([0, self._count, name, arguments]).encode()
        self._connection.sendall(b"%d:%s" % (len(text), text))
        _, _, error, result = self._answer()
        assert error is None, f"{name}: {error}"
        return result

    def _answer(self) -> Any:
        size = b""
        while (digit := self._stream.read(1)) != b":":
            assert digit, "Firefox has gone"
            size += digit
        return json.loads(self._stream.read(int(size)))

    def set_viewport_size(self, size: dict[str, int]) -> None:
        """Make the inside of the window so large."""
        for _ in range(2):  # the frame around it is known once there is one
            inner = self.evaluate("() => [innerWidth, innerHeight]")
            outer = self.command("WebDriver:GetWindowRect")
            width = outer["width"] + size["width"] - inner[0]
            height = outer["height"] + size["height"] - inner[1]
            self.command("WebDriver:SetWindowRect", width=width, height=height)

    def set_content(self, text: str) -> None:
        """Show a page."""
        doctype = "" if text.lower().startswith("<!doctype") else "<!doctype html>"
        self._place.write_text(f'{doctype}<meta charset="utf-8">{text}', "utf-8")
        self.command("WebDriver:Navigate", url=self._place.as_uri())

    def evaluate(self, function: str, argument: Any = None) -> Any:
        """What a function of the page gives, or promises."""
        script = CALL.format(function=function)
        told = self.command("WebDriver:ExecuteAsyncScript", script=script, args=[argument])["value"]
        assert "error" not in told, told["error"]
        return told.get("value")

    def screenshot(self) -> bytes:
        """A PNG of the window."""
        return base64.b64decode(self.command("WebDriver:TakeScreenshot", full=False)["value"])
