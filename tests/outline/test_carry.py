"""Curves carried by moving nodes: exact at both ends, affine where the nodes are, never wild."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Affine, Complex, Curves, Floats, Points
from shapetween.geometry.bezier import end_tangents, flatten
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import linear_between, rotations
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from shapetween.outline.carry import Carrier, Joints, _straight, affine_between
from shapetween.outline.matched import MatchedOutlines
from tests.match.shapes import disc, polygon, rounded, star
from tests.strategies import affine_maps, rotation

T = np.linspace(0, 1, 11)
seeds = st.integers(0, 40)


def prepared(
    source: Outline, target: Outline, count: int = 12
) -> tuple[Carrier, Points, Points, Curves, Curves]:
    """Matched by length alone, with even nodes."""
    u = np.linspace(0, 1, 101)
    outlines = MatchedOutlines(ArcLength(source), ArcLength(target), u, u)
    nodes = np.arange(count) / count
    pieces = outlines.cut(nodes)
    ends = outlines.points(nodes)
    return Carrier(pieces, nodes, *ends), *ends, pieces.source, pieces.target


def _first(curves: Complex) -> Complex:
    """Offset to the first control point away from the start, (...,)."""
    offsets = curves[..., 1:] - curves[..., :1]
    first = (np.abs(offsets) > 1e-9 * np.abs(offsets).max(axis=-1, keepdims=True)).argmax(axis=-1)
    return np.asarray(np.take_along_axis(offsets, first[..., None], axis=-1)[..., 0])


def mapped(points: Points, matrix: Affine) -> Points:
    return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


@settings(max_examples=30)
@given(seeds)
def test_ends_are_exact_to_the_bit_whatever_the_nodes_do(seed: int) -> None:
    carrier, a, b, first, last = prepared(polygon(star(seed)), rounded(star(seed + 50, 6)))
    nodes = np.stack([a, b, a]) + np.random.default_rng(seed).normal(0, 1e-7, (3, len(a), 2))
    found = carrier.curves(nodes, np.array([0.0, 1.0, 0.0]))
    np.testing.assert_array_equal(found[0], first)
    np.testing.assert_array_equal(found[1], last)
    assert carrier.count == len(first)


@settings(max_examples=30)
@given(seeds)
def test_curves_follow_one_another_at_all_times(seed: int) -> None:
    carrier, a, b, *_ = prepared(polygon(star(seed)), rounded(star(seed + 50, 6)))
    found = carrier.curves((1 - T[:, None, None]) * a + T[:, None, None] * b, T)
    np.testing.assert_array_equal(found[:, :, 3], np.roll(found[:, :, 0], -1, axis=1))


@settings(max_examples=30)
@given(seeds)
def test_curves_pass_through_the_nodes(seed: int) -> None:
    """Wherever the mesh puts them: on the way the outline goes through them."""
    carrier, a, b, *_ = prepared(rounded(star(seed)), rounded(star(seed + 50, 6)))
    rng = np.random.default_rng(seed)
    nodes = (1 - T[:, None, None]) * a + T[:, None, None] * b
    nodes = nodes + rng.normal(0, 0.05, (1, *a.shape)) * (T * (1 - T))[:, None, None]
    starts = carrier.curves(nodes, T)[:, :, 0]
    for frame, points in zip(starts, nodes, strict=True):
        away = np.linalg.norm(points[:, None] - frame, axis=-1).min(axis=1)
        assert away.max() < 1e-9


@settings(max_examples=40)
@given(seeds, affine_maps())
def test_an_affine_image_is_carried_affinely(seed: int, matrix: Affine) -> None:
    """Nodes that move by the in-between maps take every curve along by them."""
    source = rounded(star(seed))
    target = source.transformed(matrix)
    u = np.linspace(0, 1, 101)
    # A stretch changes what is even along the outline, so places are matched by the curve itself.
    ends = ArcLength(source), ArcLength(target)
    v = np.concatenate([[0.0], ends[1].joints[1:], [1.0]])
    u = np.concatenate([[0.0], ends[0].joints[1:], [1.0]])
    outlines = MatchedOutlines(*ends, u, v, exact=True)
    nodes = outlines.cut(np.zeros(0)).w
    a, b = outlines.points(nodes)
    carrier = Carrier(outlines.cut(np.zeros(0)), nodes, a, b)
    angle, stretch = affine_between(a, b)
    linear = linear_between(np.reshape(angle, (1,)), stretch[None], T)[:, 0]
    shift = b.mean(axis=0) - a.mean(axis=0)
    path = (a - a.mean(axis=0)) @ np.swapaxes(linear, 1, 2)
    path = path + a.mean(axis=0) + T[:, None, None] * shift
    found = carrier.curves(path, T)
    local = source.curves.reshape(-1, 2) - a.mean(axis=0)
    wanted = local @ np.swapaxes(linear, 1, 2) + a.mean(axis=0) + T[:, None, None] * shift
    size = np.ptp(wanted)
    order = np.abs(found[0, :, None, 0] - source.curves[:, 0]).sum(-1).argmin(axis=0)
    got = found[:, order].reshape(len(T), -1, 2)
    np.testing.assert_allclose(got, wanted, atol=1e-6 * size)


@settings(max_examples=30)
@given(seeds, st.floats(-np.pi, np.pi), st.floats(0.1, 10))
def test_the_frame_does_not_matter(seed: int, angle: float, scale: float) -> None:
    """Turned, scaled and moved as a whole, the same is carried, turned, scaled and moved."""
    source, target = polygon(star(seed)), rounded(star(seed + 50, 6))
    matrix = np.column_stack([scale * rotation(angle), [3.0, -7.0]])
    carrier, a, b, *_ = prepared(source, target)
    other, *_ = prepared(source.transformed(matrix), target.transformed(matrix))
    nodes = (1 - T[:, None, None]) * a + T[:, None, None] * b
    found = other.curves(mapped(nodes, matrix), T)
    np.testing.assert_allclose(found, mapped(carrier.curves(nodes, T), matrix), atol=1e-5 * scale)


@pytest.mark.parametrize("seed", range(4))
def test_sides_straight_at_both_ends_stay_straight(seed: int) -> None:
    """Nodes on the corners: sides that turn, grow and shrink, but never bend."""
    source, target = polygon(star(seed, 7)), polygon(star(seed + 9, 7))
    ends = ArcLength(source), ArcLength(target)
    u, v = (np.append(place.joints, 1.0) for place in ends)
    outlines = MatchedOutlines(*ends, u, v)
    nodes = outlines.cut(np.zeros(0)).w
    a, b = outlines.points(nodes)
    carrier = Carrier(outlines.cut(np.zeros(0)), nodes, a, b)
    turned = a.mean(axis=0) + (a - a.mean(axis=0)) @ rotation(1.0).T
    bent = 4 * (T * (1 - T))[:, None, None]
    path = (1 - T[:, None, None]) * a + T[:, None, None] * b + 0.3 * bent * (turned - a)
    found = carrier.curves(path, T)
    chord = found[:, :, 3] - found[:, :, 0]
    off = np.abs(cross(found[:, :, 1:3] - found[:, :, :1], chord[:, :, None]))
    assert (off / (chord**2).sum(-1)[..., None]).max() < 1e-3


@pytest.mark.parametrize("seed", range(6))
def test_joints_smooth_at_both_ends_stay_smooth(seed: int) -> None:
    """Even where neighbouring chords turn by different angles."""
    carrier, a, b, *_ = prepared(rounded(star(seed, 6)), rounded(star(seed + 20, 6)), count=9)
    rng = np.random.default_rng(seed)
    nodes = (1 - T[:, None, None]) * a + T[:, None, None] * b
    nodes = nodes + rng.normal(0, 0.1, (1, *a.shape)) * (4 * T * (1 - T))[:, None, None]
    found = carrier.curves(nodes, T)
    leaving, reaching = end_tangents(found)
    following = np.roll(leaving, -1, axis=1)
    kinks = np.abs(np.arctan2(cross(reaching, following), (reaching * following).sum(-1)))
    assert np.rad2deg(kinks.max()) < 2


def bulge(curves: Curves) -> Floats:
    """Distance of control points from the middle of their chord, (F, P)."""
    middle = (curves[:, :, :1] + curves[:, :, 3:]) / 2
    return np.asarray(np.linalg.norm(curves - middle, axis=-1).max(axis=-1))


@pytest.mark.parametrize("seed", range(6))
def test_no_node_throws_a_curve_about(seed: int) -> None:
    """Nodes that come together, or trade places, leave no spike: curves stay near their chords."""
    source, target = rounded(star(seed)), rounded(star(seed + 50, 6))
    carrier, a, _, first, last = prepared(source, target)
    path = np.repeat(a[None], len(T), axis=0)
    path[4:7, 3] = path[4:7, 4]  # a chord without length
    path[5, [7, 8]] = path[5, [8, 7]]  # a chord turned round
    found = carrier.curves(path, T)
    assert np.isfinite(found).all()
    most = np.maximum(bulge(first[None]), bulge(last[None]))
    reach = np.linalg.norm(found[:, :, 3] - found[:, :, 0], axis=-1) / 2
    assert (bulge(found) < reach + 1.2 * most).all()


def test_a_disc_that_turns_stays_a_disc() -> None:
    """Nodes turn half round while the curves between them are carried."""
    ring = disc()
    carrier, a, *_ = prepared(ring, ring, count=5)
    turned = a @ np.swapaxes(rotations(T * np.pi), 1, 2)
    found = flatten(carrier.curves(turned, T), 8)
    np.testing.assert_allclose(np.linalg.norm(found[1:-1], axis=-1), 1, atol=1e-3)


@pytest.mark.parametrize("slack", [(1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)])
@pytest.mark.parametrize("bend", [-150.0, -10.0, 15.0, 100.0, 170.0])
@pytest.mark.parametrize("other", [-120.0, 5.0, 60.0])
def test_no_handle_leaps_where_one_turns_all_the_way_round(
    slack: tuple[float, float], bend: float, other: float
) -> None:
    """A joint of two curves, one of which turns about it, at any time and with any kinks."""

    def pair(angle: float, handles: tuple[float, float]) -> Curves:
        way = as_points(np.exp(1j * np.deg2rad(angle)))
        first = np.array([[-3.0, 0], [-2, 0.5], [-handles[0], 0], [0, 0]])
        return np.stack([first, np.stack([0 * way, handles[1] * way, 2 * way, 3 * way])])

    joints = Joints.of(pair(bend, slack), pair(other, (1.0, 1.0)), closed=False)
    turns = np.linspace(0.0, 360.0, 3601)
    curves = np.stack([pair(turn, (0.5, 0.5)) for turn in turns])
    for t in (0.0, 0.31, 0.5, 0.77):
        moved = as_complex(curves.copy())
        joints.smooth(moved, np.full(len(turns), t))
        steps = np.abs(np.diff(moved, axis=0)).max()
        assert steps <= 6 * 3 * np.deg2rad(0.1)


def _joint(bend: float, length: float) -> Curves:
    """Two curves that meet in the origin, the second of which leaves it at an angle in degrees."""
    way = as_points(np.exp(1j * np.deg2rad(bend)))
    first = np.array([[-3.0, 0], [-2, 0.5], [-1, 0], [0, 0]])
    return np.stack([first, np.stack([0 * way, length * way, [2, -0.5], [3, 0]])])


@pytest.mark.parametrize("length", [1e-2, 1e-4, 1e-6])
def test_no_long_handle_runs_after_one_that_shrinks_to_nothing(length: float) -> None:
    """A handle of hardly any length swings round in an instant; only it itself is turned back."""
    source, target = _joint(-19.0, 1.0), _joint(12.0, length)
    joints = Joints.of(source, target, closed=False)
    times = 1 - np.append(np.geomspace(1e-1, 1e-8, 900), 0.0)
    moved = as_complex(source + times[:, None, None, None] * (target - source))
    swing = np.angle(moved[-1, 1, 1] / moved[0, 1, 1])
    assert abs(swing) > np.deg2rad(10)
    joints.smooth(moved, times)
    speeds = np.abs(np.diff(moved, axis=0)).max(axis=(1, 2)) / np.diff(times)
    assert speeds.max() <= 3 * np.abs(target - source).max()


@pytest.mark.parametrize(
    ("ratio", "shares"), [(0.5, (0.5, 0.5)), (0.15, (0.5, 0.5)), (0.05, (0.25, 0.75))]
)
def test_handles_share_a_turn_evenly_unless_one_is_far_shorter(
    ratio: float, shares: tuple[float, float]
) -> None:
    joints = Joints.of(_joint(0.0, 1.0), _joint(0.0, 1.0), closed=False)
    moved = as_complex(_joint(10.0, ratio)[None])
    joints.smooth(moved, np.array([0.5]))
    turned = np.angle(-moved[0, 0, 2]), np.deg2rad(10) - np.angle(moved[0, 1, 1])
    np.testing.assert_allclose(turned, np.deg2rad(10) * np.array(shares), atol=1e-9)


@settings(max_examples=20)
@given(seeds)
def test_a_handle_that_grows_from_nothing_turns_no_tip(seed: int) -> None:
    """However the nodes move: past half a turn the curves beside a tip cross."""
    source = polygon(star(seed)).curves.copy()
    source[:, 1] = source[:, 0]
    source[:, 2] += 0.3 * np.random.default_rng(seed).normal(size=source[:, 2].shape)
    carrier, a, b, *_ = prepared(Outline(source), rounded(star(seed + 50)))
    moved = (1 - T[:, None, None]) * a + T[:, None, None] * b
    moved += 0.3 * np.random.default_rng(seed).normal(size=moved.shape)
    curves = as_complex(carrier.curves(moved, T))
    curves, ends = curves[1:-1], curves[[0, -1]]
    leaving, reaching = np.roll(_first(curves), -1, axis=1), -_first(curves[..., ::-1])
    kinks = np.abs(np.angle(leaving / reaching))
    most = np.abs(np.angle(np.roll(_first(ends), -1, axis=1) / -_first(ends[..., ::-1])))
    folded = np.roll(np.abs(ends[0, :, 1] - ends[0, :, 0]) < 1e-12, -1)
    sharp = folded & (most.max(axis=0) > np.deg2rad(20))
    assert sharp.any()
    limit = np.maximum(most.max(axis=0), np.deg2rad(166))[sharp]
    assert (kinks[:, sharp] <= limit).all()


@given(affine_maps())
def test_an_affine_fit_that_is_exact_is_found(matrix: Affine) -> None:
    points = star(2, 9)
    angle, stretch = affine_between(points, mapped(points, matrix))
    np.testing.assert_allclose(rotations(angle) @ stretch, matrix[:, :2], atol=1e-9)


@given(seeds, seeds, st.floats(-3.0, 3.0))
def test_the_fit_back_is_the_inverse(first: int, second: int, angle: float) -> None:
    """For unlike shapes too, or backwards in time the curves would go another way."""
    a, b = star(first, 9), 3 * star(second, 9) * [1.0, 1.7] @ rotation(angle).T
    forth, back = (rotations(turn) @ s for turn, s in (affine_between(a, b), affine_between(b, a)))
    np.testing.assert_allclose(forth @ back, np.eye(2), atol=1e-9)


def test_a_fit_that_would_turn_the_plane_over_is_a_similarity() -> None:
    points = star(2, 9)
    for image in (points * [1, -1], points * [1, 0.05] + 0.3 * star(7, 9)):
        _, stretch = affine_between(points, image)
        values = np.linalg.eigvalsh(stretch)
        assert values[0] == pytest.approx(values[1])
        assert values[0] > 0


def test_points_on_a_line_say_nothing_of_what_is_across() -> None:
    """Two nodes are all that some holes have."""
    points = np.array([[10.1, 8.3], [20.6, 20.9]])
    for image in (points, points * 2.5, points @ rotation(2.0).T):
        _, stretch = affine_between(points, image)
        assert np.linalg.cond(stretch) == pytest.approx(1)


def _kinks(curves: Curves) -> Floats:
    leaving, reaching = end_tangents(curves)
    before = np.roll(reaching, 1, axis=0)
    return np.asarray(np.abs(np.arctan2(cross(before, leaving), (before * leaving).sum(-1))))


def _lens(kink: float) -> Outline:
    """A disc of four arcs that meet at a little angle, in degrees."""
    turn = np.deg2rad(90 - kink)
    handle = 4 / 3 * np.tan(turn / 4) / np.sqrt(2) / np.sin(turn / 2) * np.sin(np.pi / 4)
    corners = np.array([[1.0, 0], [0, 1], [-1, 0], [0, -1]])
    curves = []
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        chord = end - start
        out = chord @ rotation(-turn / 2).T
        into = chord @ rotation(turn / 2).T
        scale = handle / np.linalg.norm(chord) * np.sqrt(2)
        curves.append([start, start + out * scale / 2, end - into * scale / 2, end])
    return Outline(np.array(curves))


@pytest.mark.parametrize(("kink", "smooth"), [(15.0, True), (30.0, False)])
def test_joints_that_all_but_run_on_are_kept_so_and_corners_are_left(
    kink: float, smooth: bool
) -> None:
    """Nodes that bend the outline at its joints leave what was smooth as smooth as it was."""
    lens = _lens(kink)
    assert np.rad2deg(_kinks(lens.curves)) == pytest.approx(np.full(4, kink), abs=1e-6)
    carrier, a, *_ = prepared(lens, lens, 4)
    nodes = a.copy()
    nodes[::2] *= 0.5  # as a diamond
    (found,) = carrier.curves(nodes[None], np.array([0.5]))
    kept = np.rad2deg(_kinks(found))
    assert (np.abs(kept - kink) < 1.0).all() == smooth


@pytest.mark.parametrize(("noise", "exact"), [(7e-4, True), (1.6e-3, False)])
def test_a_great_stretch_is_followed_only_where_it_fits(noise: float, exact: bool) -> None:
    """Past `MAX_STRETCH` two unlike outlines say nothing of a common deformation."""
    source = star(3)
    source = source - source.mean(axis=0)
    off = np.stack([np.sin(7.0 * np.arange(9)), np.cos(5.0 * np.arange(9))], axis=1)
    known = np.column_stack([source, np.ones(9)])
    off -= known @ np.linalg.lstsq(known, off, rcond=None)[0]
    target = source * [5.0, 1.0]
    off *= noise * np.linalg.norm(target) / np.linalg.norm(off)
    _, stretch = affine_between(source, target + off)
    ratio = float(np.divide(*np.linalg.svd(stretch, compute_uv=False)))
    assert ratio == pytest.approx(5.0 if exact else 1.0, rel=0.02)


@pytest.mark.parametrize(("off", "flat"), [(6e-7, True), (1.6e-6, False)])
def test_points_on_one_line_say_nothing_of_what_happens_across_it(off: float, flat: bool) -> None:
    x = np.linspace(-1, 1, 9)
    across = np.sign(np.sin(3 * np.pi * x + 0.2))
    across = across - across.mean()
    across = across - x * (across @ x) / (x @ x)
    across *= off * np.linalg.norm(x) / np.linalg.norm(across)
    points = np.stack([x, across], axis=1)
    _, stretch = affine_between(points, points * [1.0, 2.0])
    ratio = float(np.divide(*np.linalg.svd(stretch, compute_uv=False)))
    assert ratio == pytest.approx(1.0 if flat else 2.0, rel=0.01)


@pytest.mark.parametrize(("off", "straight"), [(7e-4, True), (1.5e-3, False)])
def test_handles_that_lie_hardly_off_the_chord_make_no_curve(off: float, straight: bool) -> None:
    curve = 40 * np.array([[[0.0, 0.0], [0.3, off], [0.7, 0.0], [1.0, 0.0]]])
    assert _straight(curve).tolist() == [straight]
