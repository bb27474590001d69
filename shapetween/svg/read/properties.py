"""Which properties matter to a drawing, and which values of theirs are sound.

A value that is not sound loses against what it would override, as it does in browsers.
"""

import re
from functools import lru_cache

from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.csstransform import TRANSFORMS, is_transform
from shapetween.svg.read.shapes import GEOMETRY
from shapetween.svg.read.units import Viewport, number
from shapetween.svg.read.variables import with_scheme

__all__ = [
    "INHERITED",
    "OWN",
    "PAINTS",
    "is_plain",
    "is_too_long",
    "is_valid",
    "normal",
    "reset",
    "unfolded",
]

INHERITED = frozenset(
    {
        "clip-rule",
        "color",
        "color-interpolation",
        "color-interpolation-filters",
        "color-scheme",
        "direction",
        "dominant-baseline",
        "fill",
        "fill-opacity",
        "fill-rule",
        "font",
        "font-family",
        "font-feature-settings",
        "font-kerning",
        "font-size",
        "font-stretch",
        "font-style",
        "font-variant",
        "font-variation-settings",
        "font-weight",
        "image-rendering",
        "letter-spacing",
        "marker",
        "marker-end",
        "marker-mid",
        "marker-start",
        "paint-order",
        "shape-rendering",
        "stroke",
        "stroke-dasharray",
        "stroke-dashoffset",
        "stroke-linecap",
        "stroke-linejoin",
        "stroke-miterlimit",
        "stroke-opacity",
        "stroke-width",
        "text-anchor",
        "text-transform",
        "visibility",
        "white-space",
        "word-spacing",
        "writing-mode",
    }
)
#: Inherited properties that only style can set.
STYLED = frozenset({"color-scheme", "font", "marker", "text-transform"})
#: Properties of one element alone, which presentation attributes set as well.
OWN = frozenset(
    {
        "alignment-baseline",
        "baseline-shift",
        "clip-path",
        "display",
        "filter",
        "flood-color",
        "flood-opacity",
        "lighting-color",
        "mask",
        "mask-type",
        "opacity",
        "overflow",
        "stop-color",
        "stop-opacity",
        "text-decoration",
        "transform-origin",
        "vector-effect",
    }
)
#: Properties with colours or paints.
PAINTS = frozenset({"fill", "stroke", "color", "stop-color", "flood-color", "lighting-color"})

#: Properties that are not read here, and that style sheets ask for before they use them.
BROWSERS = frozenset(
    {
        "accent-color", "all", "animation", "animation-timeline", "appearance", "aspect-ratio",
        "backdrop-filter", "background", "background-clip", "background-color", "bottom",
        "box-shadow", "contain", "container-type", "content-visibility", "flex", "float", "gap",
        "grid", "grid-template-columns", "height", "inset", "isolation", "left", "margin",
        "mask-image", "mix-blend-mode", "object-fit", "offset-path", "overscroll-behavior",
        "padding", "position", "right", "scroll-behavior", "text-wrap", "top", "transition",
        "user-select", "width", "will-change", "zoom",
    }
)  # fmt: skip

#: How a mask may be taken, whatever it says itself.
MASK_MODES = frozenset({"alpha", "luminance", "match-source"})

_URL = re.compile(r"url\([^)]*\)", re.IGNORECASE)

_WIDE = frozenset({"inherit", "initial", "unset", "revert", "revert-layer"})

#: Properties that are one word of a few.
WORDS: dict[str, frozenset[str]] = {
    "clip-rule": frozenset({"nonzero", "evenodd"}),
    "color-interpolation": frozenset({"auto", "srgb", "linearrgb"}),
    "color-interpolation-filters": frozenset({"auto", "srgb", "linearrgb"}),
    "direction": frozenset({"ltr", "rtl"}),
    "fill-rule": frozenset({"nonzero", "evenodd"}),
    "mask-type": frozenset({"alpha", "luminance"}),
    "shape-rendering": frozenset({"auto", "optimizespeed", "crispedges", "geometricprecision"}),
    "stroke-linecap": frozenset({"butt", "round", "square"}),
    "stroke-linejoin": frozenset({"miter", "round", "bevel", "arcs", "miter-clip"}),
    "text-anchor": frozenset({"start", "middle", "end"}),
    "transform-box": frozenset({"content-box", "border-box", "fill-box", "stroke-box", "view-box"}),
    "visibility": frozenset({"visible", "hidden", "collapse"}),
}
#: Properties whose words may stand in any case, as those of `WORDS` may.
LOWERED = frozenset({*WORDS, "display", "isolation", "mix-blend-mode", "overflow", "vector-effect"})
NUMBERS = frozenset(
    {
        "opacity",
        "fill-opacity",
        "flood-opacity",
        "stroke-opacity",
        "stop-opacity",
        "stroke-miterlimit",
    }
)
LENGTHS = frozenset({"stroke-width", "stroke-dashoffset"})

#: Characters of a paint or of a transform that are read; what somebody drew has a few dozen.
MOST_CHARACTERS = 10_000

_ANY = Viewport(1.0, 1.0)


@lru_cache(maxsize=16_384)
def is_valid(name: str, value: str, styled: bool = True) -> bool:
    """Whether a value can override another.

    Parameters
    ----------
    name, value : str
    styled : bool
        Whether style says it, which is stricter than attributes are: lengths of places and sizes
        need their unit.
    """
    if len(value) > MOST_CHARACTERS and name != "d":
        return False
    word = value.strip().lower()
    if word in _WIDE:
        return True
    if name == "all":
        return False
    if "var(" in word:
        return True
    if name in PAINTS:
        return parse_paint(with_scheme(value, "", "black") if "(" in value else value) is not None
    if name in WORDS:
        return word in WORDS[name]
    if name in NUMBERS:
        return number(value) is not None
    if name in LENGTHS:
        length = _ANY.length(value, 1.0)
        return length is not None and (length >= 0 or name != "stroke-width")
    if name in TRANSFORMS:
        return is_transform(name, value)
    if styled and name in GEOMETRY and name != "d":
        bare = number(value)
        return bare is None or bare == 0 or "%" in value
    return True


_FONT = re.compile(
    r"(?P<before>(?:(?:italic|oblique|normal|bold|bolder|lighter|small-caps|\d{3})\s+)*)"
    r"(?P<size>[\d.]+[a-z%]*)(?:\s*/\s*[\d.a-z%]+)?\s+(?P<family>\S.*)",
    re.IGNORECASE | re.DOTALL,
)


def is_too_long(name: str, value: str) -> bool:
    """Whether a value that would say something is not read for its length alone."""
    if len(value) <= MOST_CHARACTERS:
        return False
    return name in INHERITED or name in OWN or name in TRANSFORMS or name.startswith("--")


def is_supported(name: str, value: str) -> bool:
    """Whether ``@supports`` is to say yes: a property that browsers know, with such a value."""
    known = name in INHERITED or name in OWN or name in GEOMETRY or name in TRANSFORMS
    return (known or name.startswith("--") or name in BROWSERS) and is_valid(name, value)


def unfolded(name: str, value: str) -> dict[str, str]:
    """A property, or those that a shorthand sets."""
    if name.removeprefix("-webkit-") in ("mask", "mask-image"):
        return _mask(value, name.endswith("mask"))
    found = _FONT.fullmatch(value.strip()) if name == "font" else None
    if found is None:
        return {name: value}
    fonts = {"font-size": found["size"], "font-family": found["family"]}
    fonts |= {"font-style": "normal", "font-variant": "normal", "font-weight": "normal"}
    for word in found["before"].lower().split():
        if word in ("italic", "oblique"):
            fonts["font-style"] = word
        elif word == "small-caps":
            fonts["font-variant"] = word
        elif word != "normal":
            fonts["font-weight"] = word
    return fonts


def reset(word: str) -> dict[str, str]:
    """What ``all`` says of every property: ``initial``, ``inherit``, ``unset`` or ``revert``.

    Attributes say nothing any more then: where a shape is, too, and how it is transformed.
    """
    named = {"initial": INHERITED, "inherit": INHERITED | OWN}.get(word, frozenset())
    return {**dict.fromkeys(named, word), **dict.fromkeys(GEOMETRY, ""), "transform": "none"}


def _mask(value: str, resets: bool) -> dict[str, str]:
    """The mask that ``mask`` or ``mask-image`` names, and of the first how it is taken."""
    named = _URL.search(value)
    if named is None:
        return {"mask": value}
    modes = [word for word in _URL.sub("", value).lower().split() if word in MASK_MODES]
    return {"mask": named[0], **({"mask-mode": (modes or ["match-source"])[0]} if resets else {})}


def is_plain(name: str) -> bool:
    """Whether a presentation attribute sets a property."""
    return (name in INHERITED and name not in STYLED) or name in OWN or name in GEOMETRY


def normal(name: str, value: str) -> str:
    """A value as it is compared: words in lower case."""
    return value.lower() if name in LOWERED else value
