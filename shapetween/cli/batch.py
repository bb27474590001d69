"""The command that makes many pairs at once."""

import os
import re
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from shapetween.base.errors import OptionError
from shapetween.cli.legs import MOST_MATCHINGS, OfLeg
from shapetween.cli.messages import wrote
from shapetween.cli.options import QUIET
from shapetween.cli.pair import morph
from shapetween.cli.values import PATH, Whole
from shapetween.timing import defaults

__all__ = ["batch"]

#: Seconds to look for a cluster. Longer only delays the message that there is none.
PATIENCE = 10
#: Where a scheduler may be. A client that is given anything else waits long, and ends with noise.
_ADDRESS = re.compile(r"(?:tcp|tls|wss?)://[^\s/]+:\d+")

#: Options of `morph` that are not those of a row, or are for moving pictures; batches write SVG.
_NOT_A_ROW = frozenset(
    {"out", "mesh", "report", "font", "quiet", "verbose", "fps", "size", "background", "css"}
    | {"matchings"}  # below, as one
    | {"loose", "strict"}  # flags have no value that a cell could hold
)
_ROW = {
    param.name or "": param
    for param in morph.params
    if isinstance(param, click.Option) and param.name not in _NOT_A_ROW
}
# A row is one leg, and has one matching.
_ROW["matching"] = click.Option(
    ["--matching"],
    type=Whole(1, MOST_MATCHINGS),
    default=1,
    show_default=True,
    metavar="K",
    help="Which of the distinct ways for one outline to become the other.",
)
#: Those that serve whole batches; one that may be repeated, such as a pin, concerns one pair.
_SHARED = [param for param in _ROW.values() if not param.multiple]


@click.command(
    epilog="Examples:  shapetween batch pairs.csv -o out --jobs 4;  "
    "shapetween batch --all-in icons -o out --resume",
    params=_SHARED,
)
@click.argument("table", type=PATH, metavar="[PAIRS.csv]", required=False)
@click.option(
    "-o",
    "--out",
    "folder",
    type=PATH,
    metavar="DIR",
    required=True,
    help="Where to write; it is made if it is not there.",
)
@click.option(
    "--pairs-in",
    "paired",
    type=PATH,
    metavar="DIR",
    help="Pairs by their names instead of a table: cat-a.svg and cat-b.svg (or with _ or . before "
    "the letter), or cat/a.svg and cat/b.svg, become cat.svg.",
)
@click.option(
    "--all-in",
    "gathered",
    type=PATH,
    metavar="DIR",
    help="Every two drawings of a folder instead of a table, each pair once.",
)
@click.option(
    "-j",
    "--jobs",
    "processes",
    type=Whole(1, 1024),
    metavar="N",
    help="How many processes.  [default: one a core]",
)
@click.option(
    "--dask",
    metavar="ADDRESS",
    help="Work on a Dask cluster instead, such as tcp://10.0.0.1:8786.",
)
@click.option(
    "--resume", is_flag=True, help="Keep what an earlier run has done and nothing has changed."
)
@click.option(
    "--times", is_flag=True, help="Put seconds into the summary; it then differs from run to run."
)
@click.option("--page", is_flag=True, help="Write index.html too, which shows and sifts all pairs.")
@QUIET
def batch(
    table: Path | None,
    folder: Path,
    paired: Path | None,
    gathered: Path | None,
    processes: int | None,
    dask: str | None,
    resume: bool,
    times: bool,
    page: bool,
    quiet: bool,
    **options: Any,
) -> None:
    """Write one animated SVG for every pair of a table, and a summary of all.

    PAIRS.csv has a header and a row a pair: the columns a and b, paths relative to the table; out,
    the file to write, relative to DIR (A-to-B.svg if left out); mesh; pin and match (several with
    blanks between); and options of 'shapetween morph' that have a value, such as quads. An empty
    cell takes the option given here.

    A pair that fails does not stop the others. summary.csv and summary.json in DIR tell of every
    pair. The files do not depend on the number of processes. Exit code 0: all done; 2: a pair
    failed, or nothing could be begun; 130: stopped, and --resume goes on from there.
    """
    from shapetween.batch import Outcome, all_pairs_in, pairs_in, run_batch

    if sum(source is not None for source in (table, paired, gathered)) != 1:
        raise OptionError("expected one of PAIRS.csv, --pairs-in and --all-in")
    if dask is not None and processes is not None:
        raise OptionError("--jobs counts processes of this machine; a --dask cluster has its own")
    _check_easing(options["easing"])
    if table is not None:
        _check_kept(table, folder)
        jobs = _jobs_of(table, options)
    elif paired is not None:
        jobs = pairs_in(paired, options)
    else:
        assert gathered is not None
        jobs = all_pairs_in(gathered, options)

    done, failed = 0, 0
    hidden = quiet or sys.stderr is None or not sys.stderr.isatty()
    try:
        with (
            _executor(dask) as executor,
            click.progressbar(
                length=len(jobs), file=sys.stderr, show_pos=True, show_eta=True, hidden=hidden
            ) as bar,
        ):

            def report(outcome: Outcome) -> None:
                nonlocal done, failed
                done += 1
                if outcome.error:
                    failed += 1
                    bar.label = f"{failed} failed"
                bar.update(1)

            outcomes = run_batch(
                jobs,
                folder,
                executor=executor,
                processes=processes or _cores(),
                resume=resume,
                times=times,
                page=page,
                report=report,
            )
    except KeyboardInterrupt:
        click.echo(f"shapetween: {done} of {len(jobs)} pairs done; --resume goes on", err=True)
        raise
    if failed:
        first = next(outcome.error for outcome in outcomes if outcome.error)
        see = folder / "summary.csv"
        raise OptionError(f"{failed} of {len(jobs)} pairs failed, the first: {first}; see {see}")
    if not quiet:
        wrote(folder, f"{len(jobs)} pairs and their summary to ")


def _check_kept(table: Path, folder: Path) -> None:
    """Check that the summary does not replace the table."""
    from shapetween.batch.ledger import Ledger
    from shapetween.io import files

    if any(files.same_file(place, table) for place in Ledger(folder).places):
        raise OptionError(
            f"{table}: is an input, and the summary would replace it; expected another name"
        )


def _jobs_of(table: Path, options: dict[str, Any]) -> list[Any]:
    """Jobs of a table, whose columns are the options of `morph`."""
    from shapetween.batch import read_table
    from shapetween.io import files

    columns = {
        max(param.opts, key=len).removeprefix("--"): (name, _reader(param))
        for name, param in _ROW.items()
    }
    return read_table(files.read_text(table), str(table), table.parent, columns, options)


def _reader(param: click.Parameter) -> Callable[[str], Any]:
    """What reads a cell as the option would be read."""

    def read(cell: str) -> Any:
        if param.name == "easing":
            _check_easing(cell)
        try:
            if param.multiple:
                return tuple(
                    _of_pair(param.type.convert(part, param, None)) for part in cell.split()
                )
            return param.type.convert(cell, param, None)
        except click.BadParameter as error:
            raise OptionError(error.message) from error

    return read


def _of_pair(value: Any) -> Any:
    """A pin, or whatever else may be repeated; a row has one leg, which need not be named."""
    if not isinstance(value, OfLeg):
        return value
    if value.leg not in (None, 1):
        raise OptionError(f"{value.leg}/...: there is but one leg")
    return value.value


def _check_easing(name: str) -> None:
    if name == defaults.EASING:  # known good, without what it takes to know the others
        return
    from shapetween.timing.easing import easing_function

    easing_function(name)


def _cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def _executor(address: str | None) -> Iterator[Executor | None]:
    """A Dask cluster as an executor; None for processes of this machine."""
    if address is None:
        yield None
        return
    if not _ADDRESS.fullmatch(address):
        raise OptionError(f"--dask: {address!r} is no address such as tcp://10.0.0.1:8786")
    try:
        from distributed import Client
    except ImportError as error:
        raise OptionError(
            "--dask needs the package distributed: pip install 'shapetween[cluster]'"
        ) from error
    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise OptionError(f"--dask: no cluster answers at {address}") from error
    with client:
        yield client.get_executor(pure=False)
