"""A whole Lottie animation: compositions, their time, and the file around them.

Keyframes run straight in the movement's own time. An easing, rests, the way back and further legs
are time remaps of compositions, so that nothing is written twice.
"""

import io
import json
import zipfile
from typing import Any

import numpy as np

from shapetween.base.observe import Observer, unobserved
from shapetween.base.version import installed_version
from shapetween.formats.grid import grid_of
from shapetween.formats.lottie.groups import frame_size
from shapetween.formats.lottie.layers import leg_layers
from shapetween.formats.lottie.properties import FRAME_DECIMALS, Json, short, transform
from shapetween.formats.options import WriteOptions
from shapetween.formats.plain import colour_losses, group_losses
from shapetween.formats.table import Segments, Written
from shapetween.timing.easing import LINEAR, handles_of
from shapetween.timing.timeline import Iteration, Timeline

__all__ = ["FRAMES_A_SECOND", "dot_lottie", "lottie", "lottie_json"]

#: Of the animation's clock; players show what lies between two frames too.
FRAMES_A_SECOND = 60

#: The date of every file in a .lottie, so that the same movement is the same bytes.
NO_DATE = (1980, 1, 1, 0, 0, 0)


def lottie(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """All of it as Lottie's JSON."""
    del observe
    animation, losses = lottie_json(segments, options)
    return Written.of(_text(animation), losses)


def dot_lottie(
    segments: Segments, options: WriteOptions, observe: Observer = unobserved
) -> Written:
    """All of it as a .lottie file: the JSON, packed."""
    del observe
    animation, losses = lottie_json(segments, options)
    manifest = {
        "version": "2",
        "generator": f"shapetween {installed_version()}",
        "animations": [{"id": "morph"}],
    }
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in (("manifest.json", manifest), ("a/morph.json", animation)):
            info = zipfile.ZipInfo(name, NO_DATE)
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, _text(content))
    return Written.of(packed.getvalue(), losses)


def lottie_json(segments: Segments, options: WriteOptions) -> tuple[Json, list[str]]:
    """The animation as plain values, and what it does not hold."""
    movements = segments.movements
    box = movements[0].box
    ends = [drawing for m in movements for drawing in m.at(np.array([0.0, 1.0]))]
    grid = grid_of(ends, options.precision)
    ways = segments.lengths(options.duration)
    plan = Timeline(ways, options.loop, options.hold, segments.closed)
    whole = plan.seconds * FRAMES_A_SECOND
    # Players show nothing at the very end; where it is not the start, one frame more shows it.
    starts_over = options.loop == "alternate" or (options.loop == "repeat" and segments.closed)
    end = short(whole if starts_over else whole + 1, FRAME_DECIMALS)
    width, height = frame_size(box)
    root: Json = {
        "v": "5.7.0",
        "ver": 10000,
        "fr": FRAMES_A_SECOND,
        "ip": 0,
        "op": end,
        "w": width,
        "h": height,
        "nm": segments.name,
        "ddd": 0,
        "assets": [],
        "layers": [],
        "markers": [*_markers(plan), {"cm": "reduced motion", "tm": 0, "dr": 1}],
    }
    made = [
        leg_layers(movement, grid, options, way * FRAMES_A_SECOND, f"leg {k}")
        for k, (movement, way) in enumerate(zip(movements, ways, strict=True))
    ]
    root["assets"] = [asset for _, assets, _ in made for asset in assets]
    plain = len(movements) == 1 and options.loop == "once" and options.hold == 0
    if plain and handles_of(options.easing) == LINEAR:
        root["layers"] = made[0][0]
    else:
        root["assets"] += [
            {"id": f"leg {k}", "layers": layers} for k, (layers, _, _) in enumerate(made)
        ]
        iterations = [
            (k, iteration) for k in range(len(movements)) for iteration in plan.iterations(k)
        ]
        last = max(iteration.until for _, iteration in iterations)
        root["layers"] = [
            _remapped(index, leg, iteration, root, options, ends=iteration.until == last)
            for index, (leg, iteration) in enumerate(iterations, start=1)
        ]
    lost = [*colour_losses(movements, "Lottie"), *group_losses(movements, "Lottie", composed=True)]
    return root, [*lost, *(loss for _, _, losses in made for loss in losses)]


def _remapped(
    index: int,
    leg: int,
    iteration: Iteration,
    root: Json,
    options: WriteOptions,
    *,
    ends: bool,
) -> Json:
    """A layer that shows a leg on one of its ways."""
    x1, y1, x2, y2 = handles_of(options.easing)
    values = (0.0, iteration.end - iteration.start)
    if iteration.back:  # backwards a curve starts at its end, and both axes run the other way
        x1, y1, x2, y2 = 1 - x2, 1 - y2, 1 - x1, 1 - y1
        values = values[::-1]
    ease = {"o": {"x": [x1], "y": [y1]}, "i": {"x": [x2], "y": [y2]}}
    stand = {"o": {"x": [0], "y": [0]}, "i": {"x": [1], "y": [1]}}
    start, end, shown = map(_frames, (iteration.start, iteration.end, iteration.shown))
    keys: list[Json] = [{"t": start, "s": [values[0]], **ease}, {"t": end, "s": [values[1]]}]
    if shown < start:
        keys.insert(0, {"t": shown, "s": [values[0]], **stand})
    until = root["op"] if ends else _frames(iteration.until)
    return {
        "ddd": 0,
        "ty": 0,
        "ind": index,
        "nm": _name(leg, iteration),
        "refId": f"leg {leg}",
        "sr": 1,
        "ks": transform(),
        "w": root["w"],
        "h": root["h"],
        "ip": shown,
        "op": until,
        "st": 0,
        "bm": 0,
        "tm": {"a": 1, "k": keys},
    }


def _markers(plan: Timeline) -> list[Json]:
    """Every way by its name, for players that play a part of it."""
    return [
        {
            "cm": _name(leg, iteration),
            "tm": _frames(iteration.start),
            "dr": _frames(iteration.end - iteration.start),
        }
        for leg in range(len(plan.ways))
        for iteration in plan.iterations(leg)
    ]


def _frames(seconds: float) -> float:
    """Seconds as frames."""
    return short(seconds * FRAMES_A_SECOND, FRAME_DECIMALS)


def _name(leg: int, iteration: Iteration) -> str:
    """A way's name, as "A to B"."""
    first, last = (leg + 1, leg) if iteration.back else (leg, leg + 1)
    return f"{_letter(first)} to {_letter(last)}"


def _letter(place: int) -> str:
    """The name of a drawing."""
    return chr(ord("A") + place) if place < 26 else str(place + 1)


def _text(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")) + "\n"
