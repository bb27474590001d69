"""The page of a comparison: one file that needs nothing else."""

import base64
import json
import math
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files

import numpy as np

from shapetween.api import Morph
from shapetween.compare.measures import COLUMNS, TIMES, Column, Figures
from shapetween.compare.panels import film_strip, playing, seen_box
from shapetween.compare.plots import Series, line_plot, stripes
from shapetween.compare.variants import Variant
from shapetween.model.drawing import Box

__all__ = ["page_html"]

#: Frames of a film strip, both ends among them; each is one of `TIMES`.
STRIP_FRAMES = 7

#: What one way's speed may be multiplied with.
SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0)

#: Values that a best one may differ from and share its honour.
TIE = 1e-4


def page_html(
    names: tuple[str, str],
    variants: Sequence[Variant],
    figures: Mapping[str, Figures],
    morph: Morph,
) -> str:
    """Write the page.

    Parameters
    ----------
    names : (str, str)
        What the two drawings are called.
    variants : sequence of Variant
    figures : mapping of str to Figures
        By key, for all variants that have a movement.
    morph : Morph
        Whose mesh and warnings are shown.
    """
    box = seen_box(variants)
    title = f"{names[0]} to {names[1]}"
    sections = [
        _stage(variants, box),
        _strips(variants, figures, box),
        _plots(variants, figures),
        _table(variants, figures),
        _mesh(morph, names),
        _warnings(morph),
    ]
    here = files("shapetween.compare")
    texts = {name: (here / name).read_text("utf-8") for name in ("page.css", "page.js")}
    return (
        "<!DOCTYPE html>\n"
        '<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n'
        f"<title>{escape(title)} · shapetween</title>\n"
        f"<style>\n{texts['page.css']}</style>\n</head>\n<body>\n"
        f"{_header(names, variants)}<main>\n{''.join(sections)}</main>\n"
        f"{_controls()}"
        f'<script type="application/json" id="data">{_data(variants, figures)}</script>\n'
        f"<script>\n{texts['page.js']}</script>\n</body>\n</html>\n"
    )


def _header(names: tuple[str, str], variants: Sequence[Variant]) -> str:
    first, second = (escape(name) for name in names)
    return (
        f'<header>\n<h1>{first} <span class="to" aria-label="to">→</span> {second}</h1>\n'
        f"<p>One matching and one mesh, moved in {len(variants)} ways.</p>\n"
        '<button id="theme" type="button" aria-label="Light or dark" title="Light or dark">'
        "◐</button>\n</header>\n"
    )


def _css(variant: Variant) -> str:
    """The class that gives a variant its colour: the same in panels, plots and table."""
    if variant.folds == "prevent":
        return "c-first"
    return f"c-{variant.method}"


def _stage(variants: Sequence[Variant], box: Box) -> str:
    panels = []
    for variant in variants:
        css = _css(variant)
        if variant.failure:
            inside = (
                f'<div class="paper failed" style="aspect-ratio:{box.width:.6g}/{box.height:.6g}">'
                f"<p><b>No movement.</b> {escape(variant.failure)}</p></div>"
            )
        else:
            inside = f'<div class="paper">{playing(variant, box)}</div>'
        readout = "" if variant.failure else '<p class="now" aria-hidden="true"></p>'
        panels.append(
            f'<figure class="panel {css}" data-key="{variant.key}">\n{inside}\n'
            f"<figcaption><h2>{escape(variant.title)}</h2>"
            f"<p>{escape(variant.about)}</p>{readout}</figcaption></figure>\n"
        )
    return f'<section class="stage" aria-label="Animations">\n{"".join(panels)}</section>\n'


def _strips(variants: Sequence[Variant], figures: Mapping[str, Figures], box: Box) -> str:
    picks = np.linspace(0, len(TIMES) - 1, STRIP_FRAMES).round().astype(np.intp)
    rows = []
    for variant in variants:
        css = _css(variant)
        if variant.failure:
            strip = f'<p class="failed">{escape(variant.failure)}</p>'
        else:
            crossing = figures[variant.key].crossing[picks].tolist()
            strip = film_strip(variant, box, TIMES[picks], crossing)
        rows.append(
            f'<div class="strip {css}"><h3><i></i>{escape(variant.title)}</h3>{strip}</div>\n'
        )
    marked = any(figures[v.key].crossing[picks].any() for v in variants if v.key in figures)
    note = (
        "<p>Framed in red: an outline crosses itself or another of its shape.</p>\n"
        if marked
        else ""
    )
    return f"<section>\n<h2>Frame by frame</h2>\n{note}{''.join(rows)}</section>\n"


def _plots(variants: Sequence[Variant], figures: Mapping[str, Figures]) -> str:
    shown = [v for v in variants if v.key in figures]

    def series(name: str) -> list[Series]:
        return [Series(v.title, _css(v), getattr(figures[v.key], name)) for v in shown]

    crossing = [(v.title, _css(v), figures[v.key].crossing) for v in shown]
    plots = [
        ("Area", "Of the larger end's.", line_plot(series("area"), "Area over time", True)),
        (
            "Perimeter",
            "Of the longer end's.",
            line_plot(series("perimeter"), "Perimeter over time", True),
        ),
        (
            "Distortion",
            "Mean ratio of stretches inside, less one, against the nearer end. 0 is rigid.",
            line_plot(series("distortion"), "Distortion over time", False),
        ),
        (
            "Self-crossing",
            "While an outline crosses itself or another of its shape.",
            stripes(crossing, "Self-crossing over time"),
        ),
    ]
    legend = "".join(f'<li class="{_css(v)}"><i></i>{escape(v.title)}</li>' for v in shown)
    cells = "".join(
        f"<figure><figcaption><h3>{name}</h3><p>{note}</p></figcaption>{plot}</figure>\n"
        for name, note, plot in plots
    )
    return (
        f'<section>\n<h2>Over time</h2>\n<ul class="legend">{legend}</ul>\n'
        f'<div class="plots">\n{cells}</div>\n</section>\n'
    )


def _table(variants: Sequence[Variant], figures: Mapping[str, Figures]) -> str:
    best = {c.key: _best(c, figures) for c in COLUMNS}
    heads = "".join(f'<th scope="col">{escape(c.title)}</th>' for c in COLUMNS)
    rows = []
    for variant in variants:
        name = f'<th scope="row" class="{_css(variant)}"><i></i>{escape(variant.title)}</th>'
        if variant.failure:
            cells = f'<td class="failed" colspan="{len(COLUMNS)}">{escape(variant.failure)}</td>'
        else:
            whole = figures[variant.key].whole
            cells = "".join(
                f'<td class="best">{_shown(whole[c.key], c)}</td>'
                if whole[c.key] <= best[c.key]
                else f"<td>{_shown(whole[c.key], c)}</td>"
                for c in COLUMNS
            )
        rows.append(f"<tr>{name}{cells}</tr>\n")
    meanings = "".join(f"<dt>{escape(c.title)}</dt><dd>{escape(c.meaning)}</dd>" for c in COLUMNS)
    return (
        "<section>\n<h2>Figures</h2>\n<p>Less is better, and the best are marked. Travel and "
        "unevenness say how smooth a movement is, which straight lines always win.</p>\n"
        f'<div class="scroll" tabindex="0" role="region" aria-label="Figures">\n<table>\n'
        f'<thead><tr><th scope="col">Method</th>{heads}</tr></thead>\n'
        f"<tbody>\n{''.join(rows)}</tbody>\n</table>\n</div>\n"
        f"<details><summary>What the columns mean</summary><dl>{meanings}</dl></details>\n"
        "</section>\n"
    )


def _best(column: Column, figures: Mapping[str, Figures]) -> float:
    """The largest value that is marked; less than all where none is better than another."""
    values = [each.whole[column.key] for each in figures.values()]
    least = min(values) + TIE
    return least if column.judged and max(values) > least else -math.inf


def _shown(value: float, column: Column) -> str:
    if column.unit == "%":
        return f"{100 * value:.1f} %"
    return f"{value:.2f}"


def _mesh(morph: Morph, names: tuple[str, str]) -> str:
    """The meshes of both drawings, as a picture of its own: its style sheet stays its own."""
    text = morph.mesh_svg(names)
    data = base64.b64encode(text.encode()).decode()
    return (
        "<section>\n<h2>The mesh</h2>\n<p>All of them move these quads. Choose Mesh below the "
        "animations to see what each makes of them.</p>\n"
        f'<img class="mesh" alt="Both drawings with their quads" '
        f'src="data:image/svg+xml;base64,{data}">\n</section>\n'
    )


def _warnings(morph: Morph) -> str:
    if not morph.warnings:
        return ""
    items = "".join(f"<li>{escape(warning)}</li>" for warning in morph.warnings)
    return f'<section>\n<h2>To know</h2>\n<ul class="warnings">{items}</ul>\n</section>\n'


def _controls() -> str:
    speeds = "".join(
        f'<option value="{speed:g}"{" selected" * (speed == 1)}>{speed:g}&times;</option>'
        for speed in SPEEDS
    )
    return (
        '<div class="controls" role="group" aria-label="Playback">\n'
        '<button id="play" type="button" aria-label="Play" title="Play or pause (space)">'
        '<svg viewBox="0 0 20 20" aria-hidden="true"><path class="go" d="M6 3l11 7-11 7z"/>'
        '<path class="stop" d="M5 3h4v14H5zM11 3h4v14h-4z"/></svg></button>\n'
        '<input id="time" type="range" min="0" max="1" step="0.001" value="0" aria-label="Time">\n'
        '<output id="clock" for="time">0.00</output>\n'
        f'<label>Speed <select id="speed">{speeds}</select></label>\n'
        '<label class="tick"><input id="mesh" type="checkbox"> Mesh</label>\n</div>\n'
    )


def _data(variants: Sequence[Variant], figures: Mapping[str, Figures]) -> str:
    data = {
        v.key: {
            "area": figures[v.key].area.round(3).tolist(),
            "perimeter": figures[v.key].perimeter.round(3).tolist(),
            "distortion": figures[v.key].distortion.round(3).tolist(),
            "crossing": figures[v.key].crossing.astype(int).tolist(),
        }
        for v in variants
        if v.key in figures
    }
    # Keys are ours and values numbers; still, nothing in here may end the script element.
    return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
