"""Who becomes whom: against pairs read off drawings by eye, and one small drawing of each kind."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapetween.geometry.affine import mapped
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.fit import fit_matrix
from shapetween.model.paint import Colour, Gradient, Stop, Stroke, Style
from shapetween.pipeline import Options, prepare
from shapetween.scene.asked import Asked, groups_of
from shapetween.scene.features import Feature, features_of
from shapetween.scene.items import Item, Painted, items_of
from shapetween.scene.joining import joined_lines
from shapetween.scene.pairing import Paired, pair_items
from shapetween.scene.pairs import of_one_kind
from shapetween.scene.relations import Scene
from shapetween.scene.sets import sets_of
from shapetween.scene.strokes.outlined import as_lines
from shapetween.svg.read.reader import read_svg
from tests.drawings import BOX, area, line, square

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
    expected = [Feature.HEAD, *eyes, *brows, Feature.NOSE, Feature.MOUTH]
    assert features(found.scenes[0]) == expected


def test_a_head_is_what_a_face_is_the_front_of_and_the_body_instead_of_hair() -> None:
    """A clown's hair is larger than his face; on a robot's screen a face is no head of it."""
    eyes = '<circle cx="42" cy="46" r="4"/><circle cx="58" cy="46" r="4"/><path d="M42 60h16v4z"/>'
    paint = f'<circle cx="50" cy="52" r="20" fill="#fff"/>{eyes}'
    hair = '<path d="M6 34a44 44 0 0 1 88 0v16h-88z" fill="#46e"/>'
    clown = f'{hair}<circle cx="50" cy="50" r="26" fill="#fc9"/>{paint}'
    _, found = partners(clown, FACE)
    kinds = features(found.scenes[0])
    assert [k for k, kind in enumerate(kinds) if kind == Feature.HEAD] == [1]
    assert features_of(found.scenes[0], sets_of(found.scenes[0])).body == 1
    robot = f'<rect x="4" y="10" width="92" height="86" fill="#999"/>{paint}'
    _, found = partners(robot, FACE)
    kinds = features(found.scenes[0])
    assert [k for k, kind in enumerate(kinds) if kind == Feature.HEAD] == [1]
    assert features_of(found.scenes[0], sets_of(found.scenes[0])).body == 0


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


RED, BLUE = Colour(1, 0, 0), Colour(0, 0, 1)


def become(
    first: Sequence[Shape], second: Sequence[Shape], *matches: tuple[str, str]
) -> list[tuple[int, int]]:
    """Which shapes become which, in a drawing of a hundred units."""
    views = corners(BOX), corners(BOX)
    one, other = (items_of(side, "it")[0] for side in (first, second))
    found = pair_items(one, other, views, Asked(groups_of(first, second, matches)))
    a, b = found.scenes
    return sorted((a.items[r.first].shape, b.items[r.second].shape) for r in found.roles.pairs)


def test_names_win_over_places() -> None:
    left, right = square(0, 0, 20), square(60, 0, 20)
    first = [area(left, name="sun"), area(right, name="moon")]
    second = [area(left, name="moon"), area(right, name="sun")]
    assert become(first, second) == [(0, 1), (1, 0)]
    unnamed = [area(left), area(right)]
    assert become(unnamed, unnamed) == [(0, 0), (1, 1)]
    assert become(first, unnamed) == [(0, 0), (1, 1)]


@pytest.mark.parametrize("first", ["path4", "Layer_1"])
def test_names_that_editors_give_only_help(first: str) -> None:
    left, right = square(0, 0, 3), square(90, 0, 3)
    one = [area(left, name=first), area(right, name="Vector")]
    other = [area(left, name="Vector"), area(right, name=first)]
    assert become(one, other) == [(0, 0), (1, 1)]
    places = [square(40, 0, 6), square(48, 0, 11), square(40, 10, 10.7), square(48, 10, 6.5)]
    bed = area(square(0, 20, 30))
    halves = [bed, area(places[0], name=first), area(places[1], name="Vector")]
    turned = [bed, area(places[2], name=first), area(places[3], name="Vector")]
    assert become(halves, turned) == [(0, 0), (1, 1), (2, 2)]
    unnamed = [area(place) for place in places]
    assert become([bed, *unnamed[:2]], [bed, *unnamed[2:]]) == [(0, 0), (1, 2), (2, 1)]


def test_a_name_that_stands_twice_says_nothing() -> None:
    left, right = square(0, 0, 20), square(60, 0, 20)
    first = [area(left, name="leaf"), area(right, name="leaf")]
    second = [area(right, name="leaf"), area(left, name="stem")]
    assert become(first, second) == [(0, 1), (1, 0)]


def test_what_the_user_says_wins_over_names() -> None:
    left, right = square(0, 0, 20), square(60, 0, 20)
    shapes = [area(left, name="sun"), area(right, name="moon")]
    assert become(shapes, shapes, ("sun", "moon"), ("moon", "sun")) == [(0, 1), (1, 0)]


def test_colour_tells_where_place_does_not() -> None:
    here, there = square(40, 40, 20), square(43, 40, 20)
    others = [area(square(0, 4 * k, 3), name=f"other-{k}") for k in range(9)]
    first = [area(here, colour=RED), area(there, colour=BLUE), *others]
    second = [area(here, colour=BLUE), area(there, colour=RED), *others]
    assert become(first, second)[:2] == [(0, 1), (1, 0)]
    stops = tuple(Stop(k / 2, RED) for k in range(3))
    gradient = Gradient("linear", (0, 0, 1, 0), (1, 0, 0, 1, 0, 0), stops)
    blended = [second[0], area(there, colour=gradient), *others]
    assert become(first, blended)[:2] == [(0, 1), (1, 0)]


def test_lines_become_lines_and_areas_areas() -> None:
    stroke, filled = line((40, 40), (60, 60)), area(square(40, 40, 20))
    assert become([stroke, filled], [filled, stroke]) == [(0, 1), (1, 0)]


def test_twins_keep_their_paint_order() -> None:
    twin = area(square(40, 40, 20))
    assert become([twin] * 3, [twin] * 3) == [(0, 0), (1, 1), (2, 2)]


def test_as_many_in_one_paint_all_have_partners() -> None:
    first = [area(square(10 * k, 10, 6), colour=RED) for k in range(4)]
    second = [area(square(10 * k, 45, 6), colour=RED) for k in range(4)]
    assert become(first, second) == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert become(first[:3], second) != become(first, second)


@pytest.mark.parametrize("inner_first", [True, False])
def test_a_closed_line_beside_an_area_goes_round_with_its_outer_side(inner_first: bool) -> None:
    """Which of its sides is painted first depends on the way it runs: walls were run through."""
    ink = Style(fill=Colour())
    frame = Item((square(10, 10, 80), square(20, 20, 60)), ink)
    sides = frame.rings[::-1] if inner_first else frame.rings
    stroke = Style(None, Stroke(Colour(), 10.0))
    bordered = Item((square(15, 15, 70),), stroke, painted=Painted(sides, ink))
    for one, other in (of_one_kind(bordered, frame), of_one_kind(frame, bordered)[::-1]):
        assert abs(one.rings[0].area) > abs(one.rings[1].area)
        assert abs(other.rings[0].area) > abs(other.rings[1].area)
