"""What command lines are run on, and what they leave behind."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

__all__ = ["SQUARE", "TRIANGLE", "Command", "Run", "listing", "svg"]

SQUARE = '<path d="M1 1H9V9H1Z"/>'
TRIANGLE = '<path fill="#f00" d="M2 2H18L10 17Z"/>'


def svg(content: str, box: str = "0 0 10 10") -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{content}</svg>'


@dataclass(frozen=True)
class Run:
    """How a command ended, what it said, and which files it wrote."""

    code: int
    out: str
    err: str
    made: frozenset[str]


Command: TypeAlias = Callable[[str], Run]


def listing(folder: Path) -> dict[str, bytes]:
    """Every file under a folder, and what it holds."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }
