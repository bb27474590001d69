"""The gallery's page, which shows all exhibits with a sentence on each."""

from collections.abc import Sequence
from html import escape
from importlib.resources import files

from shapetween.gallery.exhibits import Exhibit, Room

__all__ = ["index_html"]

INTRODUCTION = (
    "One drawing becomes another: their outlines are matched, both are split into the same quads, "
    "and every quad moves as a plane in perspective would. First the figures of the paper that "
    "this comes from, <cite>Projective Transformations for Image Transition Animations</cite> by "
    "Wong, Kovesi and Datta (2007), drawn anew; then pairs as they come out of the command line; "
    "and at last some that do not come out well."
)


def index_html(rooms: Sequence[Room]) -> str:
    """The page of rooms whose pictures lie beside it."""
    links = "".join(
        f'<a href="#{room.key}">{escape(room.title)}</a>' for room in rooms if room.exhibits
    )
    style = (files("shapetween.gallery") / "page.css").read_text("utf-8")
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f"<title>shapetween: gallery</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
        f"<header>\n<h1>shapetween</h1>\n<p>{INTRODUCTION}</p>\n<nav>{links}</nav>\n</header>\n"
        f"<main>\n{''.join(_room(room) for room in rooms)}</main>\n"
        "<footer>Drawn by <code>shapetween gallery -o DIR</code>; the drawings' sources and "
        "licences are in <code>gallery/inputs/SOURCES.md</code>.</footer>\n</body>\n</html>\n"
    )


def _room(room: Room) -> str:
    kind = "rows" if any(exhibit.wide for exhibit in room.exhibits) else "tiles"
    inside = "".join(_exhibit(exhibit) for exhibit in room.exhibits)
    return (
        f'<section id="{room.key}">\n<h2>{escape(room.title)}</h2>\n'
        f'<p class="room">{escape(room.text)}</p>\n'
        f'<div class="{kind}">\n{inside}</div>\n</section>\n'
    )


def _exhibit(exhibit: Exhibit) -> str:
    pictures = "".join(
        f'<img src="{escape(p.name)}" alt="{escape(p.shows)}" loading="lazy">'
        for p in exhibit.pictures
    )
    shown = f'<div class="pictures">{pictures}</div>\n' if pictures else ""
    credit = f'<p class="credit">{escape(exhibit.credit)}</p>\n' if exhibit.credit else ""
    return (
        f'<article class="exhibit">\n<div>\n<h3>{escape(exhibit.title)}</h3>\n'
        f"<p>{escape(exhibit.text)}</p>\n</div>\n"
        f"{shown}{_table(exhibit.table)}{credit}</article>\n"
    )


def _table(rows: Sequence[Sequence[str]]) -> str:
    if not rows:
        return ""
    heads = "".join(f'<th scope="col">{escape(cell)}</th>' for cell in rows[0])
    body = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>{"".join(map(_cell, row[1:]))}</tr>\n'
        for row in rows[1:]
    )
    return (
        '<div class="scroll" tabindex="0" role="region" aria-label="Table">\n<table>\n'
        f"<thead><tr>{heads}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n</div>\n"
    )


def _cell(text: str) -> str:
    if text.startswith("*"):
        return f'<td class="best">{escape(text[1:])}</td>'
    return f"<td>{escape(text)}</td>"
