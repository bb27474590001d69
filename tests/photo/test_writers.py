import subprocess
import sys
import weakref
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.errors import OptionError
from shapetween.raster.encode import WRITERS, Clock, writer_for
from shapetween.raster.encode.timing import Patch, patch_between
from shapetween.raster.encode.video import write_video
from shapetween.raster.light import Bytes

Image = pytest.importorskip("PIL.Image")

COUNT = 6


def frames(channels: int = 3, width: int = 40, height: int = 30) -> Iterator[Bytes]:
    """A soft disc that moves over a ramp; with four channels the ramp is clear at its left."""
    y, x = np.mgrid[:height, :width]
    for k in range(COUNT):
        ramp = np.stack([x * 6, y * 8, x + y], axis=-1).astype(np.float64)
        disc = np.clip(6 - np.hypot(x - 8 - 4 * k, y - 14), 0, 1)[..., None]
        frame = (1 - disc) * ramp + disc * (250, 240, 40)
        if channels == 4:
            alpha = np.where((x > 12)[..., None] | (disc > 0), 255.0, 0.0)
            frame = np.concatenate([frame, alpha], axis=2)
        yield np.rint(frame).astype(np.uint8)


def played(path: Path, mode: str) -> tuple[list[Bytes], list[float]]:
    """Frames as a player shows them, and their milliseconds."""
    with Image.open(path) as image:
        shown, durations = [], []
        for k in range(image.n_frames):
            image.seek(k)
            image.load()
            durations.append(image.info["duration"])
            shown.append(np.array(image.convert(mode)))
    return shown, durations


@pytest.mark.parametrize("channels", [3, 4])
@pytest.mark.parametrize(
    ("name", "tolerance"), [("a.png", 0), ("a.apng", 0), ("a.webp", 6), ("a.gif", 9)]
)
def test_animations_play_what_was_written(
    tmp_path: Path, name: str, tolerance: float, channels: int
) -> None:
    path = tmp_path / name
    writer_for(path)(path, frames(channels), Clock(COUNT, 25.0, repeats=True))
    mode = "RGB" if channels == 3 else "RGBA"
    shown, durations = played(path, mode)
    assert len(shown) == COUNT
    assert durations == [40] * COUNT
    for found, expected in zip(shown, frames(channels), strict=True):
        if channels == 4:
            assert (found[..., 3] == expected[..., 3]).all()
            found, expected = found[found[..., 3] > 0], expected[expected[..., 3] > 0]
        assert np.abs(found.astype(int) - expected).mean() <= tolerance
    with Image.open(path) as image:
        assert image.info["loop"] == 0


@pytest.mark.parametrize("name", ["a.png", "a.webp", "a.gif"])
def test_played_once(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    writer_for(path)(path, frames(), Clock(COUNT, 25.0, repeats=False))
    with Image.open(path) as image:
        assert image.info.get("loop") in (None, 1)


@pytest.mark.parametrize("name", ["a.png", "a.webp", "a.gif", "b"])
def test_the_same_bytes(tmp_path: Path, name: str) -> None:
    texts = []
    for folder in ("one", "two"):
        (tmp_path / folder).mkdir()
        path = tmp_path / folder / name
        writer_for(path)(path, frames(), Clock(COUNT, 12.0, repeats=True))
        files = sorted(path.iterdir()) if path.is_dir() else [path]
        texts.append([file.read_bytes() for file in files])
    assert texts[0] == texts[1]


def test_a_still_moment_costs_next_to_nothing(tmp_path: Path) -> None:
    """Only what changed is stored."""
    noise = np.random.default_rng(0).integers(0, 256, (60, 60, 3), dtype=np.uint8)
    sizes = {}
    for name in ("a.png", "a.webp", "a.gif"):
        for count in (1, 30):
            path = tmp_path / name
            writer_for(path)(path, [noise] * count, Clock(count, 25.0, repeats=True))
            sizes[name, count] = path.stat().st_size
        # A GIF's frame has a palette of 768 bytes.
        assert sizes[name, 30] - sizes[name, 1] < 30 * 900


def test_a_folder_of_frames(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "frame_0009.png").write_bytes(b"of an earlier run")
    (folder / "notes.txt").write_text("mine")
    writer_for(folder)(folder, frames(), Clock(COUNT, 25.0, repeats=True))
    names = [f"frame_{k:04}.png" for k in range(COUNT)]
    assert sorted(path.name for path in folder.iterdir()) == [*names, "notes.txt"]
    for name, expected in zip(names, frames(), strict=True):
        with Image.open(folder / name) as image:
            assert (np.array(image) == expected).all()


@pytest.mark.parametrize("ending", [ending for ending in WRITERS if ending != ".mp4"])
def test_frames_are_streamed(tmp_path: Path, ending: str) -> None:
    """A writer asks for a frame only when it is done with the ones before."""
    made: list[weakref.ref[Bytes]] = []

    def watched() -> Iterator[Bytes]:
        for _ in range(3):
            for frame in frames():
                made.append(weakref.ref(frame))
                assert sum(ref() is not None for ref in made) <= 3
                yield frame

    path = tmp_path / f"a{ending}"
    writer_for(path)(path, watched(), Clock(3 * COUNT, 25.0, repeats=True))


def test_rounded_times_do_not_add_up() -> None:
    clock = Clock(90, 30.0, repeats=True)
    assert sum(clock.ticks(k, 1000) for k in range(90)) == 3000
    assert sum(clock.ticks(k, 100) for k in range(90)) == 300


def test_patches() -> None:
    before = np.zeros((9, 12, 3), np.uint8)
    after = before.copy()
    assert patch_between(None, after) == Patch(0, 0, 12, 9)
    assert patch_between(before, after) == Patch(0, 0, 1, 1)
    after[3:5, 5:8, 1] = 1
    assert patch_between(before, after) == Patch(5, 3, 3, 2)
    assert patch_between(before, after, step=2) == Patch(4, 2, 4, 3)
    assert patch_between(before, after).of(after)[..., 1].all()


def test_endings(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=r"a\.avi: expected an ending of \.png, \.apng, \.webp"):
        writer_for(tmp_path / "a.avi")
    folder = tmp_path / "frames.v2"
    folder.mkdir()
    assert writer_for(folder) is WRITERS[""]


def test_gif_has_a_speed_limit(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="at most 50 frames a second"):
        writer_for(tmp_path / "a.gif")(tmp_path / "a.gif", frames(), Clock(COUNT, 60, repeats=True))


def test_a_failure_leaves_what_was_there(tmp_path: Path) -> None:
    def failing() -> Iterator[Bytes]:
        yield from frames()
        raise OptionError("stopped")

    for name in ("a.png", "a.webp", "a.gif"):
        path = tmp_path / name
        path.write_bytes(b"before")
        with pytest.raises(OptionError, match="stopped"):
            writer_for(path)(path, failing(), Clock(COUNT, 25.0, repeats=True))
        assert path.read_bytes() == b"before"
        assert len(list(tmp_path.iterdir())) == 1
        path.unlink()


@pytest.mark.parametrize("size", [(40, 30), (41, 31)])
def test_video(tmp_path: Path, size: tuple[int, int]) -> None:
    """Read back by ffmpeg itself; odd sizes get a row and a column."""
    ffmpeg = pytest.importorskip("imageio_ffmpeg").get_ffmpeg_exe()
    path = tmp_path / "a.mp4"
    write_video(path, frames(3, *size), Clock(COUNT, 12.5, repeats=False))
    command = [ffmpeg, "-loglevel", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24"]
    raw = subprocess.run([*command, "-"], capture_output=True, check=True).stdout
    width, height = (part + part % 2 for part in size)
    shown = np.frombuffer(raw, np.uint8).reshape(COUNT, height, width, 3)
    for found, expected in zip(shown, frames(3, *size), strict=True):
        assert np.abs(found[: size[1], : size[0]].astype(int) - expected).mean() < 8


def test_video_without_ffmpeg(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(OptionError, match=r"pip install 'shapetween\[video\]'"):
        write_video(tmp_path / "a.mp4", frames(), Clock(COUNT, 25.0, repeats=False))


def test_video_when_ffmpeg_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "ffmpeg"
    program.write_text("#!/bin/sh\necho no such codec >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")
    with pytest.raises(OptionError, match="ffmpeg failed: no such codec"):
        write_video(tmp_path / "a.mp4", frames(), Clock(COUNT, 25.0, repeats=False))
    assert not (tmp_path / "a.mp4").exists()


def test_pixels_that_stay_do_not_flicker_in_a_gif(tmp_path: Path) -> None:
    """A small square crosses a ramp of more colours than a palette has."""
    rows, columns = np.indices((64, 64))
    ramp = np.stack([4 * rows, 4 * columns, 2 * (rows + columns)], axis=-1).astype(np.uint8)
    shown = []
    for k in range(5):
        frame = ramp.copy()
        frame[10 * k : 10 * k + 12, 10 * k : 10 * k + 12] = (255, 40 * k, 0)
        shown.append(frame)
    writer_for(tmp_path / "a.gif")(tmp_path / "a.gif", iter(shown), Clock(5, 10, repeats=True))
    found = []
    with Image.open(tmp_path / "a.gif") as image:
        for k in range(5):
            image.seek(k)
            found.append(np.array(image.convert("RGB")))
    for k in range(4):
        still = (shown[k] == shown[k + 1]).all(axis=2)
        assert (found[k][still] == found[k + 1][still]).all()
        assert np.abs(found[k].astype(int) - shown[k]).mean() < 9
