"""Every way in which a stranger's page, or a hostile file, could reach the studio is shut."""

import json
import socket
import zlib
from collections.abc import Callable
from urllib.parse import urlsplit

import pytest

from shapetween.studio.guard import MOST_BYTES
from shapetween.studio.page import FILES
from tests.studio.conftest import PAIR, TOKEN, Client

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1H8V8H1Z"/></svg>'


def test_the_page_itself_is_answered(client: Client) -> None:
    for path in FILES:
        answer = client.ask("GET", path, token=None)
        assert answer.status == 200
        assert answer.body
    assert client.ask("GET", "/api/state").status == 200
    assert client.call("/api/command", PAIR).status == 200


def test_it_is_bound_to_this_machine_alone(client: Client) -> None:
    assert client.server.socket.getsockname()[0] == "127.0.0.1"


def test_the_token_is_in_no_request_of_its_own(client: Client) -> None:
    parts = urlsplit(client.server.address)
    assert parts.fragment == TOKEN
    assert TOKEN not in parts.path + parts.query


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1", "[::1]:{port}", ""]
)
def test_names_that_lead_here_are_refused(client: Client, host: str) -> None:
    for path in ("/", "/api/state"):
        answer = client.ask("GET", path, Host=host.format(port=client.port))
        assert answer.status in (400, 421)


def test_localhost_is_this_machine(client: Client) -> None:
    host = f"localhost:{client.port}"
    assert client.ask("GET", "/api/state", Host=host, Origin=f"http://{host}").status == 200


@pytest.mark.parametrize(
    "origin",
    [
        "https://evil.example",
        "null",
        "http://127.0.0.1:1",
        "http://localhost",
        "file://",
        "https://127.0.0.1:{port}",
    ],
)
def test_other_pages_are_refused(client: Client, origin: str) -> None:
    answer = client.ask("POST", "/api/drawing", SVG, Origin=origin.format(port=client.port))
    assert answer.status == 403


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_what_a_browser_says_of_other_pages_is_believed(client: Client, site: str) -> None:
    assert client.ask("GET", "/api/state", Sec_Fetch_Site=site).status == 403
    assert client.ask("GET", "/", Sec_Fetch_Site=site).status == 403


@pytest.mark.parametrize("token", [None, "", "wrong", TOKEN[:-1], TOKEN + "x", "ä"])
def test_without_the_token_nothing_is_done(client: Client, token: str | None) -> None:
    given = {} if token != "ä" else {"Authorization": "Bearer \xe4"}
    token = None if token == "ä" else token
    for method, path in (("GET", "/api/state"), ("POST", "/api/drawing"), ("POST", "/api/export")):
        body = SVG if method == "POST" else None
        assert client.ask(method, path, body, token=token, **given).status == 401


def test_a_foreign_page_cannot_ask_whether_it_may(client: Client) -> None:
    answer = client.ask(
        "OPTIONS",
        "/api/drawing",
        Origin="https://evil.example",
        Access_Control_Request_Method="POST",
        Access_Control_Request_Headers="authorization",
    )
    assert answer.status == 501
    for method in ("PUT", "DELETE", "TRACE", "CONNECT"):
        assert client.ask(method, "/").status in (400, 501)


def test_no_answer_lets_other_pages_read_it(client: Client) -> None:
    for answer in (
        client.ask("GET", "/"),
        client.ask("GET", "/api/state"),
        client.ask("GET", "/x"),
    ):
        assert not [name for name in answer.headers if name.startswith("Access-Control")]
        assert "Set-Cookie" not in answer.headers
        policy = answer.headers["Content-Security-Policy"]
        assert "default-src 'none'" in policy
        assert "frame-ancestors 'none'" in policy
        assert "unsafe" not in policy
        assert answer.headers["X-Content-Type-Options"] == "nosniff"
        assert answer.headers["Referrer-Policy"] == "no-referrer"
        assert answer.headers["Cross-Origin-Resource-Policy"] == "same-origin"
        assert answer.headers["Cache-Control"] == "no-store"
        assert "Python" not in answer.headers.get("Server", "")


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml",
        "/..%2f..%2fetc/passwd",
        "//etc/passwd",
        "/static/app.js",
        "/app.js/",
        "/.",
        "/%00",
        "/horse.svg",
    ],
)
def test_only_files_of_the_page_are_sent(client: Client, path: str) -> None:
    assert client.ask("GET", path).status == 404


def test_lengths_must_be_said_and_kept_within_bounds(client: Client) -> None:
    assert client.ask("POST", "/api/drawing", None).status == 411
    for length, status in (("-1", 411), ("x", 411), ("1e3", 411), (str(MOST_BYTES + 1), 413)):
        assert client.ask("POST", "/api/drawing", b"", Content_Length=length).status == status


def test_a_refused_body_is_not_taken_for_the_next_request(client: Client) -> None:
    """What follows on a connection that was refused would be read as a request of ours."""
    inner = f"GET /api/state HTTP/1.1\r\nHost: 127.0.0.1:{client.port}\r\n\r\n"
    outer = (
        f"POST /api/drawing HTTP/1.1\r\nHost: evil.example\r\nContent-Length: {len(inner)}\r\n\r\n"
    )
    with socket.create_connection(("127.0.0.1", client.port), timeout=10) as line:
        line.sendall((outer + inner).encode())
        said = b""
        while chunk := line.recv(65536):
            said += chunk
    assert said.count(b"HTTP/1.1 ") == 1
    assert said.startswith(b"HTTP/1.1 421")


def test_names_are_never_paths(client: Client) -> None:
    for k, name in enumerate(
        ["../../evil.svg", "/etc/passwd", "C:\\evil", "..%2Fevil", "", "a" * 999, "-o x", "\x00"]
    ):
        data = SVG.replace(b"9 9", f"9 {k + 10}".encode())
        answer = client.add(name.encode("unicode_escape").decode(), data)
        assert answer.status == 200, answer.body
        kept = answer.json["name"]
        assert "/" not in kept
        assert "\\" not in kept
        assert not kept.startswith(("-", "."))
        assert len(kept) < 100


NS = 'xmlns="http://www.w3.org/2000/svg"'
ENTITIES = '<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">'


def gzip_bomb() -> bytes:
    """600 MB of nothing."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    blank = b" " * 1_000_000
    return b"".join([*(packer.compress(blank) for _ in range(600)), packer.flush()])


HOSTILE: dict[str, Callable[[], bytes]] = {
    "empty": lambda: b"",
    "text": lambda: b"not an svg",
    "bytes": lambda: b"\xff\xfe\x00",
    "entities": lambda: f"<!DOCTYPE x [{ENTITIES}]><svg {NS}>&b;</svg>".encode(),
    "external": lambda: (
        f'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><svg {NS}><title>&a;</title>'
        '<path d="M0 0H9V9Z"/></svg>'
    ).encode(),
    "gzip-bomb": gzip_bomb,
    "nothing-drawn": lambda: f"<svg {NS}/>".encode(),
}


@pytest.mark.parametrize("kind", HOSTILE)
def test_broken_and_hostile_files_are_one_line(client: Client, kind: str) -> None:
    answer = client.add("bad.svg", HOSTILE[kind]())
    assert answer.status == 422
    line = answer.json["error"]
    assert "\n" not in line
    assert "Traceback" not in line
    assert "bad.svg" in line
    assert client.add("good.svg", SVG).status == 200


def test_a_drawing_comes_back_without_what_could_act(client: Client) -> None:
    evil = (
        b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9" onload="alert(1)">'
        b"<script>alert(2)</script>"
        b'<path id="&lt;img src=x onerror=alert(3)&gt;" onclick="alert(4)" d="M1 1H8V7H1Z"/></svg>'
    )
    answer = client.add("evil.svg", evil)
    assert answer.status == 200
    text = answer.json["svg"]
    assert "<script" not in text
    assert "onload" not in text
    assert "onclick" not in text
    assert "<img" not in text


@pytest.mark.parametrize(
    "job",
    [
        None,
        [],
        {"drawings": ["horse.svg"]},
        {"drawings": ["horse.svg", "../../etc/passwd"]},
        {"drawings": ["horse.svg", "/etc/passwd"]},
        {"drawings": "horse.svg"},
        {**PAIR, "out": "/tmp/x.svg"},
        {**PAIR, "options": {"out": "/tmp/x.svg"}},
        {**PAIR, "options": {"report": "/tmp/x.json"}},
        {**PAIR, "options": {"method": "--help"}},
        {**PAIR, "options": {"duration": 1e9}},
        {**PAIR, "options": {"duration": True}},
        {**PAIR, "options": {"easing": "; rm -rf /"}},
        {**PAIR, "legs": [{"pins": [[1, 2, 3]]}]},
        {**PAIR, "legs": [{"pins": [[1, 2, 3, "4"]]}]},
        {**PAIR, "legs": [{"matches": ["--help"]}]},
        {**PAIR, "legs": [{}, {}]},
    ],
)
def test_what_is_asked_for_is_checked(client: Client, job: object) -> None:
    for path, body in (
        ("/api/command", job),
        ("/api/live", job),
        ("/api/full", job),
        ("/api/export", {"job": job, "form": "svg"}),
    ):
        answer = client.call(path, body)
        assert answer.status == 422, (path, answer.body)
        assert "\n" not in answer.json["error"]


@pytest.mark.parametrize("body", [b"", b"{", b"NaN", b"[" * 100_000, b"\xff"])
def test_what_is_no_json_is_refused(client: Client, body: bytes) -> None:
    assert client.ask("POST", "/api/full", body).status == 422


@pytest.mark.parametrize(
    ("form", "output"),
    [
        ("exe", {}),
        ("svg", {"size": 100}),
        ("webp", {"size": 10**9}),
        ("webp", {"out": "/tmp/x"}),
        ("webp", {"background": ["x"]}),
        ("frames.svg", {"frames": 1.5}),
    ],
)
def test_what_is_saved_is_checked(client: Client, form: str, output: dict[str, object]) -> None:
    answer = client.ask(
        "POST", "/api/export", json.dumps({"job": PAIR, "form": form, "output": output}).encode()
    )
    assert answer.status == 422


def test_the_page_names_no_other_place() -> None:
    from shapetween.studio.page import static

    for path in FILES:
        file = static(path)
        assert file is not None
        text = file.data.decode()
        for address in ("http://", "https://", "//cdn"):
            rest = text.replace("http://www.w3.org/2000/svg", "")
            assert address not in rest, f"{path} names {address}"
