"""The files of the page, by a fixed list: no request names a path."""

from importlib.resources import files
from typing import NamedTuple

__all__ = ["FILES", "Static", "static"]

HTML, CSS, JS = "text/html; charset=utf-8", "text/css; charset=utf-8", "text/javascript"

#: Every file, by the address it is asked for. Their kinds are said here and not looked up, for what
#: a machine believes of endings may be wrong, and a browser runs no script that is called a text.
FILES = {
    "/": ("index.html", HTML),
    "/studio.css": ("studio.css", CSS),
    "/icon.svg": ("icon.svg", "image/svg+xml"),
    **{
        f"/{name}.js": (f"{name}.js", f"{JS}; charset=utf-8")
        for name in (
            "alternatives",
            "api",
            "app",
            "chain",
            "drawing",
            "exports",
            "geometry",
            "keys",
            "panel",
            "parts",
            "pins",
            "stage",
            "state",
        )
    },
}


class Static(NamedTuple):
    """One file, and what it is."""

    data: bytes
    kind: str


def static(path: str) -> Static | None:
    """What is at an address; None if there is nothing."""
    if path not in FILES:
        return None
    name, kind = FILES[path]
    return Static((files("shapetween.studio") / "static" / name).read_bytes(), kind)
