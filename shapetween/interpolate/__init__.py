"""Methods that move a mesh pair, behind one interface."""

from collections.abc import Callable

from shapetween.errors import OptionError
from shapetween.interpolate.projective import Projective
from shapetween.interpolate.base import Tween
from shapetween.mesh import MeshPair

__all__ = ["METHODS", "Tween", "tween"]

METHODS: dict[str, Callable[[MeshPair], Tween]] = {"projective": Projective}
"""Every method by the name that users choose it by."""


def tween(pair: MeshPair, method: str = "projective") -> Tween:
    """Prepare a mesh pair's movement by one of `METHODS`.

    Raises
    ------
    OptionError
        If there is no such method.
    DegenerateQuadError
        If a quad has no projective in-between.
    """
    if method not in METHODS:
        raise OptionError(f"method: {method!r} is none of {', '.join(METHODS)}")
    return METHODS[method](pair)
