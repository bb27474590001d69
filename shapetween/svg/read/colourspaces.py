"""Colours in the spaces in which style sheets mix and change them.

.. [Col4] *CSS Color Module Level 4*, sections 7 to 10 and 18.
"""

import math
from collections.abc import Callable

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.model.srgb import linear_to_srgb, srgb_to_linear

__all__ = ["HUES", "SPACES", "TO_LINEAR_SRGB", "from_space", "in_space"]

#: Linear sRGB from XYZ under D65, from XYZ under D50 after Bradford adaptation, and from linear
#: Display P3 ([Col4]_, section 18).
TO_LINEAR_SRGB = {
    "xyz-d65": np.array(
        [
            [3.2409699419045226, -1.537383177570094, -0.4986107602930034],
            [-0.9692436362808796, 1.8759675015077202, 0.04155505740717559],
            [0.05563007969699366, -0.20397695888897652, 1.0569715142428786],
        ]
    ),
    "xyz-d50": np.array(
        [
            [3.1341359569958707, -1.6173863321612538, -0.4906619460083532],
            [-0.978795502912089, 1.9162543773958770, 0.03344273116131949],
            [0.07195537988411677, -0.2289768264158322, 1.405386058324125],
        ]
    ),
    "display-p3": np.array(
        [
            [1.2249401762805598, -0.22494017628055996, 0.0],
            [-0.04205695470968816, 1.0420569547096881, 0.0],
            [-0.019637554590334432, -0.07863604555063188, 1.0982736001409663],
        ]
    ),
}

#: Which component of a space is a hue, in degrees.
HUES = {"hsl": 0, "hwb": 0, "lch": 2, "oklch": 2}

_WHITE_D50 = np.array([0.3457 / 0.3585, 1.0, (1.0 - 0.3457 - 0.3585) / 0.3585])
_EPSILON, _KAPPA = 216 / 24389, 24389 / 27
_LMS = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_OKLAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def _hsl(srgb: Floats) -> Floats:
    high, low = float(srgb.max()), float(srgb.min())
    light, spread = (high + low) / 2, high - low
    if spread == 0:
        return np.array([math.nan, 0.0, 100 * light])
    red, green, blue = srgb.tolist()
    if high == red:
        hue = (green - blue) / spread % 6
    elif high == green:
        hue = (blue - red) / spread + 2
    else:
        hue = (red - green) / spread + 4
    within = 1 - abs(2 * light - 1)
    return np.array([60 * hue, 100 * spread / within if within > 0 else 0.0, 100 * light])


def _from_hsl(given: Floats) -> Floats:
    hue, saturation, light = float(given[0]), float(given[1]) / 100, float(given[2]) / 100
    k = (np.array([0.0, 8.0, 4.0]) + hue / 30) % 12
    spread = saturation * min(light, 1 - light)
    return np.asarray(light - spread * np.clip(np.minimum(k - 3, 9 - k), -1, 1))


def _hwb(srgb: Floats) -> Floats:
    return np.array([_hsl(srgb)[0], 100 * srgb.min(), 100 * (1 - srgb.max())])


def _from_hwb(given: Floats) -> Floats:
    white, black = float(given[1]) / 100, float(given[2]) / 100
    if white + black >= 1:
        return np.full(3, white / (white + black))
    pure = _from_hsl(np.array([given[0], 100.0, 50.0]))
    return np.asarray(pure * (1 - white - black) + white)


def _lab(srgb: Floats) -> Floats:
    xyz = np.linalg.solve(TO_LINEAR_SRGB["xyz-d50"], srgb_to_linear(srgb)) / _WHITE_D50
    f = np.where(xyz > _EPSILON, np.cbrt(xyz), (_KAPPA * xyz + 16) / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def _from_lab(given: Floats) -> Floats:
    y = (given[0] + 16) / 116
    f = np.array([y + given[1] / 500, y, y - given[2] / 200])
    xyz = np.where(f**3 > _EPSILON, f**3, (116 * f - 16) / _KAPPA)
    return np.asarray(linear_to_srgb(TO_LINEAR_SRGB["xyz-d50"] @ (xyz * _WHITE_D50)))


def _oklab(srgb: Floats) -> Floats:
    return np.asarray(_OKLAB @ np.cbrt(_LMS @ srgb_to_linear(srgb)))


def _from_oklab(given: Floats) -> Floats:
    linear = np.linalg.solve(_LMS, np.linalg.solve(_OKLAB, given) ** 3)
    return np.asarray(linear_to_srgb(linear))


def _polar(lab: Floats, least: float) -> Floats:
    chroma = math.hypot(lab[1], lab[2])
    hue = math.degrees(math.atan2(lab[2], lab[1])) % 360 if chroma > least else math.nan
    return np.array([lab[0], chroma, hue])


def _straight(lch: Floats) -> Floats:
    hue = math.radians(lch[2])
    return np.array([lch[0], lch[1] * math.cos(hue), lch[1] * math.sin(hue)])


def _through(name: str) -> tuple[Callable[[Floats], Floats], Callable[[Floats], Floats]]:
    matrix = TO_LINEAR_SRGB[name]
    return (
        lambda srgb: np.linalg.solve(matrix, srgb_to_linear(srgb)),
        lambda given: np.asarray(linear_to_srgb(matrix @ given)),
    )


_P3, _XYZ65, _XYZ50 = _through("display-p3"), _through("xyz-d65"), _through("xyz-d50")

#: Of each space the way in from sRGB and the way back. A hue that means nothing is NaN.
SPACES: dict[str, tuple[Callable[[Floats], Floats], Callable[[Floats], Floats]]] = {
    "srgb": (lambda srgb: srgb, lambda given: given),
    "srgb-linear": (
        lambda srgb: np.asarray(srgb_to_linear(srgb)),
        lambda given: np.asarray(linear_to_srgb(given)),
    ),
    "display-p3": (
        lambda srgb: np.asarray(linear_to_srgb(_P3[0](srgb))),
        lambda given: _P3[1](np.asarray(srgb_to_linear(given))),
    ),
    "xyz": _XYZ65,
    "xyz-d65": _XYZ65,
    "xyz-d50": _XYZ50,
    "hsl": (_hsl, _from_hsl),
    "hwb": (_hwb, _from_hwb),
    "lab": (_lab, _from_lab),
    "lch": (lambda srgb: _polar(_lab(srgb), 0.015), lambda given: _from_lab(_straight(given))),
    "oklab": (_oklab, _from_oklab),
    "oklch": (
        lambda srgb: _polar(_oklab(srgb), 4e-6),
        lambda given: _from_oklab(_straight(given)),
    ),
}


def in_space(space: str, srgb: Floats) -> Floats:
    """The components (3,) of an sRGB colour in a space of `SPACES`."""
    return np.asarray(SPACES[space][0](np.asarray(srgb, dtype=np.float64)))


def from_space(space: str, components: Floats) -> Floats:
    """An sRGB colour (3,), which may lie beyond 0 to 1, from its components in a space."""
    return np.asarray(SPACES[space][1](np.nan_to_num(components)))
