"""What there is to tell of how the regions of a fill are moved."""

from shapetween.base.notices import Kind, Notice
from shapetween.fill.regions import Region
from shapetween.match import Matcher
from shapetween.outline.body import Carried, RingMatch

__all__ = [
    "crossing_notices",
    "facing_notices",
    "fallback_notices",
    "hole_notices",
    "too_many_pieces",
    "uncertain",
]


def too_many_pieces(simple: int, count: int, name: str) -> Notice:
    """Pieces that get no meshes."""
    return Notice(
        "too-many-pieces",
        f"{simple} of {count} pieces are too many or too small for meshes",
        name,
        "they move straight",
        severity="note",
    )


def uncertain(*, alone: bool) -> Notice:
    """A matching that may be wrong; alone is whether other matchings can be chosen by number."""
    return Notice(
        "uncertain",
        "matched with little certainty",
        instead="'shapetween alternatives' shows what else it may be, to be taken with "
        "--matching, and --pin corrects it"
        if alone
        else "look at the matching with 'shapetween mesh' and correct it with --pin",
    )


def facing_notices(outer: RingMatch) -> list[Notice]:
    """What to tell of two outlines that seem to face opposite ways."""
    if outer.coarse or not Matcher(outer.source, outer.target).faces_other_way(outer.matching):
        return []
    remedy = "--flip b mirrors the second one"
    return [Notice("facing", f"the drawings seem to face opposite ways; {remedy}")]


def crossing_notices(bodies: list[Carried], name: str) -> list[Notice]:
    """What to tell of outlines that cross on the way: of the worst body of each kind."""
    kinds: tuple[tuple[bool, Kind, str, str], ...] = (
        (False, "crossing", "the outline crosses itself", "pins on the parts that cross may help"),
        (
            True,
            "details-touch",
            "small details of the outline run into each other",
            "its large parts do not",
        ),
    )
    notices = []
    for detail, kind, text, more in kinds:
        seen = [body for body in bodies if body.crossing and not body.seen.nothing]
        crossing = [body for body in seen if body.detail == detail]
        if crossing:
            worst = max(crossing, key=lambda body: body.crossing / body.checked)
            wide = f"by {1000 * worst.seen.width:.2g} of 1000 pixels"
            often = f"at {worst.crossing} of {worst.checked} times on the way, {wide}"
            notices.append(Notice(kind, f"{text} {often}", name, more))
    return notices


def fallback_notices(bodies: list[Carried], name: str) -> list[Notice]:
    """What to tell of outlines that are not moved as outlines otherwise are."""
    notices = []
    if any(body.other_matching for body in bodies):
        notices.append(
            Notice(
                "other-matching",
                "the best matching makes the outline cross itself on the way",
                name,
                "another is taken that costs little more",
            )
        )
    if any(body.parted for body in bodies):
        notices.append(
            Notice(
                "parted",
                "parts of the outline would run into each other on the way",
                name,
                "they are kept apart",
                "note",
            )
        )
    if any(body.bare for body in bodies):
        notices.append(
            Notice("bare-mesh", "nothing keeps the outline from folding", name, "its mesh moves it")
        )
    if any(ring.coarse for body in bodies for ring in body.nodes.rings):
        notices.append(
            Notice(
                "coarse",
                "an outline of so many curves is matched and moved by a simpler one",
                name,
                "its details go along",
                severity="note",
            )
        )
    if any(ring.unevened for body in bodies for ring in body.nodes.rings):
        text = "a mesh of so many vertices inside is not evened"
        notices.append(Notice("less-care", text, name, "they stay where they are", "note"))
    if any(body.nodes.many for body in bodies):
        text = "so many curves are looked at for crossings by fewer chords"
        notices.append(Notice("less-care", text, name, "small crossings may be missed", "note"))
    return notices


def hole_notices(first: Region, second: Region, most: int, name: str) -> list[Notice]:
    """What to tell of more holes than are matched."""
    count = min(len(first.holes), len(second.holes))
    if count <= most:
        return []
    return [
        Notice(
            "too-many-holes",
            f"a piece has {count} holes, of which {most} become holes of the other",
            name,
            "the rest close and open",
        )
    ]
