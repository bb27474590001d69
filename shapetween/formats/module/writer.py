"""The text of a module: what moves, in letters, and the code that reads it.

Nothing is imported and nothing needs to be built: a browser or node takes the file as it is.
"""

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.base.observe import Observer, unobserved
from shapetween.formats.grid import Grid, grid_of
from shapetween.formats.module.basis import fit_basis
from shapetween.formats.module.code import runtime, types
from shapetween.formats.module.encoding import vlq
from shapetween.formats.module.groups import nest
from shapetween.formats.module.styles import track_nodes
from shapetween.formats.options import WriteOptions
from shapetween.formats.plain import PAINT_TIMES, paint_times
from shapetween.formats.sampled import Sampled, enough_times, sampled
from shapetween.formats.table import Segments, Written
from shapetween.model.part import Part
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.numbers import number

__all__ = ["TOLERANCE", "module", "module_text"]

#: How far a drawn point may be from its place at any time, as a share of the view box's larger
#: side: a quarter of a pixel at 1000 px. Larger is seen as a shift; smaller takes more bytes.
TOLERANCE = 2.5e-4

#: What a handle's distance counts: both together move no point of their curve by more than three
#: quarters of theirs. More spends bytes on what is not seen.
HANDLE_WEIGHT = 0.75

#: The times of a part's ends are taken this far inside, and the ends themselves kept apart. So
#: nothing that happens at the very ends alone has to be followed by a smooth function.
INSIDE = 1e-6

HEAD = (
    "// Made with shapetween. d(t) is path data, play(element) plays it.\n"
    "// This code may be used by anyone for anything.\n"
)


def module(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """All of it as a JavaScript module, with its types beside it."""
    del observe
    return Written(module_text(segments, options), beside={".d.mts": types()})


def module_text(segments: Segments, options: WriteOptions) -> str:
    """The text of the module."""
    movements, ways = segments.movements, segments.ways
    box = movements[0].box
    grid = grid_of(
        [drawing for m in movements for drawing in m.at(np.array([0.0, 1.0]))], options.precision
    )
    decimals = max(0, math.ceil(-math.log10(grid.step) - 1e-9))
    places = decimals + 3
    legs = [[_part(part, grid, decimals) for part in movement.parts] for movement in movements]
    size = TOLERANCE * max(box.width, box.height)
    nests = [nest(movement, PAINT_TIMES, decimals, size) for movement in movements]
    grouped = any(groups for groups, _ in nests)
    still = not grouped and all(_stands(part) for leg in legs for part in leg)
    if still:
        legs = [[[*part[:2], *part[2][1][1:]] for part in leg] for leg in legs]
    most = max(movements, key=lambda movement: len(movement.parts))
    numbers = (box.x, box.y, box.width, box.height)
    constants = {
        "export const viewBox": " ".join(number(value, places) for value in numbers),
        "export const parts": [part.name for part in most.parts],
        "export const timing": {
            "duration": _short(1000 * options.duration),
            "easing": options.easing,
            "loop": options.loop,
            "hold": _short(1000 * options.hold),
        },
        "const closed": segments.closed,
        "const unit": _short(grid.step),
        "const origin": [_short(box.x), _short(box.y)],
        "const decimals": decimals,
        "const legs": legs,
        **({"const nests": nests} if grouped else {}),
        **({"const ways": [_short(way / options.duration) for way in ways]} if ways else {}),
    }
    lines = [f"{name}={_json(value)};" for name, value in constants.items()]
    blocks = {"always", "still paint" if still else "moving paint", f"start {options.start}"}
    blocks |= {"groups" if grouped else "no groups", "uneven" if ways else "even"}
    return HEAD + "\n".join(lines) + "\n" + runtime(blocks)


def _stands(part: list[Any]) -> bool:
    """Whether a part has one style that never changes and needs no gradient."""
    return len(part) == 3 and len(part[2]) == 2 and len(part[2][1]) < 3


def _part(part: Part, grid: Grid, decimals: int) -> list[Any]:
    """One part: its curves as letters and scales, and the tracks of its style."""
    size = max(grid.box.width, grid.box.height)
    times = enough_times(part)
    inside = np.concatenate([[0.0], np.clip(times, INSIDE, 1 - INSIDE), [1.0]])
    shape = sampled(part, inside, size)
    text, scales = _curves(shape, times, grid, TOLERANCE * size / grid.step)
    looked = paint_times(part)
    inner = np.clip(looked, INSIDE, 1 - INSIDE).tolist()
    styles = [replace(part.style(t), groups=()) for t in inner]
    tracks = [
        [
            _short(looked[track.start]),
            *track_nodes(track, looked, decimals, TOLERANCE * size),
        ]
        for track in style_tracks(styles)
    ]
    return [text, scales, *tracks]


def _curves(shape: Sampled, times: Floats, grid: Grid, tolerance: float) -> tuple[str, list[float]]:
    """A part's structure, its first points and, if it moves, its way and terms, as letters."""
    kinds = shape.straight.astype(np.intp)
    edges = np.flatnonzero(np.diff(kinds)) + 1
    runs = np.diff([0, *edges.tolist(), len(kinds)]).tolist() if len(kinds) else []
    if len(kinds) and kinds[0]:
        runs = [0, *runs]
    rings = [2 * n + closed for n, closed in zip(shape.rings, shape.closed, strict=True)]
    stream = [len(rings), *rings, len(runs), *runs]
    order = shape.points
    points = shape.stack.reshape(len(shape.stack), -1, 2)[:, order]
    first = grid.cells(points[0])
    stream += _differences(first)
    if shape.still:
        return vlq(stream), []
    way = grid.cells(points[-1]) - first
    cells = (points[1:-1] - (grid.box.x, grid.box.y)) / grid.step
    rest = cells - first - times[:, None, None] * way
    weights = np.where(np.isin(order % 4, (1, 2)), HANDLE_WEIGHT, 1.0)
    basis = fit_basis(rest, times, weights, tolerance)
    stream += [basis.functions.shape[1], *_differences(way)]
    for field, function in zip(basis.fields, basis.functions, strict=True):
        stream += [*_differences(field), *function.tolist()]
    return vlq(stream), [_short(scale) for scale in basis.scales.tolist()]


def _differences(field: Index) -> list[int]:
    """Whole numbers (P, 2) as each point's difference from the one before."""
    return [int(v) for v in np.diff(field, axis=0, prepend=np.zeros((1, 2), field.dtype)).ravel()]


def _short(value: float) -> float:
    """A number in six digits, whole if it is."""
    rounded = float(f"{value:.6g}")
    return int(rounded) if rounded == int(rounded) and abs(rounded) < 1e15 else rounded


def _json(value: Any) -> str:
    """A value as JavaScript reads it, on one line, safe inside a page's script too."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")
