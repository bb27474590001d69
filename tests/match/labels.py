"""Pairs of outlines with landmarks set by hand, and how far a matching is from them."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.match.correspondence import Correspondence
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from shapetween.svg.read.reader import read_svg
from tests.match.shapes import target_at

__all__ = ["WRONG", "LabelledPair", "labelled"]

FILE = Path(__file__).resolve().parents[1] / "data" / "labels" / "pairs.json"

#: Distance along the target, as a share of its length, from which on a landmark is wrong.
WRONG = 0.05


@dataclass(frozen=True, eq=False)
class LabelledPair:
    """Two outlines, clockwise as drawn, and fractions of their lengths that belong together."""

    name: str
    source: Outline
    target: Outline
    u: Floats
    v: Floats
    turn: float
    faces_other_way: bool

    def wrong(self, found: Correspondence) -> int:
        """How many landmarks a matching carries to another place."""
        away = target_at(found, self.u) - self.v
        return int((np.abs(away - np.round(away)) > WRONG).sum())


def labelled(*splits: str, every: int = 1) -> list[LabelledPair]:
    """Every so many-th pair of some splits, in the order of the file."""
    rows = [row for row in json.loads(FILE.read_text("utf-8")) if row["split"] in splits]
    return [_pair(row) for row in rows[::every]]


def _pair(row: dict[str, Any]) -> LabelledPair:
    ends = [_outline(row[side]["d"]) for side in ("a", "b")]
    marks = np.array(row["landmarks"], dtype=np.float64).reshape(-1, 4)
    u, v = (
        ArcLength(outline).nearest(marks[:, 2 * k : 2 * k + 2])[0] if len(marks) else marks[:, 0]
        for k, outline in enumerate(ends)
    )
    return LabelledPair(
        row["id"], ends[0], ends[1], u, v, float(row["turn"] or 0), row["faces_other_way"]
    )


def _outline(path: str) -> Outline:
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 1000"><path d="{path}"/></svg>'
    )
    (shape,) = read_svg(text.encode("utf-8"), "labels").shapes
    (ring,) = shape.rings
    outline = ring if ring.closed else ring.close()
    return outline if outline.area > 0 else outline.reversed()
