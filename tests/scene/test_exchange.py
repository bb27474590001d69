"""Drawings with little in common: one goes as a whole, the other comes."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from shapetween import Morph, morph
from shapetween.base.arrays import Curves, Floats
from shapetween.model.part import Change, CurveTrack
from shapetween.scene.assign import Role, Roles, assign
from shapetween.scene.disturbance import waviness
from shapetween.scene.exchange import behind_both, difference, too_different
from shapetween.scene.items import items_of
from shapetween.scene.motion.turning import total_turning
from shapetween.scene.pierced import pierced_apart
from shapetween.scene.relations import perceive
from shapetween.svg.read.reader import read_svg

VIEW = "0 0 100 100"
FACE = (
    '<circle cx="50" cy="50" r="40" fill="#fc0"/><circle cx="35" cy="40" r="5"/>'
    '<circle cx="65" cy="40" r="5"/><path d="M30 62q20 20 40 0" fill="none" stroke="#000"/>'
)
SAD = FACE.replace("q20 20", "q20 -20")
GROUND = '<ellipse cx="50" cy="94" rx="30" ry="4" fill="#ddd"/>'
STAR = (
    '<path d="M50 2l6 38 38-6-32 20 22 36-34-24-34 24 22-36-32-20 38 6z" fill="#394"/>'
    '<path d="M20 8h8v8z" fill="#fa0"/><path d="M80 70v9h-9z" fill="#a0f"/>'
)
CAR = (
    '<path d="M8 60h84v18h-84z" fill="#c22"/><path d="M26 60l10-18h28l10 18z" fill="#9cf"/>'
    '<circle cx="28" cy="80" r="11" stroke="#222" stroke-width="4" fill="#888"/>'
    '<circle cx="72" cy="80" r="11" stroke="#222" stroke-width="4" fill="#888"/>'
    '<path d="M40 66h8v2h-8z"/><path d="M84 64h6v4h-6z" fill="#ff8"/>'
)


def made(tmp_path: Path, first: str, second: str, **options: Any) -> Morph:
    paths = [tmp_path / "a.svg", tmp_path / "b.svg"]
    for path, inner in zip(paths, (first, second), strict=True):
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{inner}</svg>')
    return morph(*paths, **options)


def is_exchanged(found: Morph) -> bool:
    return any(notice.kind == "exchanged" for notice in found.notices)


def boxes(found: Morph, t: float) -> list[Floats]:
    """Least and greatest corner of what is seen at one time, part by part."""
    (frame,) = found.movements[0].at(np.array([t]))
    seen = [shape for shape in frame.shapes if shape.style.opacity > 0]
    corners: list[NDArray[np.float64]] = []
    for shape in seen:
        points = np.concatenate([ring.curves.reshape(-1, 2) for ring in shape.rings])
        corners.append(np.stack([points.min(axis=0), points.max(axis=0)]))
    return corners


def test_a_car_leaves_as_a_whole_and_a_star_comes(tmp_path: Path) -> None:
    found = made(tmp_path, CAR, STAR)
    assert is_exchanged(found)
    assert "--loose" in " ".join(found.warnings)
    home, there = (np.array(boxes(found, t)) for t in (0.0, 1.0))
    ends = [
        np.array([e[:, 0].min(axis=0), e[:, 1].max(axis=0)]).mean(axis=0) for e in (home, there)
    ]
    middle = np.mean(ends, axis=0)
    sizes = []
    for t in (0.1, 0.2, 0.3, 0.4):
        now = np.array(boxes(found, t))
        assert now.shape == home.shape  # the star is not seen yet
        # Everything is where one shrinking takes it, to where the star comes from.
        sizes.append(np.ptp(now[0], axis=0)[0] / np.ptp(home[0], axis=0)[0])
        np.testing.assert_allclose(now - middle, sizes[-1] * (home - middle), atol=2.5)
    assert (np.diff([1.0, *sizes]) < 0).all()
    for t in (0.5, 0.7, 0.9):
        now = np.array(boxes(found, t))
        assert now.shape == there.shape
        size = np.ptp(now[0], axis=0)[0] / np.ptp(there[0], axis=0)[0]
        np.testing.assert_allclose(now - middle, size * (there - middle), atol=2.5)


def test_strokes_shrink_with_the_drawing(tmp_path: Path) -> None:
    found = made(tmp_path, CAR, STAR)
    widths = []
    for t in (0.0, 0.35):
        (frame,) = found.movements[0].at(np.array([t]))
        (width,) = {s.style.stroke.width for s in frame.shapes if s.style.stroke is not None}
        widths.append(width)
    sizes = [np.ptp(boxes(found, t)[0], axis=0)[0] for t in (0.0, 0.35)]
    assert widths[1] / widths[0] == pytest.approx(sizes[1] / sizes[0], rel=1e-6)


def test_one_shrinks_to_nothing_before_the_other_grows(tmp_path: Path) -> None:
    """No leap from one to the other, no lump of both, and half-way something is seen."""
    found = made(tmp_path, CAR, STAR)
    counts = [len(boxes(found, t)) for t in (0.0, 1.0)]
    largest = []
    for t in np.linspace(0, 1, 201).tolist():
        corners = boxes(found, t)
        assert len(corners) in (0, *counts)
        largest.append(max((float(np.ptp(box, axis=0).max()) for box in corners), default=0.0))
    assert np.abs(np.diff(largest)).max() < 0.06 * 84
    assert min(largest) < 0.06 * 84
    assert (np.array(largest) < 0.1 * 84).mean() < 0.06
    assert largest[100] > 0.2 * 60


def test_the_ground_that_both_stand_on_stays(tmp_path: Path) -> None:
    found = made(tmp_path, GROUND + CAR, GROUND + STAR)
    assert is_exchanged(found)
    for t in (0.0, 0.3, 0.46, 0.7, 1.0):
        assert any(
            abs(box[0] - [20, 90]).max() < 1e-6 and abs(box[1] - [80, 98]).max() < 1e-6
            for box in boxes(found, t)
        )
    assert np.array(boxes(found, 0.4))[:, 1, 1].max() < 98 + 1e-6


@pytest.mark.parametrize(("opacity", "stays"), [(0.4, False), (0.6, True)])
def test_a_shadow_goes_with_what_stands_on_it(tmp_path: Path, opacity: float, stays: bool) -> None:
    shadow = GROUND.replace('fill="#ddd"', f'fill="#000" fill-opacity="{opacity}"')
    found = made(tmp_path, shadow + CAR, shadow + STAR)
    assert is_exchanged(found)
    wide = [np.isclose(box[1, 0] - box[0, 0], 60) for box in boxes(found, 0.4)]
    assert any(wide) == stays


def test_a_face_stays_and_only_its_mouth_moves(tmp_path: Path) -> None:
    assert not is_exchanged(made(tmp_path, FACE, SAD))


def test_one_thing_becomes_another_whatever_the_two_are(tmp_path: Path) -> None:
    star = '<path d="M50 5l12 33 35 1-28 22 10 34-29-20-29 20 10-34-28-22 35-1z"/>'
    assert not is_exchanged(made(tmp_path, star, '<path d="M10 45h80v8h-80z"/>'))


@pytest.mark.parametrize("asked", [{"pairing": "loose"}, {"matches": [("#1", "#1")]}])
def test_who_asks_for_parts_gets_parts(tmp_path: Path, asked: dict[str, Any]) -> None:
    assert not is_exchanged(made(tmp_path, CAR, STAR, **asked))


def test_both_ends_are_as_drawn(tmp_path: Path) -> None:
    found = made(tmp_path, CAR, STAR)
    for t, name in ((0.0, "a.svg"), (1.0, "b.svg")):
        (frame,) = found.movements[0].at(np.array([t]))
        seen = [shape for shape in frame.shapes if shape.style.opacity > 0]
        drawn = read_svg((tmp_path / name).read_bytes(), name).shapes
        assert len(seen) == len(drawn)
        for one, other in zip(seen, drawn, strict=True):
            assert one.style.fill == other.style.fill
            np.testing.assert_allclose(
                one.rings[0].curves.min(axis=(0, 1)), other.rings[0].curves.min(axis=(0, 1))
            )


CARD = '<rect x="2" y="2" width="96" height="96" rx="12" fill="{}"/>'


def test_a_card_stays_and_what_lies_on_it_is_exchanged(tmp_path: Path) -> None:
    """A large card in common does not make a car like a star."""
    found = made(tmp_path, CARD.format("#dde") + CAR, CARD.format("#fed") + STAR)
    assert is_exchanged(found)
    for t in (0.2, 0.46, 0.8):
        whole = next(box for box in boxes(found, t) if np.ptp(box, axis=0).min() > 95)
        np.testing.assert_allclose(whole, [[2, 2], [98, 98]], atol=1e-6)
    middles = [box.mean(axis=0) for box in boxes(found, 0.42) if np.ptp(box, axis=0).max() < 60]
    assert middles
    assert all(abs(middle - [50, 55]).max() < 10 for middle in middles)


def test_one_mark_on_a_card_becomes_another(tmp_path: Path) -> None:
    mark, other = '<path d="M45 20h10v60h-10z"/>', '<path d="M20 45l60 0-30 35z"/>'
    assert not is_exchanged(made(tmp_path, CARD.format("#dde") + mark, CARD.format("#dde") + other))


@pytest.mark.parametrize(("paint", "exchanged"), [("#235", True), ("#fb0", False)])
def test_a_face_is_exchanged_for_what_is_none_in_another_colour(
    tmp_path: Path, paint: str, exchanged: bool
) -> None:
    """Half-way its mouth would be on a bomb of mud; in its own colours it may move."""
    bomb = (
        f'<circle cx="50" cy="50" r="40" fill="{paint}"/>'
        '<circle cx="30" cy="32" r="6" fill="#fff"/><path d="M70 12l12 -8l6 10z" fill="#888"/>'
    )
    assert is_exchanged(made(tmp_path, FACE, bomb)) == exchanged


def test_a_face_is_no_card(tmp_path: Path) -> None:
    eyes = '<circle cx="35" cy="40" r="5"/><circle cx="65" cy="40" r="5"/>'
    head = '<circle cx="50" cy="50" r="40" fill="#fc0"/>'
    tongue = '<path d="M30 62h40v6h-40z"/><path d="M44 68h14v14h-14z" fill="#e55"/>'
    assert not is_exchanged(made(tmp_path, FACE, head + eyes + tongue))


def test_spots_on_wings_make_no_face_of_a_card(tmp_path: Path) -> None:
    card = '<circle cx="50" cy="50" r="48" fill="{}"/>'
    wings = (
        '<path d="M48 20c-40-20-40 70 0 60z" fill="#c22"/>'
        '<path d="M52 20c40-20 40 70 0 60z" fill="#c22"/>'
        '<circle cx="35" cy="40" r="5"/><circle cx="65" cy="40" r="5"/>'
    )
    found = made(tmp_path, card.format("#dde") + wings, card.format("#fed") + CAR)
    whole = [box for box in boxes(found, 0.46) if np.ptp(box, axis=0).min() > 95]
    assert is_exchanged(found)
    assert len(whole) == 1


LETTER_A = '<path d="M8 92L44 8h12L92 92H76l-8-22H32l-8 22zM37 58h26L50 22z" fill-rule="evenodd"/>'
LETTER_O = (
    '<path d="M50 30a32 32 0 0 1 0 64a32 32 0 0 1 0-64zM50 44a18 18 0 0 0 0 36a18 18 0 0 0 0-36z"/>'
)
LOW_O = LETTER_O.replace("32 32", "29 32").replace("18 18", "14 18")


def test_areas_with_holes_that_are_unlike_are_exchanged(tmp_path: Path) -> None:
    assert is_exchanged(made(tmp_path, LETTER_A, LETTER_O))
    assert not is_exchanged(made(tmp_path, LOW_O, LETTER_O))
    eyelet = LETTER_A.replace("M37 58h26L50 22z", "M48 30h4v4h-4z")
    assert not is_exchanged(made(tmp_path, eyelet, '<path d="M10 30L90 40L30 90L50 50z"/>'))


@pytest.mark.parametrize("asked", [{"pairing": "loose"}, {"method": "arap"}, {"quads": 6}])
def test_who_asks_for_a_mesh_of_them_gets_one(tmp_path: Path, asked: dict[str, Any]) -> None:
    assert not is_exchanged(made(tmp_path, LETTER_A, LETTER_O, **asked))


def test_drawings_that_are_exchanged_have_meshes_to_look_at(tmp_path: Path) -> None:
    found = made(tmp_path, CAR, STAR)
    assert is_exchanged(found)
    assert "quads" in found.mesh_json()


def test_layers_of_light_on_a_body_do_not_make_drawings_alike(tmp_path: Path) -> None:
    body = '<path d="M12 70V40a20 20 0 0 1 34 -16l8 8l8 -8a20 20 0 0 1 26 16v30z" fill="{}"/>'
    star = '<path d="M50 20l10 25 30 5-25 15 5 28-20-16-20 16 5-28-25-15 30-5z" fill="{}"/>'
    legs = (
        '<path d="M20 70h8v26h-8z" fill="#123"/><path d="M72 70h8v26h-8z" fill="#123"/>'
        '<path d="M44 70h8v20h-8z" fill="#123"/><path d="M30 40h30v10h-30z" fill="#456"/>'
    )
    dots = (
        '<circle cx="14" cy="12" r="9"/><circle cx="86" cy="12" r="9"/>'
        '<path d="M40 45l10 20 10-20z" fill="#29c"/>'
    )
    paints = ("#c84", "#d95", "#e96", "#fa7", "#fb8")
    for count in (1, len(paints)):
        first, second = ("".join(map(own.format, paints[:count])) for own in (body, star))
        assert is_exchanged(made(tmp_path, first + legs, second + dots))


DRONE = (
    '<g fill="none" stroke="#000" stroke-width="6"><path d="M10 12h26M64 12h26M22 12v20M78 12v20"/>'
    '<path d="M14 32h72l-8 22H22z"/><path d="M36 54q14 22 28 0M30 70l-8 20M70 70l8 20"/></g>'
)
TOWER = (
    '<g fill="none" stroke="#000" stroke-width="6"><path d="M12 90V44L50 8L88 44V90"/>'
    '<path d="M40 90q10-40 20 0M30 30v12M70 30v12"/><circle cx="50" cy="44" r="6"/></g>'
)


def weight_and_size(found: Morph, t: float) -> tuple[float, float]:
    """Width of the thinnest stroke seen at one time, and the width of the first part."""
    (frame,) = found.movements[0].at(np.array([t]))
    seen = [s.style.stroke for s in frame.shapes if s.style.opacity > 0]
    width = min(stroke.width for stroke in seen if stroke is not None)
    return width, float(np.ptp(boxes(found, t)[0], axis=0)[0])


def test_line_drawings_thin_by_less_than_they_shrink(tmp_path: Path) -> None:
    found = made(tmp_path, DRONE, TOWER)
    assert is_exchanged(found)
    width, whole = weight_and_size(found, 0.0)
    now, size = weight_and_size(found, 0.36)
    assert now / width == pytest.approx((size / whole) ** 0.6, rel=1e-6)
    assert size / whole < 0.5


def test_areas_with_an_outline_shrink_as_areas(tmp_path: Path) -> None:
    outlined = CAR.replace('fill="#c22"', 'fill="#c22" stroke="#000" stroke-width="4"')
    found = made(tmp_path, outlined, STAR)
    assert is_exchanged(found)
    (width, whole), (now, size) = (weight_and_size(found, t) for t in (0.0, 0.36))
    assert now / width == pytest.approx(size / whole, rel=1e-6)


def wheel(middle: float, count: int, deep: float, tilt: float = 0.0) -> str:
    """A body with so many teeth."""
    angle = np.arange(2 * count) * np.pi / count + tilt
    radius = np.where(np.arange(2 * count) % 2, 30 - deep, 30.0)
    x, y = middle + radius * np.cos(angle), 50 + radius * np.sin(angle)
    return "M" + "L".join(f"{a:.3f} {b:.3f}" for a, b in zip(x, y, strict=True)) + "z"


def toothed(count: int, deep: float, more: str) -> str:
    return f'<path d="{wheel(50, count, deep)}" fill="#04c"/>{more}'


EARS = '<path d="M2 2h46v46z" fill="#04c"/><path d="M98 2h-46v46z" fill="#04c"/>'
FEET = '<path d="M2 98h46v-46h-46z" fill="#04c"/><path d="M76 98a22 22 0 1 0-1 0z" fill="#04c"/>'


def test_intricate_bodies_are_exchanged_where_plain_ones_move(tmp_path: Path) -> None:
    assert not is_exchanged(made(tmp_path, toothed(24, 0.2, EARS), toothed(3, 10, FEET)))
    assert is_exchanged(made(tmp_path, toothed(12, 14, EARS), toothed(7, 14, FEET)))
    # What stays as it is may be as intricate as it likes.
    assert not is_exchanged(made(tmp_path, toothed(12, 14, EARS), toothed(12, 14, FEET)))


class Waving:
    """A closed line of twelve sides that is round at both ends and has so deep teeth between."""

    counts, closed, areas = (24,), (True,), ()

    def __init__(self, deep: float) -> None:
        self.deep = deep

    def curves(self, t: Floats) -> Curves:
        angle = np.arange(24) * np.pi / 12
        teeth = np.where(np.arange(24) % 2, self.deep, 0.0)
        radius = 30 - 4 * (t * (1 - t))[:, None] * teeth
        points = 50 + radius[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        steps = np.linspace(0, 1, 4)[:, None]
        after = np.roll(points, -1, axis=1)
        return np.asarray(points[:, :, None] * (1 - steps) + after[:, :, None] * steps)

    def following(self, change: Change) -> CurveTrack:
        return change(self)


@pytest.mark.parametrize(("deep", "exchanged"), [(0.0, False), (12.0, True)])
def test_what_gets_wavy_on_its_way_is_exchanged(
    tmp_path: Path, deep: float, exchanged: bool
) -> None:
    made(tmp_path, toothed(24, 0.2, EARS), toothed(3, 10, FEET))
    scenes = []
    for name in "ab":
        drawing = read_svg((tmp_path / f"{name}.svg").read_bytes(), name)
        scenes.append(perceive(items_of(drawing.shapes, name)[0], np.array([[0, 0], [100, 100]])))
    a, b = scenes
    roles = assign(a, b)
    behind = behind_both(a, b, roles)
    tracks: dict[int, tuple[CurveTrack, ...]] = {
        k: (Waving(deep),) for k in range(len(roles.pairs))
    }
    assert not too_different(a, b, roles, behind)
    assert too_different(a, b, roles, behind, waviness(a, b, roles, tracks)) == exchanged


WALL = '<path d="M10 {y}h80v{h}h-80z{holes}" fill="#234"/><path d="M{x} 4h20v10z" fill="#234"/>'
WINDOWS = "M20 {0}v12h12v-12zM66 {0}v12h12v-12z"


@pytest.mark.parametrize(
    ("holes", "exchanged"), [("", False), ("M20 40v12h58v-12z", False), (WINDOWS, True)]
)
def test_an_area_with_several_holes_is_exchanged_for_an_unlike_one(
    tmp_path: Path, holes: str, exchanged: bool
) -> None:
    house = WALL.format(y=20, h=60, x=10, holes=holes.format(30))
    cart = (
        '<path d="M4 22L96 20L50 92zM36 30L64 30L50 60z" fill="#234"/>'
        '<path d="M70 90h10v8z" fill="#234"/><circle cx="20" cy="88" r="10" fill="#234"/>'
    )
    assert is_exchanged(made(tmp_path, house, cart)) == exchanged


def test_one_thing_is_exchanged_for_several_that_it_is_quite_unlike(tmp_path: Path) -> None:
    disc = '<circle cx="50" cy="50" r="24"/>'
    rays = "".join(
        f'<path d="M{48 + x} {46 + y}h4v8h-4z"/>'
        for x, y in ((0, 38), (0, -38), (38, 0), (-38, 0), (27, 27), (-27, -27))
    )
    moon = '<path d="M40 20a32 32 0 1 0 40 44a30 30 0 0 1 -40 -44z"/>'
    assert not is_exchanged(made(tmp_path, disc + rays, moon))
    star = f'<path d="{wheel(50, 5, 18)}"/>'
    rocket = (
        '<path d="M66 6C90 4 96 10 94 34L60 74L26 40z"/><path d="M22 44L8 60L30 70L34 56z"/>'
        '<path d="M44 72L42 90L56 96L60 78z"/><circle cx="14" cy="86" r="12"/>'
    )
    assert is_exchanged(made(tmp_path, rocket, star))


LINE = '<g fill="none" stroke="#000" stroke-width="2"><path d="{}"/></g>'
BOLT = "M58 10L24 58h24L42 90L78 44H52z"


def differ(first: str, second: str) -> float:
    """How little two drawings of a line each have in common."""
    scenes = []
    for k, line in enumerate((first, second)):
        page = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{LINE.format(line)}</svg>'
        items = items_of(read_svg(page.encode(), str(k)).shapes, str(k))[0]
        scenes.append(perceive(items, np.array([[0, 0], [100, 100]])))
    a, b = scenes
    roles = Roles((Role(0, 0, 0.0, "matched"),), (), (), (), ())
    return difference(a, b, roles, behind_both(a, b, roles))


def test_lines_are_as_alike_as_what_they_go_round() -> None:
    """Thin lines have no place in common, and are seen as one outline all the same."""
    assert differ(BOLT, "M60 6L20 56h26L40 94L82 40H54z") < 0
    # Drawn with a gap a bolt is a bolt, and an arc is no disc.
    assert differ(BOLT, "M60 6L20 56h26L40 94L82 40H54L58 13") < -0.4
    disc = "M90 50a40 40 0 1 1 -80 0a40 40 0 1 1 80 0z"
    assert differ(disc, "M90 50a40 40 0 1 1 -80 0") > 0.4
    # An open line is like what lies beside it, and unlike what does not.
    cloud = "M8 70V40A42 36 0 0 1 92 40V70"
    assert differ(cloud, "M14 78V46A36 26 0 0 1 86 42V62") < -0.3
    assert differ(cloud, "M8 70L92 66") > 0.3


def test_two_bars_become_a_tick(tmp_path: Path) -> None:
    """A bar fills all of its hull, and a tick hardly any: that says nothing."""
    bars = LINE.format("M10 10L90 90") + LINE.format("M90 10L10 90")
    assert not is_exchanged(made(tmp_path, bars, LINE.format("M10 55L38 85L90 15")))


HOUSE = '<path d="M50 8L96 50H82V92H60V64H40V92H18V50H4z"/>'
SHOP = (
    '<path d="M10 8h80v10h-80z"/>'
    '<path d="M14 24h72l8 30h-6v38h-10v-34h-14v34h-50v-38h-8zM24 60v22h26v-22z"/>'
)
TALLER = '<path d="M50 2L96 44H84V92H60V64H40V92H16V44H4z"/><path d="M70 8h10v12h-10z"/>'


def test_an_area_is_exchanged_that_nobody_could_say_how_it_becomes_another(tmp_path: Path) -> None:
    assert is_exchanged(made(tmp_path, HOUSE, SHOP))
    assert not is_exchanged(made(tmp_path, HOUSE, TALLER))


def test_what_has_holes_is_exchanged_for_an_area_it_has_no_likeness_with(tmp_path: Path) -> None:
    glass = (
        '<path fill-rule="evenodd" d="M10 4h80v12h-8q0 22 -24 34q24 12 24 34h8v12h-80v-12h8q0 -22 '
        "24 -34q-24 -12 -24 -34h-8zM30 16h40q0 16 -20 24q-20 -8 -20 -24zM50 60q20 8 20 24h-40q0 "
        '-16 20 -24z"/>'
    )
    skull = (
        '<path fill-rule="evenodd" d="M50 6c28 0 46 16 46 40c0 16 -10 24 -20 30v20h-12v-12h-8v12'
        "h-12v-12h-8v12h-12v-20c-10 -6 -20 -14 -20 -30c0 -24 18 -40 46 -40zM26 40v18h14v-18z"
        'M60 40v18h14v-18z"/>'
    )
    assert is_exchanged(made(tmp_path, glass, skull))
    other = skull.replace("M26 40v18h14v-18z", "M24 36v22h18v-22z")
    assert not is_exchanged(made(tmp_path, skull, other))


LINES = '<g fill="none" stroke="#000" stroke-width="6" stroke-linecap="round">{}</g>'
HAT = '<path d="M20 40h60v40h-60zM30 40c0-40 40-40 40 0"/><path d="M20 66h60"/>'


def test_a_straight_line_that_goes_elsewhere_is_no_reason_to_move(tmp_path: Path) -> None:
    """The bar of a hat is no bar of a list; but the handle of a magnifier is one of an x."""
    sorted_ = '<path d="M25 10v70l-15-15M25 80l15-15M50 12h40M50 30h30M50 48h20"/>'
    assert is_exchanged(made(tmp_path, LINES.format(HAT), LINES.format(sorted_)))


def test_bars_turn_into_bars_and_never_leave(tmp_path: Path) -> None:
    menu, cross = '<path d="M10 25h80M10 50h80M10 75h80"/>', '<path d="M25 25l50 50M75 25l-50 50"/>'
    assert not is_exchanged(made(tmp_path, LINES.format(menu), LINES.format(cross)))


def test_one_pair_that_tears_is_given_up_for_the_rest_to_move(tmp_path: Path) -> None:
    """A tray would become the cloud; it goes, the cloud comes, and the arrow stays an arrow."""
    scaled = '<g transform="scale(4)" stroke-width="2">{}</g>'
    tray = '<path d="M4 17v2a2 2 0 0 0 2 2h12a2 2 0 0 0 2-2v-2M7 11l5 5 5-5M12 4v12"/>'
    cloud = (
        '<path d="M19 18a3.5 3.5 0 0 0 0-7h-1a5 4.5 0 0 0-11-2a4.6 4.4 0 0 0-2.1 8.4"/>'
        '<path d="M12 13v9M9 19l3 3 3-3"/>'
    )
    one, other = (LINES.format(scaled.format(inner)) for inner in (tray, cloud))
    found = made(tmp_path, one, other)
    assert not is_exchanged(found)
    seen = [
        tuple(part.style(t).opacity > 0 for t in (0.0, 1.0))
        for part in found.prepared.movement.parts
    ]
    assert set(seen) == {(True, True), (True, False), (False, True)}
    assert seen.count((True, True)) == 2


@pytest.mark.parametrize(("paint", "exchanged"), [("#c40", False), ("#d41", False), ("#08a", True)])
def test_drawings_that_change_colour_are_exchanged_sooner(paint: str, exchanged: bool) -> None:
    body = toothed(24, 0.2, EARS).replace("#04c", "#c40", 1)
    other = toothed(3, 10, FEET).replace("#04c", "{0}", 1)
    a, b, painted = (
        perceive(
            items_of(read_svg(text.encode(), "x").shapes, "x")[0], np.array([[0, 0], [99, 99]])
        )
        for text in (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{inner}</svg>'
            for inner in (body, other.format("#c40"), other.format(paint))
        )
    )
    roles = assign(a, b)
    assert too_different(a, painted, roles, behind_both(a, painted, roles)) == exchanged


def test_a_bubble_drawn_in_lines_is_exchanged_for_an_area_as_its_area_would_be(
    tmp_path: Path,
) -> None:
    bubble = "M20 74C8 50 16 18 50 14C84 18 92 50 74 76C60 88 44 88 34 84L10 92z"
    line = f'<path d="{bubble}" fill="none" stroke="#000" stroke-width="8"/>'
    inner = '<path d="M40 40l8 8-4 6 6 6 6-4 8 8-8 6C40 66 36 54 36 44z"/>'
    blocks = (
        '<path fill-rule="evenodd" d="M50 8L70 28L62 36L70 44L92 50L72 72L62 64L50 92L28 70L36 60'
        'L8 52L30 30L38 38zM44 40v20l18-10z"/>'
    )
    assert is_exchanged(made(tmp_path, line + inner, blocks))
    same = line.replace("L10 92z", "L14 90z")
    assert not is_exchanged(made(tmp_path, line + inner, same))


def test_a_rounded_triangle_comes_apart_into_two_rounded_bars(tmp_path: Path) -> None:
    play = '<path d="M20 18v64a6 6 0 0 0 9 5l54-32a6 6 0 0 0 0-10l-54-32a6 6 0 0 0-9 5z"/>'
    bars = '<rect x="{}" y="14" width="26" height="72" rx="7"/>'
    found = made(tmp_path, play, bars.format(18) + bars.format(56))
    assert not is_exchanged(found)


def test_a_small_part_that_nobody_could_say_how_it_becomes_another_is_alone(tmp_path: Path) -> None:
    """A torn pair is worse than none."""
    body = '<rect x="2" y="2" width="96" height="96" rx="8" fill="#fc5"/>'
    curl = '<path d="M40 10L72 8L64 60Q56 20 40 10z" fill="#333"/>'
    hook = '<path d="M28 60Q50 94 70 64L66 92L28 94L36 80z" fill="#333"/>'
    first, second = body + curl, body + hook
    assert alone(made(tmp_path, first, second)) == 1
    assert alone(made(tmp_path, first, second, pairing="loose")) == 0
    assert alone(made(tmp_path, first, body + curl.replace("M40 10", "M38 14"))) == 0


def test_pieces_of_a_cloud_do_not_go_elsewhere_without_the_rest_of_it(tmp_path: Path) -> None:
    """Its largest piece is alone, so all are; without it, each goes to its like."""
    ground = '<circle cx="50" cy="50" r="48" fill="#06c"/>'
    side = '<circle cx="{}" cy="{}" r="9" fill="#fff"/>'
    piece = '<path d="M30 50h40v-24h-8v-12h-14l-8 16z" fill="#fff"/>'
    low = ground + side.format(30, 60) + side.format(70, 60)
    high = ground + side.format(32, 64) + side.format(68, 64)
    assert alone(made(tmp_path, low, high)) == 0
    assert alone(made(tmp_path, low + piece.replace("50h40", "62h40"), high)) == 3


def alone(found: Morph) -> int:
    """How many parts of the first drawing have no partner."""
    assert found.prepared.scene is not None
    return len(found.prepared.scene.roles.disappearing)


PEN = 'fill="none" stroke="#000" stroke-width="6" stroke-linecap="round" stroke-linejoin="round"'
SHEET = f'<path d="M28 10h30l16 16v64h-46z" {PEN}/><path d="M58 10v16h16" {PEN}/>'
WORDS = f'<path d="M38 50h24" {PEN}/><path d="M38 62h24" {PEN}/><path d="M38 74h16" {PEN}/>'


def test_what_would_be_small_and_elsewhere_does_not_keep_drawings_together(tmp_path: Path) -> None:
    """An angle's legs are like the fold of a sheet, at another place and much larger."""
    angle = f'<path d="M20 36v50h50" {PEN}/><path d="M20 62a24 24 0 0 1 24 24" {PEN}/>'
    assert is_exchanged(made(tmp_path, angle, SHEET))
    nearly = f'<path d="M50 8v24h24" {PEN}/><path d="M20 60h24" {PEN}/>'
    assert not is_exchanged(made(tmp_path, nearly, SHEET))


def test_a_closed_line_that_is_torn_open_keeps_nothing(tmp_path: Path) -> None:
    clip = f'<path d="M74 40l-36 36a14 14 0 0 1-20-20l40-40a22 22 0 0 1 30 30l-40 42" {PEN}/>'
    sheet = f'<rect x="20" y="10" width="56" height="80" rx="10" {PEN}/>'
    assert is_exchanged(made(tmp_path, sheet + WORDS, clip))


@pytest.mark.parametrize(("holes", "apart"), [(1, False), (2, True)])
def test_convex_areas_move_unless_several_holes_swim(
    tmp_path: Path, holes: int, apart: bool
) -> None:
    bar = "M70 8l22 22-62 62-22-22z" + ["M64 24l12 12-40 40-12-12z", ""][holes - 1]
    bar += "M60 26l6 6-34 34-6-6zM70 36l6 6-34 34-6-6z" * (holes - 1)
    box = "M8 8h84v84h-84z" + "M20 24h60v20h-60z" + "M20 56h60v20h-60z" * (holes - 1)
    one, other = (f'<path fill-rule="evenodd" d="{d}"/>' for d in (bar, box))
    assert is_exchanged(made(tmp_path, one, other)) is apart


LETTER = '<path fill-rule="evenodd" d="{}"/>'
EIGHT = "M10 10h60v80h-60zM24 24v20h32v-20zM24 56v20h32v-20z"
NINE = "M10 10h60v80h-60v-14h46v-18h-46zM24 24v20h32v-20z"
ZERO = "M10 10h60v80h-60zM24 24v52h32v-52z"
TABLE = "M10 10h60v80h-14v-30h-32v30h-14zM24 24v16h32v-16z"
SEVEN = "M10 10h60v14l-30 66h-16l30-66h-44z"


@pytest.mark.parametrize(
    ("first", "second", "exchanged"),
    [
        (ZERO, EIGHT, False),
        (EIGHT, SEVEN, True),
        (ZERO, "M10 10h60v14h-46v52h46v14h-60z", False),  # a hole opens into a bay
    ],
)
def test_letters_are_exchanged_that_would_be_torn(
    tmp_path: Path, first: str, second: str, exchanged: bool
) -> None:
    found = made(tmp_path, LETTER.format(first), LETTER.format(second))
    assert is_exchanged(found) == exchanged


@pytest.mark.parametrize(("first", "apart"), [(NINE, True), (TABLE, False)])
def test_what_would_be_a_blot_on_its_way_is_apart(first: str, apart: bool) -> None:
    """A nine's bay and its hole would close before a zero's hole opens."""
    ends = [
        items_of(
            read_svg(
                f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{text}</svg>'.encode(),
                "it",
            ).shapes,
            "it",
        )[0][0]
        for text in (LETTER.format(first), LETTER.format(ZERO))
    ]
    assert pierced_apart(*ends) == apart


def test_a_ring_that_would_be_torn_open_as_a_line_moves_as_an_area(tmp_path: Path) -> None:
    """A D becomes a P by its bowl; as lines its ring would be torn."""
    d = "M10 10h34a26 40 0 0 1 0 80h-34zM24 24v52h20a12 26 0 0 0 0-52z"
    p = "M10 10h36a24 24 0 0 1 0 48h-22v32h-14zM24 24v20h22a10 10 0 0 0 0-20z"
    found = made(tmp_path, LETTER.format(d), LETTER.format(p))
    assert not is_exchanged(found)
    assert not any(notice.kind == "stroke-outline" for notice in found.notices)
    ring = found.prepared.movement.parts[0].tracks[0]
    curves = ring.curves(np.array([0.0, 0.5, 1.0]))[:, : ring.counts[0]]
    turns = [total_turning(own) for own in curves]
    assert turns[1] < max(turns[0], turns[2]) + 0.3


@pytest.mark.parametrize("comes", [True, False])
@pytest.mark.parametrize(
    "sign",
    [
        "M20 48L30 38L44 52L72 24L82 34L44 72Z",  # a tick
        "M44 18H56V44H82V56H56V82H44V56H18V44H44Z",  # a plus
        "M24 46L74 24L56 76L48 54Z",  # an arrow
    ],
)
def test_a_sign_and_a_plate_that_it_is_cut_out_of_are_exchanged(
    tmp_path: Path, sign: str, comes: bool
) -> None:
    plate = "M50 6C74 6 94 26 94 50C94 74 74 94 50 94C26 94 6 74 6 50C6 26 26 6 50 6Z"
    ends = f'<path d="{sign}"/>', f'<path fill-rule="evenodd" d="{plate}{sign}"/>'
    found = made(tmp_path, *(ends if comes else ends[::-1]))
    assert is_exchanged(found)
    # At no time is a part of the sign inside of the plate's edge and another part outside.
    for t in np.linspace(0, 1, 33):
        assert len(boxes(found, t)) <= 1


SIGNS = (
    '<path d="M40 40l20 20M35 62v-20M50 36c10 0 10 8 14 8M42 64h18M62 56v-16"/>',
    '<path d="M36 44c4-9 12-9 14-9"/><circle cx="50" cy="50" r="6"/>'
    '<circle cx="62" cy="60" r="4"/><circle cx="40" cy="60" r="4"/>',
)
CORNERS = '<path d="M2 2l4 4"/>', '<circle cx="95" cy="96" r="3"/>'


@pytest.mark.parametrize(
    ("deep", "corners", "lines", "exchanged"),
    [
        (10, ("", ""), True, False),
        (10, CORNERS, True, True),
        (12, ("", ""), True, True),
        (10, ("", ""), False, True),
    ],
)
def test_lines_round_most_of_both_drawings_move_though_all_within_is_exchanged(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    deep: float,
    corners: tuple[str, str],
    lines: bool,
    exchanged: bool,
) -> None:
    """With something in the corners the line is less of what is seen; with deep teeth unlike.

    Were they areas, those would be bare half-way.
    """
    if not lines:
        monkeypatch.setattr("shapetween.scene.exchange.in_lines", lambda *_: False)
    wheels = wheel(50, 12, deep), wheel(50, 3, 16)
    first, second = (
        f'<g fill="none" stroke="#000" stroke-width="3"><path d="{body}"/>{inner}{corner}</g>'
        for body, inner, corner in zip(wheels, SIGNS, corners, strict=True)
    )
    assert is_exchanged(made(tmp_path, first, second)) is exchanged
