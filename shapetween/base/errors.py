"""What can be wrong with a user's input, one class for each thing a caller could do about it."""

from collections.abc import Iterable

__all__ = [
    "BudgetError",
    "DegenerateQuadError",
    "InputError",
    "MeshError",
    "OptionError",
    "OutlineError",
    "ShapeError",
    "ShapetweenError",
]


class ShapetweenError(Exception):
    """Anything the user can put right; its text is one line: what is wrong, and what would do."""


class InputError(ShapetweenError):
    """A file that cannot be read as a drawing.

    Attributes
    ----------
    name : str
        The file, as the user named it.
    """

    def __init__(self, name: str, message: str) -> None:
        super().__init__(f"{name}: {message}")
        self.name = name


class BudgetError(InputError):
    """A file past one of the limits that keep reading quick and safe."""


class OutlineError(ShapetweenError):
    """An outline that cannot be matched or meshed: no area, or crossing itself."""


class MeshError(ShapetweenError):
    """A mesh that is not valid, or that does not fit the outlines."""


class DegenerateQuadError(MeshError):
    """Quads that have no projective in-between.

    Attributes
    ----------
    indices : tuple of int
        The quads, counted from 0.
    """

    def __init__(self, indices: Iterable[int], message: str) -> None:
        self.indices = tuple(int(i) for i in indices)
        named = ", ".join(str(i) for i in self.indices[:8]) + (
            ", ..." if len(self.indices) > 8 else ""
        )
        super().__init__(f"quad {named}: {message}")


class OptionError(ShapetweenError):
    """An option's value that cannot be used with these files."""


class ShapeError(ShapetweenError, ValueError):
    """An array of the wrong shape, or with numbers that are not finite."""
