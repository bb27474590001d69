"""Hypothesis profiles, and the corpus of real files where there is one."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings

if TYPE_CHECKING:
    from tests.browser import Browser

# As the command line has it, and set before numpy is imported: on small matrices threads only
# wait for each other, and on a busy machine for everything else.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

settings.register_profile(
    "ci", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("deep", max_examples=2000, deadline=None)
settings.load_profile("ci")

CORPUS = Path(__file__).resolve().parents[2] / "shared" / "corpus"


@pytest.fixture(scope="session")
def corpus() -> Path:
    """Folder of real drawings, with a list of pairs; it is no part of the repository."""
    if not (CORPUS / "pairs.json").is_file():
        pytest.skip("no corpus of real drawings beside the repository")
    return CORPUS


@pytest.fixture(scope="module")
def browser() -> Iterator["Browser"]:
    """Chromium; skips where there is none."""
    from tests.browser import chromium

    with chromium() as opened:
        yield opened


@pytest.fixture(scope="module")
def lottie_web(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of lottie-web; skips where it cannot be installed."""
    from tests.node import install

    return install(("lottie-web@5",), tmp_path_factory.mktemp("lottie"))
