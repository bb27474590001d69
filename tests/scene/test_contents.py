"""What lies on a thing that stands still: it goes as one, or is exchanged as one."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import shapetween as st
from shapetween.base.arrays import Curves, Floats, Points
from shapetween.base.ends import End
from shapetween.model.part import CurveTrack
from shapetween.scene.assign import Role, Roles
from shapetween.scene.contents import contents_apart
from shapetween.scene.faces import have_faces
from shapetween.scene.hosts import lies_on, stands_still
from shapetween.scene.items import items_of
from shapetween.scene.relations import Scene, perceive
from shapetween.scene.unmatched.clusters import clusters_of
from shapetween.scene.unmatched.contents import joined_on_hosts
from shapetween.scene.unmatched.going import Side
from shapetween.svg.read.reader import read_svg

VIEW = "0 0 100 100"
CARD = '<path d="M10 10H90V90H10z" fill="#fc3"/>'
LINES = 'fill="none" stroke="#000" stroke-width="2"'


def hook(x: float, y: float, size: float = 20) -> str:
    """A thing that is no plain form, twice as high as wide."""
    return (
        f'<path d="M{x} {y}h{size / 2}v{size}h{-size / 4}v{-size * 0.7}h{-size / 4}z" fill="#222"/>'
    )


def scene(inner: str) -> Scene:
    page = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{inner}</svg>'
    items = items_of(read_svg(page.encode(), "a").shapes, "a")[0]
    return perceive(items, np.array([[-50.0, -50.0], [150.0, 150.0]]))


@dataclass(frozen=True, eq=False)
class Slid:
    """A track that goes from one place to another."""

    first: Curves
    second: Curves

    @property
    def counts(self) -> tuple[int, ...]:
        return (len(self.first),)

    @property
    def closed(self) -> tuple[bool, ...]:
        return (True,)

    def curves(self, t: Floats) -> Curves:
        return self.first + t[:, None, None, None] * (self.second - self.first)


def signs(
    found: Scene, way: Points | None = None, growth: float = 1.0, staying: int = 1
) -> list[tuple[int, ...]]:
    """What goes as one on the first item, which goes some way and grows, as others stay."""
    own = found.items[0].outer.curves
    there = found.items[0].centre + growth * (own - found.items[0].centre)
    track: CurveTrack = Slid(own, there + (0 if way is None else way))  # type: ignore[assignment]  # of the whole protocol only this is asked
    rest = found.items[1:staying]
    others = {k: (Slid(*[item.outer.curves] * 2),) for k, item in enumerate(rest, 1)}
    anchors = {0: (track,), **others}
    side = Side(found, anchors, End.SOURCE, faces=have_faces(found, found)[0])  # type: ignore[arg-type]
    clusters = clusters_of(range(staying, len(found.items)), found, side.anchors)
    return [cluster.members for cluster in joined_on_hosts(clusters, side) if cluster.sign]


def test_near_things_are_one_sign() -> None:
    near, far = (CARD + hook(30, 30) + hook(40 + gap * 20, 30) for gap in (0.65, 0.85))
    assert signs(scene(near)) == [(1, 2)]
    assert signs(scene(far)) == []


def test_what_they_lie_on_stands_still() -> None:
    drawn = scene(CARD + hook(30, 30) + hook(45, 30))
    for way, joined in ((0.05, True), (0.07, False)):
        assert bool(signs(drawn, np.array([way * drawn.scale, 0.0]))) is joined
    for growth, joined in ((np.exp(0.22), True), (np.exp(0.28), False)):
        assert bool(signs(drawn, None, growth)) is joined


@pytest.mark.parametrize(("off", "on_it"), [(0.4, True), (0.6, False)])
def test_what_hangs_over_lies_on_it_if_most_does(off: float, on_it: bool) -> None:
    y = 90 - 20 * (1 - off)
    bar = f'<path d="M40 {y}h10v20h-10z"/>'
    assert lies_on(scene(CARD + bar), 0)[1] == on_it


@pytest.mark.parametrize(("share", "on_it"), [(0.75, True), (0.85, False)])
def test_a_front_as_large_as_its_back_is_no_sign(share: float, on_it: bool) -> None:
    front = f'<path d="M10 10h80v{80 * share}h-80z" fill="#a40"/>'
    assert lies_on(scene(CARD + front), 0)[1] == on_it


def test_what_is_painted_before_lies_behind() -> None:
    assert not lies_on(scene(hook(40, 40) + CARD), 1)[0]
    ring = f'<circle cx="50" cy="50" r="40" {LINES}/>'
    assert lies_on(scene(hook(40, 40) + ring), 1)[0]


def test_keys_and_bars_go_each_in_its_place() -> None:
    def keys(larger: float) -> str:
        return CARD + "".join(
            f'<path d="M{x} 40h{s}v{s}h{-s}z"/>' for x, s in ((30, 10), (46, 10 * larger))
        )

    assert signs(scene(keys(1.4))) == []
    assert signs(scene(keys(1.6))) == [(1, 2)]
    text = "".join(f'<path d="M30 {y}H60" {LINES}/>' for y in (30, 40, 50))
    assert signs(scene(CARD + text)) == []


@pytest.mark.parametrize(("length", "joined"), [(0.45, True), (0.55, False)])
def test_what_divides_a_thing_goes_alone(length: float, joined: bool) -> None:
    line = f'<path d="M{50 - 40 * length} 44H{50 + 40 * length}" {LINES}/>'
    found = signs(scene(CARD + hook(40, 50) + hook(55, 50) + line))
    assert found == ([(1, 2, 3)] if joined else [(1, 2)])


@pytest.mark.parametrize(("length", "joined"), [(4.5, True), (14.0, False)])
def test_the_edge_of_a_thing_is_no_sign(length: float, joined: bool) -> None:
    """A foot of this length stands on the border, of a thing 20 high."""
    y = (90 - 20) - 0.1
    foot = f'<path d="M30 90v-20h14v10h{length - 14}v10z" fill="#222"/>'
    found = signs(scene(CARD + hook(46, y - 3, 18) + foot))
    assert bool(found) is joined


def test_features_of_a_face_go_each_in_its_place() -> None:
    eyes = '<circle cx="35" cy="40" r="5"/><circle cx="65" cy="40" r="5"/>'
    mouth = f'<path d="M30 62q20 20 40 0" {LINES}/>'
    brows = hook(44, 26, 8) + hook(52, 26, 8)
    disc = '<circle cx="50" cy="50" r="40" fill="#fc0"/>'
    with_face = scene(disc + eyes + mouth + brows)
    assert have_faces(with_face, scene(disc))[0][0]
    assert signs(with_face) == []
    assert signs(scene(disc + brows)) == [(1, 2)]


def test_a_sign_goes_about_one_place(tmp_path: Path) -> None:
    paths = tmp_path / "one.svg", tmp_path / "other.svg"
    inner = CARD + hook(36, 40) + hook(50, 40), CARD
    for path, own in zip(paths, inner, strict=True):
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{VIEW}">{own}</svg>')
    found = st.morph(*paths)
    home, later = found.movements[0].at(np.array([0.0, 0.2]))
    ends = [
        np.concatenate([s.rings[0].curves.reshape(-1, 2) for s in frame.shapes[1:]])
        for frame in (home, later)
    ]
    middle = np.array([48.0, 50.0])
    size = np.ptp(ends[1][:, 1]) / np.ptp(ends[0][:, 1])
    assert 0.3 < size < 0.99
    assert ends[1] == pytest.approx(middle + size * (ends[0] - middle), abs=1e-6)


BURST = (
    '<path d="M50 25l6 14 15-8-7 16 16 6-16 6 6 16-15-7-6 15-6-15-15 7 7-16-16-6 16-6-7-15z"'
    ' fill="#222"/>'
)


def apart(one: Scene, other: Scene, reason: str = "matched", cost: float = 0.4) -> set[int]:
    """Pairs given up of a card and the first thing on it, which become each other."""
    pairs = (Role(0, 0, -1.0, "alike"), Role(1, 1, cost, reason))
    rest = [tuple(range(2, len(side.items))) for side in (one, other)]
    tracks = {
        k: (Slid(one.items[k].outer.curves, one.items[k].outer.curves),) for k in range(len(pairs))
    }
    return contents_apart(one, other, Roles(pairs, rest[0], rest[1]), tracks)  # type: ignore[arg-type]  # of the whole protocol only this is asked


def test_unlike_signs_are_exchanged_on_what_stays() -> None:
    hooks = scene(CARD + hook(30, 30, 40) + hook(55, 30, 40))
    burst = scene(CARD + BURST)
    assert apart(hooks, burst) == {1}
    assert apart(burst, burst) == set()
    assert apart(hooks, burst, cost=-0.9) == {1}
    assert apart(hooks, burst, cost=-1.1) == set()
    assert apart(hooks, burst, "given") == set()  # asked for by the user
    assert apart(hooks, burst, "alike") == set()  # that stands still


def test_signs_on_what_moves_are_not_exchanged() -> None:
    hooks = scene(CARD + hook(30, 30, 40) + hook(55, 30, 40))
    moved = scene(CARD.replace("M10 10", "M30 10").replace("H90", "H110") + BURST)
    assert not stands_still(hooks.items[0].box, moved.items[0].box, hooks.scale)
    assert apart(hooks, moved) == set()


def test_of_two_single_signs_a_certain_pair_moves() -> None:
    one, other = scene(CARD + hook(36, 30, 40)), scene(CARD + BURST)
    assert apart(one, other, cost=0.35) == {1}
    assert apart(one, other, cost=0.25) == set()


def test_lines_on_what_else_stays_go_into_that() -> None:
    """Veins of a leaf go into its stem; without a stem they are a sign."""
    veins = f'<path d="M50 44L62 44L62 32" {LINES}/><path d="M50 60L65 60L65 48" {LINES}/>'
    with_stem = scene(CARD + f'<path d="M50 30V80" {LINES}/>' + veins)
    assert signs(with_stem, staying=2) == []
    assert signs(scene(CARD + veins)) == [(1, 2)]


def test_a_face_gives_way_to_what_is_none_and_moves_to_a_face() -> None:
    disc = '<circle cx="50" cy="50" r="40" fill="#fc0"/>'
    mouth = f'<path d="M30 62q20 20 40 0" {LINES}/>'
    face = scene(
        disc + mouth + '<circle cx="35" cy="40" r="5"/><circle cx="65" cy="40" r="5"/>' + BURST
    )
    other = scene(disc + BURST + '<ellipse cx="35" cy="40" rx="4" ry="9"/>')
    assert have_faces(face, other)[0][0]
    assert not have_faces(other, other)[0][0]
    assert apart(face, face) == set()
    assert apart(face, scene(disc + BURST)) == {1}
