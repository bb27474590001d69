"""Names that a format allows, made of those that drawings and files have."""

import re
from collections.abc import Sequence

__all__ = ["identifier", "identifiers"]


def identifier(name: str, default: str) -> str:
    """A name of letters, digits, dashes and low lines that starts with a letter.

    Examples
    --------
    >>> identifier("left wing (2)", "part"), identifier("3d", "part"), identifier("…", "part")
    ('left-wing-2', 'part-3d', 'part')
    """
    cleaned = re.sub(r"[^A-Za-z0-9_]+", "-", name).strip("-")
    if not cleaned:
        return default
    return cleaned if cleaned[0].isalpha() else f"{default}-{cleaned}"


def identifiers(names: Sequence[str], default: str) -> list[str]:
    """Such names, each another: what an earlier one has taken is given a number."""
    found: list[str] = []
    for name in names:
        plain = identifier(name, default)
        fresh, count = plain, 1
        while fresh in found:
            count += 1
            fresh = f"{plain}-{count}"
        found.append(fresh)
    return found
