"""Figures of a stage on inputs made by formula, as they were when somebody last looked at them.

They hold the constants of a stage, also those that no promise depends on: whoever changes one sees
what else it changes. Where the new figures are meant, `SHAPETWEEN_RECORD=1` writes them down.
"""

import json
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

KNOWN = Path(__file__).resolve().parent / "data/baseline"

#: Relative difference that rounding may make, on any processor. Constants change far more.
ROUNDING = 1e-6


def assert_known(stage: str, case: str, figures: Sequence[float]) -> None:
    """The figures of a case are those that are written down."""
    path = KNOWN / f"{stage}.json"
    known = json.loads(path.read_text("utf-8")) if path.is_file() else {}
    if os.environ.get("SHAPETWEEN_RECORD"):
        known[case] = [float(f"{figure:.9g}") for figure in figures]
        path.parent.mkdir(exist_ok=True)
        rows = [f"{json.dumps(name)}: {json.dumps(known[name])}" for name in sorted(known)]
        path.write_text("{\n" + ",\n".join(rows) + "\n}\n", "utf-8")
    assert len(figures) == len(known[case])
    scale = max(map(abs, known[case]), default=0.0)
    np.testing.assert_allclose(figures, known[case], rtol=ROUNDING, atol=ROUNDING * scale)
