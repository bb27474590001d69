"""Lines of icons: what hangs on what, what closes what, and nothing that is torn."""

from pathlib import Path

import numpy as np
import pytest
import shapely

import shapetween as st
from shapetween.base.arrays import Floats
from shapetween.model.part import Part
from shapetween.scene.movement import SceneMovement
from shapetween.scene.torn import torn
from tests.scene.test_faults import drawn
from tests.scene.test_leaving import ICON, box, lone, morph

TIMES = np.linspace(0, 1, 17)
MUG = '<path d="M4 8h12v12h-12z"/>'
HANDLE = '<path d="M16 11h2a3 3 0 0 1 0 6h-2"/>'


def scene(found: st.Morph) -> SceneMovement:
    assert found.prepared.scene is not None
    return found.prepared.scene


def closed(found: st.Morph) -> list[tuple[bool, bool]]:
    """Which sides of each pair are rings."""
    a, b = scene(found).scenes
    return [
        (a.items[role.first].closed, b.items[role.second].closed)
        for role in scene(found).roles.pairs
    ]


def pieces(found: st.Morph, t: float) -> int:
    """Of how many pieces a frame is."""
    (frame,) = found.prepared.movement.at(np.array([t]))
    return int(shapely.get_num_geometries(drawn(frame).buffer(1e-6)))


def ends_of(points: Floats) -> Floats:
    return np.stack([points[0, 0], points[-1, 3]])


@pytest.mark.parametrize("arrives", [False, True])
def test_a_handle_folds_onto_what_it_hangs_on(tmp_path: Path, arrives: bool) -> None:
    """It keeps both its joints, and lies on the wall when it is gone."""
    bare = '<path d="M4 8h12v12h-12z"/>'
    drawings = (bare, MUG + HANDLE) if arrives else (MUG + HANDLE, bare)
    (handle,) = lone(morph(tmp_path, *drawings, ICON), arrives=arrives)
    seen = [t for t in TIMES if handle.style(float(t)).opacity > 0]
    assert len(seen) > 5
    heights = []
    for t in seen:
        curves = handle.curves(np.array([t]))[0]
        np.testing.assert_allclose(ends_of(curves), [[16, 11], [16, 17]], atol=1e-6)
        heights.append(float(curves[..., 0].max()) - 16)
    assert max(heights) == pytest.approx(5, abs=0.01)
    gone = handle.curves(np.array([0.1 if arrives else 0.9]))[0]
    np.testing.assert_allclose(gone[..., 0], 16, atol=1e-6)


def test_what_folds_goes_along_with_what_it_hangs_on(tmp_path: Path) -> None:
    """The mug goes aside and the handle's ends stay on its wall."""
    moved = '<path d="M2 6h12v14h-12z"/>'
    found = morph(tmp_path, MUG + HANDLE, moved, ICON)
    (handle,) = lone(found, arrives=False)
    mug = next(part for part in found.prepared.movement.parts if part is not handle)
    for t in (0.1, 0.2, 0.3):
        wall = box(mug, t)[1, 0]
        curves = handle.curves(np.array([t]))[0]
        np.testing.assert_allclose(ends_of(curves)[:, 0], wall, atol=0.05)


def test_a_line_across_goes_to_its_middle_and_stays_straight(tmp_path: Path) -> None:
    """It is no shorter than the border beside it, so it does not bend down onto that."""
    card = '<rect x="2" y="5" width="20" height="14" rx="2"/>'
    (stripe,) = lone(morph(tmp_path, card + '<path d="M2 10h20"/>', card, ICON), arrives=False)
    for t in (0.1, 0.2, 0.3, 0.4):
        low, high = box(stripe, t)
        assert low[0] + high[0] == pytest.approx(24)
        assert low[1] == high[1] == pytest.approx(10)
    assert np.ptp(box(stripe, 0.4)[:, 0]) < 8


def test_a_box_becomes_what_is_closed_by_its_lid(tmp_path: Path) -> None:
    """The lid lies across the open side, so nothing opens: it goes, and the box stays one."""
    bin_ = '<path d="M5 6v13a2 2 0 0 0 2 2h10a2 2 0 0 0 2 -2v-13"/><path d="M3 6h18"/>'
    box_ = '<path d="M3 3h18v18h-18z"/>'
    for drawings in ((bin_, box_), (box_, bin_)):
        found = morph(tmp_path, *drawings, ICON)
        assert (True, True) in closed(found)
        (start,) = found.prepared.movement.at(np.zeros(1))
        (own,) = morph(tmp_path, drawings[0], drawings[0], ICON).prepared.movement.at(np.zeros(1))
        assert drawn(start).symmetric_difference(drawn(own)).area < 1e-3 * drawn(own).area
        for t in TIMES[1:-1]:
            (frame,) = found.prepared.movement.at(np.array([t]))
            assert len(shapely.get_parts(drawn(frame).buffer(1e-6))) == 1
            assert any(part.interiors for part in shapely.get_parts(drawn(frame).buffer(1e-6)))


def test_what_is_all_of_what_closes_a_line_is_drawn_once(tmp_path: Path) -> None:
    """An envelope opens: its upper edge rises and is the roof."""
    shut = '<path d="M3 7h18v12h-18z"/>'
    opened = '<path d="M4 9v11h16v-11"/><path d="M4 9l8 -6l8 6"/>'
    found = morph(tmp_path, shut, opened, ICON)
    assert closed(found) == [(True, True)]
    assert len(found.prepared.movement.parts) == 1
    (first, last) = found.prepared.movement.at(np.array([0.0, 1.0]))
    for frame, text in ((first, shut), (last, opened)):
        (own,) = morph(tmp_path, text, text, ICON).prepared.movement.at(np.zeros(1))
        assert drawn(frame).symmetric_difference(drawn(own)).area < 1e-3 * drawn(own).area


def test_a_cup_never_unzips_to_become_a_wave(tmp_path: Path) -> None:
    wave = '<path d="M2 20c3 0 4 -3 6 -3s4 3 8 3s4 -3 6 -3"/>'
    cup = '<path d="M6 3h12v8a6 6 0 0 1 -12 0z"/>'
    foot = '<path d="M8 21h8"/>'
    assert (True, False) not in closed(morph(tmp_path, cup + foot, wave + RAYS, ICON))


RAYS = '<path d="M4 4l3 3"/><path d="M20 4l-3 3"/>'


def test_a_ring_with_a_mouth_is_still_a_ring(tmp_path: Path) -> None:
    mouth = '<path d="M15 4.5a9.5 7.5 0 1 0 5.5 4"/>'
    dot = '<path d="M12 12h.01"/>'
    ring = '<circle cx="12" cy="12" r="9"/>'
    assert (True, False) in closed(morph(tmp_path, ring + dot, mouth + dot, ICON))


def test_an_eye_closes_by_its_lids(tmp_path: Path) -> None:
    """Both come together, and the corners stay."""
    eye = '<path d="M2 12q10 -12 20 0q-10 12 -20 0z"/><circle cx="12" cy="12" r="3"/>'
    shut = '<path d="M2 11q10 8 20 0"/><path d="M7 14l-1 3"/><path d="M17 14l1 3"/>'
    for drawings in ((eye, shut), (shut, eye)):
        found = morph(tmp_path, *drawings, ICON)
        (lids,) = (
            part
            for part in found.prepared.movement.parts
            if part.style(0.5).opacity == 1 and np.ptp(box(part, 0.5)[:, 0]) > 15
        )
        assert lids.closed == (True,)
        for t in TIMES:
            low, high = box(lids, float(t))
            assert low[0] == pytest.approx(2, abs=0.3)
            assert high[0] == pytest.approx(22, abs=0.3)
        heights = [float(np.ptp(box(lids, float(t))[:, 1])) for t in TIMES]
        assert (np.diff(heights) < 0.01).all() or (np.diff(heights) > -0.01).all()


def test_a_stem_that_is_drawn_with_the_dome_stands_still_as_well(tmp_path: Path) -> None:
    """Half of a dome with its stem, and all of it, with the stem by itself, in any order."""
    base = '<path d="M2 18h20"/>'
    half = '<path d="M4 18a8 8 0 0 1 8 -8v-5"/>'
    whole = '<path d="M4 18a8 8 0 0 1 16 0"/><path d="M12 10v-5"/>'
    found = morph(tmp_path, base + half, base + whole, ICON)
    both = drawn(found.prepared.movement.at(np.zeros(1))[0])
    for t in TIMES:
        (frame,) = found.prepared.movement.at(np.array([t]))
        assert both.difference(drawn(frame).buffer(1e-3)).area < 1e-3 * both.area


def test_an_arrow_stays_an_arrow_however_its_head_is_written(tmp_path: Path) -> None:
    """Its head goes with its shaft, whether it is one line or two legs."""
    one = '<path d="M12 20v-16"/><path d="M5 11l7 -7l7 7"/>'
    two = '<path d="M6 21v-18M10 7l-4 -4M2 7l4 -4M18 3v18M22 17l-4 4M14 17l4 4"/>'
    found = morph(tmp_path, one, two, ICON)
    assert len(scene(found).roles.pairs) == 2
    shaft, head = (p for p in found.prepared.movement.parts if p.style(0.0).opacity > 0)
    for t in TIMES:
        tip = box(head, float(t))
        line = box(shaft, float(t))
        assert tip[0, 1] == pytest.approx(line[0, 1], abs=0.01)
        assert tip.mean(axis=0)[0] == pytest.approx(line[0, 0], abs=0.01)


def test_mates_come_from_ends_that_are_mates(tmp_path: Path) -> None:
    ring = '<circle cx="12" cy="12" r="10"/>'
    ticks = '<path d="M6 10l2 3l2 -1"/><path d="M18 10l-2 3l-2 -1"/>'
    parts = lone(morph(tmp_path, ring, ring + ticks, ICON), arrives=True)
    left, right = (box(part, 0.3) for part in parts)
    np.testing.assert_allclose(left[:, 0], 24 - right[::-1, 0], atol=1e-6)
    np.testing.assert_allclose(left[:, 1], right[:, 1], atol=1e-6)


def test_an_end_goes_round_what_it_lies_on_and_not_through_it(tmp_path: Path) -> None:
    """A note's stem goes from one side of its head to the other, however small the head is."""
    note = '<circle cx="7" cy="17" r="4"/><path d="M11 17v-13h8"/>'
    other = '<circle cx="7" cy="17" r="4"/><path d="M3 17v-13h16"/>'
    found = morph(tmp_path, note, other, ICON)
    stem = max(found.prepared.movement.parts, key=lambda p: float(np.ptp(box(p, 0.0))))
    ends = np.array([ends_of(stem.curves(np.array([t]))[0]) for t in TIMES])
    away = np.linalg.norm(ends - np.array([7.0, 17.0]), axis=-1).min(axis=1)
    np.testing.assert_allclose(away, 4, atol=0.02)


def test_what_hangs_on_what_goes_folds_onto_that(tmp_path: Path) -> None:
    """A key's bit lies down on its shaft, which is retracted thereafter."""
    bow = '<circle cx="6" cy="12" r="4"/>'
    key = bow + '<path d="M10 12h12"/><path d="M15 12v4h5v-4"/>'
    parts = lone(morph(tmp_path, key, bow, ICON), arrives=False)
    shaft, bit = sorted(parts, key=lambda p: float(np.ptp(box(p, 0.0)[:, 1])))
    for t in (0.05, 0.1, 0.15):
        curves = bit.curves(np.array([t]))[0]
        np.testing.assert_allclose(ends_of(curves), [[15, 12], [20, 12]], atol=1e-6)
    assert bit.style(0.4).opacity == 0 < shaft.style(0.4).opacity


def test_a_speck_at_a_line_s_end_is_not_closed_by_it(tmp_path: Path) -> None:
    bent = '<path d="M18 7v10h-12v-10"/><path d="M6 7h.06"/>'
    found = morph(tmp_path, bent, '<circle cx="12" cy="12" r="9"/><path d="M9 12h6"/>', ICON)
    assert drawn(found.prepared.movement.at(np.array([0.5]))[0]).area > 0


def test_pieces_that_lie_hardly_aside_are_pieces(tmp_path: Path) -> None:
    """A microphone's arm that is cut by a slash is drawn a little wider there, and still is it."""
    arm = '<path d="M5 11a7 7 0 0 0 14 0"/>'
    cut = (
        '<path d="M4.55 11A7.45 7.45 0 0 0 13.93 18.2"/>'
        '<path d="M19 13.55A7.45 7.45 0 0 0 19.45 11"/>'
    )
    slash = '<path d="M3 3l18 18"/>'
    found = morph(tmp_path, arm, cut + slash, ICON)
    assert len(scene(found).roles.pairs) == 2
    (early, late) = found.prepared.movement.at(np.array([0.15, 0.9]))
    for frame in (early, late):  # the short piece never leaves its place
        assert drawn(frame).intersection(shapely.box(17, 10, 21, 13)).area > 0.9 * 2 * 2.5


def test_a_slash_closes_nothing(tmp_path: Path) -> None:
    """Its ends lie on what it cuts, and yet it is no lid: what it leaves of a shield stays."""
    shield = '<path d="M5 5l7 -2l7 2v8c0 4 -3 6 -7 8c-4 -2 -7 -4 -7 -8z"/>'
    off = (
        '<path d="M8 4.14l4 -1.14l7 2v8"/>'
        '<path d="M17 17.4c-1.2 1.5 -3 2.6 -5 3.6c-4 -2 -7 -4 -7 -8v-8"/>'
    )
    found = morph(tmp_path, shield, off + '<path d="M5 5l12 12.4"/>', ICON)
    kept = drawn(morph(tmp_path, off, off, ICON).prepared.movement.at(np.zeros(1))[0])
    for frame in found.prepared.movement.at(TIMES):
        assert kept.difference(drawn(frame).buffer(0.35)).area < 0.02 * kept.area


def test_a_panel_closed_by_what_it_stands_on_stays_whole(tmp_path: Path) -> None:
    """A handle lies along most of a panel, and with the case below it is as closed as that."""
    panel = '<path d="M8 3h8v6q-4 2 -8 0z"/><path d="M3 10v11h18v-11"/>'
    case = '<path d="M8 7v-4h8v4"/><path d="M2 7h20v14h-20z"/>'
    assert (True, True) in closed(morph(tmp_path, panel, case, ICON))


PICTURE = '<path d="M3 3h18v18h-18z"/>'


def arc_going(tmp_path: Path, line: str) -> Part:
    (part,) = lone(morph(tmp_path, PICTURE + line, PICTURE, ICON), arrives=False)
    return part


def test_a_hill_folds_into_its_corner_and_a_bow_across_goes_to_its_middle(tmp_path: Path) -> None:
    hill = arc_going(tmp_path, '<path d="M7 21c3 -7 8 -9 14 -8"/>')
    bow = arc_going(tmp_path, '<path d="M3 12q9 -3 18 0"/>')
    for t in (0.1, 0.3):
        curves = hill.curves(np.array([t]))[0]
        np.testing.assert_allclose(ends_of(curves), [[7, 21], [21, 13]], atol=1e-6)
        low, high = box(bow, t)
        assert low[0] > 3.1
        assert low[0] + high[0] == pytest.approx(24)


@pytest.mark.parametrize("style", ['stroke="#f00"', 'stroke-width="4"'])
def test_what_would_be_seen_on_what_it_folds_onto_does_not(tmp_path: Path, style: str) -> None:
    """Of another colour or wider, it would not be gone when it lies on it."""
    handle = f'<path d="M21 8h1a3 3 0 0 1 0 6h-1" {style}/>'
    curves = arc_going(tmp_path, handle).curves(np.array([0.3]))[0]
    assert np.abs(ends_of(curves) - [[21, 8], [21, 14]]).max() > 0.1


def test_what_is_torn_is_never_a_pair(tmp_path: Path) -> None:
    """A cup is not to become a wave above it, nor its foot's."""
    cup = '<path d="M5 4q7 -3 14 0v5q0 7 -7 7q-7 0 -7 -7z"/><path d="M6 22h12"/>'
    wave = '<path d="M2 9q3 0 5 -2q5 4 10 0q2 2 5 2"/><path d="M2 19q3 0 5 -2q5 4 10 0q2 2 5 2"/>'
    first, second = scene(morph(tmp_path, cup, wave, ICON)).scenes
    np.testing.assert_array_equal(torn(first, second), [[True, True], [False, False]])
    np.testing.assert_array_equal(torn(second, first), torn(first, second).T)


def test_a_box_never_collapses_into_three_of_its_sides(tmp_path: Path) -> None:
    box_, sides = PICTURE + FLAG, '<path d="M4 4v11h16v-11"/>' + FLAG
    first, second = scene(morph(tmp_path, box_, sides, ICON)).scenes
    assert torn(first, second)[0, 0]


def test_what_crosses_a_line_does_not_close_it(tmp_path: Path) -> None:
    """The ends stand out beyond the bar, and would be drawn twice."""
    crossed = '<path d="M5 3v16h14v-16"/><path d="M3 7h18"/>'
    assert (True, True) not in closed(morph(tmp_path, crossed, PICTURE, ICON))


FLAG = '<path d="M11 9h2"/>'


def test_a_ring_elsewhere_is_not_what_a_lid_closes(tmp_path: Path) -> None:
    tray = '<path d="M3 12v9h18v-9"/><path d="M2 12h20"/>'
    eye = '<circle cx="12" cy="5" r="3"/><path d="M3 12v9h18v-9"/>'
    assert (True, True) not in closed(morph(tmp_path, tray, eye, ICON))


def test_a_chord_is_not_closed_by_half_of_its_ring(tmp_path: Path) -> None:
    """The dish stays what it was, beside the ring that it crosses."""
    dish = '<path d="M12 3a9 9 0 1 0 .01 0z"/><path d="M3 12q9 3 18 0"/>'
    egg = '<path d="M12 6a8.5 7.5 0 1 0 .01 0z"/>'
    found = morph(tmp_path, dish, egg, ICON)
    first = scene(found).scenes[0]
    assert [item.closed for item in first.items] == [True, False]


WHOLE = '<path d="M5 12h-2l9-9 9 9h-2"/><path d="M5 12v7a2 2 0 0 0 2 2h10a2 2 0 0 0 2-2v-7"/>'
BADGED = (
    '<path d="M21 12l-9-9-9 9h2v7a2 2 0 0 0 2 2h6"/>'
    '<path d="M19 22l3.4-3.3a2.2 2.2 0 0 0-3.4-2.7 2.2 2.2 0 0 0-3.3 2.7z"/>'
)


@pytest.mark.parametrize("backwards", [False, True])
def test_what_lines_have_in_common_stands_still_however_they_are_put_together(
    tmp_path: Path, backwards: bool
) -> None:
    """A house is a roof and walls; with a heart beside it, a roof with one wall in one line."""
    ends = (BADGED, WHOLE) if backwards else (WHOLE, BADGED)
    found = morph(tmp_path, *ends, ICON)
    assert not any(notice.kind == "exchanged" for notice in found.notices)
    common = [(11, 21), (7, 21), (5, 19), (5, 12), (3, 12), (12, 3), (20, 11)]
    common_line = shapely.LineString(common).buffer(0.3)
    for t in TIMES:
        (frame,) = found.prepared.movement.at(np.array([t]))
        assert drawn(frame).buffer(0.3).contains(common_line)


def test_a_letter_that_opens_is_not_broken(tmp_path: Path) -> None:
    """Its foot is where it was, but what is left of either is nowhere in the other drawing."""
    shut, opened = '<path d="M3 6h18v12H3z"/>', '<path d="M3 9v9h18V9l-9-6z"/>'
    flap = '<path d="M5 12l7 4 7-4"/>'
    found = morph(tmp_path, shut + flap, opened + flap, ICON)
    assert not any(item.cut for side in scene(found).scenes for item in side.items)


def test_what_is_cut_out_of_a_line_becomes_nothing_else(tmp_path: Path) -> None:
    """The corner of a table makes room for an x; it is no stroke of that."""
    table = '<path d="M3 5a2 2 0 0 1 2-2h14a2 2 0 0 1 2 2v14a2 2 0 0 1-2 2H5a2 2 0 0 1-2-2z"/>'
    crossed = (
        '<path d="M13 21H5a2 2 0 0 1-2-2V5a2 2 0 0 1 2-2h14a2 2 0 0 1 2 2v8"/>'
        '<path d="M22 22l-5-5"/><path d="M17 22l5-5"/>'
    )
    found = morph(tmp_path, table, crossed, ICON)
    assert len(scene(found).roles.pairs) == 1


def test_a_large_rest_of_a_line_is_a_thing_by_itself(tmp_path: Path) -> None:
    """A folder's divider is where its front's edge is; the front is what was left of it."""
    shut = '<path d="M3 20V4h6l3 3h9v13z"/><path d="M3 10h18"/>'
    opened = (
        '<path d="M4 10V4h6l3 3h7v3"/><path d="M21 12l-1 8H4l-1-8a2 2 0 0 1 1-2h16a2 2 0 0 1 1 2"/>'
    )
    found = morph(tmp_path, shut, opened, ICON)
    (a, b), roles = scene(found).scenes, scene(found).roles
    assert max((a.items[k].size / a.scale for k in roles.disappearing), default=0.0) < 0.5
    assert max((b.items[k].size / b.scale for k in roles.appearing), default=0.0) < 0.5


def test_a_tiny_line_beside_one_that_is_all_of_another_cuts_nothing(tmp_path: Path) -> None:
    """As in charts of many bars, whose neighbours lie nearly on each other."""
    one = '<path d="M30 100V1"/>'
    other = '<path d="M31 100V1"/><path d="M29 60v-.8"/>'
    found = morph(tmp_path, one, other, 'viewBox="0 0 100 100" fill="none" stroke="#000"')
    assert len(scene(found).scenes[0].items) == 1
