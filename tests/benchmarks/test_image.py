"""Speed, memory and values of warped pictures, beside OpenCV's where it is installed.

python -m pytest tests/benchmarks/test_image.py --benchmark-enable -s
"""

import resource
import time
from typing import Any

import numpy as np
import pytest

from shapetween.geometry.homography import quad_homographies
from shapetween.mesh.pair import MeshPair
from shapetween.photo.layers import Piece
from shapetween.photo.transition import Transition
from shapetween.raster.light import Bytes
from shapetween.raster.picture import Picture
from tests.photo.scenes import shown

WIDTH, HEIGHT, FRAMES = 1920, 1080, 60


def photograph(seed: int) -> Bytes:
    """Smooth colours with some grain."""
    rng = np.random.default_rng(seed)
    coarse = rng.integers(0, 256, (9, 16, 3)).astype(np.float64)
    x, y = np.linspace(0, 14.99, WIDTH), np.linspace(0, 7.99, HEIGHT)
    i, j = x.astype(int), y.astype(int)
    fx, fy = (x - i)[None, :, None], (y - j)[:, None, None]
    upper = coarse[j][:, i] * (1 - fx) + coarse[j][:, i + 1] * fx
    lower = coarse[j + 1][:, i] * (1 - fx) + coarse[j + 1][:, i + 1] * fx
    grain = rng.normal(0, 6, (HEIGHT, WIDTH, 3))
    mixed = upper * (1 - fy) + lower * fy + grain
    return np.asarray(np.clip(mixed, 0, 255).astype(np.uint8))


def five_boards() -> list[Piece]:
    """Boards of 640 x 160 and so that change places and lean."""
    boards = []
    for k in range(5):
        a = np.array([[0.0, 0.0], [640, 40 - 12 * k], [620, 170], [10, 190 + 8 * k]])
        b = np.array([[20.0, 10 * k], [560, 0], [600, 200], [0, 160]])
        a += [200 + 150 * k, 60 + 170 * k]
        b += [1100 - 190 * k, 60 + 170 * ((2 * k + 1) % 5)]
        boards.append(Piece(MeshPair(a, b, np.array([[0, 1, 2, 3]]))))
    return boards


def prepared() -> Transition:
    a, b = Picture.of(photograph(1)), Picture.of(photograph(2))
    return Transition.between(a, b, five_boards(), np.linspace(0, 1, FRAMES))


def test_a_frame_with_five_boards(benchmark: Any) -> None:
    transition = prepared()
    benchmark.pedantic(transition.frame, (FRAMES // 2,), rounds=5)


@pytest.mark.skipif("not config.getoption('benchmark_enable')", reason="takes half a minute")
def test_sixty_frames_on_two_cores() -> None:
    transition = prepared()
    start, worked = time.perf_counter(), time.process_time()
    for frame in transition.frames(workers=2):
        assert frame.shape == (HEIGHT, WIDTH, 3)
    seconds, worked = time.perf_counter() - start, time.process_time() - worked
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{FRAMES} frames: {seconds:.1f} s, {worked:.1f} s of work, {peak:.0f} MB at most")
    # Work, not time: others may use the machine as well.
    assert worked < 60
    assert peak < 1024


def test_one_board_beside_opencv(benchmark: Any) -> None:
    """A whole picture warped; OpenCV's own time is printed."""
    cv2 = pytest.importorskip("cv2")
    cv2.setNumThreads(1)
    values = photograph(1)
    picture = Picture.of(values)
    box = np.array([[0.0, 0.0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]])
    places = np.array([[60.0, 30.0], [1880, 90], [1850, 1060], [20, 1000]])
    matrix = quad_homographies(box[None], places[None])[0]
    start = time.process_time()
    for _ in range(5):
        cv2.warpPerspective(values, matrix, (WIDTH, HEIGHT))
    print(f"OpenCV: {(time.process_time() - start) / 5 * 1000:.0f} ms")
    benchmark.pedantic(shown, (picture, box, places), rounds=5)
