"""The page: the module of the movement, a player around it, and what there is to know.

Everything is in the one file; no address is fetched.
"""

import re
from functools import cache
from html import escape
from importlib import resources

from shapetween.base.observe import Observer, unobserved
from shapetween.formats.module.writer import module, module_text
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments, Written

__all__ = ["html"]

#: Backgrounds to choose from, by what the page calls them.
PAPERS = {"White": "#fff", "Grey": "#888", "Black": "#000", "Chequered": "chequered"}

SPEEDS = ("0.1", "0.25", "0.5", "1", "2", "4")

LOOPS = ("once", "repeat", "alternate")


def html(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """All of it as a page."""
    made = module(segments, options, observe)
    messages = (*segments.warnings, *made.warnings)
    return Written(_page(segments, options, tuple(dict.fromkeys(messages))), made.notices)


def _page(segments: Segments, options: WriteOptions, messages: tuple[str, ...]) -> str:
    box = segments.movements[0].box
    title = escape(segments.movements[0].title or segments.name.replace("-", " "))
    papers = dict(PAPERS)
    if options.background is not None and options.background not in papers.values():
        papers = {options.background: options.background, **papers}
    chosen = options.background or PAPERS["White"]
    count = len(segments.movements) + 1
    names = [_letter(k) for k in range(count)]
    if segments.closed:
        names[-1] = f"{names[0]} again"
    drawings = "".join(
        f'<button type="button"><div class="paper"></div>{name}</button>' for name in names
    )
    notices = "".join(f"<li>{escape(' '.join(line.split()))}</li>\n" for line in messages)
    # A page is a script's surroundings, not a module's: what it exports is of no use there.
    script = re.sub(
        r"^export (?:default )?", "", module_text(segments, options), flags=re.MULTILINE
    )
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        '<link rel="icon" href="data:,">\n'
        f"<title>{title}</title>\n<style>\n{_resource('page.css')}"
        f":root {{ --wide: {box.width / box.height:.6g}; }}\n</style>\n</head>\n<body>\n"
        f"<header><h1>{title}</h1>"
        '<button type="button" id="theme">Light or dark</button></header>\n<main>\n'
        '<div id="stage" class="paper"></div>\n'
        '<input id="seek" type="range" min="0" max="1" step="any" value="0" aria-label="Time">\n'
        '<div class="controls">\n<button type="button" id="play">Play</button>\n'
        f"{_choice('Speed', 'speed', {f'{s} times': s for s in SPEEDS}, '1')}"
        f"{_choice('Loop', 'loop', {name.capitalize(): name for name in LOOPS}, options.loop)}"
        f"{_choice('Background', 'paper', papers, chosen)}</div>\n"
        f'<h2>Drawings</h2>\n<div class="drawings">{drawings}</div>\n'
        f"<h2>Notices</h2>\n{f'<ul>{notices}</ul>' if notices else '<p>None.</p>'}\n"
        "</main>\n<footer>Made with shapetween.</footer>\n"
        f'<script type="module">\n{script}{_resource("page.js")}</script>\n</body>\n</html>\n'
    )


def _choice(label: str, name: str, choices: dict[str, str], chosen: str) -> str:
    """A list to choose from."""
    options = "".join(
        f'<option value="{escape(value)}"{" selected" if value == chosen else ""}>'
        f"{escape(text)}</option>"
        for text, value in choices.items()
    )
    return f'<label>{label}<select id="{name}">{options}</select></label>\n'


def _letter(place: int) -> str:
    """The name of a drawing."""
    return chr(ord("A") + place) if place < 26 else str(place + 1)


@cache
def _resource(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text("utf-8")
