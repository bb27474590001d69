import io
import sys
import zlib
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.errors import BudgetError, InputError, OptionError
from shapetween.raster.light import Bytes, encode
from shapetween.raster.load import read_picture
from shapetween.raster.picture import Picture

Image = pytest.importorskip("PIL.Image")

PIXELS = np.random.default_rng(3).integers(0, 256, (6, 9, 4), dtype=np.uint8)


def values(picture: Picture) -> Bytes:
    return encode(picture.light.astype(np.float32) * np.float32(1 / 65535), opaque=picture.opaque)


@pytest.mark.parametrize("ending", ["png", "webp"])
def test_colours_come_back(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"a.{ending}"
    Image.fromarray(PIXELS[..., :3]).save(path, lossless=True)
    assert (values(read_picture(path)) == PIXELS[..., :3]).all()


def test_jpeg(tmp_path: Path) -> None:
    path = tmp_path / "a.jpg"
    smooth = np.add.outer(np.arange(16), np.arange(16))[..., None].repeat(3, axis=2) * 8
    Image.fromarray(smooth.astype(np.uint8)).save(path, quality=100)
    assert np.abs(values(read_picture(path)).astype(int) - smooth).max() <= 2


def test_alpha(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.fromarray(PIXELS).save(path)
    found = values(read_picture(path))
    assert (found[..., 3] == PIXELS[..., 3]).all()
    strong = PIXELS[..., 3] > 200
    assert np.abs(found.astype(int) - PIXELS)[strong].max() <= 1


def test_a_palette_with_a_clear_colour(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    image = Image.fromarray(np.array([[0, 1]], np.uint8))
    image.putpalette([255, 0, 0, 0, 0, 255])
    image.save(path, transparency=1)
    assert values(read_picture(path)).tolist() == [[[255, 0, 0, 255], [0, 0, 0, 0]]]


def test_sixteen_bit_grey_is_not_cut_off(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.fromarray(np.array([[0, 257 * 100, 65535]], np.uint16)).save(path)
    assert values(read_picture(path))[0, :, 0].tolist() == [0, 100, 255]


@pytest.mark.parametrize("orientation", range(1, 9))
def test_pictures_stand_upright(tmp_path: Path, orientation: int) -> None:
    """The corner pixel of each orientation comes to the top left, as EXIF 2.32 defines them."""
    path = tmp_path / "a.png"
    marked = np.zeros((4, 6, 3), np.uint8)
    corner = {1: (0, 0), 2: (0, -1), 3: (-1, -1), 4: (-1, 0), 5: (0, 0), 6: (-1, 0)}
    corner |= {7: (-1, -1), 8: (0, -1)}
    marked[corner[orientation]] = 255
    exif = Image.Exif()
    exif[0x0112] = orientation
    Image.fromarray(marked).save(path, exif=exif)
    found = values(read_picture(path))
    assert found.shape[:2] == ((4, 6) if orientation < 5 else (6, 4))
    assert found[0, 0].tolist() == [255, 255, 255]


def test_a_colour_profile_is_honoured(tmp_path: Path) -> None:
    """A picture in linear light with a profile that says so looks as it should in sRGB."""
    from PIL import ImageCms

    path = tmp_path / "a.png"
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("XYZ"))
    Image.new("RGB", (2, 2), (188, 120, 60)).save(path, icc_profile=profile.tobytes())
    picture = read_picture(path)
    # A profile for XYZ cannot be applied to red, green and blue: said, and taken as sRGB.
    assert "colour profile" in picture.warnings[0]
    srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB"))
    Image.new("RGB", (2, 2), (188, 120, 60)).save(path, icc_profile=srgb.tobytes())
    picture = read_picture(path)
    assert picture.warnings == ()
    assert np.abs(values(picture).astype(int) - (188, 120, 60)).max() <= 1


def test_a_gamma_of_its_own(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.new("RGB", (1, 1), (128, 128, 128)).save(path)
    data = path.read_bytes()
    chunk = b"gAMA" + (100_000).to_bytes(4, "big")
    chunk = (4).to_bytes(4, "big") + chunk + zlib.crc32(chunk).to_bytes(4, "big")
    path.write_bytes(data[:33] + chunk + data[33:])
    # Half of all light is 188 in sRGB.
    assert values(read_picture(path)).tolist() == [[[188, 188, 188]]]


def test_of_an_animation_the_first_frame(tmp_path: Path) -> None:
    path = tmp_path / "a.webp"
    frames = [Image.new("RGB", (4, 4), colour) for colour in ("red", "blue")]
    frames[0].save(path, save_all=True, append_images=frames[1:], lossless=True)
    picture = read_picture(path)
    assert values(picture)[0, 0].tolist() == [255, 0, 0]
    assert "animation" in picture.warnings[0]


def saved(ending: str) -> bytes:
    buffer = io.BytesIO()
    large = np.random.default_rng(1).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    Image.fromarray(large).save(buffer, ending)
    return buffer.getvalue()


@pytest.mark.parametrize("ending", ["PNG", "JPEG", "WEBP"])
@pytest.mark.parametrize("share", [0.002, 0.02, 0.5, 0.95])
def test_files_that_are_cut_off(tmp_path: Path, ending: str, share: float) -> None:
    path = tmp_path / "a.bin"
    data = saved(ending)
    path.write_bytes(data[: int(len(data) * share)])
    with pytest.raises(InputError, match=r"a\.bin: is ") as caught:
        read_picture(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("ending", ["PNG", "JPEG", "WEBP"])
def test_damaged_files_never_end_in_a_traceback(tmp_path: Path, ending: str) -> None:
    path = tmp_path / "a.bin"
    data = np.frombuffer(saved(ending), np.uint8)
    rng = np.random.default_rng(5)
    for _ in range(60):
        broken = data.copy()
        places = rng.integers(0, len(data) if rng.random() < 0.5 else 60, 3)
        broken[places] = rng.integers(0, 256, 3)
        path.write_bytes(broken.tobytes())
        with suppress(InputError):
            read_picture(path, 1.0)


@pytest.mark.parametrize("data", [b"", b"hello", b"<svg xmlns='http://www.w3.org/2000/svg'/>"])
def test_what_is_no_picture(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(data)
    with pytest.raises(InputError, match=r"a\.png: is not a picture; expected PNG, JPEG or WebP"):
        read_picture(path)


def test_a_missing_picture(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file"):
        read_picture(tmp_path / "none.png")


def test_the_pixel_budget(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.new("1", (2000, 1500)).save(path)
    with pytest.raises(BudgetError, match=r"2000 x 1500 pixels are 3\.0 megapixels; at most 2"):
        read_picture(path, 2)
    assert read_picture(path, 3).width == 2000


def test_a_bomb_is_refused_unread(tmp_path: Path) -> None:
    path = tmp_path / "bomb.png"
    Image.new("1", (8, 8)).save(path)
    data = bytearray(path.read_bytes())
    data[16:24] = (60_000).to_bytes(4, "big") * 2
    data[29:33] = zlib.crc32(bytes(data[12:29])).to_bytes(4, "big")
    path.write_bytes(data)
    with pytest.raises(BudgetError, match="at most 64 megapixels are read"):
        read_picture(path)


def test_without_pillow(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(OptionError, match=r"pip install 'shapetween\[image\]'"):
        read_picture(Path("a.png"))
