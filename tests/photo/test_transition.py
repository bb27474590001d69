import threading

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points, Quads
from shapetween.base.errors import MeshError, OptionError
from shapetween.mesh.pair import MeshPair
from shapetween.photo.filling import filled
from shapetween.photo.layers import Layer, Piece
from shapetween.photo.transition import Transition, fitted
from shapetween.raster.faces import Projection
from shapetween.raster.light import FULL, Bytes
from shapetween.raster.picture import Picture
from tests.photo.scenes import shown
from tests.strategies import convex_quads, grid

T = np.array([0.0, 0.3, 0.5, 0.8, 1.0])
RNG = np.random.default_rng(11)
EYE = np.eye(2, 3)


def noise(width: int = 64, height: int = 48, channels: int = 3) -> Bytes:
    return RNG.integers(0, 256, (height, width, channels), dtype=np.uint8)


def plain(colour: tuple[int, ...], width: int = 64, height: int = 48) -> Picture:
    return Picture.of(np.full((height, width, len(colour)), colour, np.uint8))


def one_quad(a: Points, b: Points) -> Piece:
    return Piece(MeshPair(a, b, np.array([[0, 1, 2, 3]])))


BOARD_A = np.array([[5.3, 6.1], [40.2, 3.4], [37.7, 30.9], [8.8, 25.2]])
BOARD_B = np.array([[20.4, 15.0], [58.9, 20.1], [60.0, 44.4], [23.3, 40.7]])


def test_ends_are_the_pictures_themselves() -> None:
    a, b = noise(), noise()
    transition = Transition.between(
        Picture.of(a), Picture.of(b), [one_quad(BOARD_A, BOARD_B)], np.array([0.0, 1.0])
    )
    assert (transition.frame(0) == a).all()
    assert (transition.frame(1) == b).all()


def bent_mesh() -> Piece:
    """Many quads and two triangles over the whole of a picture."""
    vertices, quads = grid(4, 3)
    source = vertices * 16.0
    target = source + 3 * np.sin(vertices[:, ::-1] * 2)
    edge = (vertices[:, 0] % 4 == 0) | (vertices[:, 1] % 3 == 0)
    target[edge] = source[edge]
    pair = MeshPair(source, target, quads[:-1], quads[-1][[[0, 1, 2], [0, 2, 3]]])
    return Piece(pair)


@pytest.mark.parametrize("method", ["projective", "linear", "arap"])
def test_no_seam_shows_between_faces(method: str) -> None:
    """A mesh of one colour over a background of another: nothing of it comes through."""
    red, blue = plain((200, 30, 40)), plain((20, 60, 220))
    transition = Transition.between(
        red, red, [bent_mesh()], T, background=blue, method=method, tolerance=100.0
    )
    core = slice(8, -8)
    for k in range(len(T)):
        frame = transition.frame(k)[core, core].astype(int)
        assert np.abs(frame - (200, 30, 40)).max() <= 1


def test_a_moving_mesh_is_drawn_without_gaps_or_steps() -> None:
    """Colour that is smooth in the picture is smooth in the frames, across shared sides too."""
    ramp = np.add.outer(np.arange(48), 2 * np.arange(64))[..., None].repeat(3, axis=2)
    picture = Picture.of(ramp.astype(np.uint8))
    transition = Transition.between(picture, picture, [bent_mesh()], T, tolerance=0.25)
    assert transition.layers[0].slips[1] <= 0.25
    for k in range(len(T)):
        frame = transition.frame(k)[8:-8, 8:-8, 0].astype(int)
        assert np.abs(np.diff(frame, axis=1)).max() <= 8


@settings(max_examples=25)
@given(convex_quads(), convex_quads(), st.floats(0, 1), st.floats(0, 1), st.floats(0, 1))
def test_straight_lines_stay_straight_in_every_frame(
    a: Quads, b: Quads, s: float, r: float, t: float
) -> None:
    a, b = (100 * quad / np.abs(quad).max() for quad in (a, b))
    layer = Layer.of(one_quad(a, b), (EYE, EYE), np.array([t]), "projective", 1.0)
    face = layer.faces(0)[0]
    for inverse in face.inverses:
        assert isinstance(inverse, Projection)
        x = face.corners
        start, end = x[0] + s * (x[1] - x[0]), x[3] + r * (x[2] - x[3])
        line = start + np.linspace(0, 1, 9)[:, None] * (end - start)
        shown = np.stack(inverse(*line.T), axis=1)
        along = shown[-1] - shown[0]
        off = (shown - shown[0]) @ np.array([-along[1], along[0]]) / np.linalg.norm(along)
        assert np.abs(off).max() < 1e-4


def test_the_middle_of_a_board_goes_straight() -> None:
    layer = Layer.of(one_quad(BOARD_A, BOARD_B), (EYE, EYE), T, "projective", 1.0)
    middles = layer.vertices.mean(axis=1)
    straight = (1 - T[:, None]) * BOARD_A.mean(axis=0) + T[:, None] * BOARD_B.mean(axis=0)
    assert np.allclose(middles, straight)


def test_colours_dissolve_in_light() -> None:
    black, white = plain((0, 0, 0)), plain((255, 255, 255))
    transition = Transition.between(
        black, white, [one_quad(BOARD_A, BOARD_A)], np.array([0.5]), background=black
    )
    frame = transition.frame(0)
    assert frame[15, 20].tolist() == [188, 188, 188]
    assert frame[45, 60].tolist() == [0, 0, 0]


def test_clear_pixels_leave_no_dark_seam() -> None:
    """White that fades out over white stays white, whatever colour hides in its clear pixels."""
    pixels = np.zeros((48, 64, 4), np.uint8)
    pixels[:, 20:44] = 255
    picture = Picture.of(pixels)
    turned = np.array([[10.0, -4.0], [66.0, 10.0], [52.0, 58.0], [-4.0, 40.0]])
    whole = np.array([[0.0, 0.0], [64.0, 0.0], [64.0, 48.0], [0.0, 48.0]])
    transition = Transition.between(
        picture, picture, [one_quad(whole, turned)], T, background=(1.0, 1.0, 1.0, 1.0)
    )
    for k in range(len(T)):
        assert transition.frame(k).min() == 255


@pytest.mark.parametrize("near", [0, 1])
def test_the_later_mesh_is_in_front_all_the_way(near: int) -> None:
    square = np.array([[10.0, 10.0], [30.0, 10.0], [30.0, 30.0], [10.0, 30.0]])
    beside = square + np.array([24, 0])
    split = np.full((48, 64, 3), (255, 0, 0), np.uint8)
    split[:, 32:] = (0, 0, 255)
    a, b = Picture.of(split), Picture.of(split[:, ::-1])
    meshes = [one_quad(square, beside), one_quad(beside, square)]
    transition = Transition.between(
        a, b, meshes if near else meshes[::-1], np.linspace(0, 1, 9), background=(0, 0, 0, 1)
    )
    front = (0, 0, 255) if near else (255, 0, 0)
    assert transition.frame(4)[20, 32].tolist() == list(front)


def test_backgrounds() -> None:
    a, b = plain((255, 0, 0)), plain((0, 0, 255))
    corner = one_quad(BOARD_A / 8, BOARD_A / 8)
    half = np.array([0.5])

    def behind(background: object) -> list[int]:
        frame = Transition.between(a, b, [corner], half, background=background).frame(0)  # type: ignore[arg-type]
        return [int(value) for value in frame[40, 50]]

    assert behind("keep") == [255, 0, 0]
    assert behind("dissolve") == [188, 0, 188]
    assert behind((0.0, 1.0, 0.0, 1.0)) == [0, 255, 0]
    assert behind((0.0, 1.0, 0.0, 0.5)) == [0, 255, 0, 128]
    assert behind(plain((9, 8, 7))) == [9, 8, 7]
    assert behind(plain((9, 8, 7, 255), 32, 24)) == [9, 8, 7]
    with pytest.raises(OptionError, match="neither 'keep' nor 'dissolve'"):
        behind("stay")


def test_what_moves_leaves_no_ghost_behind() -> None:
    """Neither where it was nor where it will be is anything of it seen on the way."""
    pytest.importorskip("cv2", reason="OpenCV is not installed")
    ground = np.full((96, 128, 3), (90, 140, 200), np.uint8)
    boards = np.array([[10, 20], [110, 60]])
    pictures = []
    for left, top in boards.tolist():
        pixels = ground.copy()
        pixels[top : top + 12, left : left + 12] = (250, 30, 20)
        pictures.append(Picture.of(pixels))
    corners = np.array([[0.0, 0.0], [12.0, 0.0], [12.0, 12.0], [0.0, 12.0]])
    moving = one_quad(corners + boards[0], corners + boards[1])
    times = np.array([0.0, 0.5, 1.0])
    shown = {
        way: Transition.between(pictures[0], pictures[1], [moving], times, background=way)
        for way in ("fill", "dissolve")
    }
    for k, picture in ((0, pictures[0]), (2, pictures[1])):
        np.testing.assert_array_equal(shown["fill"].frame(k), shown["dissolve"].frame(k))
        assert picture.width == 128
    for left, top in boards.tolist():
        place = slice(top - 2, top + 14), slice(left - 2, left + 14)
        off = {
            way: np.abs(found.frame(1)[place].astype(int) - (90, 140, 200)).max()
            for way, found in shown.items()
        }
        assert off["fill"] <= 3
        assert off["dissolve"] > 50


def test_a_large_picture_is_filled_and_a_clear_one_stays_clear() -> None:
    pytest.importorskip("cv2", reason="OpenCV is not installed")
    light = np.zeros((900, 1200, 4), np.uint16)
    light[:, :600] = FULL
    covered = np.zeros((900, 1200), bool)
    covered[300:500, 200:400] = covered[300:500, 800:1000] = True
    light[covered] = (0, 0, 0, FULL)
    found = filled(light, covered)
    assert found[400, 300].min() > 0.98 * FULL
    assert found[400, 900].max() < 0.02 * FULL
    np.testing.assert_array_equal(found[~covered][:1000], light[~covered][:1000])
    everything = np.ones((900, 1200), bool)
    np.testing.assert_array_equal(filled(light, everything), light)


def test_without_opencv_it_says_what_is_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shapetween.photo.filling.can_fill", lambda: False)
    with pytest.raises(OptionError, match="needs OpenCV; pip install shapetween"):
        filled(np.zeros((4, 4, 4), np.uint16), np.ones((4, 4), bool))


def test_pictures_of_other_sizes_are_fitted() -> None:
    """B is twice as large and wider: scaled evenly, in the middle."""
    assert fitted(128, 48, (64, 48)).tolist() == [[0.5, 0, 0], [0, 0.5, 12]]
    a, b = plain((255, 0, 0)), plain((0, 0, 255), 128, 48)
    transition = Transition.between(a, b, [], np.array([0.0, 1.0]))
    assert not transition.opaque
    last = transition.frame(1)
    assert last[24, 30].tolist() == [0, 0, 255, 255]
    assert last[4, 30, 3] == 0


def test_frames_of_another_size() -> None:
    a = noise()
    large = Transition.between(
        Picture.of(a), Picture.of(a), [one_quad(BOARD_A, BOARD_B)], T, size=(128, 96)
    )
    assert large.frame(2).shape == (96, 128, 3)
    small = Transition.between(
        Picture.of(a), Picture.of(a), [one_quad(BOARD_A, BOARD_A)], T, size=(32, 24)
    )
    light = (a.astype(np.float64) / 255) ** 2.2
    means = light.reshape(24, 2, 32, 2, 3).mean(axis=(1, 3)) ** (1 / 2.2) * 255
    # Shrunk by area: pixels are the means of four, not one of them.
    assert np.abs(small.frame(0)[6:10, 8:14] - means[6:10, 8:14]).max() < 12


def test_fine_patterns_do_not_shimmer_where_they_shrink() -> None:
    """Stripes of one pixel seen from afar are even grey, not waves."""
    stripes = np.zeros((256, 256, 3), np.uint8)
    stripes[:, ::2] = 255
    picture = Picture.of(stripes)
    whole = np.array([[0.0, 0.0], [256.0, 0.0], [256.0, 256.0], [0.0, 256.0]])
    far = np.array([[20.0, 20.0], [71.0, 26.0], [69.0, 66.0], [23.0, 77.0]])
    frame = shown(picture, whole, far)[32:60, 30:62, 0].astype(int)
    assert np.abs(frame - 188).max() < 25


def test_quads_reaching_beyond_the_picture_are_cut() -> None:
    red = plain((255, 0, 0))
    beyond = np.array([[-20.0, 10.0], [30.0, 10.0], [30.0, 40.0], [-20.0, 40.0]])
    row = shown(red, beyond, beyond + np.array([30, 0]), behind=0)[25, :, 0]
    assert (row[:29] == 0).all()
    assert (row[31:59] == 255).all()


def test_a_quad_that_fails_on_the_way_becomes_triangles() -> None:
    """Turned by half a turn in straight lines, a quad shrinks to a point and back."""
    a = noise()
    transition = Transition.between(
        Picture.of(a),
        Picture.of(a),
        [one_quad(BOARD_A, BOARD_A[[2, 3, 0, 1]])],
        np.linspace(0, 1, 5),
        method="linear",
    )
    assert transition.layers[0].split == (0,)
    assert "quad 0 does not stay convex: two triangles instead" in transition.warnings[0]
    for k in range(5):
        assert transition.frame(k).shape == (48, 64, 3)


def test_a_quad_without_an_in_between_is_named() -> None:
    with pytest.raises(MeshError, match="quad 0: inverted"):
        Transition.between(
            plain((0, 0, 0)), plain((0, 0, 0)), [one_quad(BOARD_A, BOARD_A[::-1])], T
        )


def test_frames_come_in_order_and_few_at_a_time() -> None:
    a = Picture.of(noise())
    transition = Transition.between(a, a, [one_quad(BOARD_A, BOARD_B)], np.linspace(0, 1, 12))
    order = [*range(12), *range(10, 0, -1)]
    single = [transition.frame(k) for k in order]
    before = threading.active_count()
    for workers in (1, 3):
        for drawn, expected in zip(transition.frames(order, workers), single, strict=True):
            assert (drawn == expected).all()
    stopped = transition.frames(order, 2)
    next(stopped)
    stopped.close()
    assert threading.active_count() == before
