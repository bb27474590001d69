"""A page of all that a batch has made, beside the files that it shows."""

from collections.abc import Sequence
from functools import cache
from html import escape
from importlib import resources
from pathlib import PurePath
from urllib.parse import quote

from shapetween.batch.entry import Entry

__all__ = ["page_html"]

#: How sure a matching may be, the least sure first: a pair is as sure as its least sure ring.
CONFIDENCES = ("unsure", "likely", "sure")


def page_html(entries: Sequence[Entry], title: str) -> str:
    """The page.

    Parameters
    ----------
    entries : sequence of Entry
        Of a summary; paths of what was made are relative to the page.
    title : str
    """
    failed = sum(entry["status"] != "done" for entry in entries)
    count = f"{len(entries)} pairs" + (f", of which {failed} failed" if failed else "")
    found = [name for name in (*CONFIDENCES, "failed") if name in map(_sort, entries)]
    choices = "".join(f'<option value="{name}">{name.capitalize()}</option>' for name in found)
    cards = "".join(map(_card, entries))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
        f'<link rel="icon" href="data:,">\n<title>{escape(title)}</title>\n'
        f"<style>\n{_resource('page.css')}</style>\n</head>\n<body>\n"
        f"<header><h1>{escape(title)}</h1><p>{count}</p></header>\n"
        '<form>\n<input type="search" name="name" placeholder="Name" aria-label="Name">\n'
        '<select name="confidence" aria-label="Confidence"><option value="">Any confidence</option>'
        f'{choices}</select>\n<label><input type="checkbox" name="warned">With warnings</label>\n'
        f"<output></output>\n</form>\n<main>\n{cards}</main>\n"
        "<footer>Made with shapetween. A click on a picture plays it again.</footer>\n"
        f"<script>\n{_resource('page.js')}</script>\n</body>\n</html>\n"
    )


def _sort(entry: Entry) -> str:
    """How sure a pair is, or that it failed; empty where nothing had to be matched."""
    if entry["status"] != "done":
        return "failed"
    rings = entry["report"].get("rings", [])
    found = {ring["matching"]["confidence"] for ring in rings}
    return next((name for name in CONFIDENCES if name in found), "")


def _card(entry: Entry) -> str:
    a, b = (PurePath(entry[side]).stem for side in ("a", "b"))
    name, sort = escape(f"{a} to {b}"), _sort(entry)
    if sort == "failed":
        error = escape(str(entry["error"]))
        return (
            f'<article class="failed"><div class="picture">{error}</div>\n'
            f'<h2>{name}</h2><p class="note"><b>Failed</b></p></article>\n'
        )
    link = quote(str(entry["out"]))
    warnings = entry["report"].get("warnings", [])
    lines = "".join(f"<li>{escape(' '.join(line.split()))}</li>" for line in warnings)
    label = f"<b>{sort.capitalize()}</b>" if sort else ""
    many = "1 warning" if len(warnings) == 1 else f"{len(warnings)} warnings"
    more = (
        f'<details class="note"><summary>{many}</summary><ul>{lines}</ul></details>'
        if lines
        else ""
    )
    return (
        f'<article class="{sort}"><button type="button" class="picture">'
        f'<img data-src="{link}" alt="{name}"></button>\n'
        f'<h2><a href="{link}">{name}</a></h2><p class="note">{label}</p>{more}</article>\n'
    )


@cache
def _resource(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text("utf-8")
