"""What an optimiser makes of the animated file plays as the file itself does."""

import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from shapetween.svg.write.smil import smil_svg
from shapetween.timing.timeline import Loop
from tests.browser import Browser, chromium, difference
from tests.movements import sample_chain, sample_movement

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as opened:
        yield opened


@pytest.mark.parametrize("loop", ["once", "alternate"])
@pytest.mark.parametrize("chained", [False, True])
def test_svgo_leaves_the_picture_the_same(
    browser: Browser, tmp_path: Path, loop: Loop, chained: bool
) -> None:
    """Its default run writes what a path holds at rest in other numbers and letters."""
    program = shutil.which("svgo")
    if program is None:
        pytest.skip("no svgo on this machine: npm install -g svgo")
    legs = sample_chain() if chained else (sample_movement(),)
    text = smil_svg(*legs, duration=1.0, loop=loop, hold=0.2)
    given, made = tmp_path / "in.svg", tmp_path / "out.svg"
    given.write_text(text, "utf-8")
    subprocess.run([program, str(given), "-o", str(made)], check=True, capture_output=True)
    optimised = made.read_text("utf-8")
    assert optimised != text
    seconds = [0.0, 0.45, 0.7, 1.0, 1.9]
    shots = browser.pictures([text] * 5 + [optimised] * 5, [*seconds, *seconds])
    for played, again in zip(shots[:5], shots[5:], strict=True):
        assert difference(played, again) <= 2e-4
    assert max(difference(shots[0], shot) for shot in shots) > 0.01
