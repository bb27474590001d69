"""The code of a module, no more of it than is needed."""

import re
from collections.abc import Set
from functools import cache
from importlib import resources

__all__ = ["runtime", "types"]

#: A string, a template or a regular expression, in which nothing may be left out.
_LITERAL = re.compile(r'("(?:[^"\\]|\\.)*"|`[^`]*`|/[\\^][^/ ]*/)')

#: Spaces around what parts words by itself. Two signs in a row are never written in the code.
_SPACES = re.compile(r" *([-+*/%=<>!&|?:;,.(){}\[\]]) *")


def runtime(wanted: Set[str]) -> str:
    """The blocks of `runtime.js` of which a name is wanted, in their order.

    Parameters
    ----------
    wanted : set of str
        Such as ``always``, ``still paint`` and ``start load``.
    """
    lines = []
    kept = False
    for line in _resource("runtime.js").splitlines():
        text = line.strip()
        if text.startswith("//: "):
            kept = bool(wanted & set(text.removeprefix("//: ").split(", ")))
        elif kept and text and not text.startswith("//"):
            lines.append(_tight(text))
    return "\n".join(lines) + "\n"


def types() -> str:
    """Types of what a module exports."""
    return _resource("types.d.mts")


def _tight(line: str) -> str:
    """A line without needless spaces."""
    parts = _LITERAL.split(line)
    parts[::2] = [_SPACES.sub(r"\1", part) for part in parts[::2]]
    return "".join(parts)


@cache
def _resource(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text("utf-8")
