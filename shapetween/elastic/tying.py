"""Which stroked lines of a drawing end on which others, so that they stay there on the way."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.attach.riders import Rider, Tip
from shapetween.attach.ties import Spot, Tie, Tied
from shapetween.elastic.aboard import LonePart, RidingPart, ShownPart, unrepeated
from shapetween.elastic.junctions import DrawnLine, Junctions, junctions
from shapetween.model.movement import Part
from shapetween.model.paint import Style

__all__ = ["tied"]

#: Share of a line's length by which what lies on it may slide along it on the way. Farther, and it
#: comes off and lies down again.
SLIDE = 0.2

#: Ties that may hang on each other one by one. What is tied to a line waits for it, and a line in
#: a thousand pieces would take long; so their chains turn round.
LONGEST = 12


@dataclass(frozen=True, slots=True, eq=False)
class _Line:
    """A line that rides.

    Attributes
    ----------
    part, place : int
        Which rider of which part it is.
    rider : Rider or Tip
    drawn : (DrawnLine or None, DrawnLine or None)
        As both drawings have it.
    """

    part: int
    place: int
    rider: Rider | Tip
    drawn: tuple[DrawnLine | None, DrawnLine | None]

    @property
    def stays(self) -> bool:
        """Whether it becomes another line."""
        return isinstance(self.rider, Rider)

    @property
    def length(self) -> float:
        """Length, about; of the longer one of both."""
        known = [line.curves for line in self.drawn if line is not None]
        return max(float(np.linalg.norm(np.diff(c, axis=1), axis=2).sum()) for c in known)


@dataclass(frozen=True, slots=True, eq=False)
class _Link:
    """A tie that is wished for: of a place of one line to another line."""

    guest: int
    at: float
    host: int
    spots: tuple[Spot | None, Spot | None]
    lasts: bool


def tied(parts: Sequence[Part]) -> tuple[Part, ...]:
    """The same parts, with lines that end on others tied to them.

    Where two lines end on each other the shorter one is tied; no line is tied to itself by way of
    others. Lines that become others are not tied to lines that come or go.
    """
    own = unrepeated(parts)
    lines = [line for k, part in enumerate(own) for line in _lines(part, k)]
    if len(lines) < 2:
        return tuple(parts)
    touching = [junctions([line.drawn[end] for line in lines]) for end in (0, 1)]
    links = _settled(_own(lines, touching), _carried(lines, touching), len(lines))
    if not links:
        return tuple(parts)
    riders: dict[int, Rider | Tip | Tied] = {}

    def made(k: int) -> Rider | Tip | Tied:
        if k not in riders:
            ties = tuple(
                Tie(link.at, made(link.host), link.spots, link.lasts)
                for link in links
                if link.guest == k
            )
            riders[k] = Tied(lines[k].rider, ties) if ties else lines[k].rider
        return riders[k]

    there = {(line.part, line.place): k for k, line in enumerate(lines)}
    fresh = {}
    for number, part in enumerate(own):
        if isinstance(part, RidingPart | LonePart):
            riders_now = [
                made(there[number, place]) if (number, place) in there else rider
                for place, rider in enumerate(part.riders)
            ]
            fresh[id(part)] = replace(part, riders=tuple(riders_now))
    return tuple(
        replace(part, part=fresh.get(id(part.part), part.part))
        if isinstance(part, ShownPart)
        else fresh.get(id(part), part)
        for part in parts
    )


def _lines(part: Part, number: int) -> list[_Line]:
    """Those of a part's riders that are stroked lines and keep their size."""
    if isinstance(part, RidingPart):
        first, second = map(_width, part.styles)
        if first is None or second is None:
            return []
        return [
            _Line(
                number,
                place,
                rider,
                (
                    DrawnLine(rider.source, rider.closed, first),
                    DrawnLine(rider.target, rider.closed, second),
                ),
            )
            for place, rider in enumerate(part.riders)
            if isinstance(rider, Rider)
        ]
    if not isinstance(part, LonePart):
        return []
    width = _width(part.whole)
    if width is None:
        return []
    lines = []
    for place, rider in enumerate(part.riders):
        if isinstance(rider, Tip):
            line = DrawnLine(rider.home, False, width)
            drawn = (None, line) if rider.arrives else (line, None)
            lines.append(_Line(number, place, rider, drawn))
    return lines


def _width(style: Style) -> float | None:
    """Width of what is stroked and not filled."""
    return None if style.fill is not None or style.stroke is None else style.stroke.width


def _own(lines: Sequence[_Line], touching: Sequence[Junctions]) -> list[_Link]:
    """Ties of every line's ends, those that matter most first."""
    links: list[tuple[tuple[bool, float, float], _Link]] = []
    for guest, line in enumerate(lines):
        for end in (0, 1):
            near = [
                {
                    h: f
                    for h, f in found.get((guest, end), {}).items()
                    if lines[h].stays >= line.stays
                }
                for found in touching
            ]
            at = float(end * line.rider.counts[0])
            both = {
                h
                for h in near[0].keys() & near[1].keys()
                if _slide(lines[h].rider, near[0][h][1], near[1][h][1]) <= SLIDE
            }
            for host in both:
                away = near[0][host][0] + near[1][host][0]
                link = _Link(guest, at, host, (near[0][host][1], near[1][host][1]), True)
                links.append(((False, line.length, away), link))
            for k, side in enumerate(near if not both else ()):
                for host, (away, spot) in side.items():
                    link = _Link(guest, at, host, _only(spot, k), not line.stays)
                    links.append(((True, line.length, away), link))
    return _sorted(links)


def _carried(lines: Sequence[_Line], touching: Sequence[Junctions]) -> list[_Link]:
    """Ties of what comes or goes to the ends of other lines that lie on it, the nearest first."""
    return _sorted(
        [
            (
                (False, 0.0, away),
                _Link(
                    lone,
                    spot.place,
                    guest,
                    _only(Spot(float(end * lines[guest].rider.counts[0]), -spot.offset), k),
                    True,
                ),
            )
            for k, found in enumerate(touching)
            for (guest, end), hosts in found.items()
            for lone, (away, spot) in hosts.items()
            if lines[guest].stays and not lines[lone].stays
        ]
    )


def _slide(host: Rider | Tip, first: Spot, second: Spot) -> float:
    """How far apart two places on a line are, as a share of its length."""
    bounds = host.bounds
    one, other = np.interp([first.place, second.place], np.arange(len(bounds)), bounds).tolist()
    ways = abs(other - one)
    return min(ways, 1 - ways) if host.closed else ways


def _only(spot: Spot, side: int) -> tuple[Spot | None, Spot | None]:
    return (None, spot) if side else (spot, None)


def _sorted(links: list[tuple[tuple[bool, float, float], _Link]]) -> list[_Link]:
    return [link for _, link in sorted(links, key=lambda pair: pair[0])]


def _settled(own: Sequence[_Link], carried: Sequence[_Link], count: int) -> list[_Link]:
    """The first tie of every end in each drawing that closes no circle of lines.

    What others carry is carried by one of them, and only if its own ends hold it nowhere.
    """
    chains = _Chains(count)
    taken: set[tuple[int, float, int]] = set()
    settled = []
    for link in own:
        sides = {(link.guest, link.at, k) for k in (0, 1) if link.spots[k] is not None}
        if not sides & taken and chains.add(link.guest, link.host):
            taken |= sides
            settled.append(link)
    held = (k for k in carried if not chains.hosts[k.guest] and chains.add(k.guest, k.host))
    return [*settled, *held]


class _Chains:
    """Which lines are tied to which, without circles and in short chains."""

    def __init__(self, count: int) -> None:
        self.hosts: list[set[int]] = [set() for _ in range(count)]
        self._guests: list[set[int]] = [set() for _ in range(count)]

    def add(self, guest: int, host: int) -> bool:
        """Tie one line to another, if that may be."""
        below, above = self._far(host, self.hosts), self._far(guest, self._guests)
        if guest in below or max(below.values()) + 1 + max(above.values()) > LONGEST:
            return False
        self.hosts[guest].add(host)
        self._guests[host].add(guest)
        return True

    def _far(self, start: int, ways: Sequence[set[int]]) -> dict[int, int]:
        """In how many ties at most lines are reached from one of them."""
        found = {start: 0}
        todo = [start]
        while todo:
            here = todo.pop()
            for k in ways[here]:
                if found.get(k, -1) <= found[here]:
                    found[k] = found[here] + 1
                    todo.append(k)
        return found
