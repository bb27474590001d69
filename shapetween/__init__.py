"""Turn two vector drawings into the movement between them.

>>> import shapetween as st
>>> square = [[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]]
>>> st.interpolate_quads(square, square, [0.5]).shape
(1, 1, 4, 2)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from shapetween.api import Chain, Morph, chain, morph
    from shapetween.base.errors import ShapetweenError
    from shapetween.interop import between
    from shapetween.interpolate import tween
    from shapetween.interpolate.quads import interpolate_quads
    from shapetween.mesh.pair import MeshPair
    from shapetween.model.drawing import Drawing

__all__ = [
    "Chain",
    "Drawing",
    "MeshPair",
    "Morph",
    "ShapetweenError",
    "between",
    "chain",
    "interpolate_quads",
    "morph",
    "tween",
]

#: Where each public name lives; nothing is imported before it is asked for.
_HOMES = {
    "Chain": "shapetween.api",
    "Drawing": "shapetween.model.drawing",
    "MeshPair": "shapetween.mesh.pair",
    "Morph": "shapetween.api",
    "ShapetweenError": "shapetween.base.errors",
    "between": "shapetween.interop",
    "chain": "shapetween.api",
    "interpolate_quads": "shapetween.interpolate.quads",
    "morph": "shapetween.api",
    "tween": "shapetween.interpolate",
}


def __dir__() -> list[str]:
    """Names, public ones among them before they have been asked for: editors complete from it."""
    return sorted({*globals(), *__all__})


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'shapetween' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
