"""Previews: the matching is the full one's, the ends are exact, and pins are kept."""

from pathlib import Path

import numpy as np
import pytest

import shapetween as st
from shapetween.api import Pin
from shapetween.base.errors import OptionError
from shapetween.outline.preview import Effort
from shapetween.studio.preview import previewed

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"

PAIRS = [("horse", "kangaroo"), ("hammer", "wrench"), ("maple-leaf", "monstera-leaf")]


def pin_of(m: st.Morph, place: int, shift: int) -> Pin:
    """A pin on the first outline that asks for a little more than the matching says."""
    ring = m.correspondence[0]
    (ax, ay), (bx, by) = ring.source[place], ring.target[(place + shift) % len(ring.target)]
    return float(ax), float(ay), float(bx), float(by)


@pytest.mark.parametrize("pair", PAIRS, ids="-".join)
@pytest.mark.parametrize("level", ["line", "plane"])
def test_the_matching_is_that_of_the_full_result(pair: tuple[str, str], level: Effort) -> None:
    a, b = (INPUTS / f"{name}.svg" for name in pair)
    free = st.morph(a, b, effort="line")
    pin, near = pin_of(free, 130, 9), pin_of(free, 134, 2)
    base = st.morph(a, b, pins=[near], effort="line")
    quick, full = previewed(base, [near], [pin], level), st.morph(a, b, pins=[pin])
    assert quick is not None
    mine, theirs = (m.prepared.filled[0].bodies[0].nodes.rings[0].matching for m in (quick, full))
    np.testing.assert_array_equal(mine.u, theirs.u)
    np.testing.assert_array_equal(mine.v, theirs.v)
    for t in (0.0, 1.0):
        areas = [m.at(t).shapes[0].rings[0].area for m in (quick, full)]
        assert areas[0] == pytest.approx(areas[1], rel=1e-9)
    ring = quick.correspondence[0]
    at = int(np.hypot(ring.source[:, 0] - pin[0], ring.source[:, 1] - pin[1]).argmin())
    size = np.ptp(ring.target, axis=0).max()
    assert np.hypot(*(ring.target[at] - pin[2:])) < 1e-6 * size


def test_without_pins_nothing_changes() -> None:
    free = st.morph(INPUTS / "horse.svg", INPUTS / "kangaroo.svg", effort="plane")
    quick = previewed(free, [], [])
    assert quick is not None
    assert quick.svg(keyframes=5) == free.svg(keyframes=5)


def test_a_pin_on_nothing_is_for_the_full_result_to_refuse() -> None:
    free = st.morph(INPUTS / "horse.svg", INPUTS / "kangaroo.svg", effort="plane")
    assert previewed(free, [], [(500.0, 500.0, 1.0, 1.0)]) is None


def test_pins_on_other_outlines_need_another_start() -> None:
    """What was found with a pin does not tell how its outline moves without."""
    free = st.morph(INPUTS / "horse.svg", INPUTS / "kangaroo.svg", effort="plane")
    pin = pin_of(free, 130, 9)
    assert previewed(free, [], [pin]) is None
    held = st.morph(INPUTS / "horse.svg", INPUTS / "kangaroo.svg", pins=[pin], effort="plane")
    assert previewed(held, [pin], []) is None
    assert previewed(held, [pin], [pin_of(free, 140, 3)]) is not None


@pytest.mark.parametrize("effort", ["line", "plane"])
@pytest.mark.parametrize("pair", [*PAIRS, ("run", "walk"), ("lock", "key")], ids="-".join)
def test_every_effort_has_the_matching_of_the_full_one(
    pair: tuple[str, str], effort: Effort
) -> None:
    a, b = (INPUTS / f"{name}.svg" for name in pair)
    for pins in ([], [pin_of(st.morph(a, b), 130, 9)]):
        quick, full = st.morph(a, b, pins=pins, effort=effort), st.morph(a, b, pins=pins)
        rings = [
            [r for part in m.prepared.filled for body in part.bodies for r in body.nodes.rings]
            for m in (quick, full)
        ]
        for mine, theirs in zip(*rings, strict=True):
            np.testing.assert_array_equal(mine.matching.u, theirs.matching.u)
            np.testing.assert_array_equal(mine.matching.v, theirs.matching.v)
        for t in (0.0, 1.0):
            ends = [m.at(t).shapes for m in (quick, full)]
            areas = [[ring.area for shape in shapes for ring in shape.rings] for shapes in ends]
            assert areas[0] == pytest.approx(areas[1], rel=1e-9)


def test_an_effort_that_is_none_is_refused() -> None:
    with pytest.raises(OptionError, match="effort: 'some' is none of line, plane, full"):
        st.morph(INPUTS / "horse.svg", INPUTS / "kangaroo.svg", effort="some")  # type: ignore[arg-type]


def test_a_hole_is_pinned_in_a_preview_too() -> None:
    """A hole of the preview is matched as the full result's, turned with its outer ring."""
    a, b = (INPUTS / f"{name}.svg" for name in ("lock", "key"))
    free = st.morph(a, b, effort="line")
    k = next(k for k, ring in enumerate(free.correspondence) if ring.hole)
    ring = free.correspondence[k]
    (ax, ay), (bx, by) = ring.source[40].tolist(), ring.target[52].tolist()
    pin = (ax, ay, bx, by)
    near = (ax, ay, *map(float, ring.target[46]))
    quick = previewed(st.morph(a, b, pins=[near], effort="line"), [near], [pin])
    full = st.morph(a, b, pins=[pin])
    assert quick is not None
    mine, theirs = (m.prepared.filled[0].bodies[0].nodes.rings[k].matching for m in (quick, full))
    np.testing.assert_array_equal(mine.u, theirs.u)
    np.testing.assert_array_equal(mine.v, theirs.v)


def test_of_many_shapes_only_what_is_pinned_moves_anew() -> None:
    paths = INPUTS / "run.svg", INPUTS / "walk.svg"
    free = st.morph(*paths, effort="plane")
    pins = [pin_of(free, 130, 2), pin_of(free, 130, 9)]
    base = st.morph(*paths, pins=pins[:1], effort="plane")
    quick = previewed(base, pins[:1], pins[1:])
    assert quick is not None
    parts = [m.prepared.movement.parts for m in (base, quick)]
    mid = [[part.curves(np.array([0.5])) for part in some] for some in parts]
    changed = [not np.array_equal(one, other) for one, other in zip(*mid, strict=True)]
    assert sum(changed) == 1
    assert quick.at(0.5).drawn != base.at(0.5).drawn
