"""What a batch has done, kept so that an interrupted one can go on.

While it runs, each outcome becomes a line of a hidden journal. At the end the summaries take its
place, in the order of the jobs, so that they do not depend on who finished first.
"""

import csv
import io
import json
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from shapetween.base.errors import ShapetweenError
from shapetween.batch.entry import Entry
from shapetween.batch.page import page_html
from shapetween.io import files

__all__ = ["Ledger"]

"""An outcome as plain values, as the summary has it."""

#: Columns of the table that are summed up, or taken at their worst, over a report's rings.
_SUMS = ("quads", "triangles")
_LEAST = ("least_corner_sine",)
_MOST = ("largest_w_ratio",)


class Ledger:
    """The journal and the summaries of the batch in one folder.

    Parameters
    ----------
    folder : Path
        Where the batch writes.
    page : bool
        Whether to write a page of all pairs too.
    """

    def __init__(self, folder: Path, *, page: bool = False) -> None:
        self.folder = folder
        self.table = folder / "summary.csv"
        self.full = folder / "summary.json"
        self._page = folder / "index.html" if page else None
        self._journal = folder / ".batch-journal.jsonl"

    @property
    def places(self) -> tuple[Path, ...]:
        """Every file that it writes."""
        return self.table, self.full, self._journal, *((self._page,) if self._page else ())

    def begin(self, *, resume: bool) -> dict[str, Entry]:
        """Begin a journal, with what is done already if that is wanted.

        Returns
        -------
        dict of str to Entry
            Finished entries whose files are as they were written, by the digest of their task.
        """
        entries = [*self._summed(), *self._noted()] if resume else []
        done = {entry["task"]: entry for entry in entries if self._stands(entry)}
        files.write_text(self._journal, "".join(map(_line, done.values())))
        return done

    def add(self, entry: Entry) -> None:
        """Note an outcome."""
        with self._journal.open("a", encoding="utf-8", newline="\n") as journal:
            journal.write(_line(entry))

    def end(self, entries: Iterable[Entry]) -> None:
        """Write the summaries and end the journal."""
        listed = list(entries)
        files.write_text(self.full, json.dumps({"pairs": listed}, indent=1) + "\n")
        files.write_text(self.table, _table(listed))
        if self._page is not None:
            files.write_text(self._page, page_html(listed, self.folder.resolve().name))
        self._journal.unlink(missing_ok=True)

    def _summed(self) -> list[Entry]:
        """Entries of an earlier run that came to its end; none if its summary cannot be read."""
        try:
            pairs = json.loads(files.read_text(self.full))["pairs"]
        except (ShapetweenError, ValueError, KeyError, TypeError):
            return []
        return list(pairs) if isinstance(pairs, list) else []

    def _noted(self) -> list[Entry]:
        """Entries of an earlier run that was interrupted; its last line may be torn."""
        try:
            lines = files.read_text(self._journal).splitlines()
        except ShapetweenError:
            return []
        entries = []
        for line in lines:
            try:
                entries.append(json.loads(line))
            except ValueError:
                continue
        return entries

    def _stands(self, entry: Any) -> bool:
        """Whether an entry is of a finished pair, and what was written is still there."""
        try:
            path, digest = self.folder / entry["out"], entry["sha256"]
            return (
                entry["status"] == "done"
                and isinstance(entry["task"], str)
                and sha256(files.read_bytes(path)).hexdigest() == digest
            )
        except (ShapetweenError, KeyError, TypeError):
            return False


def _line(entry: Entry) -> str:
    return json.dumps(entry) + "\n"


def _table(entries: list[Entry]) -> str:
    """The entries with the main figures of their reports, one to a row."""
    text = io.StringIO(newline="")
    rows = [_row(entry) for entry in entries]
    names = list(dict.fromkeys(name for row in rows for name in row))
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _row(entry: Entry) -> dict[str, Any]:
    report: Mapping[str, Any] = entry.get("report") or {}
    rings = report.get("rings", [])

    def figures(name: str) -> list[float]:
        return [ring[name] for ring in rings if name in ring]

    row = {name: entry[name] for name in ("a", "b", "out", "status", "error")}
    row |= {name: sum(figures(name)) if rings else "" for name in _SUMS}
    row |= {name: min(figures(name), default="") for name in _LEAST}
    row |= {name: max(figures(name), default="") for name in _MOST}
    row["crossing_frames"] = sum(ring["self_crossing"]["found"] for ring in rings) if rings else ""
    row["confidence"] = " ".join(dict.fromkeys(ring["matching"]["confidence"] for ring in rings))
    row["warnings"] = len(report["warnings"]) if report else ""
    if "seconds" in entry:
        row["seconds"] = round(sum(entry["seconds"].values()), 3)
    return row
