"""What moves, from drawings laid over pictures."""

from pathlib import Path

import numpy as np
import pytest

from shapetween.base.errors import MeshError, OutlineError
from shapetween.photo.sources import light_of_colour, read_moving
from shapetween.photo.transition import Transition
from shapetween.raster.light import Bytes
from shapetween.raster.picture import Picture

SIZE = 120


def disc(rx: float, ry: float) -> Bytes:
    """A red ellipse in the middle of a white picture, soft by a pixel."""
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5 - SIZE / 2
    inside = np.clip((1 - np.hypot(x / rx, y / ry)) * min(rx, ry) + 0.5, 0, 1)[..., None]
    return np.asarray(np.rint(255 * (1 - inside) + np.array([220, 30, 40]) * inside), np.uint8)


def drawn(path: Path, rx: float, ry: float, attributes: str) -> Path:
    """An ellipse drawn over a picture, in a view box of another size than the picture's."""
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-30 -30 60 60">'
        f'<ellipse rx="{rx / 2}" ry="{ry / 2}" {attributes}/></svg>'
    )
    return path


@pytest.mark.parametrize("attributes", ['fill="#d33"', 'fill="none" stroke="blue"'])
def test_outlines_carry_what_is_inside_them(tmp_path: Path, attributes: str) -> None:
    """However they are painted, and all of it: the mesh follows the curve."""
    values = disc(50, 30), disc(28, 46)
    a, b = (Picture.of(part) for part in values)
    outlines = (
        drawn(tmp_path / "a.svg", 51, 31, attributes),
        drawn(tmp_path / "b.svg", 29, 47, attributes),
    )
    moving = read_moving((a, b), outlines=outlines)
    transition = Transition.between(
        a, b, moving.pieces, np.array([0.0, 0.5, 1.0]), background=(1.0, 1.0, 1.0, 1.0)
    )
    for frame, expected in zip((0, 2), values, strict=True):
        assert np.abs(transition.frame(frame).astype(int) - expected).mean() < 0.5
    middle = transition.frame(1)
    assert np.abs(middle[55:65, 55:65].astype(int) - (220, 30, 40)).max() <= 1
    red = (middle[..., 1] < 140).sum()
    assert red == pytest.approx(np.pi * (50 * 30 + 28 * 46) / 2, rel=0.03)


def test_outlines_without_an_inside(tmp_path: Path) -> None:
    picture = Picture.of(disc(50, 30))
    line = tmp_path / "line.svg"
    line.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        '<path d="M0 0L5 5" stroke="red"/></svg>'
    )
    with pytest.raises(OutlineError, match=r"line\.svg: .*encloses no area"):
        read_moving((picture, picture), outlines=(line, line))


def test_a_mesh_that_cannot_move_is_named(tmp_path: Path) -> None:
    picture = Picture.of(disc(50, 30))
    path = tmp_path / "m.json"
    path.write_text(
        '{"source": [[0,0],[9,0],[9,9],[0,9]], "target": [[0,0],[9,0],[2,2],[0,9]], '
        '"quads": [[0,1,2,3]]}'
    )
    with pytest.raises(MeshError, match=r"m\.json: target: quad 0 is not convex at vertex 2"):
        read_moving((picture, picture), mesh=path)


@pytest.mark.parametrize(
    ("text", "light"),
    [
        ("#fff", (1.0, 1.0, 1.0, 1.0)),
        ("transparent", (0.0, 0.0, 0.0, 0.0)),
        ("rgb(188 0 0 / 50%)", (0.5, 0.0, 0.0, 0.5)),
        ("mauv", None),
        ("none", None),
        ("url(#a)", None),
    ],
)
def test_colours(text: str, light: tuple[float, ...] | None) -> None:
    found = light_of_colour(text)
    assert found == (None if light is None else pytest.approx(light, abs=0.005))
