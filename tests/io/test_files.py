"""Files whole or not at all."""

import errno
import os
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from shapetween.base.errors import BudgetError, InputError, OptionError
from shapetween.io.files import check_outputs, read_bytes, read_text, write_frames, write_text


def listing(folder: Path) -> dict[str, str]:
    """Every file and folder under a folder, and what it holds."""
    return {
        str(path.relative_to(folder)): path.read_text("utf-8") if path.is_file() else ""
        for path in sorted(folder.rglob("*"))
    }


def full_disk(*_: object, **__: object) -> int:
    raise OSError(errno.ENOSPC, "No space left on device")


def test_reading(tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    path.write_bytes(b"\xef\xbb\xbf<svg/>")
    assert read_bytes(path) == b"\xef\xbb\xbf<svg/>"
    assert read_text(path) == "<svg/>"


def test_what_cannot_be_read_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match=r"none\.svg: there is no such file"):
        read_bytes(tmp_path / "none.svg")
    with pytest.raises(InputError, match="is a folder"):
        read_bytes(tmp_path)
    with pytest.raises(InputError, match="not the name of a file"):
        read_bytes(Path("a\0b"))
    (tmp_path / "big").write_bytes(b"x" * 11)
    with pytest.raises(BudgetError, match="big: larger than the 10 bytes"):
        read_bytes(tmp_path / "big", limit=10)
    assert len(read_bytes(tmp_path / "big", limit=11)) == 11
    (tmp_path / "latin").write_bytes(b"caf\xe9")
    with pytest.raises(InputError, match="latin: byte 3 is not UTF-8"):
        read_text(tmp_path / "latin")

    def forbidden(*_: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "open", forbidden)
    with pytest.raises(InputError, match="big: permission denied"):
        read_bytes(tmp_path / "big")


def test_a_pipe_is_written_to_and_stays_one(tmp_path: Path) -> None:
    """By the name that shells and systems give it, a link that leads to no place on a disk."""
    read, write = os.pipe()
    check_outputs([Path(f"/dev/fd/{write}")], [])
    write_text(Path(f"/dev/fd/{write}"), "through")
    os.close(write)
    with os.fdopen(read) as stream:
        assert stream.read() == "through"


def test_a_folder_that_may_not_be_written_to_is_named_before_any_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(OptionError, match="may not be written to"):
        check_outputs([tmp_path / "out.svg"], [])


def test_writing_replaces_a_file_and_keeps_its_mode(tmp_path: Path) -> None:
    path = tmp_path / "out.svg"
    write_text(path, "one\n")
    assert stat.S_IMODE(path.stat().st_mode) == 0o666 & ~current_umask()
    path.chmod(0o640)
    write_text(path, "é\n")
    assert path.read_bytes() == b"\xc3\xa9\n"
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert list(listing(tmp_path)) == ["out.svg"]


def current_umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_links_and_devices_are_written_through(tmp_path: Path) -> None:
    target, link = tmp_path / "target.svg", tmp_path / "link.svg"
    target.write_text("old", "utf-8")
    link.symlink_to(target)
    write_text(link, "new")
    assert link.is_symlink()
    assert target.read_text("utf-8") == "new"
    write_text(Path(os.devnull), "gone")
    assert Path(os.devnull).is_char_device()


@pytest.mark.parametrize(
    ("name", "message"),
    [("no/out.svg", "there is no folder"), (".", "is a folder"), ("file/out.svg", "no folder")],
)
def test_places_that_cannot_be_written_are_named(tmp_path: Path, name: str, message: str) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    before = listing(tmp_path)
    with pytest.raises(OptionError, match=message):
        write_text(tmp_path / name, "text")
    assert listing(tmp_path) == before


def test_a_write_that_fails_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "out.svg"
    path.write_text("old", "utf-8")
    monkeypatch.setattr(Path, "write_text", full_disk)
    with pytest.raises(OptionError, match=r"out\.svg: cannot be written: no space left"):
        write_text(path, "new")
    assert listing(tmp_path) == {"out.svg": "old"}


def test_frames_make_their_folder(tmp_path: Path) -> None:
    assert write_frames(tmp_path / "frames", (f"frame {k}" for k in range(3))) == 3
    assert listing(tmp_path / "frames") == {f"frame_{k:04}.svg": f"frame {k}" for k in range(3)}
    assert list(tmp_path.iterdir()) == [tmp_path / "frames"]


def test_frames_replace_those_of_an_earlier_run_only(tmp_path: Path) -> None:
    write_frames(tmp_path, ["old"] * 5)
    kept = {"notes.txt": "mine", "frame_one.svg": "mine", "frame_0001.svg.bak": "mine"}
    for name, text in kept.items():
        (tmp_path / name).write_text(text, "utf-8")
    write_frames(tmp_path, ["new", "new"])
    assert listing(tmp_path) == kept | {"frame_0000.svg": "new", "frame_0001.svg": "new"}


def test_frames_that_cannot_be_made_leave_the_old_ones(tmp_path: Path) -> None:
    write_frames(tmp_path, ["old", "old"])
    before = listing(tmp_path)

    def failing() -> Iterator[str]:
        yield "new"
        raise OptionError("cannot go on")

    with pytest.raises(OptionError, match="cannot go on"):
        write_frames(tmp_path, failing())
    assert listing(tmp_path) == before


@pytest.mark.parametrize("failing_move", range(5))
def test_frames_that_cannot_be_moved_leave_the_old_ones(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing_move: int
) -> None:
    write_frames(tmp_path, ["old", "old"])
    before = listing(tmp_path)
    moves = iter(range(100))
    rename = Path.rename

    def sometimes(self: Path, target: Path) -> Path:
        if next(moves) == failing_move:
            raise OSError(errno.EIO, "Input/output error")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", sometimes)
    with pytest.raises(OptionError, match="input/output error"):
        write_frames(tmp_path, ["new"] * 3)
    assert listing(tmp_path) == before


def test_frames_need_a_folder(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("mine", "utf-8")
    with pytest.raises(OptionError, match="is not a folder"):
        write_frames(tmp_path / "taken", ["frame"])
    with pytest.raises(OptionError, match="there is no folder"):
        write_frames(tmp_path / "no" / "frames", ["frame"])


def test_inputs_and_other_outputs_are_not_overwritten(tmp_path: Path) -> None:
    a, b, out = tmp_path / "a.svg", tmp_path / "b.svg", tmp_path / "out.svg"
    for path in (a, b):
        path.write_text("", "utf-8")
    check_outputs([out, tmp_path / "report.json"], [a, b])
    (tmp_path / "link.svg").symlink_to(a)
    for output in (a, tmp_path / "." / "b.svg", tmp_path / "link.svg"):
        with pytest.raises(OptionError, match="is an input"):
            check_outputs([output], [a, b])
    with pytest.raises(OptionError, match="is written twice"):
        check_outputs([out, tmp_path / ".." / tmp_path.name / "out.svg"], [a, b])
    with pytest.raises(OptionError, match="there is no folder"):
        check_outputs([tmp_path / "no" / "out.svg"], [a, b])


def test_frames_overwrite_no_input(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    write_frames(folder, ["one", "two"])
    frame, mine = folder / "frame_0001.svg", folder / "mine.svg"
    mine.write_text("", "utf-8")
    link, shown = tmp_path / "link.svg", folder / "frame_0002.svg"
    link.symlink_to(frame)
    shown.symlink_to(mine)
    for path in (frame, folder / ".." / "frames" / frame.name, link, shown):
        with pytest.raises(OptionError, match=r"is an input, and frames .*expected another folder"):
            check_outputs([folder], [path])
    check_outputs([folder], [mine, tmp_path / "no" / "frame_0000.svg"])
    check_outputs([tmp_path / "other"], [frame])


def test_names_too_long_are_refused_before_any_work(tmp_path: Path) -> None:
    for name in ("x" * 300, "x" * 300 + "/out.svg"):
        with pytest.raises(OptionError, match="cannot be written: file name too long"):
            check_outputs([tmp_path / name], [])
