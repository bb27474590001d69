"""Every method on one matching: what they share, and what happens when one fails."""

from pathlib import Path

import numpy as np
import pytest

from shapetween.api import morph
from shapetween.base.errors import MeshError, OptionError
from shapetween.compare import Comparison, compare
from shapetween.compare.variants import bare_variants
from shapetween.geometry.bezier import signed_area
from shapetween.interpolate import METHODS, Tween
from shapetween.mesh.pair import MeshPair
from shapetween.svg.read.reader import read_svg

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"


def test_every_method_is_shown_and_the_guarded_one_first(tools: Comparison) -> None:
    assert [v.key for v in tools.variants] == ["guarded-projective", *METHODS]
    assert tools.figures.keys() == {v.key for v in tools.variants}


def test_all_methods_move_the_same_rings_between_the_same_ends(tools: Comparison) -> None:
    rings = [[ring for body in v.bodies for ring in body.nodes.rings] for v in tools.variants]
    assert all(one is other for mine in rings for one, other in zip(mine, rings[0], strict=True))
    for variant in tools.variants:
        assert variant.movement is not None
        for drawn, name in zip(
            variant.movement.at(np.array([0.0, 1.0])), ("hammer", "wrench"), strict=True
        ):
            given = read_svg((INPUTS / f"{name}.svg").read_bytes(), name)
            areas = [
                sum(abs(signed_area(ring.curves)) for ring in shown.shapes[0].rings)
                for shown in (drawn, given)
            ]
            assert areas[0] == pytest.approx(areas[1], rel=1e-9)


@pytest.mark.parametrize("method", ["projective", "linear"])
def test_a_bare_variant_is_what_the_method_alone_makes(method: str) -> None:
    """Holes, pieces and rings without a partner among them."""
    pair = INPUTS / "key.svg", INPUTS / "lock.svg"
    guarded = morph(*pair, together=False)
    alone = morph(*pair, method=method, folds="allow")
    (variant,) = bare_variants(guarded.prepared, [method])
    assert variant.movement is not None
    t = np.array([0.0, 0.3, 0.8, 1.0])
    for part, expected in zip(variant.movement.parts, alone.prepared.movement.parts, strict=True):
        np.testing.assert_allclose(part.curves(t), expected.curves(t), atol=1e-9)


def failing(pair: MeshPair) -> Tween:
    """A method that cannot move anything."""
    del pair
    raise MeshError("quad 3: <no> in-between")


def test_a_method_that_fails_says_why_and_the_others_are_shown(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(METHODS, "arap", failing)
    result = compare(INPUTS / "horse.svg", INPUTS / "kangaroo.svg")
    failed = {v.key: v.failure for v in result.variants if v.failure}
    assert failed == {"arap": "quad 3: <no> in-between"}
    assert result.to_json()["variants"]["arap"]["failed"] == failed["arap"]
    for text in (result.html(), result.svg()):
        assert "quad 3: &lt;no&gt; in-between" in text


def test_the_first_method_may_fail_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(METHODS, "projective", failing)
    result = compare(INPUTS / "horse.svg", INPUTS / "kangaroo.svg")
    failed = [v.key for v in result.variants if v.failure]
    assert failed == ["guarded-projective", "projective"]
    assert result.figures.keys() == set(METHODS) - {"projective"}


def test_where_the_pair_is_at_fault_nothing_is_shown(tmp_path: Path) -> None:
    lines = tmp_path / "line.svg"
    lines.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        '<path fill="none" stroke="#000" d="M1 1L8 8"/></svg>',
        "utf-8",
    )
    with pytest.raises(OptionError, match="nothing to compare"):
        compare(lines, lines)
