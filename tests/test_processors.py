"""The same bytes on any machine: other instructions of the same processor change no output."""

import os
import platform
import subprocess
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from tests.ties import TIES

ROOT = Path(__file__).resolve().parents[1]

#: Pairs of all kinds: silhouettes, limbs, letters, holes, several parts, lines and gradients.
PAIRS = (
    ("hammer", "wrench"),
    ("horse", "kangaroo"),
    ("camel", "elephant"),
    ("hand-closed", "hand-open"),
    ("airplane", "jet"),
    ("umbrella", "tree"),
    ("maple-leaf", "monstera-leaf"),
    ("letter-o", "letter-c"),
    ("key", "lock"),
    ("run", "walk"),
    ("man-dancing", "woman-dancing"),
    ("fish-checked", "fish-scaled"),
)

#: Known scenes in which strands touch on the way.
TOUCHING = tuple(f"pairing:vaadin-calendar-briefcase:vaadin-calendar-user#{k}" for k in (1, 2))

DIGESTS = """
import hashlib, sys
import shapetween as st
from tests.scene.test_baseline import drawings
from tests.ties import svg
for name in sys.argv[1:]:
    halves = name.split(":")
    if halves[0] == "made":
        first, second = map(svg, halves[1:])
    elif halves[0] == "moved":
        first, second = drawings(name.removeprefix("moved:"))
    else:
        first, second = (f"gallery/inputs/{half}.svg" for half in halves)
    text = st.morph(first, second).svg()
    print(name, hashlib.sha256(text.encode()).hexdigest())
"""


def digests(changes: Mapping[str, str]) -> list[str]:
    """What the pairs come out as in a process of its own."""
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in ("OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES")
    }
    environment |= {"PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "ignore", **changes}
    pairs = PAIRS + tuple(("made", *pair) for pair in TIES)
    names = [":".join(pair) for pair in pairs] + [f"moved:{case}" for case in TOUCHING]
    run = subprocess.run(
        [sys.executable, "-c", DIGESTS, *names],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()


@cache
def here() -> list[str]:
    return digests({})


def flags() -> set[str]:
    try:
        return set(Path("/proc/cpuinfo").read_text("utf-8").split())
    except OSError:
        return set()


#: What a processor must have for a kernel of OpenBLAS.
KERNELS = {"Prescott": "pni", "Haswell": "avx2", "Zen": "avx2", "SkylakeX": "avx512f"}


@pytest.mark.parametrize("kernel", KERNELS)
def test_another_kernel_of_the_matrix_library_changes_nothing(kernel: str) -> None:
    if platform.machine() not in ("x86_64", "AMD64") or KERNELS[kernel] not in flags():
        pytest.skip("this processor has no such kernel")
    assert digests({"OPENBLAS_CORETYPE": kernel}) == here()


@pytest.mark.parametrize("names", ["X86_V4", "X86_V3 X86_V4"])
def test_fewer_vector_instructions_change_nothing(names: str) -> None:
    features: dict[str, bool] = np._core._multiarray_umath.__cpu_features__  # type: ignore[attr-defined]
    if not all(features.get(name) for name in names.split()):
        pytest.skip("this processor or this numpy has no such instructions to do without")
    assert digests({"NPY_DISABLE_CPU_FEATURES": names}) == here()
