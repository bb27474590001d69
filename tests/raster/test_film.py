"""Movements as pictures, against resvg's own drawings of the ends and of what really happens."""

import base64
import io
from pathlib import Path

import numpy as np
import pytest

from shapetween.api import chain, morph
from shapetween.base.arrays import Floats
from shapetween.base.errors import InputError
from shapetween.model.paint import Colour
from shapetween.raster.film import Film, frame_size
from shapetween.raster.light import Bytes
from shapetween.raster.resvg import drawn, drawn_apart

pytest.importorskip("resvg_py")
Image = pytest.importorskip("PIL.Image")

SIZE = (240, 240)
WHITE = Colour(1, 1, 1)
STRIPES = (
    '<pattern id="p" width="24" height="14" patternUnits="userSpaceOnUse">'
    '<rect width="24" height="14" fill="#fc6"/><rect width="11" height="14" fill="#136"/>'
    '<circle cx="17" cy="7" r="4" fill="#b22"/></pattern>'
)
DOTS = (
    '<pattern id="p" width=".15" height=".15"><rect width="99" height="99" fill="#def"/>'
    '<circle cx="8" cy="8" r="6" fill="#064"/></pattern>'
)
EL = "M20 30H160V80H80V170H20Z"


def svg(body: str, box: str = "0 0 240 240") -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{body}</svg>'


def filled(pattern: str, transform: str = "", more: str = "") -> str:
    return svg(
        f'<defs>{pattern}</defs><g transform="{transform}">'
        f'<path id="el" fill="url(#p)" d="{EL}" {more}/></g>'
    )


def film(folder: Path, a: str, b: str, count: int = 3, background: Colour | None = WHITE) -> Film:
    for name, text in (("a.svg", a), ("b.svg", b)):
        (folder / name).write_text(text, "utf-8")
    found = morph(folder / "a.svg", folder / "b.svg", pictures=True)
    times = np.arange(count) / (count - 1)
    return Film.of([found.prepared.movement], times, size=SIZE, background=background)


def on_white(text: str) -> Floats:
    pixels = drawn(text, *SIZE).astype(np.float64)
    alpha = pixels[..., 3:] / 255
    return np.asarray(pixels[..., :3] * alpha + 255 * (1 - alpha))


def psnr(found: Bytes, wanted: Floats, margin: int = 0) -> float:
    """Of the pixels at least `margin` away from white ones of what is wanted."""
    from scipy.ndimage import binary_erosion

    inside = np.asarray((wanted < 254).any(axis=2))
    inside = binary_erosion(inside, iterations=margin) if margin else np.ones_like(inside)
    error = (found.astype(np.float64) - wanted)[inside]
    return float(10 * np.log10(255**2 / max(float((error**2).mean()), 1e-9)))


@pytest.mark.parametrize(
    "ends",
    [
        (filled(STRIPES), filled(DOTS, "rotate(50 120 120)")),
        (filled(STRIPES, "scale(.8)", 'fill-opacity=".6"'), filled(STRIPES, "translate(60 40)")),
        (filled(STRIPES, "", 'stroke="#000" stroke-width="6"'), svg(f'<path d="{EL}"/>')),
    ],
    ids=["other-pattern", "translucent", "colour"],
)
def test_ends_are_the_drawings_themselves(tmp_path: Path, ends: tuple[str, str]) -> None:
    frames = list(film(tmp_path, *ends).frames())
    assert psnr(frames[0], on_white(ends[0])) > 40
    assert psnr(frames[-1], on_white(ends[1])) > 40


def test_a_pattern_rides_on_its_shape(tmp_path: Path) -> None:
    """B is A turned, so every frame is A turned, to the last tile."""
    shown = film(tmp_path, filled(STRIPES), filled(STRIPES, "rotate(70 120 120)"))
    frame = list(shown.frames())[1]
    # The shape's middle goes straight; the outline says how far it has come.
    first, half = (
        drawing.shapes[0].rings[0].curves[:, 0]
        for drawing in shown.movements[0].at(np.array([0.0, 0.5]))
    )
    found = np.linalg.lstsq(np.c_[first, np.ones(len(first))], half, rcond=None)[0]
    assert np.degrees(np.arctan2(found[0, 1], found[0, 0])) == pytest.approx(35, abs=0.1)
    there = f"matrix({' '.join(map(str, found.ravel().tolist()))})"
    assert psnr(frame, on_white(filled(STRIPES, there)), margin=3) > 25
    shifted = STRIPES.replace('id="p"', 'id="p" patternTransform="translate(6)"')
    assert psnr(frame, on_white(filled(shifted, there)), margin=3) < 15


def test_halfway_is_mixed_in_light(tmp_path: Path) -> None:
    def plain(colour: str) -> str:
        tile = f'<pattern id="p" width="1" height="1"><rect width="240" height="240" {colour}/>'
        return filled(f"{tile}</pattern>")

    frame = list(film(tmp_path, plain('fill="#000"'), plain('fill="#fff"')).frames())[1]
    assert frame[50, 60].tolist() == [188, 188, 188]  # half of the light, not half of the value


def test_transparent_where_nothing_is(tmp_path: Path) -> None:
    frames = list(film(tmp_path, filled(STRIPES), filled(DOTS), background=None).frames())
    assert frames[1].shape == (*SIZE, 4)
    assert frames[1][0, 0].tolist() == [0, 0, 0, 0]
    assert frames[1][50, 60, 3] == 255


def png(colour: tuple[int, int, int]) -> bytes:
    file = io.BytesIO()
    values = np.full((20, 20, 3), colour, np.uint8)
    values[:, 10:] = 255 - values[:, 10:]
    Image.fromarray(values).save(file, "PNG")
    return file.getvalue()


def clipped(address: str) -> str:
    return svg(
        f'<clipPath id="c"><path d="{EL}"/></clipPath><image id="el" clip-path="url(#c)" '
        f'href="{address}" width="200" height="200" image-rendering="optimizeSpeed"/>'
    )


def test_a_picture_in_a_clip_path(tmp_path: Path) -> None:
    inside = "data:image/png;base64," + base64.b64encode(png((200, 40, 40))).decode()
    (tmp_path / "beside.png").write_bytes(png((40, 40, 200)))
    frames = list(film(tmp_path, clipped(inside), clipped("beside.png")).frames())
    assert frames[0][60, 50].tolist() == [200, 40, 40]
    assert frames[2][60, 50].tolist() == [40, 40, 200]
    assert frames[0][60, 140].tolist() == [55, 215, 215]
    assert frames[1][100, 150].tolist() == [255, 255, 255]


def test_pictures_from_elsewhere_are_left_out(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.png").write_bytes(png((9, 9, 9)))
    body = f'<path id="el" d="{EL}"/>'
    for address in (
        "../secret.png",
        str(tmp_path / "secret.png"),
        "file:///x.png",
        "http://x/y.png",
    ):
        (tmp_path / "in" / "a.svg").write_text(
            svg(f'{body}<image href="{address}" width="9" height="9"/>'), "utf-8"
        )
        found = morph(tmp_path / "in" / "a.svg", tmp_path / "in" / "a.svg", pictures=True)
        assert any("folder was left out" in warning for warning in found.warnings)
        assert len(found.at(0).shapes) == 1


def test_a_shape_that_leaves_takes_its_pattern_along(tmp_path: Path) -> None:
    dot = '<circle id="dot" cx="200" cy="200" r="20" fill="#000"/>'
    both = filled(STRIPES).replace("</svg>", dot + "</svg>")
    frames = list(film(tmp_path, both, svg(dot), count=9).frames())
    assert psnr(frames[0], on_white(both)) > 40
    assert (frames[8][:180] == 255).all()
    inked = [(frame[:180] < 250).any(axis=2).sum() for frame in frames]
    assert 0.4 < inked[2] / inked[0] < 0.95
    assert inked == sorted(inked, reverse=True)
    movement = morph(tmp_path / "a.svg", tmp_path / "b.svg", pictures=True).prepared.movement
    (part,) = (part for part in movement.parts if part.only is not None)
    # As drawn, many pixels for one: resvg leaves seams between the tiles of a smaller pattern.
    fine = Image.fromarray(drawn(filled(STRIPES), 8 * SIZE[0], 8 * SIZE[1]), "RGBA")
    white = Image.alpha_composite(Image.new("RGBA", fine.size, "white"), fine).convert("RGB")
    for k in (1, 2, 3):
        # Stripes and outline shrink by one similarity.
        home, now = (part.curves(np.array([t]))[0].reshape(-1, 2) for t in (0.0, k / 8))
        size = np.ptp(now, axis=0)[0] / np.ptp(home, axis=0)[0]
        x, y = 8 * (home[0] - now[0] / size)
        back = (1 / size, 0, x, 0, 1 / size, y)
        smaller = white.transform(fine.size, Image.Transform.AFFINE, back, fillcolor="white")
        wanted = np.asarray(smaller.resize(SIZE, Image.Resampling.BOX), np.float64)
        assert psnr(frames[k][:180], wanted[:180]) > 32


def test_patterns_of_many_shapes_ride_together(tmp_path: Path) -> None:
    """Two shapes of a drawing that only turns: halfway both patterns have turned by half of it."""
    parts = (
        '<path id="el" fill="url(#p)" d="M60 60H160V100H100V160H60Z"/>'
        '<circle id="dot" cx="150" cy="150" r="24" fill="url(#q)"/>'
    )
    more = STRIPES + STRIPES.replace('"p"', '"q"').replace("#136", "#631")

    def turned(transform: str) -> str:
        return svg(f'<defs>{more}</defs><g transform="{transform}">{parts}</g>')

    shown = film(tmp_path, turned(""), turned("rotate(60 120 120)"))
    frames = list(shown.frames())
    assert psnr(frames[2], on_white(turned("rotate(60 120 120)"))) > 40
    first, half = (
        np.concatenate([shape.rings[0].curves[:, 0] for shape in drawing.shapes])
        for drawing in shown.movements[0].at(np.array([0.0, 0.5]))
    )
    found = np.linalg.lstsq(np.c_[first, np.ones(len(first))], half, rcond=None)[0]
    there = f"matrix({' '.join(map(str, found.ravel().tolist()))})"
    assert psnr(frames[1], on_white(turned(there)), margin=3) > 25


def test_several_drawings_follow_each_other(tmp_path: Path) -> None:
    texts = [filled(STRIPES), filled(DOTS), filled(STRIPES, "rotate(90 120 120)")]
    for k, text in enumerate(texts):
        (tmp_path / f"{k}.svg").write_text(text, "utf-8")
    found = chain([tmp_path / f"{k}.svg" for k in range(3)], pictures=True)
    movements = [leg.prepared.movement for leg in found.legs]
    shown = Film.of(movements, np.array([0, 0.5, 1]), size=SIZE, background=WHITE)
    assert (shown.count, shown.ends) == (5, [0, 2, 4])
    for text, frame in zip(texts, shown.frames(shown.ends, workers=2), strict=True):
        assert psnr(frame, on_white(text)) > 40


def test_the_same_frames_whatever_the_order(tmp_path: Path) -> None:
    shown = film(tmp_path, filled(STRIPES), filled(DOTS, "rotate(40 120 120)"), count=4)
    there, back = list(shown.frames(workers=2)), list(shown.frames([3, 2, 1, 0]))
    for one, other in zip(there, back[::-1], strict=True):
        assert (one == other).all()


def test_what_cannot_be_drawn_is_told() -> None:
    with pytest.raises(InputError, match=r"it\.svg: a pattern or picture in it cannot be drawn"):
        drawn_apart("<svg", 10, 10, "it.svg")


def test_a_damaged_picture_is_told(tmp_path: Path) -> None:
    damaged = "data:image/png;base64," + base64.b64encode(png((1, 2, 3))[:40]).decode()
    shown = film(tmp_path, clipped(damaged), filled(STRIPES))
    assert shown.warnings == (f"{tmp_path / 'a.svg'}: a pattern or picture in it shows nothing",)


@pytest.mark.parametrize(
    "tile",
    [
        '<rect width="1e9" height="1e9"/><path d="M0 0L1e30 5"/>',
        '<rect width="9" height="9" fill="url(#p)"/>',
    ],
    ids=["huge", "of-itself"],
)
def test_hostile_patterns_end_as_a_film_or_a_line(tmp_path: Path, tile: str) -> None:
    """Some abort the renderer, which is therefore run apart."""
    pattern = f'<pattern id="p" width="1e9" height="1e9" patternUnits="userSpaceOnUse">{tile}'
    told = ""
    try:
        made = len(list(film(tmp_path, filled(f"{pattern}</pattern>"), filled(DOTS)).frames()))
    except InputError as error:
        told, made = str(error), 0
    assert made == 3 or told.endswith("a pattern or picture in it cannot be drawn")


def test_sizes(tmp_path: Path) -> None:
    box = morph(_saved(tmp_path), _saved(tmp_path)).at(0).box
    assert frame_size(box) == (800, 400)
    assert frame_size(box, (100,)) == (100, 50)
    assert frame_size(box, (30, 70)) == (30, 70)


def _saved(folder: Path) -> Path:
    place = folder / "wide.svg"
    place.write_text(svg(f'<path d="{EL}"/>', "0 0 20 10"), "utf-8")
    return place
