"""The studio's server: the page's files, and a few calls, on this machine alone."""

import json
import threading
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import quote, unquote, urlsplit

from shapetween.base.errors import OptionError, ShapetweenError
from shapetween.studio.guard import HEADERS, Guard, Refusal
from shapetween.studio.page import static
from shapetween.studio.session import Session
from shapetween.studio.workers import Superseded

__all__ = ["Server"]

#: Seconds after which a connection that says nothing is closed: a page asks again by a new one.
PATIENCE = 60

JSON_KIND = "application/json"


class Server(ThreadingHTTPServer):
    """Serves one session.

    Parameters
    ----------
    session : Session
    token : str
        What every call must know.
    port : int
        0 for any that is free.

    Raises
    ------
    OptionError
        If the port cannot be had.
    """

    daemon_threads = True
    # Another program's port is its own: with it two servers could share one, and answer in turn.
    allow_reuse_address = False

    def __init__(self, session: Session, token: str, port: int = 0) -> None:
        self.session = session
        try:
            super().__init__(("127.0.0.1", port), Handler)
        except (OSError, OverflowError) as error:
            raise OptionError(f"--port {port}: cannot be had; expected a free one, or 0") from error
        self.guard = Guard(self.server_address[1], token)

    @property
    def address(self) -> str:
        """What to open in a browser; what follows the # is never sent to anybody."""
        return f"http://127.0.0.1:{self.server_address[1]}/#{self.guard.token}"

    def start(self) -> threading.Thread:
        """Serve in a thread of its own."""
        thread = threading.Thread(target=self.serve_forever, args=(0.1,), daemon=True)
        thread.start()
        return thread

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A page that has gone away in the middle of an answer is no error."""
        import sys

        if not isinstance(sys.exception(), ConnectionError | TimeoutError):
            super().handle_error(request, client_address)


class Handler(BaseHTTPRequestHandler):
    """One connection."""

    server: Server
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "shapetween", ""
    timeout = PATIENCE
    # Head and body in one packet, sent at once: else each answer waits 40 ms for the other side.
    wbufsize = -1
    disable_nagle_algorithm = True

    def do_GET(self) -> None:
        """Send a file of the page, or the state of the session."""
        path = urlsplit(self.path).path
        if self._refused("GET", path):
            return
        if path == "/api/state":
            self._send_json(self.server.session.state())
            return
        file = static(path)
        if file is None:
            self._refuse(Refusal(404, "there is nothing at this address"))
        else:
            self._send(200, file.data, file.kind)

    def do_POST(self) -> None:
        """Answer a call."""
        path = urlsplit(self.path).path
        if self._refused("POST", path):
            return
        call = CALLS.get(path)
        if call is None:
            self._refuse(Refusal(404, "there is no such call"))
            return
        body = self.rfile.read(int(self.headers["Content-Length"]))
        try:
            call(self, body)
        except Superseded:
            self._send_error(409, "a newer request has taken the place of this one")
        except ShapetweenError as error:
            self._send_error(422, " ".join(str(error).split()))
        except OSError as error:
            if isinstance(error, ConnectionError):
                raise
            reason = (error.strerror or "the disk cannot be used").lower()
            self._send_error(507, f"not kept: {reason}")

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing: the terminal is the user's."""

    def _refused(self, method: str, path: str) -> bool:
        refusal = self.server.guard.refusal(method, path, self.headers)
        if refusal is not None:
            self._refuse(refusal)
        return refusal is not None

    def _refuse(self, refusal: Refusal) -> None:
        """Answer without having read the body, so what follows on this connection is unknown."""
        self.close_connection = True
        self._send_error(refusal.status, refusal.line)

    def _send_error(self, status: int, line: str) -> None:
        self._send(status, json.dumps({"error": line}).encode(), JSON_KIND)

    def _send_json(self, value: object) -> None:
        self._send(200, json.dumps(value, separators=(",", ":")).encode(), JSON_KIND)

    def _send(self, status: int, data: bytes, kind: str, **more: str) -> None:
        self.send_response(status)
        for name, value in HEADERS.items():
            self.send_header(name, value)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(data)))
        for name, value in more.items():
            self.send_header(name.replace("_", "-"), value)
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(data)
        self.wfile.flush()

    def _name(self) -> str:
        """What the page calls the file that it sends."""
        return unquote(self.headers.get("X-Name", "")) or "drawing.svg"

    def _page(self) -> str:
        """Which of the open pages it is that asks."""
        return self.headers.get("X-Page", "")[:64]

    def _job(self, body: bytes) -> Any:
        return self.server.session.job(_parsed(body))

    def _drawing(self, body: bytes) -> None:
        self._send_json(self.server.session.add(self._name(), body))

    def _open(self, body: bytes) -> None:
        self._send_json(self.server.session.open(self._name(), body))

    def _command(self, body: bytes) -> None:
        self._send_json(self.server.session.command(self._job(body)))

    def _live(self, body: bytes) -> None:
        self._send_json(self.server.session.live(self._job(body)))

    def _alternatives(self, body: bytes) -> None:
        self._send_json(self.server.session.alternatives(self._page(), self._job(body)))

    def _full(self, body: bytes) -> None:
        self._send_json(self.server.session.full(self._page(), self._job(body)))

    def _save(self, body: bytes) -> None:
        text = self.server.session.save(self._job(body))
        self._send(200, text.encode(), JSON_KIND)

    def _export(self, body: bytes) -> None:
        data = _parsed(body)
        if not isinstance(data, dict) or not isinstance(data.get("output", {}), dict):
            raise OptionError("request: expected an object with job, form and output")
        session = self.server.session
        job = session.job(data.get("job"))
        made = session.export(job, str(data.get("form")), data.get("output", {}))
        self._send(
            200,
            made.data,
            "application/octet-stream",
            X_Name=quote(made.name),
            X_Warnings=quote(json.dumps(made.warnings)),
        )


CALLS: dict[str, Callable[[Handler, bytes], None]] = {
    "/api/drawing": Handler._drawing,
    "/api/open": Handler._open,
    "/api/command": Handler._command,
    "/api/live": Handler._live,
    "/api/alternatives": Handler._alternatives,
    "/api/full": Handler._full,
    "/api/save": Handler._save,
    "/api/export": Handler._export,
}
"""Every call, by its address."""


def _parsed(body: bytes) -> Any:
    try:
        return json.loads(body)
    except (ValueError, RecursionError) as error:
        raise OptionError("request: expected JSON") from error
