"""What a user is to be told: what was lost, is doubtful, or was done another way than the best."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

__all__ = ["Kind", "Notice", "distinct"]

Kind: TypeAlias = Literal[
    "file",
    "format",
    "outlined-anew",
    "uncertain",
    "other-matching",
    "parted",
    "crossing",
    "details-touch",
    "coarse",
    "bare-mesh",
    "too-many-pieces",
    "too-many-holes",
    "hole-alone",
    "apart",
    "one-setting",
    "less-care",
    "too-many-parts",
    "by-corners",
    "no-mesh",
    "stroke-outline",
    "facing",
    "exchanged",
    "outside",
    "other",
]
"""What a notice is about.

file: something in the file cannot be carried. format: something of the movement cannot be held by
the format that is written, or less closely. outlined-anew: an outline crosses itself and was
replaced by what it shows. uncertain: matched with little certainty. other-matching: not the best
matching was taken. parted: strands that would cross are kept apart. crossing, details-touch:
outlines or small details of them cross on the way. coarse: matched or moved by a simplified
outline. bare-mesh: nothing keeps the outline from folding. too-many-pieces, too-many-holes: some
are moved more simply. hole-alone: a hole that has a counterpart cannot be matched with it. apart:
pieces are not kept from each other. one-setting: less is tried to keep an outline from crossing.
less-care: an outline of so many curves is meshed or looked at more coarsely. too-many-parts: some
of what is seen of smaller drawings is not looked for. by-corners: an outline
moves by its corners where a mesh was due. no-mesh: the report has no mesh of a pair.
stroke-outline: the area of a stroke does not follow its line. facing: the drawings seem to face
opposite ways. exchanged: the drawings have too little in common for their parts to become each
other. outside: shapes outside of the view are left out.
"""


@dataclass(frozen=True, slots=True)
class Notice:
    """One thing to tell.

    Attributes
    ----------
    kind : str
        One of `Kind`.
    message : str
        One line without the place.
    place : str
        File and shape that it concerns, empty where it is the whole.
    instead : str
        What was done instead, or what the user may do, empty if there is nothing.
    severity : {"warning", "note"}
        A warning is printed; a note stands in the report only.
    """

    kind: Kind
    message: str
    place: str = ""
    instead: str = ""
    severity: Literal["warning", "note"] = "warning"

    def __str__(self) -> str:
        """All of it as one line."""
        line = f"{self.place}: {self.message}" if self.place else self.message
        return f"{line}; {self.instead}" if self.instead else line

    def as_json(self) -> dict[str, str]:
        """All of it for a report."""
        return {
            "kind": self.kind,
            "severity": self.severity,
            "place": self.place,
            "message": self.message,
            "instead": self.instead,
        }


def distinct(notices: Iterable[Notice]) -> tuple[Notice, ...]:
    """Each notice once, in order."""
    return tuple(dict.fromkeys(notices))
