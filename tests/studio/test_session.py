"""What the studio answers: previews, full results, files, projects."""

import io
import json
import os
import shlex
import signal
import sys
import threading
import time
import zipfile
from pathlib import Path
from urllib.parse import unquote

import pytest

import shapetween as st
from shapetween.cli import main
from shapetween.studio.exports import forms
from tests.studio.conftest import INPUTS, PAIR, Client

HORSE, KANGAROO = INPUTS / "horse.svg", INPUTS / "kangaroo.svg"
PINNED = {
    **PAIR,
    "legs": [{"pins": [[22, 9.5, 22, 7]]}],
    "options": {"duration": 1.5, "loop": "alternate", "quads": 12, "method": "arap"},
}


def run_line(line: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "argv", shlex.split(line))
    with pytest.raises(SystemExit) as stop:
        main()
    assert stop.value.code == 0


def test_the_full_result_is_the_librarys(client: Client) -> None:
    answer = client.call("/api/full", PINNED).json
    m = st.morph(HORSE, KANGAROO, pins=[(22, 9.5, 22, 7)], method="arap", quads=12)
    assert answer["svg"] == m.svg(duration=1.5, loop="alternate")
    assert answer["seconds"] == 3.0
    ring = answer["legs"][0]["rings"][0]
    assert len(ring["a"]) == len(ring["b"]) >= 512
    assert any(abs(x - 22) + abs(y - 9.5) < 0.1 for x, y in ring["a"])


def test_what_is_saved_is_what_is_shown_and_what_the_line_makes(
    client: Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = client.call("/api/full", PINNED).json["svg"]
    saved = client.call("/api/export", {"job": PINNED, "form": "svg"})
    assert saved.status == 200
    assert unquote(saved.headers["X-Name"]) == "horse-to-kangaroo.svg"
    assert saved.body.decode() == shown
    line = client.call("/api/command", PINNED).json["line"]
    run_line(line, tmp_path, monkeypatch)
    assert (tmp_path / "horse-to-kangaroo.svg").read_text("utf-8") == shown


def test_previews_are_quick_movements_of_one_leg(client: Client) -> None:
    live, full = (client.call(f"/api/{kind}", PINNED).json for kind in ("live", "full"))
    assert live["seconds"] == full["seconds"]
    assert live["svg"].count("<animate") >= 1
    (ring,), (known,) = live["legs"][0]["rings"], full["legs"][0]["rings"]
    assert ring["a"][0] == known["a"][0]
    assert "keyTimes" in live["svg"]


@pytest.mark.parametrize("form", [form for form in forms() if form != "mp4"])
def test_every_form_is_saved(client: Client, form: str) -> None:
    takes = forms()[form].takes
    output = {
        key: value for key, value in {"size": 64, "fps": 5, "frames": 3}.items() if key in takes
    }
    answer = client.call("/api/export", {"job": PAIR, "form": form, "output": output})
    assert answer.status == 200, answer.body
    assert unquote(answer.headers["X-Name"]) == "horse-to-kangaroo" + forms()[form].ending
    assert len(answer.body) > 100
    if form.startswith("frames"):
        with zipfile.ZipFile(io.BytesIO(answer.body)) as archive:
            assert len(archive.namelist()) == 3


def test_chains_have_pins_of_their_own(client: Client) -> None:
    names = [
        client.add(n, (INPUTS / n).read_bytes()).json["name"]
        for n in ("horse.svg", "kangaroo.svg", "camel.svg")
    ]
    job = {
        "drawings": [*names, names[0]],
        "legs": [{"pins": [[22, 9.5, 22, 7]]}, {}, {}],
        "options": {"loop": "repeat"},
    }
    answer = client.call("/api/full", job).json
    assert len(answer["legs"]) == 3
    assert answer["seconds"] == 6.0
    assert "--pin 1/22,9.5:22,7" in client.call("/api/command", job).json["line"]
    paths = [INPUTS / name for name in job["drawings"]]
    c = st.chain(paths, pins={1: [(22, 9.5, 22, 7)]})
    assert answer["svg"] == c.svg(loop="repeat")


def test_work_is_saved_and_opened_again(
    client: Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    saved = client.call("/api/save", PINNED)
    assert saved.status == 200
    data = json.loads(saved.body)
    assert data["legs"] == [{"pins": [[22, 9.5, 22, 7]]}]
    again = client.ask("POST", "/api/open", saved.body, X_Name="work.json").json
    assert again["last"]["drawings"] == PAIR["drawings"]
    assert again["last"]["options"] == PINNED["options"]
    (tmp_path / "work.json").write_bytes(saved.body)
    run_line("shapetween morph --project work.json -o out.svg", tmp_path, monkeypatch)
    assert (tmp_path / "out.svg").read_text("utf-8") == client.call("/api/full", PINNED).json["svg"]


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "not JSON"),
        (b"[]", "no project"),
        (b'{"shapetween": "project", "version": 2}', "version 2"),
        (
            b'{"shapetween": "project", "version": 1, "drawings": [{"file": "/etc/passwd"}]}',
            "in the project",
        ),
        (b'{"shapetween": "project", "version": 1, "drawings": []}', "two or more"),
        (b'{"shapetween": "project", "version": 1, "drawings": [{"svg": "<svg/>"}]}', "name"),
    ],
)
def test_broken_projects_are_one_line(client: Client, data: bytes, said: str) -> None:
    answer = client.ask("POST", "/api/open", data, X_Name="work.json")
    assert answer.status == 422
    assert answer.json["error"].startswith("work.json: ")
    assert said in answer.json["error"]


def test_alternatives_are_distinct_and_numbered(client: Client) -> None:
    found = client.call("/api/alternatives", PAIR).json["alternatives"]
    assert [one["matching"] for one in found] == list(range(1, len(found) + 1))
    assert len({one["svg"] for one in found}) == len(found) >= 2


def test_a_newer_request_ends_the_older_one(client: Client) -> None:
    statuses: list[int] = []

    def ask(k: int) -> None:
        job = {**PAIR, "options": {"quads": 20 + k}}
        answer = client.ask("POST", "/api/full", json.dumps(job).encode(), X_Page="one")
        statuses.append(answer.status)

    threads = [threading.Thread(target=ask, args=(k,)) for k in range(5)]
    for thread in threads:
        thread.start()
        time.sleep(0.05)
    for thread in threads:
        thread.join()
    assert statuses.count(200) >= 1
    assert set(statuses) <= {200, 409}
    assert statuses[-1] == 200


def test_two_pages_do_not_end_each_others_work(client: Client) -> None:
    statuses: list[int] = []

    def ask(page: str) -> None:
        job = {**PAIR, "options": {"quads": 30}}
        answer = client.ask("POST", "/api/full", json.dumps(job).encode(), X_Page=page)
        statuses.append(answer.status)

    threads = [threading.Thread(target=ask, args=(page,)) for page in ("one", "two", "three")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert statuses == [200, 200, 200]


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="processes are killed in another way")
def test_killed_workers_are_replaced(client: Client) -> None:
    import multiprocessing

    for child in multiprocessing.active_children():
        assert child.pid is not None
        os.kill(child.pid, signal.SIGKILL)
    for kind in ("live", "full"):
        statuses = [client.call(f"/api/{kind}", PAIR).status for _ in range(3)]
        assert statuses[-1] == 200
        assert set(statuses) <= {200, 422}


def test_a_full_disk_at_export_is_one_line(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    import tempfile

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", full)
    answer = client.call("/api/export", {"job": PAIR, "form": "svg"})
    assert answer.status == 422
    assert answer.json["error"] == "horse-to-kangaroo.svg: not saved: no space left on device"


def test_what_the_command_says_passes_through(client: Client) -> None:
    job = {**PAIR, "legs": [{"pins": [[-500, -500, 22, 7]]}]}
    for path, body in (("/api/full", job), ("/api/export", {"job": job, "form": "svg"})):
        answer = client.call(path, body)
        assert answer.status == 422
        assert answer.json["error"].startswith("pin")


def test_drawings_of_one_name_are_told_apart(client: Client) -> None:
    first = client.add("same.svg", HORSE.read_bytes()).json["name"]
    second = client.add("same.svg", KANGAROO.read_bytes()).json["name"]
    assert (first, second) == ("same.svg", "same-2.svg")
    assert client.add("same.svg", HORSE.read_bytes()).json["name"] == "same.svg"
