"""What the studio's worker processes do: read drawings, and move them.

Workers stand in the folder of the session's drawings, so messages call these by their names alone,
as those of the command line do. All answers are plain values that become JSON.
"""

import json
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shapetween.studio.job import Job, Leg
from shapetween.studio.settings import SETTINGS

if TYPE_CHECKING:
    from shapetween.api import Chain, Morph, Pin
    from shapetween.model.drawing import Drawing
    from shapetween.outline.correspondence import RingCorrespondence

__all__ = ["TASKS", "full", "live", "read", "warm"]

#: Shapes of a movement that is shown while a pin is dragged. More make the page slower than the
#: hand; with fewer limbs that turn are seen to shrink between two of them.
LIVE_KEYFRAMES = 17


#: Most matchings that are offered: of more none is told from another.
MOST_ALTERNATIVES = 6

#: Legs that a worker keeps, from which previews start. Each holds a few megabytes; with fewer,
#: going to and fro in a chain begins anew each time.
KEPT = 4

#: Digits of places that are sent to the page, as a share of the view box: a hundredth of a pixel
#: of a large screen.
DIGITS = 5


def warm() -> None:
    """Import what every movement needs, before anybody waits for it."""
    import shapetween.api
    import shapetween.svg.write.sequence
    import shapetween.svg.write.smil  # noqa: F401


def read(name: str, data: bytes) -> dict[str, Any]:
    """What the page shows of a drawing that has just come in.

    Raises
    ------
    ShapetweenError
        If it cannot be read.
    """
    from shapetween.io.fonts import fonts_in
    from shapetween.svg.read.reader import read_svg
    from shapetween.svg.write.sequence import frame_svg

    drawing = read_svg(data, name, fonts=fonts_in())
    box = drawing.box
    return {
        "name": name,
        "svg": frame_svg(drawing),
        "box": [box.x, box.y, box.width, box.height],
        "shapes": [
            {"key": shape.name or f"#{k}", "rings": len(shape.rings), **_area(drawing, k - 1)}
            for k, shape in enumerate(drawing.shapes, start=1)
        ],
        "warnings": [str(line) for line in drawing.warnings],
    }


def live(job: Job) -> dict[str, Any]:
    """The movement of one leg as it may be seen while something is dragged."""
    from shapetween.api import Morph
    from shapetween.studio.preview import previewed

    (leg,) = job.legs
    key = json.dumps(replace(job, legs=(replace(leg, pins=()),)).plain())
    moved = None
    if key in _DRAGGED:
        base, pins = _DRAGGED[key]
        moved = previewed(base, pins, leg.pins)
    if moved is None:  # the first of a drag, or nothing of which anything can be kept
        found = _moved(job, quick=True)
        assert isinstance(found, Morph)
        while len(_DRAGGED) >= KEPT:
            del _DRAGGED[next(iter(_DRAGGED))]
        moved, _DRAGGED[key] = found, (found, leg.pins)
    return _answer(moved, job, LIVE_KEYFRAMES)


#: The legs that were dragged last, by what they are without pins, and the pins they moved with.
_DRAGGED: dict[str, "tuple[Morph, tuple[Pin, ...]]"] = {}


def full(job: Job) -> dict[str, Any]:
    """The very movement that would be saved."""
    return _answer(_moved(job, quick=False), job, "auto")


def alternatives(job: Job) -> dict[str, Any]:
    """The best distinct matchings of one leg, each as it moves."""
    from shapetween.base.errors import OptionError

    (leg,) = job.legs
    found = []
    for matching in range(1, MOST_ALTERNATIVES + 1):
        try:
            moved = _moved(replace(job, legs=(replace(leg, matching=matching),)), quick=True)
        except OptionError:  # there are no more
            break
        svg = moved.svg(keyframes=LIVE_KEYFRAMES, loop="alternate", hold=0.3, easing="ease-in-out")
        found.append({"matching": matching, "svg": svg})
    return {"alternatives": found}


def _answer(moved: "Chain | Morph", job: Job, keyframes: Any) -> dict[str, Any]:
    import numpy as np

    from shapetween.api import Morph
    from shapetween.geometry.affine import inverted

    settings = _timing(job)
    if isinstance(moved, Morph):
        legs = [(moved, moved.correspondence, (np.eye(2, 3), inverted(moved.prepared.fit)))]
    else:
        back = [inverted(matrix) for matrix in moved.fits]
        legs = list(zip(moved.legs, moved.correspondence, pairwise(back), strict=True))
    return {
        "svg": moved.svg(keyframes=keyframes, **settings),
        "seconds": _seconds(moved, settings),
        "warnings": list(moved.warnings),
        "legs": [_leg(*leg) for leg in legs],
    }


def _timing(job: Job) -> dict[str, Any]:
    """How the movement is written for the stage, which sets it going by itself."""
    write = {setting.name for setting in SETTINGS if setting.stage == "write"} - {"start"}
    return {name: value for name, value in job.options.items() if name in write}


def _seconds(moved: "Chain | Morph", settings: dict[str, Any]) -> float:
    """How long all of it takes, until it stops or starts over."""
    from shapetween.formats.options import write_options
    from shapetween.formats.paced import paced
    from shapetween.formats.segments import Segments
    from shapetween.timing.timeline import Timeline

    options = write_options(settings)
    segments, options = paced(Segments(moved.movements, moved.closed, "", ()), options)
    ways = (options.duration,) * len(segments.movements)
    return Timeline(ways, options.loop, options.hold, moved.closed).seconds


def _moved(job: Job, *, quick: bool) -> "Chain | Morph":
    from shapetween.api import chain, morph

    prepared = {s.name for s in SETTINGS if s.stage == "prepare"}
    options = {name: value for name, value in job.options.items() if name in prepared}
    if quick:
        options["effort"] = "plane"
    if len(job.legs) == 1:
        leg = job.legs[0]
        options["matching"] = leg.matching
        a, b = map(Path, job.drawings)
        return morph(a, b, pins=leg.pins, matches=_pairs(leg), **options)
    legs = dict(enumerate(job.legs, start=1))
    return chain(
        map(Path, job.drawings),
        pins={k: leg.pins for k, leg in legs.items()},
        matches={k: _pairs(leg) for k, leg in legs.items()},
        matching={k: leg.matching for k, leg in legs.items()},
        **options,
    )


def _pairs(leg: Leg) -> list[tuple[str, str]]:
    """Shapes that become each other, both sides of each."""
    return [(one, other) for match in leg.matches for one, _, other in [match.partition(":")]]


def _leg(leg: "Morph", known: "tuple[RingCorrespondence, ...]", fits: Any) -> dict[str, Any]:
    """What the page draws over both drawings of a leg."""
    from shapetween.studio.shown import line_rings, shape_pairs

    rings = [(ring.name, ring.hole, True, ring.source, ring.target) for ring in known]
    rings += line_rings(leg, *fits)
    return {
        "rings": [
            {"name": name, "hole": hole, "closed": closed, "a": _numbers(a), "b": _numbers(b)}
            for name, hole, closed, a, b in rings
        ],
        "pairs": shape_pairs(leg),
    }


def _numbers(points: Any) -> list[list[float]]:
    """Points rounded for the page."""
    import numpy as np

    size = float(np.ptp(points, axis=0).max()) or 1.0
    rounded: list[list[float]] = np.round(points, DIGITS - int(np.floor(np.log10(size)))).tolist()
    return rounded


def _area(drawing: "Drawing", k: int) -> dict[str, str]:
    """One shape as path data, for the page to tell what is pointed at."""
    shape = drawing.shapes[k]
    words: list[str] = []
    for ring in shape.rings:
        words.append("M{:.6g} {:.6g}".format(*ring.curves[0, 0]))
        words += [
            "C{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}".format(*curve[1:].ravel())
            for curve in ring.curves
        ]
        words += ["Z"] if ring.closed else []
    return {"d": "".join(words)}


TASKS: dict[str, Callable[..., Any]] = {
    task.__name__: task for task in (warm, read, live, alternatives, full)
}
"""What a worker may be asked for."""
