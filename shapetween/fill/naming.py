"""Names that a person gave to shapes, told from those that editors give by themselves."""

import re

__all__ = ["is_given"]

#: What editors call a thing of which they know no more than its kind: words of SVG, of Inkscape,
#: Illustrator in several languages, Figma and Sketch.
_KINDS = (
    "path|g|rect|rectangle|circle|ellipse|oval|line|polyline|polygon|star|text|tspan|flowroot|use"
    "|svg|image|symbol|group|layer|shape|combined[-_ ]?shape|compound[-_ ]?path|vector|union"
    "|subtract|intersect|exclude|frame|slice|artboard|mask|clip|bitmap|outline|fill|stroke|xmlid"
    "|svgid|id|ebene|calque|capa|camada|livello|warstwa|laag|gruppe|groupe|grupo|pfad|trac[eé]"
)

#: Such a word alone or with numbers: "path123-4", "Layer_1", "XMLID_12_", "Group 2 Copy"; or
#: numbers alone.
_GENERATED = re.compile(rf"(?:{_KINDS})?(?:[-_ .:]*(?:\d+|copy))*[-_ .]*", re.IGNORECASE)


def is_given(name: str) -> bool:
    """Whether a name says what a shape is, not only of which kind and how many there were before.

    Examples
    --------
    >>> [name for name in ("tail", "leg-2", "path4", "Layer_1", "Vector", "_12") if is_given(name)]
    ['tail', 'leg-2']
    """
    return _GENERATED.fullmatch(name) is None
