"""What has no partner is seen whole or not at all: it grows, or is drawn, and is no ghost."""

from pathlib import Path

import numpy as np
import pytest
import shapely

import shapetween as st
from shapetween.base.arrays import Floats
from shapetween.base.ends import End
from shapetween.geometry.bezier import signed_area
from shapetween.model.drawing import Shape
from shapetween.model.paint import Colour, Stroke, Style
from shapetween.model.part import Part
from shapetween.scene.asked import Change
from shapetween.scene.items import Item
from shapetween.scene.unmatched.going import Going
from shapetween.scene.unmatched.part import unmatched_part
from shapetween.scene.unmatched.presence import BOTH, Leaving
from tests.scene.strokes import polyline
from tests.scene.test_faults import drawn, seen

ICON = 'fill="none" stroke="#000" stroke-width="2" stroke-linecap="round" stroke-linejoin="round"'
RING = '<circle cx="12" cy="12" r="10"/>'
PLUS = '<path d="M12 8v8"/><path d="M8 12h8"/>'
FACE = '<circle cx="12" cy="12" r="10" fill="#fc3"/>'
EYES = '<circle cx="8" cy="10" r="2"/><circle cx="16" cy="10" r="2"/>'
CLOUD = '<path d="M3 5h18v6h-18z"/>'


def svg(tmp_path: Path, name: str, inner: str, style: str = "") -> Path:
    file = tmp_path / f"{name}.svg"
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><g {style}>{inner}</g></svg>'
    )
    return file


def morph(
    tmp_path: Path, first: str, second: str, style: str = "", change: Change | None = None
) -> st.Morph:
    one, other = svg(tmp_path, "a", first, style), svg(tmp_path, "b", second, style)
    return st.morph(one, other, change=change)


def lone(found: st.Morph, *, arrives: bool) -> list[Part]:
    """Parts that are there at one end only."""
    gone = 0.0 if arrives else 1.0
    return [
        p
        for p in found.prepared.movement.parts
        if p.style(gone).opacity == 0 and p.style(1 - gone).opacity > 0
    ]


def opacities(part: Part, times: Floats) -> Floats:
    return np.array([part.style(float(t)).opacity for t in times])


def box(part: Part, t: float) -> Floats:
    points = part.curves(np.array([t]))[0].reshape(-1, 2)
    return np.stack([points.min(axis=0), points.max(axis=0)])


@pytest.mark.parametrize(
    ("first", "second", "style"),
    [
        (FACE, FACE + EYES, ""),
        (FACE + EYES, FACE, ""),
        (RING, RING + PLUS, ICON),
        (CLOUD, CLOUD + '<path d="M5 13h2v6h-2z"/><path d="M14 13h2v6h-2z"/>', ""),
    ],
)
def test_nothing_is_seen_through(tmp_path: Path, first: str, second: str, style: str) -> None:
    """Hardly at any time is anything half seen, which is there at one end only."""
    found = morph(tmp_path, first, second, style)
    parts = lone(found, arrives=True) + lone(found, arrives=False)
    assert len(parts) == 2
    for part in parts:
        seen = opacities(part, np.linspace(0, 1, 401))
        assert ((seen > 0) & (seen < 1)).mean() < 0.03


def test_eyes_open_about_their_own_middles_at_one_moment(tmp_path: Path) -> None:
    eyes = lone(morph(tmp_path, FACE, FACE + EYES), arrives=True)
    boxes = np.array([[box(eye, t) for t in (0.45, 0.6, 0.8, 1.0)] for eye in eyes])
    middles = boxes.mean(axis=2)
    np.testing.assert_allclose(middles, np.tile([[[8, 10]], [[16, 10]]], (1, 4, 1)), atol=1e-3)
    sizes = np.ptp(boxes, axis=2)
    np.testing.assert_allclose(sizes[0], sizes[1], rtol=1e-6)
    assert sizes[0, 0, 0] > 0.15 * 4  # no speck, but soon after it comes a thing to be seen
    assert (np.diff(sizes[0, :, 0]) > 0).all()


def test_a_sign_of_lines_grows_as_one_and_keeps_its_weight(tmp_path: Path) -> None:
    """Only what is not yet half as large has thinner strokes, or it would be a blot."""
    parts = lone(morph(tmp_path, RING, RING + PLUS, ICON), arrives=True)
    for t, weight in ((0.15, 1.3), (0.4, 2.0), (0.8, 2.0)):
        widths = {round(p.style(t).stroke.width, 6) for p in parts}  # type: ignore[union-attr]
        lengths = {round(float(np.ptp(box(p, t), axis=0).max()), 6) for p in parts}
        assert len(widths) == len(lengths) == 1
        assert 0.2 * 8 < lengths.pop() < 8
        assert widths.pop() == pytest.approx(weight, rel=0.2)
    for part in parts:
        np.testing.assert_allclose(box(part, 0.5).mean(axis=0), [12, 12], atol=1e-6)


def test_the_outline_of_what_stays_gets_thin(tmp_path: Path) -> None:
    style = 'fill="none" stroke="#840" stroke-width="2"'
    rim = f'<circle cx="12" cy="12" r="10" {style}/>'
    (part,) = lone(morph(tmp_path, FACE, FACE + rim), arrives=True)
    widths = [part.style(t).stroke.width for t in (0.45, 0.6, 0.8, 1.0)]  # type: ignore[union-attr]
    assert 0.2 < widths[0] < widths[1] < widths[2] < widths[3] == 2
    assert set(opacities(part, np.linspace(0, 1, 21)).tolist()) == {0.0, 1.0}
    # A line along a part of it is drawn.
    roof = f'<path d="M4.93 4.93a10 10 0 0 1 14.14 0" {style}/>'
    (part,) = lone(morph(tmp_path, FACE, FACE + roof), arrives=True)
    assert part.style(0.7).opacity == 1
    assert np.ptp(box(part, 0.7), axis=0)[0] < 0.95 * np.ptp(box(part, 1.0), axis=0)[0]


def test_what_stands_at_an_edge_grows_out_of_it(tmp_path: Path) -> None:
    """An ear has its foot on the head all the time."""
    head = '<path d="M4 10h16v12h-16z" fill="#fc3"/>'
    ear = '<path d="M5 11v-7l5 7z" fill="#840"/>'
    (part,) = lone(morph(tmp_path, head, head + ear), arrives=True)
    for t in (0.45, 0.55, 0.7, 0.9):
        low, high = box(part, t)
        assert high[1] >= 10 - 1e-6
        assert 5 <= low[0] <= high[0] <= 10


def test_what_stands_at_the_border_it_lies_in_grows_out_of_that(tmp_path: Path) -> None:
    """A door has its foot on the ground all the time, a window its middle where it is."""
    house = '<path d="M2 4h20v18h-20z" fill="#fc3"/>'
    door = '<path d="M5 14h4v8h-4z" fill="#840"/><path d="M13 8h5v5h-5z" fill="#840"/>'
    parts = lone(morph(tmp_path, house, house + door), arrives=True)
    for t in (0.5, 0.7):
        boxes = sorted((box(part, t) for part in parts), key=lambda b: float(b[0, 0]))
        np.testing.assert_allclose(boxes[0][1, 1], 22, atol=0.01)
        np.testing.assert_allclose(boxes[1].mean(axis=0), [15.5, 10.5], atol=1e-6)


def test_rays_that_are_boxes_grow_out_of_their_inner_ends(tmp_path: Path) -> None:
    turns = range(0, 360, 45)
    box_ = '<path transform="rotate({} 12 12)" d="M11.4 1h1.2v4h-1.2z"/>'
    rays = "".join(box_.format(k) for k in turns)
    sun = '<path d="M8 8h8v8h-8z"/><circle cx="12" cy="12" r="1" fill="#fff"/>'
    sun = f'<circle cx="12" cy="12" r="5"/>{sun}'
    parts = lone(morph(tmp_path, sun, sun + rays), arrives=True)
    assert len(parts) == 8
    for part in parts:
        for t in (0.5, 0.7):
            points = part.curves(np.array([t]))[0].reshape(-1, 2) - 12
            assert np.hypot(*points.T).min() == pytest.approx(7, abs=0.05)


def test_a_slash_between_what_it_parts_takes_its_time(tmp_path: Path) -> None:
    halves = '<path d="M6 2h14v14z"/><path d="M2 6l14 14h-14z"/>'
    slash = f'<path d="M2 2 22 22" {ICON}/>'
    (part,) = lone(morph(tmp_path, halves, halves + slash), arrives=True)
    lengths = [float(np.ptp(box(part, t), axis=0).max()) for t in (0.3, 0.5, 0.7, 0.9)]
    assert part.style(0.3).opacity == 1
    assert (np.diff(lengths) > 3).all()


def test_a_gap_opens_before_what_grows_in_it(tmp_path: Path) -> None:
    whole = '<path d="M2 12h20"/>'
    cut = '<path d="M2 12h5"/><path d="M17 12h5"/><circle cx="12" cy="12" r="2"/>'
    found = morph(tmp_path, whole, cut, ICON)
    for t in np.linspace(0, 1, 41):
        (frame,) = found.prepared.movement.at(np.array([t]))
        pieces = [shape for shape in frame.shapes if shape.style.opacity > 0.05]
        sign = [s for s in pieces if np.abs(ends_of(s) - 12).max() < 2.01]
        lines = [s for s in pieces if all(s is not other for other in sign)]
        if sign and t > 0.45:
            both = (shapely.union_all([seen(s) for s in some]) for some in (sign, lines))
            assert shapely.distance(*both) > 0.2


def ends_of(shape: Shape) -> Floats:
    return np.concatenate([ring.curves.reshape(-1, 2) for ring in shape.rings])


def test_what_hangs_on_a_line_that_comes_is_drawn_after_it(tmp_path: Path) -> None:
    """A lamp's stem comes out of its shade, and the foot out of the stem."""
    shade = '<path d="M6 3h12v7h-12z"/>'
    stem = '<path d="M12 20V10"/><path d="M8 20h8"/>'
    parts = lone(morph(tmp_path, shade, shade + stem, ICON), arrives=True)
    upright = next(p for p in parts if np.ptp(box(p, 1.0)[:, 1]) > 5)
    foot = next(p for p in parts if p is not upright)
    assert box(upright, 0.5)[0, 1] == pytest.approx(10, abs=1e-6)
    starts = [np.flatnonzero(opacities(p, np.linspace(0, 1, 101)) > 0)[0] for p in (upright, foot)]
    assert starts[0] < starts[1] - 5
    np.testing.assert_allclose(box(foot, 0.8).mean(axis=0)[0], 12, atol=0.1)


def test_what_disappears_is_early_what_appears_late_and_the_middle_is_not_empty(
    tmp_path: Path,
) -> None:
    brows = '<path d="M6 6h4v1h-4z"/><path d="M14 6h4v1h-4z"/>'
    lid = '<path d="M6 6h12v2h-12z"/>'
    found = morph(tmp_path, FACE + EYES + brows, FACE + EYES + lid)
    away, new = lone(found, arrives=False), lone(found, arrives=True)
    assert len(away) + len(new) > 1
    assert all(p.style(0.55).opacity == 0 for p in away)
    assert all(p.style(0.35).opacity == 0 for p in new)
    for t in np.linspace(0, 1, 21):
        assert any(p.style(float(t)).opacity == 1 for p in away + new)


def test_what_is_nowhere_near_what_goes_does_not_jump_in_half_way(tmp_path: Path) -> None:
    """Brows go and a mouth comes: it is on its way when they are half as large."""
    mouth = '<path d="M7 15h10v3h-10z"/>'
    brows = '<path d="M6 6h4v1h-4z"/><path d="M14 6h4v1h-4z"/>'
    (new,) = lone(morph(tmp_path, FACE + EYES + brows, FACE + EYES + mouth), arrives=True)
    assert new.style(0.25).opacity == 0 < new.style(0.35).opacity
    sizes = np.array([0.0] + [float(np.ptp(box(new, t)[:, 0])) for t in (0.375, 0.5, 0.625)])
    assert np.diff(sizes).max() < 0.5 * 10
    assert sizes[2] > 0.6 * 10


def test_where_nothing_stays_one_gives_way_to_the_other_as_a_whole(tmp_path: Path) -> None:
    """Bars shrink to nothing before a disc grows; no frame half-way is blank."""
    bars = '<path d="M4 20v-8"/><path d="M12 20v-16"/><path d="M20 20v-12"/>'
    target = '<circle cx="12" cy="12" r="10"/><circle cx="12" cy="12" r="5"/>'
    frames = morph(tmp_path, bars, target, ICON).prepared.movement.at(np.linspace(0, 1, 41))
    areas = np.array([drawn(frame).area for frame in frames])
    least = int(areas.argmin())
    assert 16 < least < 20
    assert (np.diff(areas[: least + 1]) < 0).all()
    assert (np.diff(areas[least:]) > 0).all()
    assert areas[20] > 0.05 * areas[-1]


def test_shade_melts_into_what_it_lies_on_and_shapes_do_not(tmp_path: Path) -> None:
    shade = '<path d="M12 2a10 10 0 0 1 0 20a12 12 0 0 0 0-20z" fill="#f5bd2c"/>'
    (part,) = lone(morph(tmp_path, FACE, FACE + shade), arrives=True)
    np.testing.assert_allclose(box(part, 0.6), box(part, 1.0), atol=1e-6)
    assert 0 < part.style(0.7).opacity < 1
    # A disc in a ring's hole has the ring's colour, but lies on nothing.
    pin = '<path fill-rule="evenodd" d="M2 2h20v20h-20zM6 6v12h12v-12z"/>'
    (disc,) = lone(morph(tmp_path, pin, pin + '<circle cx="12" cy="12" r="3"/>'), arrives=True)
    assert disc.style(0.7).opacity == 1


@pytest.mark.parametrize(("radius", "melts"), [(6, True), (3.4, False)])
def test_a_ground_that_others_stay_on_melts_and_a_small_one_shrinks(
    tmp_path: Path, radius: float, melts: bool
) -> None:
    """An ape's muzzle would grow as a lump below its nostrils; the white of an eye is a ghost."""
    nose = '<circle cx="12" cy="13" r="1.5" fill="#222"/>'
    muzzle = f'<circle cx="12" cy="13" r="{radius}" fill="#a33"/>'
    (part,) = lone(morph(tmp_path, FACE + nose, FACE + muzzle + nose), arrives=True)
    assert (0 < part.style(0.7).opacity < 1) == melts


def test_a_mask_comes_in_from_the_edge_and_does_not_melt(tmp_path: Path) -> None:
    """Half dark over half bright, all along the edge of a head, is mud half-way."""
    mouth = '<circle cx="12" cy="17" r="1.5" fill="#822"/>'
    mask = '<path d="M2 13h20a10 10 0 0 1-20 0z" fill="#333"/>'
    (part,) = lone(morph(tmp_path, FACE + mouth, FACE + mask + mouth), arrives=True)
    assert part.style(0.7).opacity == 1
    assert np.ptp(box(part, 0.7)[:, 0]) < np.ptp(box(part, 1.0)[:, 0])


def test_rays_keep_to_what_they_surround_all_alike(tmp_path: Path) -> None:
    turns = range(0, 360, 45)
    rays = "".join(f'<path transform="rotate({k} 12 12)" d="M12 2v3"/>' for k in turns)
    sun = '<circle cx="12" cy="12" r="4"/>'
    parts = lone(morph(tmp_path, sun, sun + rays, ICON), arrives=True)
    assert len(parts) == 8
    for t in (0.5, 0.7):
        points = [p.curves(np.array([t]))[0].reshape(-1, 2) - 12 for p in parts]
        radii = np.array([np.hypot(*p.T) for p in points])
        np.testing.assert_allclose(radii.min(axis=1), 7, atol=1e-3)
        assert np.ptp(radii.max(axis=1)) < 1e-3


def test_equal_things_of_a_list_do_not_carry_each_other(tmp_path: Path) -> None:
    """The third mark of a list goes to where its arrow is; the others go where they stand."""
    marks = "".join(f'<path d="M2 {y}h5v5h-5z"/>' for y in (2, 9, 16))
    parts = lone(morph(tmp_path, marks, '<path d="M15 15h7v6h-7z"/>'), arrives=False)
    assert len(parts) == 2
    for part in parts:
        for t in (0.2, 0.4):
            np.testing.assert_allclose(box(part, t).mean(axis=0), box(part, 0).mean(axis=0))


def test_a_line_opens_as_the_slash_passes(tmp_path: Path) -> None:
    """The first gap is open and the second one still closed while the tip is between them."""
    bars = '<path d="M2 6h20"/><path d="M2 18h20"/>'
    cut = '<path d="M2 6h2"/><path d="M8 6h14"/><path d="M2 18h14"/><path d="M20 18h2"/>'
    slash = '<path d="M2 2 22 22"/>'
    found = morph(tmp_path, bars, cut + slash, ICON)
    tip = next(p for p in lone(found, arrives=True) if np.ptp(box(p, 1.0), axis=0).min() > 10)
    for frame, t in zip(
        found.prepared.movement.at(np.linspace(0, 1, 101)), np.linspace(0, 1, 101), strict=True
    ):
        others = [s for s in frame.shapes if not is_slash(s)]
        whole = shapely.union_all([seen(s) for s in others if s.style.opacity > 0.05])
        reached = float(box(tip, float(t))[1, 1]) if tip.style(float(t)).opacity > 0 else 0.0
        for y in (6.0, 18.0):
            closed = whole.intersects(shapely.Point(y, y))
            assert closed or reached > y - 4  # nothing is cut open for no reason
            assert not closed or reached < y + 4
            beside = [whole.intersects(shapely.Point(y + way, y)) for way in (-0.8, 0.8)]
            assert all(beside) or reached > y - 5
            assert not any(beside) or reached < y + 5
    backwards = morph(tmp_path, cut + slash, bars, ICON)
    there, back = (
        shapely.union_all([seen(s) for s in m.prepared.movement.at(np.array([t]))[0].shapes])
        for m, t in ((found, 1.0), (backwards, 0.0))
    )
    assert there.symmetric_difference(back).area < 1e-6
    (late,) = backwards.prepared.movement.at(np.array([0.97]))
    assert drawn(late).intersects(shapely.Point(18, 18))


def is_slash(shape: Shape) -> bool:
    points = np.concatenate([ring.curves.reshape(-1, 2) for ring in shape.rings])
    return bool(np.ptp(points[:, 1]) > 0.5)


def test_a_gap_opens_before_a_tick_is_drawn_in_it(tmp_path: Path) -> None:
    """Only a slash cuts it open with its tip; a tick would be drawn over what is to go."""
    ring = '<path d="M4 4h16v16h-16z"/>'
    ticked = '<path d="M12 20H4V4h16v8"/><path d="M15 19l2 2 5-5"/>'
    found = morph(tmp_path, ring, ticked, ICON)
    (tick,) = lone(found, arrives=True)
    gap = shapely.LineString([(15, 20), (20, 20), (20, 15)]).buffer(0.5)
    others = [part for part in found.prepared.movement.parts if part is not tick]
    for t in np.linspace(0, 1, 33).tolist():
        if tick.style(t).opacity > 0 and np.ptp(box(tick, t), axis=0).max() > 2:
            ways = [p.curves(np.array([t]))[0] for p in others if p.style(t).opacity > 0]
            points = shapely.points(np.concatenate(ways)[:, 0])
            assert not shapely.intersects(gap, points).any()


def test_a_gap_opens_into_what_is_left_of_its_line(tmp_path: Path) -> None:
    """Of a lock's shackle the end goes up, and nothing stays on the body."""
    body = '<path d="M4 11h16v10h-16z"/>'
    shut, open_ = '<path d="M7 11V5H17V11"/>', '<path d="M7 11V5H17V7"/>'
    (part,) = lone(morph(tmp_path, body + shut, body + open_, ICON), arrives=False)
    for t in (0.1, 0.2, 0.3):
        assert box(part, t)[0, 1] == pytest.approx(7, abs=1e-6)


@pytest.mark.parametrize("change", ["fade", "draw", "grow", "slide"])
def test_what_is_asked_for_is_done(tmp_path: Path, change: Change) -> None:
    dot = '<circle cx="12" cy="12" r="3"/>'
    found = morph(tmp_path, RING, RING + '<path d="M7 12h8"/>', ICON, change)
    (part,) = lone(found, arrives=True)
    half, whole = box(part, 0.7), box(part, 1.0)
    length = float(np.ptp(half, axis=0).max()) / 8
    if change == "fade":
        np.testing.assert_allclose(half, whole)
        assert 0.1 < part.style(0.7).opacity < 0.9
        return
    assert part.style(0.7).opacity == 1
    assert 0.1 < length < 0.99
    width = part.style(0.2).stroke.width  # type: ignore[union-attr]
    assert (width < 2) == (change != "draw")
    middle = half.mean(axis=0)
    if change == "grow":
        np.testing.assert_allclose(middle, [11, 12], atol=1e-6)
    if change == "slide":
        assert 11 < middle[0] < 12
    # What is no line grows where it is to be drawn.
    (disc,) = lone(morph(tmp_path, FACE, FACE + dot, "", change), arrives=True)
    assert box(disc, 0.7)[1, 0] < 15 - 1e-3


def test_one_closed_line_becomes_two_by_a_seam_drawn_across(tmp_path: Path) -> None:
    """From play to pause no gap is seen in any outline but the seam's own, and that closes soon."""
    play = '<path d="M5 3v18l15-9z"/>'
    pause = '<rect x="4" y="3" width="5" height="18"/><rect x="14" y="3" width="5" height="18"/>'
    there, back = morph(tmp_path, play, pause, ICON), morph(tmp_path, pause, play, ICON)
    times = np.linspace(0, 1, 41)
    for found, order in ((there, times), (back, times[::-1])):
        for t, frame in zip(times, found.prepared.movement.at(order), strict=True):
            whole = drawn(frame)
            shapes = [whole] if whole.geom_type == "Polygon" else list(whole.geoms)
            holes = [shapely.Polygon(hole) for shape in shapes for hole in shape.interiors]
            cells = sum(hole.area > 12 for hole in holes)  # a slit between two seams is none
            assert 1 <= cells <= 2
            assert cells == 2 or t < 0.45
            assert len(shapes) == 1 or t > 0.4
    (first,) = there.prepared.movement.at(np.array([0.0]))
    whole = shapely.LinearRing([(5, 3), (5, 21), (20, 12)]).buffer(1)
    assert drawn(first).symmetric_difference(whole).area < 0.02 * whole.area


def test_a_menus_middle_bar_goes_to_its_middle_and_soon(tmp_path: Path) -> None:
    menu = '<path d="M4 5h16"/><path d="M4 12h16"/><path d="M4 19h16"/>'
    cross = '<path d="M18 6 6 18"/><path d="m6 6 12 12"/>'
    found = lone(morph(tmp_path, menu, cross, ICON), arrives=False)
    (bar,) = (part for part in found if part.only is not None)
    for t in (0.1, 0.3, 0.4):
        np.testing.assert_allclose(box(bar, t).mean(axis=0), [12, 12], atol=1e-6)
    assert bar.style(0.5).opacity == 0


@pytest.mark.parametrize("painted", [False, True])
def test_a_ring_as_an_area_and_one_as_a_line_become_each_other_as_areas(
    tmp_path: Path, painted: bool
) -> None:
    """A speech bubble's wall goes to a frame's without paling."""
    bubble = (
        '<path fill-rule="evenodd" d="M12 2c12 0 12 16 0 16l-6 4v-5c-7-4-5-15 6-15z'
        'M12 4c8 0 8 12 0 12l-3 2v-2c-5-4-5-12 3-12z"/>'
    )
    frame = '<path fill="none" stroke="#000" stroke-width="2" d="M3 4h18v16h-18z"/>'
    if painted:
        frame = '<path fill-rule="evenodd" d="M2 3h20v18h-20zM4 5v14h16v-14z"/>'
        frame += '<path d="M7 9h10v2h-10z"/>'
    ends = svg(tmp_path, "a", bubble), svg(tmp_path, "b", frame)
    (wall,) = (
        part
        for part in st.morph(*ends, pairing="loose").prepared.movement.parts
        if part.only is None and part.style(0.0).opacity == 1
    )
    for t in np.linspace(0, 1, 9):
        style = wall.style(float(t))
        assert isinstance(style.fill, Colour)
        assert style.fill.alpha == 1
        assert style.stroke is None
    assert len(wall.rings) == 2


def test_what_passes_another_is_seen_through_for_a_moment_only(tmp_path: Path) -> None:
    red, blue = (
        '<circle cx="9" cy="12" r="7" fill="#f00"/>',
        '<path d="M9 5h13v14h-13z" fill="#00f"/>',
    )
    parts = morph(tmp_path, red + blue, blue + red).prepared.movement.parts
    copies = [p for p in parts if p.style(0.0).opacity != p.style(1.0).opacity]
    assert len(copies) == 1
    for t in (0.1, 0.3, 0.43, 0.57, 0.8):
        assert copies[0].style(t).opacity in (0.0, 1.0)
    assert 0.1 < copies[0].style(0.5).opacity < 0.9


@pytest.mark.parametrize(("line", "even"), [("M4 12h16", True), ("M4 8l16 8", False)])
def test_a_line_between_two_that_stay_is_drawn_as_one(
    tmp_path: Path, line: str, even: bool
) -> None:
    """Drawn from both, its halves would meet in a seam; and it is never a mere dot.

    On the mirror axis of all it comes from its middle, and else from one end.
    """
    posts = '<path d="M4 2v20"/><path d="M20 2v20"/>'
    (rail,) = lone(morph(tmp_path, posts, f'{posts}<path d="{line}"/>', ICON), arrives=True)
    assert len(rail.rings) == 1
    for t in (0.45, 0.6, 0.8):
        low, high = box(rail, t)
        assert low[0] == pytest.approx(24 - high[0] if even else 4)
        assert 0.14 * 16 < high[0] - low[0] < 16
    assert set(opacities(rail, np.linspace(0, 1, 101)).tolist()) == {0.0, 1.0}


def test_what_comes_does_not_wait_where_nothing_goes(tmp_path: Path) -> None:
    eye, _ = lone(morph(tmp_path, FACE, FACE + EYES), arrives=True)
    assert eye.style(0.2).opacity == 1
    went = FACE + '<path d="M10 16h4v2h-4z"/>'
    found = morph(tmp_path, went, FACE + EYES)
    assert all(part.style(0.2).opacity == 0 for part in lone(found, arrives=True))


def test_a_mouth_goes_to_its_middle_and_a_tick_to_where_one_begins_it(tmp_path: Path) -> None:
    style = 'fill="none" stroke="#000" stroke-width="2"'
    mouth = f'<path d="M8 15c2 2 6 2 8 0" {style}/>'
    (part,) = lone(morph(tmp_path, FACE + mouth, FACE), arrives=False)
    assert box(part, 0.3).mean(axis=0)[0] == pytest.approx(12, abs=0.05)
    tick = f'<path d="M7 12l3 3 7-7" {style}/>'
    (part,) = lone(morph(tmp_path, FACE + tick, FACE), arrives=False)
    assert box(part, 0.3)[0, 0] == pytest.approx(7, abs=0.05)


def test_a_part_beside_one_that_is_wider_at_first_keeps_its_gap(tmp_path: Path) -> None:
    head, body = (
        '<circle cx="12" cy="7" r="4"/>',
        '<rect x="4" y="13" width="16" height="8" rx="3"/>',
    )
    both = (
        '<circle cx="8" cy="8" r="3"/><rect x="2" y="13" width="12" height="7" rx="3"/>'
        '<path d="M15 13h5q2 0 2 2v2q0 2 -2 2h-5z"/>'
    )
    for arrives in (True, False):
        ends = (head + body, both) if arrives else (both, head + body)
        found = morph(tmp_path, *ends)
        (part,) = lone(found, arrives=arrives)
        for t in (0.3, 0.5, 0.7, 0.9):
            at = np.array([t if arrives else 1 - t])
            own = shapely.Polygon(part.curves(at)[0, :, 0])
            others = [p for p in found.prepared.movement.parts if p is not part]
            points = np.concatenate([p.curves(at)[0, :, 0] for p in others])
            assert own.distance(shapely.MultiPoint(points)) > 0.3


def test_a_fill_that_becomes_an_outline_of_its_colour_is_never_grey(tmp_path: Path) -> None:
    solid = '<path d="M4 3h16l-2 18H6z"/>'
    hollow = '<path d="M5 5h14l-2 15H7z" fill="none" stroke="#000" stroke-width="2"/>'
    found = morph(tmp_path, solid, hollow)
    (part,) = found.prepared.movement.parts
    for t in np.linspace(0, 1, 9).tolist():
        style = part.style(t)
        assert isinstance(style.fill, Colour)
        assert (style.fill.red, style.fill.alpha, style.opacity) == (0, 1, 1)
        assert style.stroke is None
    areas = [signed_area(ring.curves) for ring in found.at(1.0).shapes[0].rings]
    assert len(areas) == 2
    assert areas[0] * areas[1] < 0


def test_a_ring_is_drawn_round_what_stays_from_its_head_down(tmp_path: Path) -> None:
    """At its own size and weight, evenly on both sides; round a dot it grows from that."""
    bar = '<path d="M{} 12h{}"/>'
    ring = '<circle cx="12" cy="12" r="9"/>'
    (drawn_round,) = lone(
        morph(tmp_path, bar.format(7, 10), bar.format(7, 10) + ring, ICON), arrives=True
    )
    (grown,) = lone(
        morph(tmp_path, bar.format(11.5, 1), bar.format(11.5, 1) + ring, ICON), arrives=True
    )
    times = [t for t in np.linspace(0, 1, 33).tolist() if drawn_round.style(t).opacity > 0]
    ends = []
    for t in times:
        points = drawn_round.curves(np.array([t]))[0][:, [0, 3]].reshape(-1, 2)
        assert np.hypot(*(points - 12).T) == pytest.approx(9, abs=0.01)
        assert points[:, 1].min() == pytest.approx(3, abs=0.3)
        assert points[:, 0].mean() == pytest.approx(12, abs=0.05)
        stroke = drawn_round.style(t).stroke
        assert stroke is not None
        assert stroke.width == 2
        ends.append(points[:, 1].max())
    assert ends[0] < 4
    assert ends[-1] == pytest.approx(21)
    assert (np.diff(ends) > -1e-9).all()
    assert np.ptp(grown.curves(np.array([0.3]))[0][:, :, 0]) < 9


def test_a_ring_waits_until_there_is_room_in_it(tmp_path: Path) -> None:
    """A check that shrinks into it would be cut by it."""
    check, small = '<path d="M2 12l7 7 14-14"/>', '<path d="M9 12l2 2 4-4"/>'
    ring = '<circle cx="12" cy="12" r="9"/>'
    found = morph(tmp_path, check, ring + small, ICON)
    (comes,) = lone(found, arrives=True)
    back = morph(tmp_path, ring + small, check, ICON)
    (goes,) = lone(back, arrives=False)
    (stays,) = (p for p in found.prepared.movement.parts if p is not comes)
    for t in np.linspace(0, 1, 33).tolist():
        assert (comes.style(t).opacity > 0) == (goes.style(1 - t).opacity > 0)
        if comes.style(t).opacity > 0:
            points = stays.curves(np.array([t]))[0].reshape(-1, 2)
            assert np.hypot(*(points - 12).T).max() < 9 - 1
    assert comes.style(0.7).opacity > 0


def test_a_line_waits_until_what_is_in_its_place_has_moved(tmp_path: Path) -> None:
    """Links come apart before a slash is drawn between them, and it goes before they meet."""
    links = '<path d="M7 {}l9 1M3 21h18"/>'
    apart, slash = links.format(15), '<path d="M12 2v10"/>'
    joined = links.format(6)
    (comes,) = lone(morph(tmp_path, joined, apart + slash, ICON), arrives=True)
    (goes,) = lone(morph(tmp_path, apart + slash, joined, ICON), arrives=False)
    (free,) = lone(morph(tmp_path, apart, apart + slash, ICON), arrives=True)
    assert comes.style(0.5).opacity == goes.style(0.5).opacity == 0
    assert comes.style(0.6).opacity > 0
    assert goes.style(0.4).opacity > 0
    assert free.style(0.2).opacity > 0


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_a_line_that_is_cut_at_its_corner_is_whole_at_rest(opacity: float) -> None:
    """A mitre is no join of two halves; of what is seen through both would be seen twice."""
    black = Colour(0.0, 0.0, 0.0)
    line = polyline((20, 4), (20, 20), (4, 20))
    style = Style(fill=None, stroke=Stroke(black, 2.0), opacity=opacity)
    going = Going(Leaving((0.0, 0.6), kept=BOTH))
    part, told = unmatched_part(Item((line,), style, 0, ""), going, End.SOURCE, None)
    assert not told
    halves = np.split(part.curves(np.zeros(1))[0], np.cumsum(part.rings)[:-1])
    strokes = [
        shapely.LineString(half).buffer(1, cap_style="flat", join_style="mitre")
        for half in [np.concatenate([h[:1, 0], h[:, 3]]) for h in halves]
    ]
    whole = shapely.LineString([(20, 4), (20, 20), (4, 20)])
    painted = whole.buffer(1, cap_style="flat", join_style="mitre")
    missed = painted.difference(shapely.union_all(strokes)).area
    overlap = strokes[0].intersection(strokes[1]).area
    if opacity == 1:
        assert missed < 1e-9
    else:
        assert overlap < 1.1  # half of the corner
