"""Batches: the same files whoever makes them, whatever goes wrong, and however often they stop."""

import json
import os
import signal
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from shapetween import morph
from shapetween.batch import Job, Outcome, run_batch
from shapetween.batch.processes import process_pool
from shapetween.batch.work import Made, Task, _drawing, make
from shapetween.svg.read.reader import read_svg
from tests.cli.commands import SQUARE, TRIANGLE, listing, svg

HEADER = "a,b,out,status,error,quads,triangles"


def line(d: str) -> str:
    """A drawing of one line, which is quick to prepare."""
    return svg(f'<path fill="none" stroke="#000" d="{d}"/>')


@pytest.fixture
def jobs(tmp_path: Path) -> list[Job]:
    """Three pairs of lines, and two that fail: a file is missing, or is no drawing."""
    drawings = [*(line(d) for d in ["M1 1H9V9H1", "M1 1H9L5 8", "M5 1L9 5L5 9L1 5"]), "nothing"]
    paths = [tmp_path / f"{name}.svg" for name in "pqrx"]
    for path, text in zip(paths, drawings, strict=True):
        path.write_text(text, "utf-8")
    p, q, r, x = paths
    return [
        Job(p, q, Path("one.svg")),
        Job(p, x, Path("two.svg")),
        Job(q, r, Path("in/three.svg"), None, {"method": "arap", "loop": "alternate"}),
        Job(p, tmp_path / "none.svg", Path("four.svg")),
        Job(r, p, Path("five.svg"), None, {"duration": 9.0}),
    ]


DONE = {"one.svg", "in/three.svg", "five.svg"}


class Here(Executor):
    """Does everything at once, where it is called; raises what it is told to at a certain task."""

    def __init__(self, stop: int = -1, error: BaseException | None = None) -> None:
        self.tasks: list[Task] = []
        self._stop, self._error = stop, error

    def submit(self, function: Any, /, *args: Any, **kwargs: Any) -> "Future[Any]":
        future: Future[Any] = Future()
        if len(self.tasks) == self._stop and self._error is not None:
            if not isinstance(self._error, Exception):
                raise self._error
            future.set_exception(self._error)
        else:
            future.set_result(function(*args, **kwargs))
        self.tasks += args
        return future


def test_one_bad_pair_does_not_stop_the_rest(jobs: list[Job], tmp_path: Path) -> None:
    reported: list[Outcome] = []
    outcomes = run_batch(jobs, tmp_path / "out", executor=Here(), report=reported.append)
    assert [outcome.job for outcome in outcomes] == jobs
    assert {outcome.job.out for outcome in reported} == {job.out for job in jobs}
    assert [bool(outcome.error) for outcome in outcomes] == [False, True, False, True, False]
    assert set(listing(tmp_path / "out")) == DONE | {"summary.csv", "summary.json"}
    assert outcomes[3].error.endswith("none.svg: there is no such file")
    pairs = json.loads((tmp_path / "out/summary.json").read_text("utf-8"))["pairs"]
    assert [pair["status"] for pair in pairs] == ["done", "failed", "done", "failed", "done"]
    assert pairs[0]["report"]["warnings"] == []
    rows = (tmp_path / "out/summary.csv").read_text("utf-8").splitlines()
    assert rows[0].startswith(HEADER)
    assert len(rows) == 6


@contextmanager
def dask() -> Iterator[Executor]:
    """A cluster of separate processes on this machine."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client.get_executor(pure=False)


@pytest.mark.parametrize("executor", [lambda: ThreadPoolExecutor(3), lambda: process_pool(2), dask])
def test_the_same_bytes_on_any_executor(jobs: list[Job], tmp_path: Path, executor: Any) -> None:
    run_batch(jobs, tmp_path / "here", executor=Here())
    with executor() as workers:
        run_batch(jobs, tmp_path / "there", executor=workers)
    assert listing(tmp_path / "here") == listing(tmp_path / "there")


def test_processes_and_their_threads(jobs: list[Job], tmp_path: Path) -> None:
    before = dict(os.environ)
    run_batch(jobs, tmp_path / "one", processes=1)
    run_batch(jobs, tmp_path / "two", processes=2)
    assert listing(tmp_path / "one") == listing(tmp_path / "two")
    with process_pool(1) as pool:
        assert pool.submit(os.getenv, "OMP_NUM_THREADS").result() == "1"
    assert dict(os.environ) == before


@pytest.mark.parametrize("stop", [0, 1, 2])
def test_going_on_after_an_interruption(jobs: list[Job], tmp_path: Path, stop: int) -> None:
    run_batch(jobs, tmp_path / "whole", executor=Here())
    with pytest.raises(KeyboardInterrupt):
        run_batch(jobs, tmp_path / "out", executor=Here(stop, KeyboardInterrupt()))
    assert not {name for name in listing(tmp_path / "out") if "summary" in name}
    again = Here()
    outcomes = run_batch(jobs, tmp_path / "out", executor=again, resume=True)
    assert listing(tmp_path / "whole") == listing(tmp_path / "out")
    assert sum(outcome.kept for outcome in outcomes) + len(again.tasks) == 4


def test_only_what_has_not_changed_is_kept(jobs: list[Job], tmp_path: Path) -> None:
    out = tmp_path / "out"

    def again(resume: bool = True) -> set[str]:
        outcomes = run_batch(jobs, out, executor=Here(), resume=resume)
        return {outcome.job.out.as_posix() for outcome in outcomes if outcome.kept}

    again()
    assert again() == DONE
    assert again(resume=False) == set()
    (out / "one.svg").write_text("edited", "utf-8")
    assert again() == DONE - {"one.svg"}
    jobs[4] = Job(jobs[4].a, jobs[4].b, jobs[4].out, None, {"duration": 3.0})
    assert again() == DONE - {"five.svg"}
    jobs[0].b.write_text(line("M1 1H9V9"), "utf-8")  # of one.svg and in/three.svg
    assert again() == {"five.svg"}
    (out / "summary.json").write_text("{", "utf-8")
    assert again() == set()


def test_a_torn_journal_is_read_as_far_as_it_is_sound(jobs: list[Job], tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        run_batch(jobs, tmp_path, executor=Here(3, KeyboardInterrupt()))
    journal = tmp_path / ".batch-journal.jsonl"
    assert journal.is_file()
    with journal.open("a") as file:
        file.write('{"out": "five.svg", "sta')
    outcomes = run_batch(jobs, tmp_path, executor=Here(), resume=True)
    assert [bool(outcome.error) for outcome in outcomes] == [False, True, False, True, False]
    assert not journal.exists()


def test_seconds_only_if_wanted(jobs: list[Job], tmp_path: Path) -> None:
    run_batch(jobs[:2], tmp_path / "out", executor=Here(), times=True)
    pair, _ = json.loads((tmp_path / "out/summary.json").read_text("utf-8"))["pairs"]
    assert {"read", "write"} < set(pair["seconds"])
    assert "seconds" in (tmp_path / "out/summary.csv").read_text("utf-8").splitlines()[0]


def test_a_bug_costs_one_pair(
    jobs: list[Job], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(data: bytes, name: str, **_: object) -> None:
        raise ZeroDivisionError(name)

    with monkeypatch.context() as patch:
        patch.setattr("shapetween.svg.read.reader.read_svg", broken)
        (outcome,) = run_batch(jobs[:1], tmp_path, executor=Here())
    assert outcome.error.startswith("internal error: ZeroDivisionError")
    assert "Traceback" in outcome.entry["traceback"]
    (outcome,) = run_batch(jobs[:1], tmp_path, executor=Here(0, RuntimeError("lost")))
    assert outcome.error == "internal error: RuntimeError: lost"
    (outcome,) = run_batch(jobs[:1], tmp_path, executor=Here(0, BrokenProcessPool("gone")))
    assert "ended from outside" in outcome.error


def kill_at_nine(task: Task) -> Any:
    """Make a task, but die of the one that lasts nine seconds."""
    if task.options.get("duration") == 9:
        os.kill(os.getpid(), signal.SIGTERM)
    return make(task)


def test_a_process_that_dies_costs_only_its_own_pair(
    jobs: list[Job], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shapetween.batch.run.make", kill_at_nine)
    outcomes = run_batch([jobs[4], jobs[0], jobs[2]], tmp_path / "out", processes=2)
    assert [outcome.entry["status"] for outcome in outcomes] == ["failed", "done", "done"]
    assert "ended from outside" in outcomes[0].error


def test_what_a_worker_makes_is_what_morph_writes(tmp_path: Path) -> None:
    a, b = tmp_path / "a.svg", tmp_path / "b.svg"
    a.write_text(svg(SQUARE), "utf-8")
    b.write_text(svg(TRIANGLE), "utf-8")
    first = morph(a, b, folds="allow", pins=[(1, 1, 2, 2)])
    options = {"folds": "allow", "pins": ((1.0, 1.0, 2.0, 2.0),), "precision": 1}
    job = Job(a, b, Path("1.svg"), None, options)
    (outcome,) = run_batch([job], tmp_path, executor=Here())
    assert (tmp_path / "1.svg").read_text("utf-8") == first.svg(precision=1)
    assert outcome.entry["report"] == first.report()
    (tmp_path / "mesh.json").write_text(first.mesh_json(), "utf-8")
    job = Job(a, b, Path("2.svg"), tmp_path / "mesh.json", {"folds": "allow"})
    (outcome,) = run_batch([job], tmp_path, executor=Here())
    assert outcome.entry["report"]["rings"][0]["quads"] == first.report()["rings"][0]["quads"]
    header, row = (tmp_path / "summary.csv").read_text("utf-8").splitlines()
    cells = dict(zip(header.split(","), row.split(","), strict=True))
    assert cells["quads"] == str(len(first.meshes[0][1].quads))
    assert float(cells["least_corner_sine"]) > 0


def test_a_worker_reads_a_drawing_once(monkeypatch: pytest.MonkeyPatch) -> None:
    texts = [line(d).encode() for d in ("M1 2H8V7H2", "M1 2H8L4 8", "M4 1L8 5L4 9L1 4")]
    tasks = [
        Task((f"{j}", f"{k}", ""), (texts[j], texts[k]), None, {})
        for j in range(3)
        for k in range(3)
        if j != k
    ]
    read: list[str] = []

    def reading(data: bytes, name: str, **options: Any) -> Any:
        read.append(name)
        return read_svg(data, name, **options)

    monkeypatch.setattr("shapetween.svg.read.reader.read_svg", reading)
    made = [make(task) for task in tasks]
    assert sorted(read) == ["0", "1", "2"]
    _drawing.cache_clear()
    last = make(tasks[-1])
    assert isinstance(last, Made)
    assert isinstance(made[-1], Made)
    assert made[-1].svg == last.svg
