"""One comparison that several tests look at."""

from pathlib import Path

import pytest

from shapetween.compare import Comparison, compare

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"


@pytest.fixture(scope="session")
def tools() -> Comparison:
    """A hammer that turns as it becomes a wrench."""
    return compare(INPUTS / "hammer.svg", INPUTS / "wrench.svg")
