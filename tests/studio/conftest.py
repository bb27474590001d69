"""A studio that runs, and what a page would ask of it."""

import http.client
import json
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from shapetween.studio.server import Server
from shapetween.studio.session import Session

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"
TOKEN = "a-token-of-the-tests"


@dataclass(frozen=True)
class Answer:
    """What a server said."""

    status: int
    headers: dict[str, str]
    body: bytes

    @property
    def json(self) -> Any:
        return json.loads(self.body)


@dataclass(frozen=True)
class Client:
    """Sends requests, those of the page's own unless told otherwise."""

    server: Server

    @property
    def port(self) -> int:
        return self.server.guard.port

    def ask(
        self,
        method: str,
        path: str,
        body: bytes | None = None,
        *,
        token: str | None = TOKEN,
        **headers: str,
    ) -> Answer:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=600)
        sent = {"Host": f"127.0.0.1:{self.port}"}
        if token is not None:
            sent["Authorization"] = f"Bearer {token}"
        sent |= {name.replace("_", "-"): value for name, value in headers.items()}
        try:
            connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
            if body is not None and "Content-Length" not in sent:
                sent["Content-Length"] = str(len(body))
            for name, value in sent.items():
                if value:
                    connection.putheader(name, value)
            connection.endheaders(body)
            answer = connection.getresponse()
            return Answer(answer.status, dict(answer.getheaders()), answer.read())
        finally:
            connection.close()

    def call(self, path: str, value: object) -> Answer:
        return self.ask("POST", path, json.dumps(value).encode())

    def add(self, name: str, data: bytes) -> Answer:
        return self.ask("POST", "/api/drawing", data, X_Name=name)


@pytest.fixture(scope="session")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    """A studio with the horse and the kangaroo."""
    session = Session(tmp_path_factory.mktemp("session"))
    try:
        session.open_paths([INPUTS / "horse.svg", INPUTS / "kangaroo.svg"])
        server = Server(session, TOKEN)
        server.start()
        try:
            yield Client(server)
        finally:
            server.shutdown()
            server.server_close()
    finally:
        session.close()


PAIR = {"drawings": ["horse.svg", "kangaroo.svg"]}
"""What the page asks for when nothing has been set."""


@pytest.fixture(scope="session")
def axe(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The accessibility checker axe-core, where npm can fetch it."""
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("no npm on this machine to fetch axe-core with")
    folder = tmp_path_factory.mktemp("axe")
    words = [npm, "install", "--no-audit", "--no-fund", "--silent", "axe-core@4"]
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, timeout=120, check=False)
    except subprocess.TimeoutExpired:
        pytest.skip("axe-core cannot be fetched")
    script = folder / "node_modules" / "axe-core" / "axe.min.js"
    if done.returncode or not script.is_file():
        pytest.skip("axe-core cannot be fetched")
    return script.read_text("utf-8")
