"""Who becomes whom: against pairs read off drawings by eye, and one small drawing of each kind."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapetween.geometry.affine import mapped
from shapetween.model.drawing import Box, Drawing
from shapetween.model.fit import fit_matrix
from shapetween.pipeline import Options, prepare
from shapetween.scene.asked import Asked
from shapetween.scene.features import Feature, features_of
from shapetween.scene.items import Item, items_of
from shapetween.scene.joining import joined_lines
from shapetween.scene.pairing import Paired, pair_items
from shapetween.scene.relations import Scene
from shapetween.scene.sets import sets_of
from shapetween.scene.strokes.outlined import as_lines
from shapetween.svg.read.reader import read_svg

DATA = Path(__file__).resolve().parents[1] / "data" / "pairing"
CORPUS = Path(__file__).resolve().parents[3] / "shared"
TRUTH = json.loads((DATA / "truth.json").read_text("utf-8"))

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'


def paired(first: Drawing, second: Drawing) -> tuple[Paired, tuple[Sequence[Item], Sequence[Item]]]:
    """Two drawings' pairs, and their items before any was cut."""
    matrix = fit_matrix(first, second, "view", "none")
    sides = first.shapes, second.transformed(matrix).shapes
    one, other = (joined_lines(items_of(side, "it")[0]) for side in sides)
    if len(one) > 1 or len(other) > 1:
        one, other = as_lines(one, other)
    views = corners(first.box), mapped(corners(second.box), matrix)
    return pair_items(one, other, views, Asked()), (one, other)


def corners(box: Box) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([[box.x, box.y], [box.x + box.width, box.y + box.height]])


def partners(first: str, second: str) -> tuple[dict[int, int], Paired]:
    """Pairs of two drawings of a hundred units, given as what is in them."""
    drawings = [read_svg(f"{HEAD}{text}</svg>".encode(), "it") for text in (first, second)]
    found, _ = paired(drawings[0], drawings[1])
    return {role.first: role.second for role in found.roles.pairs}, found


def features(scene: Scene) -> list[Feature]:
    return [Feature(int(kind)) for kind in features_of(scene, sets_of(scene)).kinds]


def looks(item: Item) -> list[float]:
    """What an item is known by, whatever its number."""
    points = item.points - item.points.mean(axis=0)
    extent = max(float(np.ptp(item.points, axis=0).max()), 1e-9)
    return [*item.box.ravel(), float((points[:, 0] * points[:, 1]).mean()) / extent, item.width]


def numbers(scene: Scene, items: Sequence[Item], known: Sequence[Sequence[float]]) -> list[int]:
    """Of each item of a scene the number that the truth calls it by."""
    found = []
    for k, item in enumerate(scene.items):
        own = item
        if len(scene.items) == len(items):
            own = items[k]
        elif not any(item is other for other in items):  # a piece is what it was cut from
            own = max(
                (other for other in items if other.shape == item.shape),
                key=lambda other: other.drawn.intersection(item.drawn).area - 1e-9 * other.area,
            )
        found.append(int(np.abs(np.array(known) - looks(own)).sum(axis=1).argmin()))
    return found


def counted(rows: Sequence[dict[str, Any]]) -> tuple[int, int, int, int]:
    """Pairs made, those of them that are wrong, pairs wanted, and those of them that are made."""
    made = wrong = wanted = right = 0
    for row in rows:
        files = [(CORPUS if name.startswith("corpus/") else DATA) / name for name in row["files"]]
        drawings = [read_svg(file.read_bytes(), file.name) for file in files]
        found, items = paired(drawings[0], drawings[1])
        names = [
            numbers(scene, own, known)
            for scene, own, known in zip(found.scenes, items, row["items"], strict=True)
        ]
        pairs = {(names[0][role.first], names[1][role.second]) for role in found.roles.pairs}
        must, may = ({tuple(pair) for pair in row[key]} for key in ("must", "may"))
        made += len(pairs)
        wrong += len(pairs - must - may)
        wanted += len(must)
        right += len(pairs & must)
    return made, wrong, wanted, right


@pytest.mark.parametrize("half", ["found", "held"])
@pytest.mark.parametrize("there", [True, False], ids=["here", "corpus"])
def test_pairs_are_those_that_a_person_makes(half: str, there: bool) -> None:
    rows = [
        row
        for row in TRUTH
        if row["half"] == half and row["files"][0].startswith("corpus/") != there
    ]
    if not there and not CORPUS.is_dir():
        pytest.skip("the corpus is not here")
    made, wrong, wanted, right = counted(rows)
    assert wrong <= 0.08 * made
    assert right >= 0.92 * wanted


FACE = '<circle cx="50" cy="50" r="46" fill="#fc5"/>'


def test_features_of_a_face_are_seen() -> None:
    text = (
        f'{FACE}<circle cx="34" cy="42" r="6"/><circle cx="66" cy="42" r="6"/>'
        '<path d="M28 28H40V31H28Z"/><path d="M60 28H72V31H60Z"/>'
        '<path d="M47 52H53L50 58Z"/><path d="M34 66H66Q50 86 34 66Z"/>'
    )
    _, found = partners(text, FACE)
    eyes, brows = [Feature.EYE] * 2, [Feature.BROW] * 2
    expected = [Feature(0), *eyes, *brows, Feature.NOSE, Feature.MOUTH]
    assert features(found.scenes[0]) == expected


def test_a_winking_eye_is_an_eye_and_a_mouth_never_becomes_one() -> None:
    first = (
        f'{FACE}<circle cx="34" cy="42" r="6"/><circle cx="66" cy="42" r="6"/>'
        '<path d="M34 64H66Q50 84 34 64Z"/>'
    )
    second = (
        f'{FACE}<path d="M40 60H60V64H40Z"/><circle cx="34" cy="38" r="6"/>'
        '<path d="M58 40Q66 32 74 40" fill="none" stroke="#000" stroke-width="3"/>'
    )
    pairs, _ = partners(first, second)
    assert pairs == {0: 0, 1: 2, 2: 3, 3: 1}


def test_a_nose_leaves_alone_where_only_ears_come() -> None:
    first = f'{FACE}<circle cx="34" cy="42" r="6"/><circle cx="66" cy="42" r="6"/>' + (
        '<circle cx="50" cy="56" r="4"/>'
    )
    second = (
        f'{FACE}<circle cx="20" cy="18" r="5" fill="#111"/><circle cx="80" cy="18" r="5"/>'
        '<circle cx="34" cy="42" r="6"/><circle cx="66" cy="42" r="6"/>'
        '<path d="M34 68H66V72H34Z"/>'
    )
    pairs, _ = partners(first, second)
    assert (pairs[1], pairs[2]) == (3, 4)
    assert pairs.get(3) not in (1, 2)


def test_wheels_become_wheels_however_the_bodies_differ() -> None:
    wheel = '<circle cx="{}" cy="80" r="{}" fill="#222"/>'
    first = '<path fill="#e33" d="M5 76V56L25 52L36 36H70L80 52L95 56V76Z"/>'
    second = '<path fill="#fa3" d="M4 20H96V78H4Z"/><circle cx="50" cy="60" r="9" fill="#222"/>'
    pairs, found = partners(
        first + wheel.format(26, 9) + wheel.format(74, 9),
        second + wheel.format(20, 12) + wheel.format(80, 12),
    )
    assert features(found.scenes[1]).count(Feature.WHEEL) == 2
    assert pairs == {0: 0, 1: 2, 2: 3}


def test_mates_go_both_or_neither() -> None:
    ears = (
        '<circle cx="20" cy="18" r="14" fill="#444"/><circle cx="80" cy="18" r="14" fill="#444"/>'
    )
    first = f'{ears}<circle cx="50" cy="56" r="40" fill="#eee"/>'
    face = '<circle cx="50" cy="56" r="40" fill="#eee"/>'
    other = f'<path d="M8 8L36 12L24 32Z" fill="#444"/>{face}'
    assert partners(first, other)[0] == {2: 1}
    assert partners(other, first)[0] == {1: 2}
    same = f'<circle cx="24" cy="20" r="14" fill="#444"/>{face}'
    assert partners(first, same)[0] == {0: 0, 2: 1}


def rays(count: int, radius: float, turn: float = 0.0) -> str:
    """Small bars round the middle."""
    return "".join(
        f'<path d="M47 {50 - radius}H53V{38 - radius}H47Z" fill="#fa0" '
        f'transform="rotate({turn + 360 * k / count} 50 50)"/>'
        for k in range(count)
    )


def test_a_ring_of_rays_goes_round_in_order() -> None:
    disc = '<circle cx="50" cy="50" r="{}" fill="#fd3"/>'
    pairs, _ = partners(disc.format(20) + rays(8, 26), disc.format(26) + rays(8, 34, 15))
    assert pairs == {k: k for k in range(9)}


def test_rays_do_not_become_craters() -> None:
    craters = [(30, 30, 9), (70, 28, 5), (62, 62, 12), (36, 70, 7), (78, 50, 4)]
    moon = '<circle cx="50" cy="50" r="45" fill="#fd9"/>' + "".join(
        f'<circle cx="{x}" cy="{y}" r="{r}" fill="#eb6"/>' for x, y, r in craters
    )
    pairs, _ = partners(f'<circle cx="50" cy="50" r="24" fill="#fd3"/>{rays(8, 30)}', moon)
    assert pairs == {0: 0}


def test_of_unrelated_drawings_only_the_bodies_pair() -> None:
    rocket = (
        '<path fill="#ddd" d="M50 4Q74 30 68 78H32Q26 30 50 4Z"/>'
        '<circle cx="50" cy="36" r="8" fill="#39c"/><path fill="#e33" d="M40 80H60L50 98Z"/>'
    )
    pizza = (
        '<path fill="#fc6" d="M6 14Q50 -4 94 14L50 96Z"/>'
        '<circle cx="36" cy="26" r="6" fill="#c22"/><circle cx="62" cy="30" r="7" fill="#c22"/>'
        '<circle cx="50" cy="58" r="6" fill="#c22"/>'
    )
    pairs, _ = partners(rocket, pizza)
    assert pairs[0] == 0
    assert not {1, 2} & pairs.keys()


def test_what_is_much_larger_than_a_detail_is_something_else() -> None:
    plate = '<rect x="4" y="4" width="92" height="92" fill="#eee"/>'
    small = f'{plate}<path d="M46 46H54V54H46Z" fill="#28c"/>'
    large = f'{plate}<path d="M20 20H80V80H20Z" fill="#28c"/>'
    alike, _ = partners(small, f'{plate}<path d="M43 43H57V57H43Z" fill="#28c"/>')
    assert alike == {0: 0, 1: 1}
    pairs, _ = partners(f'{small}<circle cx="80" cy="20" r="5" fill="#c22"/>', large)
    assert 2 not in pairs


def test_what_moved_is_itself_wherever_it_is_in_the_file() -> None:
    first = '<path d="M10 10H30V20H22V30H10Z"/><circle cx="75" cy="75" r="12" fill="#c33"/>'
    second = '<circle cx="25" cy="70" r="12" fill="#c33"/><path d="M60 12H80V22H72V32H60Z"/>'
    pairs, _ = partners(first, second)
    assert pairs == {0: 1, 1: 0}


def test_a_grid_of_many_that_moved_and_changed_colour_keeps_its_members() -> None:
    count = 15
    shifts = np.random.default_rng(3).uniform(-0.12, 0.12, (count * count, 2))
    forms = (
        '<circle cx="{x}" cy="{y}" r="2.2" fill="{f}"/>',
        '<path d="M{x} {y}m-2 -1h4v2h-4z" fill="{f}"/>',
        '<path d="M{x} {y}m0 -2.4l2.4 4h-4.8z" fill="{f}"/>',
    )

    def grid(moved: bool, colours: tuple[str, ...]) -> str:
        texts = []
        for k, shift in enumerate(shifts):
            x, y = np.array([k % count + 0.5, k // count + 0.5]) + moved * shift
            text = forms[k % len(forms)]
            texts.append(text.format(x=6 * x, y=6 * y, f=colours[k % len(colours)]))
        return "".join(texts)

    pairs, _ = partners(grid(False, ("#e33", "#3a3")), grid(True, ("#33c", "#cc3")))
    assert sum(i == j for i, j in pairs.items()) >= 0.98 * count * count


FLAG = "M20 10H30V15H85L65 35L85 55H30V92H20Z"
FLAG_BACK = "M80 10H70V15H15L35 35L15 55H70V92H80Z"


@pytest.mark.parametrize("more", ["", '<circle cx="25" cy="5" r="4" fill="#c33"/>'])
def test_what_looks_the_other_way_turns_over(more: str) -> None:
    back = more.replace('cx="25"', 'cx="75"')
    _, found = partners(f'<path d="{FLAG}"/>{more}', f'<path d="{FLAG_BACK}"/>{back}')
    assert found.frame is not None
    assert found.frame.over == 0
    middle = found.frame.carried(found.scenes[0].items[0].points[None], np.array([0.5]))
    assert 0 < np.ptp(middle[0, :, 0]) < 0.1 * np.ptp(found.scenes[0].items[0].points[:, 0])


def test_an_arrow_turns_and_what_is_symmetric_stays() -> None:
    arrow = '<g fill="none" stroke="#000" stroke-width="8"><path d="M10 50H90"/><path d="M{}"/></g>'
    _, found = partners(arrow.format("60 20L90 50L60 80"), arrow.format("40 20L10 50L40 80"))
    assert found.frame is None or found.frame.over < 0
    _, found = partners('<path d="M50 5L95 95H5Z"/>', '<path d="M50 5L95 95H5Z"/>')
    assert found.frame is None


def test_a_frame_that_is_drawn_as_a_line_becomes_an_area_with_a_hole() -> None:
    area = '<path fill-rule="evenodd" d="M5 20Q50 -10 95 20V80H5ZM15 28V70H85V28Q50 6 15 28Z"/>'
    line = '<path d="M10 20H90V80H10Z" fill="none" stroke="#000" stroke-width="10"/>'
    dot = '<circle cx="50" cy="50" r="4"/>'
    drawings = [read_svg(f"{HEAD}{text}{dot}</svg>".encode(), "it") for text in (area, line)]
    movement = prepare(drawings[0], drawings[1], Options()).movement
    for frame in movement.at(np.linspace(0.1, 0.9, 5)):
        assert [len(shape.rings) for shape in frame.shapes] == [2, 1]
        assert all(shape.style.stroke is None for shape in frame.shapes)


def test_a_thumb_turns_down_as_a_card_does() -> None:
    names = [DATA / f"twemoji-thumbs-{name}.svg" for name in ("up", "down")]
    drawings = [read_svg(name.read_bytes(), name.name) for name in names]
    found = prepare(drawings[0], drawings[1], Options()).scene
    assert found is not None
    assert found.frame is not None
    assert found.frame.over == 1
    assert not found.roles.disappearing + found.roles.appearing
