"""Files meant to break a reader, from the corpus: each ends as its list says, and soon."""

import json
import re
import time
from pathlib import Path

import pytest

from tests.cli.commands import Command
from tests.conftest import CORPUS

#: Seconds that any of them may take; the slowest is a hundred thousand commands.
QUICK = 10.0

PAIRS = (
    [
        p
        for p in json.loads((CORPUS / "pairs.json").read_text("utf-8"))
        if p["category"] == "hostile"
    ]
    if (CORPUS / "pairs.json").is_file()
    else []
)


@pytest.mark.skipif(not PAIRS, reason="no corpus of real drawings beside the repository")
@pytest.mark.parametrize("pair", PAIRS, ids=lambda p: Path(p["a"]).stem)
def test_hostile_files_end_as_expected(
    run: Command, tmp_path: Path, corpus: Path, pair: dict[str, str]
) -> None:
    start = time.perf_counter()
    result = run(f"morph {corpus / pair['a']} {corpus / pair['b']} -o out.svg")
    assert time.perf_counter() - start < QUICK
    ended = "works" if result.code == 0 else "error"
    assert ended in (pair["expected"], pair.get("also_ok")), result.err
    if ended == "error":
        assert result.code == 2
        assert result.err.count("\n") == 1
        assert Path(pair["a"]).name in result.err
        assert not result.made
        return
    assert result.made == {"out.svg"}
    text = (tmp_path / "out.svg").read_text("utf-8")
    assert not re.search(r"script|href|\bon\w+=|file:|nan|inf\b", text, re.IGNORECASE)
