"""Running jobs on any executor, and writing what comes of them as it comes."""

from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import closing
from dataclasses import dataclass
from hashlib import sha256
from itertools import chain, islice
from pathlib import Path

from shapetween.base.errors import OptionError, ShapetweenError
from shapetween.batch.entry import Entry
from shapetween.batch.jobs import Job, check_jobs
from shapetween.batch.ledger import Ledger
from shapetween.batch.processes import process_pool
from shapetween.batch.work import Made, Task, Unmade, make
from shapetween.io import files

__all__ = ["Outcome", "run_batch"]

#: Tasks handed to an executor before the first is back. More wait in memory with their files;
#: fewer leave workers of a large cluster without work.
AHEAD = 64

LOST = Unmade("its process was ended from outside, perhaps for want of memory")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a job.

    Attributes
    ----------
    job : Job
    entry : Entry
        Paths, status ("done" or "failed"), error, and report, as the summary has them.
    kept : bool
        Whether an earlier run had done it.
    """

    job: Job
    entry: Entry
    kept: bool = False

    @property
    def error(self) -> str:
        """Why it failed, in one line; empty if it did not."""
        return str(self.entry["error"])


def run_batch(
    jobs: Iterable[Job],
    folder: Path,
    *,
    executor: Executor | None = None,
    processes: int = 1,
    resume: bool = False,
    times: bool = False,
    page: bool = False,
    report: Callable[[Outcome], None] = lambda outcome: None,
) -> list[Outcome]:
    """Do all jobs, and write a summary of them.

    Whatever the executor and the number of processes, the files are the same, byte for byte. A
    job that fails does not stop the others. If the run is interrupted, what is written is whole,
    and a run with `resume` goes on from there.

    Parameters
    ----------
    jobs : iterable of Job
    folder : Path
        Where to write; it is made if it is not there.
    executor : concurrent.futures.Executor, optional
        Who does the work. It is not shut down. By default, processes of this machine.
    processes : int
        How many processes, if there is no executor.
    resume : bool
        Keep what an earlier run into the folder has done, if its input, its options and what it
        wrote are as they were.
    times : bool
        Put seconds into the summary, which then differs from run to run.
    page : bool
        Write ``index.html`` too, which shows all pairs.
    report : callable, optional
        Called with every outcome as it comes.

    Returns
    -------
    list of Outcome
        In the order of the jobs.

    Raises
    ------
    OptionError
        If the folder or the summary cannot be written, or two jobs write one file.
    """
    listed = list(jobs)
    ledger = Ledger(folder, page=page)
    check_jobs(listed, folder, ledger.places)
    _make_folder(folder)
    done = ledger.begin(resume=resume)
    outcomes: dict[Path, Outcome] = {}
    left = []
    for job in listed:
        if done and (entry := done.get(_digest(job))) is not None:
            outcomes[job.out] = Outcome(job, entry, kept=True)
            report(outcomes[job.out])
        else:
            left.append(job)
    run = _Run(folder, times)
    found = (
        run.on_processes(left, processes)
        if executor is None
        else run.on(iter(left), executor, AHEAD)
    )
    with closing(found):  # processes end with it, whatever happens here
        for outcome in found:
            outcomes[outcome.job.out] = outcome
            ledger.add(outcome.entry)
            report(outcome)
    ordered = [outcomes[job.out] for job in listed]
    ledger.end(outcome.entry for outcome in ordered)
    return ordered


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OptionError(f"{folder}: cannot be made: {error.strerror}") from error


@dataclass(frozen=True, slots=True)
class _Run:
    """Where a batch writes, and whether with seconds."""

    folder: Path
    times: bool

    def on_processes(self, jobs: list[Job], processes: int) -> Generator[Outcome]:
        """Outcomes of jobs, on processes of this machine.

        If a process dies it takes the pool with it, and all that was under way: whatever that was
        is then done by itself, so that only the culprit fails.
        """
        left = iter(jobs)
        while some := list(islice(left, 1)):
            lost: list[Job] = []
            with process_pool(min(processes, len(jobs))) as pool:
                yield from self.on(chain(some, left), pool, 2 * processes, lost)
            for job in lost:
                with process_pool(1) as pool:
                    yield from self.on(iter([job]), pool, 1)

    def on(
        self, jobs: Iterator[Job], executor: Executor, ahead: int, lost: list[Job] | None = None
    ) -> Generator[Outcome]:
        """Outcomes of jobs as they come, at most `ahead` under way.

        Jobs under way when the executor breaks go to the list `lost` if there is one, and no
        more jobs are begun.
        """
        running: dict[Future[Made | Unmade], tuple[Job, str]] = {}
        broken = False
        try:
            while True:
                while not broken and len(running) < ahead and (job := next(jobs, None)):
                    try:
                        task = _task(job)
                    except ShapetweenError as error:
                        yield self._settled(job, "", Unmade(str(error)))
                        continue
                    running[_submitted(executor, task)] = job, task.digest(job.out.as_posix())
                if not running:
                    return
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    job, digest = running.pop(future)
                    made = _result(future)
                    if made is LOST and lost is not None:
                        broken = True
                        lost.append(job)
                        continue
                    yield self._settled(job, digest, made)
        finally:
            for future in running:
                future.cancel()

    def _settled(self, job: Job, digest: str, made: Made | Unmade) -> Outcome:
        """Write what was made, and say so."""
        entry: Entry = {"a": str(job.a), "b": str(job.b), "out": job.out.as_posix()}
        if isinstance(made, Made):
            try:
                place = self.folder / job.out
                _make_folder(place.parent)
                files.write_text(place, made.svg)
            except ShapetweenError as error:
                made = Unmade(str(error))
        if isinstance(made, Unmade):
            entry |= {"status": "failed", "error": made.error}
            if made.traceback:
                entry["traceback"] = made.traceback
            return Outcome(job, entry)
        entry |= {"status": "done", "error": "", "task": digest}
        entry |= {"sha256": sha256(made.svg.encode()).hexdigest(), "report": made.report}
        if self.times:
            entry["seconds"] = {stage: round(value, 4) for stage, value in made.seconds.items()}
        return Outcome(job, entry)


def _task(job: Job) -> Task:
    """What a worker needs for a job, read from its files."""
    mesh = files.read_text(job.mesh) if job.mesh is not None else None
    return Task(
        (str(job.a), str(job.b), str(job.mesh or "")),
        (files.read_bytes(job.a), files.read_bytes(job.b)),
        mesh,
        job.options,
    )


def _digest(job: Job) -> str:
    """The digest of a job's task; empty if its files cannot be read."""
    try:
        return _task(job).digest(job.out.as_posix())
    except ShapetweenError:
        return ""


def _submitted(executor: Executor, task: Task) -> "Future[Made | Unmade]":
    try:
        return executor.submit(make, task)
    except BrokenExecutor as error:
        failed: Future[Made | Unmade] = Future()
        failed.set_exception(error)
        return failed


def _result(future: "Future[Made | Unmade]") -> Made | Unmade:
    error = future.exception()
    if error is None:
        return future.result()
    if isinstance(error, BrokenExecutor):
        return LOST
    return Unmade(f"internal error: {type(error).__name__}: {error}")
