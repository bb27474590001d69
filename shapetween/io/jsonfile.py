"""JSON that a person wrote or edited, read strictly: every error names its place in the file."""

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from shapetween.base.errors import MeshError

__all__ = ["check_keys", "parse", "real", "rows"]


def parse(text: str, name: str) -> Any:
    """What the text says.

    Parameters
    ----------
    text : str
    name : str
        What errors call the file.

    Raises
    ------
    MeshError
        If it is not JSON, holds a number that is none, or says a key twice.
    """
    try:
        return json.loads(text, parse_constant=_refuse_constant, object_pairs_hook=_unique_keys)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise MeshError(f"{name}: {where}: not JSON: {error.msg}") from error
    except (MeshError, RecursionError, ValueError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise MeshError(f"{name}: {reason}") from error


def _refuse_constant(constant: str) -> float:
    raise MeshError(f"{constant} is not a number that may stand here")


def _unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    keys = [key for key, _ in pairs]
    for k, key in enumerate(keys):
        if key in keys[:k]:
            raise MeshError(f"key {key!r} stands twice in one object")
    return dict(pairs)


def check_keys(data: dict[str, Any], allowed: set[str], place: str) -> None:
    """Refuse an object's keys that nobody will read.

    Raises
    ------
    MeshError
        If there are any; `place` is what its text begins with.
    """
    unknown = sorted(set(data) - allowed)
    if unknown:
        raise MeshError(f"{place}unknown key {unknown[0]!r}; expected {', '.join(sorted(allowed))}")


def rows(value: object, place: str, width: int, item: Callable[[object, str], Any]) -> Any:
    """A list of rows of `width` items, each read by `item`, as an array.

    Raises
    ------
    MeshError
        If it is none; the text names the place.
    """
    what = "[x, y]" if width == 2 else f"{width} vertex numbers"
    if not isinstance(value, list):
        raise MeshError(f"{place}: expected a list of {what}")
    found = []
    for k, row in enumerate(value):
        if not isinstance(row, list) or len(row) != width:
            raise MeshError(f"{place}[{k}]: expected {what}")
        found.append([item(entry, f"{place}[{k}][{n}]") for n, entry in enumerate(row)])
    return np.array(found).reshape(-1, width)


def real(value: object, place: str) -> float:
    """A number that an array can hold.

    Raises
    ------
    MeshError
        If it is none; the text names the place.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise MeshError(f"{place}: expected a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise MeshError(f"{place}: the number is too large")
    return number
