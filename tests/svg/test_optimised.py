"""What an optimiser makes of the animated file plays as the file itself does."""

import subprocess
from pathlib import Path

import pytest

import shapetween as st
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.timeline import Loop
from tests.browser import Browser, difference
from tests.movements import sample_chain, sample_movement
from tests.node import install

pytestmark = pytest.mark.browser

INPUTS = Path(__file__).parents[2] / "gallery" / "inputs"

SECONDS = (0.0, 0.45, 0.7, 1.0, 1.9)


@pytest.fixture(scope="module")
def svgo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The optimiser, from its package."""
    return install(("svgo@4",), tmp_path_factory.mktemp("svgo")) / ".bin" / "svgo"


def assert_the_same(browser: Browser, svgo: Path, folder: Path, text: str) -> None:
    given, made = folder / "in.svg", folder / "out.svg"
    given.write_text(text, "utf-8")
    subprocess.run([str(svgo), str(given), "-o", str(made)], check=True, capture_output=True)
    optimised = made.read_text("utf-8")
    assert optimised != text
    shots = browser.pictures([text] * 5 + [optimised] * 5, [*SECONDS, *SECONDS])
    for played, again, second in zip(shots[:5], shots[5:], SECONDS, strict=True):
        assert difference(played, again) <= 2e-4, f"another picture at {second} s"
    assert max(difference(shots[0], shot) for shot in shots) > 0.01


@pytest.mark.parametrize("loop", ["once", "alternate"])
@pytest.mark.parametrize("chained", [False, True])
def test_svgo_leaves_the_picture_the_same(
    browser: Browser, svgo: Path, tmp_path: Path, loop: Loop, chained: bool
) -> None:
    """Its default run writes what a path holds at rest in other numbers and letters."""
    legs = sample_chain() if chained else (sample_movement(),)
    assert_the_same(browser, svgo, tmp_path, smil_svg(*legs, duration=1.0, loop=loop, hold=0.2))


@pytest.mark.parametrize("loop", ["once", "alternate"])
@pytest.mark.parametrize(
    "pair", ["horse-kangaroo", "key-lock", "letter-o-letter-c", "man-werewolf"]
)
def test_svgo_leaves_real_drawings_the_same(
    browser: Browser, svgo: Path, tmp_path: Path, pair: str, loop: Loop
) -> None:
    """Sums of easings over the whole way and over windows of it, holes, keyframes, many parts."""
    a, b = ("letter-o", "letter-c") if "letter" in pair else pair.split("-")
    morph = st.morph(INPUTS / f"{a}.svg", INPUTS / f"{b}.svg")
    text = morph.svg(duration=1.0, loop=loop)
    # As large as the window, not as the page that an icon is for.
    assert_the_same(browser, svgo, tmp_path, text)
