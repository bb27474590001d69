"""Whole numbers as text: five bits a letter, as source maps have them.

.. [Smap] Source Map, ECMA-426, "Base64 VLQ". There the sign is the lowest bit, here a negative
   number -n is 2 n - 1 (zigzag), so that 0 has one form.
"""

from collections.abc import Iterable

__all__ = ["LETTERS", "vlq"]

#: Letters that need no escape in JavaScript, JSON or an address.
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"


def vlq(numbers: Iterable[int]) -> str:
    """Whole numbers, lowest digits first, of which all but the last of each have a further bit.

    Examples
    --------
    >>> vlq([0, -1, 1, 16, -500])
    'ABCgBnf'
    """
    letters = []
    for number in numbers:
        rest = 2 * number if number >= 0 else -2 * number - 1
        while rest > 31:
            letters.append(LETTERS[32 + rest % 32])
            rest //= 32
        letters.append(LETTERS[rest])
    return "".join(letters)
