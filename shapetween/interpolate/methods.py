"""Every method by its name: what a new one is added to."""

from collections.abc import Callable

from shapetween.base.errors import OptionError
from shapetween.interpolate.arap import AlexaArap, Arap
from shapetween.interpolate.base import Tween
from shapetween.interpolate.inside import Interior
from shapetween.interpolate.linear import Linear
from shapetween.interpolate.projective import PaperProjective, Projective
from shapetween.mesh.pair import MeshPair

__all__ = ["INTERIORS", "METHODS", "check_method", "tween"]

METHODS: dict[str, Callable[[MeshPair], Tween]] = {
    "projective": Projective,
    "projective-2007": PaperProjective,
    "arap": Arap,
    "arap-2000": AlexaArap,
    "linear": Linear,
}
"""Every method by the name that users choose it by."""

INTERIORS: dict[str, Interior] = {
    "projective": "homography",
    "projective-2007": "homography",
    "arap": "triangles",
    "arap-2000": "triangles",
    "linear": "triangles",
}
"""How each method carries what is inside a quad."""


def check_method(method: str) -> None:
    """Check that a name is one of `METHODS`.

    Raises
    ------
    OptionError
        If it is not.
    """
    if method not in METHODS:
        import difflib  # only for what is misspelt

        near = difflib.get_close_matches(method, METHODS, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise OptionError(f"method: {method!r} is none of {', '.join(METHODS)}{hint}")


def tween(pair: MeshPair, method: str = "projective") -> Tween:
    """Prepare a mesh pair's movement by one of `METHODS`.

    Raises
    ------
    OptionError
        If there is no such method.
    MeshError
        If a face has no in-between by this method.
    """
    check_method(method)
    return METHODS[method](pair)
