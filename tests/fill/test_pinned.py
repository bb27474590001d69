"""Pins on holes: kept on both engines, born where the match is, refused where they fit nothing."""

from pathlib import Path

import numpy as np
import pytest

import shapetween as st
from shapetween.base.arrays import Points
from shapetween.base.errors import OptionError
from shapetween.fill.pinned import pinned_rings
from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.model.outline import Outline

#: An odd outline around an odd hole: by the outline engine.
LIMBS = (
    "M10 10L40 4L52 30L90 20L80 60L95 90L50 80L12 94L20 50Z M40 40L60 36L66 58L50 66L38 56Z",
    "M14 8L50 12L60 26L94 10L84 56L90 96L54 84L8 90L18 44Z M42 36L62 42L60 62L44 60L36 50Z",
)
#: Simple forms, not of one width, or they were strokes.
RINGS = (
    "M50 10A40 40 0 1 1 49.9 10Z M60 44A10 10 0 1 1 59.9 44Z",
    "M10 10H90V90H10Z M46 40H70V64H46Z",
)
#: Two holes side by side.
EYES = (
    "M5 20H95V80H5Z M20 40H40V60H20Z M60 40H80V60H60Z",
    "M10 10H90L80 90H20Z M24 30L40 34L36 50L22 46Z M60 30L78 34L74 50L58 46Z",
)


def written(folder: Path, pair: tuple[str, str], more: str = "") -> tuple[Path, Path]:
    paths = folder / "a.svg", folder / "b.svg"
    for path, d in zip(paths, pair, strict=True):
        path.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
            f'<path fill-rule="evenodd" d="{d}"/>{more}</svg>'
        )
    return paths


def followed(m: st.Morph, point: tuple[float, float]) -> Points:
    """Where the place of the first drawing's outlines that is nearest to a point ends."""
    ends = [part.curves(np.array([0.0, 1.0])) for part in m.prepared.movement.parts]
    t = np.linspace(0, 1, 201)
    flat = [evaluate(end, t).reshape(2, -1, 2) for end in ends]
    both = np.concatenate(flat, axis=1)
    k = int(np.hypot(*(both[0] - point).T).argmin())
    assert np.hypot(*(both[0, k] - point)) < 0.3
    there: Points = both[1, k]
    return there


@pytest.mark.parametrize("more", ["", '<path d="M2 96H98V99H2Z"/>'], ids=["outline", "scene"])
def test_a_pin_on_a_hole_is_kept(tmp_path: Path, more: str) -> None:
    pin = (40.0, 40.0, 62.0, 42.0)  # not the corner that it becomes by itself
    paths = written(tmp_path, LIMBS, more)
    free, held = st.morph(*paths), st.morph(*paths, pins=[pin])
    assert np.hypot(*(followed(free, pin[:2]) - pin[2:])) > 5
    assert np.hypot(*(followed(held, pin[:2]) - pin[2:])) < 0.3
    assert not held.warnings


@pytest.mark.parametrize("more", ["", '<path d="M2 96H98V99H2Z"/>'], ids=["alone", "scene"])
def test_a_pin_on_the_hole_of_a_simple_form_is_kept(tmp_path: Path, more: str) -> None:
    paths = written(tmp_path, RINGS, more)
    held = st.morph(*paths, pins=[(60, 44, 70, 40)])
    assert np.hypot(*(followed(held, (60, 44)) - (70, 40))) < 0.3


@pytest.mark.parametrize("pair", [LIMBS, RINGS], ids=["outline", "simple"])
def test_a_pin_on_the_match_changes_no_matching(tmp_path: Path, pair: tuple[str, str]) -> None:
    """As the page sets it: every other place of the hole goes where it went."""
    paths = written(tmp_path, pair, '<path d="M2 96H98V99H2Z"/>')
    free = st.morph(*paths)
    points = [(40.0, 40.0), (60.0, 36.0)] if pair is LIMBS else [(60.0, 44.0), (70.0, 54.0)]
    there = followed(free, points[0])
    held = st.morph(*paths, pins=[(*points[0], *there)])
    for point in points:
        away = followed(held, point) - followed(free, point)
        assert np.hypot(*away) < 0.5


def test_pins_say_which_hole_becomes_which(tmp_path: Path) -> None:
    paths = written(tmp_path, EYES, '<path d="M2 96H98V99H2Z"/>')
    crossed = [(20.0, 40.0, 60.0, 30.0), (60.0, 40.0, 24.0, 30.0)]
    free, held = st.morph(*paths, pairing="loose"), st.morph(*paths, pins=crossed)
    for ax, ay, bx, by in crossed:
        assert np.hypot(*(followed(free, (ax, ay)) - (bx, by))) > 30
        assert np.hypot(*(followed(held, (ax, ay)) - (bx, by))) < 0.3


def test_a_pin_from_a_hole_to_the_outside_is_refused(tmp_path: Path) -> None:
    paths = written(tmp_path, RINGS)
    with pytest.raises(OptionError, match="does not lie on two outlines that become each other"):
        st.morph(*paths, pins=[(60, 44, 10, 50)])


def test_a_hole_becomes_one_hole(tmp_path: Path) -> None:
    paths = written(tmp_path, EYES)
    with pytest.raises(OptionError, match="another pin makes that hole a different one"):
        st.morph(*paths, pins=[(20, 40, 24, 30), (40, 60, 78, 34)])


def square(low: float, high: float) -> Outline:
    points = np.array([[low, low], [high, low], [high, high], [low, high]])
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def test_reach_is_a_share_of_the_piece() -> None:
    """A click beside the line is meant, one elsewhere is not; at any unit."""
    for unit in (1e-6, 1.0, 1e6):
        rings = square(0, 100 * unit), square(40 * unit, 60 * unit)
        size = np.hypot(100, 100)
        for off, on in ((0.049, True), (0.051, False)):
            pins = np.array([[50, 40 - off * size, 50, 40]]) * unit
            assert bool(pinned_rings(rings, rings, pins).holes) is on


def test_of_two_rings_the_nearer_is_meant() -> None:
    rings = square(0, 100), square(4, 60)
    pins = np.array([[50.0, 1.0, 50.0, 1.0], [50.0, 3.0, 50.0, 3.0], [50.0, 2.0, 50.0, 2.0]])
    found = pinned_rings(rings, rings, pins)
    assert found.outer == (0, 2)
    assert found.holes == {(0, 0): (1,)}
