"""Numbers, and the path data of frames, in as few bytes as SVG allows.

Frames hold only absolute ``M``, ``C`` and ``Z``, in the same order in every frame, so that any
program can blend between them number by number. A number has no zero before its point and
none at its end, a minus sign or a second point parts it from the number before, and a run of
curves has one ``C``: the grammar of SVG 2, section 9.3.9, read as tightly as it may be.
"""

import math
from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.base.errors import OptionError
from shapetween.model.drawing import Box, Drawing

__all__ = [
    "characters",
    "check_digits",
    "decimals_for",
    "decimals_of",
    "number",
    "path_data",
    "written",
]

#: Share of the view box's larger side that a last decimal may be worth, before it is rounded to a
#: power of ten. Larger and curves show steps when enlarged; smaller and files grow unseen.
ROUNDING_SHARE = 4e-5

#: Largest whole number that every double below it reaches; past it decimals would be invented.
LARGEST_EXACT = 2.0**53

#: Least share of the view box's larger side that counts as the size of a drawing: what is smaller
#: is a dot to anyone, and would be written with decimals without end.
LEAST_DRAWN = 1e-3

_SPACE, _MINUS, _POINT, _ZERO = b" -.0"


def decimals_for(box: Box, precision: int | None = None) -> int:
    """Decimals that coordinates in `box` are written with.

    Parameters
    ----------
    box : Box
    precision : int, optional
        The user's own choice, from 0 to 15.

    Returns
    -------
    int
        By default as many as bring the rounding step to about 1/10000 of the box's larger side.

    Raises
    ------
    OptionError
        If `precision` is out of its range.

    Examples
    --------
    >>> decimals_for(Box(0, 0, 24, 24)), decimals_for(Box(0, 0, 1000, 500))
    (3, 1)
    """
    if precision is not None:
        if not 0 <= precision <= 15:
            raise OptionError(f"precision {precision}: expected a number of decimals from 0 to 15")
        return precision
    size = max(box.width, box.height)
    return max(0, round(-math.log10(size * ROUNDING_SHARE))) if size > 0 else 0


def decimals_of(drawing: Drawing, precision: int | None = None) -> int:
    """Decimals that a drawing's coordinates are written with.

    As `decimals_for` has them, but of a small drawing on a large page as many as its own size
    needs.
    """
    if precision is not None or not drawing.shapes:
        return decimals_for(drawing.box, precision)
    page, drawn = (max(box.width, box.height) for box in (drawing.box, drawing.drawn))
    size = max(min(page, drawn), LEAST_DRAWN * page)
    return decimals_for(Box(0, 0, size, size))


def number(value: float, decimals: int) -> str:
    """One number, rounded and written as short as it goes.

    Examples
    --------
    >>> [number(v, 2) for v in (0.5, -0.25, 3.0, 120.0, -0.001)]
    ['.5', '-.25', '3', '120', '0']
    """
    text = f"{value:.{decimals}f}"
    if decimals:
        text = text.rstrip("0").removesuffix(".")
    sign, digits = ("-", text[1:]) if text.startswith("-") else ("", text)
    digits = digits.removeprefix("0") or "0"
    return digits if digits == "0" else sign + digits


def written(values: Floats, decimals: int) -> Floats:
    """What a reader of the file gets for `values`, any shape."""
    scale = 10.0**decimals
    return np.rint(values * scale) / scale


def path_data(
    curves: Curves, rings: Sequence[int], closed: Sequence[bool], decimals: int
) -> tuple[str, ...]:
    """Path data of every frame, all with the same commands.

    Parameters
    ----------
    curves : (F, N, 4, 2) float64
        Control points, ring after ring; within a ring each curve starts where the last one ended.
    rings : sequence of int
        Number of curves in each ring, N together.
    closed : sequence of bool
        Which rings end with ``Z``.
    decimals : int

    Returns
    -------
    tuple of str
        One for each frame.

    Raises
    ------
    OptionError
        If a coordinate has more digits than a double carries.

    Notes
    -----
    All frames are laid out at once as a table of characters, a row for each number, in which 0
    stands for nothing written.

    Examples
    --------
    >>> curve = np.array([[[[0, 0], [0.5, 0.25], [1, -1], [0, 0]]]])
    >>> path_data(curve, [1], [True], 2)
    ('M0 0C.5.25 1-1 0 0Z',)
    """
    order, letters, ends = _layout(rings, closed)
    values = curves.reshape(len(curves), -1)[:, order]
    if not values.size:
        return ("",) * len(curves)
    check_digits(values, decimals)
    table = characters(np.rint(values * 10.0**decimals).astype(np.int64), decimals, letters, ends)
    return tuple(frame.tobytes().translate(None, b"\0").decode("ascii") for frame in table)


def check_digits(values: Floats, decimals: int) -> None:
    """Check that doubles carry the decimals of numbers of any shape.

    Raises
    ------
    OptionError
        If they do not.
    """
    peak = float(np.abs(values).max(initial=0.0)) * 10.0**decimals
    if peak >= LARGEST_EXACT:
        raise OptionError(
            f"a coordinate of {peak / 10.0**decimals:.3g} has no {decimals} decimals; "
            "expected a lower precision"
        )


def _layout(
    rings: Sequence[int], closed: Sequence[bool]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Which coordinates a path writes, and the letter before and after each (0 for none)."""
    order: list[np.ndarray] = []
    letters: list[bytes] = []
    ends: list[bytes] = []
    first = 0
    for count, is_closed in zip(rings, closed, strict=True):
        # The first point of a curve is written for the first curve of its ring only.
        index = np.arange(first * 8, (first + count) * 8).reshape(count, 8)
        order += [index[0, :2], index[:, 2:].ravel()]
        letters.append(b"M\0C" + b"\0" * (6 * count - 1))
        ends.append(b"\0" * (6 * count + 1) + (b"Z" if is_closed else b"\0"))
        first += count
    return (
        np.concatenate([np.zeros(0, np.intp), *order]),
        np.frombuffer(b"".join(letters), np.uint8),
        np.frombuffer(b"".join(ends), np.uint8),
    )


def characters(
    scaled: np.ndarray, decimals: int, letters: np.ndarray, ends: np.ndarray
) -> np.ndarray:
    """Characters of whole numbers of last decimals, (F, K) to (F, K, W), 0 where there is none.

    `letters` and `ends` are the characters before and after each of the K numbers, 0 for none.
    """
    size = np.abs(scaled)
    whole_digits = len(str(int(size.max()) // 10**decimals))
    width = whole_digits + decimals
    digits = np.zeros((width, *scaled.shape), np.uint8)
    rest = size
    for place in range(width - 1, -1, -1):
        shorter = rest // 10
        digits[place] = (rest - shorter * 10).astype(np.uint8)
        rest = shorter
    whole, part = digits[:whole_digits], digits[whole_digits:]

    # A digit is written if it or a digit farther from the point is not 0.
    whole_shown = np.logical_or.accumulate(whole != 0, axis=0)
    part_shown = np.logical_or.accumulate(part[::-1] != 0, axis=0)[::-1]
    whole_shown[-1] |= size == 0
    has_point = part_shown[0] if decimals else np.zeros(scaled.shape, np.bool_)
    starts_with_point = ~whole_shown[-1]

    negative = scaled < 0
    follows_point = np.roll(has_point, 1, axis=1)
    parted = (letters != 0) | negative | (starts_with_point & follows_point)

    table = np.zeros((width + 5, *scaled.shape), np.uint8)
    table[0] = letters
    table[1] = np.where(parted, 0, _SPACE)
    table[2] = np.where(negative, _MINUS, 0)
    table[3 : 3 + whole_digits] = np.where(whole_shown, whole + _ZERO, 0)
    table[3 + whole_digits] = np.where(has_point, _POINT, 0)
    table[4 + whole_digits : -1] = np.where(part_shown, part + _ZERO, 0)
    table[-1] = ends
    return np.moveaxis(table, 0, -1)
