"""node, run on modules and packages; a test skips where there is none."""

import json
import shutil
import subprocess
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import pytest


def run_node(script: str, folder: Path) -> Any:
    """Run a module's text in a folder; what it prints, as JSON."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node on this machine")
    (folder / "script.mjs").write_text(script, "utf-8")
    run = subprocess.run(
        [node, "script.mjs"], cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout) if run.stdout.strip() else None


@cache
def _installed(packages: tuple[str, ...], folder: Path) -> str:
    """What went wrong when the packages were installed there, if anything did."""
    npm = shutil.which("npm")
    if npm is None:
        return "no npm on this machine"
    command = [npm, "install", "--silent", "--no-audit", "--no-fund", "--prefix", str(folder)]
    try:
        run = subprocess.run(
            [*command, *packages], capture_output=True, text=True, timeout=300, check=False
        )
    except subprocess.TimeoutExpired:
        return "npm does not answer"
    return "" if run.returncode == 0 else f"npm: {run.stderr.strip().splitlines()[-1:]}"


def install(packages: Sequence[str], folder: Path) -> Path:
    """Install packages into a folder, and tell where they are; skips where that cannot be."""
    reason = _installed(tuple(packages), folder)
    if reason:
        pytest.skip(reason)
    return folder / "node_modules"
