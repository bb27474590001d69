"""Transforms as style sheets write them: units, percentages, three dimensions that end flat.

.. [TR2] *CSS Transforms Module Level 2*.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
import tinycss2

from shapetween.base.arrays import Affine, Floats
from shapetween.geometry.affine import affine, compose
from shapetween.model.drawing import Box
from shapetween.svg.read.calc import calculated
from shapetween.svg.read.units import Viewport

__all__ = ["TRANSFORMS", "css_transform", "is_transform", "transform_step"]

#: The properties that move what is drawn, in the order in which they are applied ([TR2]_, 6).
TRANSFORMS = ("translate", "rotate", "scale", "transform")

#: Functions of one list that are read; more were not written by anybody.
MOST_FUNCTIONS = 1000

_ANGLES = {"deg": 1.0, "grad": 0.9, "turn": 360.0, "rad": 180 / math.pi}
_Values: TypeAlias = list[float]

#: Stands for lengths where only the syntax matters.
_ANY = Viewport(1.0, 1.0)
_UNIT = Box(0.0, 0.0, 1.0, 1.0)


def _moved(x: float, y: float = 0.0, z: float = 0.0) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def _scaled(x: float, y: float | None = None, z: float = 1.0) -> Floats:
    return np.diag([x, x if y is None else y, z, 1.0])


def _turned(x: float, y: float, z: float, degrees: float) -> Floats:
    """A turn about an axis, by Rodrigues' formula."""
    length = math.sqrt(x * x + y * y + z * z)
    if length == 0:
        return np.eye(4)
    x, y, z = x / length, y / length, z / length
    axis = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = math.radians(degrees)
    matrix = np.eye(4)
    matrix[:3, :3] += math.sin(angle) * axis + (1 - math.cos(angle)) * (axis @ axis)
    return matrix


def _slanted(x: float, y: float = 0.0) -> Floats:
    matrix = np.eye(4)
    matrix[0, 1], matrix[1, 0] = math.tan(math.radians(x)), math.tan(math.radians(y))
    return matrix


def _flat(a: float, b: float, c: float, d: float, e: float, f: float) -> Floats:
    matrix = np.eye(4)
    matrix[:2, :2], matrix[:2, 3] = [[a, c], [b, d]], [e, f]
    return matrix


#: Name in lower case -> kinds of its arguments, how many are needed, and the map they make. Kinds
#: are x, y and z for lengths, n for numbers and a for angles.
_FUNCTIONS: dict[str, tuple[str, int, Callable[..., Floats]]] = {
    "matrix": ("nnnnnn", 6, _flat),
    "matrix3d": ("n" * 16, 16, lambda *m: np.array(m).reshape(4, 4).T),
    "translate": ("xy", 1, _moved),
    "translatex": ("x", 1, _moved),
    "translatey": ("y", 1, lambda y: _moved(0.0, y)),
    "translatez": ("z", 1, lambda z: _moved(0.0, 0.0, z)),
    "translate3d": ("xyz", 3, _moved),
    "scale": ("nn", 1, _scaled),
    "scalex": ("n", 1, lambda x: _scaled(x, 1.0)),
    "scaley": ("n", 1, lambda y: _scaled(1.0, y)),
    "scalez": ("n", 1, lambda z: _scaled(1.0, 1.0, z)),
    "scale3d": ("nnn", 3, _scaled),
    "rotate": ("a", 1, lambda a: _turned(0, 0, 1, a)),
    "rotatex": ("a", 1, lambda a: _turned(1, 0, 0, a)),
    "rotatey": ("a", 1, lambda a: _turned(0, 1, 0, a)),
    "rotatez": ("a", 1, lambda a: _turned(0, 0, 1, a)),
    "rotate3d": ("nnna", 4, _turned),
    "skew": ("aa", 1, _slanted),
    "skewx": ("a", 1, _slanted),
    "skewy": ("a", 1, lambda y: _slanted(0.0, y)),
    "perspective": ("z", 1, lambda z: np.eye(4)),  # all that is drawn lies in one plane
}


def is_transform(name: str, text: str) -> bool:
    """Whether a value of one of the properties `TRANSFORMS` is sound."""
    return transform_step(name, text, _ANY, _UNIT) is not None


def transform_step(name: str, text: str, viewport: Viewport, box: Box) -> Floats | None:
    """The map that a property of `TRANSFORMS` says, (4, 4); None if it is malformed.

    Parameters
    ----------
    name, text : str
    viewport : Viewport
        For units that follow the font.
    box : Box
        What percentages are of.
    """
    if text.strip().lower() == "none":
        return np.eye(4)
    tokens = [
        token
        for token in tinycss2.parse_component_value_list(text, skip_comments=True)
        if token.type != "whitespace"
    ]
    if not tokens or len(tokens) > MOST_FUNCTIONS:
        return None
    if name != "transform":
        return _alone(name, tokens, viewport, box)
    matrix = np.eye(4)
    for token in tokens:
        if token.type != "function" or token.lower_name not in _FUNCTIONS:
            return None
        kinds, least, build = _FUNCTIONS[token.lower_name]
        arguments = _arguments(token.arguments)
        if not least <= len(arguments) <= len(kinds):
            return None
        values = _values(arguments, kinds, viewport, box)
        if values is None:
            return None
        with np.errstate(all="ignore"):
            matrix = matrix @ build(*values)
    return matrix if np.isfinite(matrix).all() else None


def _alone(name: str, tokens: list[Any], viewport: Viewport, box: Box) -> Floats | None:
    """``translate``, ``rotate`` or ``scale`` as a property."""
    texts = [token.serialize() for token in tokens]
    if name == "rotate":
        axes = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
        words = [text for text in texts if text.lower() in axes]
        if len(texts) == 2 and len(words) == 1:
            texts.remove(words[0])
            angle = _values(texts, "a", viewport, box)
            return None if angle is None else _turned(*axes[words[0].lower()], *angle)
        kinds = "a" if len(texts) == 1 else "nnna"
        values = _values(texts, kinds, viewport, box) if len(texts) == len(kinds) else None
        return None if values is None else _turned(*([0.0, 0.0, 1.0, *values][-4:]))
    kinds = "xyz" if name == "translate" else "nnn"
    values = _values(texts, kinds, viewport, box) if len(texts) <= 3 else None
    if values is None:
        return None
    return _moved(*values) if name == "translate" else _scaled(*values)


def _arguments(tokens: list[Any]) -> list[str]:
    """What stands between the commas."""
    parts: list[list[Any]] = [[]]
    for token in tokens:
        if token.type == "literal" and token.value == ",":
            parts.append([])
        else:
            parts[-1].append(token)
    return [tinycss2.serialize(part).strip() for part in parts]


def _values(texts: list[str], kinds: str, viewport: Viewport, box: Box) -> _Values | None:
    values = []
    for text, kind in zip(texts, kinds, strict=False):
        value = calculated(text, _unit_of(kind, viewport, box))
        if value is None:
            return None
        values.append(value)
    return values


def _unit_of(kind: str, viewport: Viewport, box: Box) -> Callable[[float, str], float | None]:
    def unit(value: float, name: str) -> float | None:
        if kind == "a":
            if name in _ANGLES:
                return value * _ANGLES[name]
            return value if not name and value == 0 else None
        if kind == "n":
            return value / 100 if name == "%" else value if not name else None
        if not name:
            return value if value == 0 else None
        if name == "%":
            return None if kind == "z" else value / 100 * (box.width if kind == "x" else box.height)
        return viewport.length(f"{value!r}{name}", 0.0)

    return unit


def css_transform(
    properties: Mapping[str, str],
    attribute: Affine | None,
    viewport: Viewport,
    box: Box,
    origin: tuple[str, str] = ("0", "0"),
) -> Affine:
    """All that moves an element, about its ``transform-origin``.

    Parameters
    ----------
    properties : Mapping
        What the element's style says.
    attribute : (2, 3) float64, optional
        Its ``transform`` attribute, which holds where no style says otherwise.
    viewport : Viewport
    box : Box
        The reference box.
    origin : (str, str)
        Where nothing is said of it.
    """
    matrix = np.eye(4)
    for name in TRANSFORMS:
        text = properties.get(name)
        if text is not None:
            step = transform_step(name, text, viewport, box)
            matrix = matrix if step is None else matrix @ step
        elif name == "transform" and attribute is not None:
            matrix = matrix @ _flat(*attribute.T.ravel())
    flat = np.asarray(matrix[:2][:, [0, 1, 3]])
    x, y = _origin(properties.get("transform-origin", ""), origin, viewport, box)
    return compose(compose(affine(1, 0, 0, 1, x, y), flat), affine(1, 0, 0, 1, -x, -y))


def _origin(
    text: str, default: tuple[str, str], viewport: Viewport, box: Box
) -> tuple[float, float]:
    words = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}
    parts = [
        token.serialize().lower()
        for token in tinycss2.parse_component_value_list(text, skip_comments=True)
        if token.type != "whitespace" and token != ","
    ][:2]
    if not parts:
        parts = list(default)
    if len(parts) == 1:
        parts = ["center", *parts] if parts[0] in ("top", "bottom") else [*parts, "center"]
    if parts[0] in ("top", "bottom") or parts[1] in ("left", "right"):
        parts.reverse()
    x, y = (
        viewport.length(words.get(part, part), side)
        for part, side in zip(parts, (box.width, box.height), strict=True)
    )
    if x is None or y is None:
        return box.x, box.y
    return box.x + x, box.y + y
