"""View boxes, and how they are fitted into the viewports that show them.

.. [SVG2] *Scalable Vector Graphics 2*, section 8.
"""

from collections.abc import Mapping

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import affine
from shapetween.model.drawing import Box
from shapetween.svg.read.units import numbers

__all__ = ["fit", "parse_view_box"]

_SHARES = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}


def parse_view_box(text: str | None) -> Box | None:
    """A ``viewBox``; None if there is none, or it is malformed or without area."""
    values, rest = numbers(text or "", 4)
    if len(values) != 4 or rest or values[2] <= 0 or values[3] <= 0:
        return None
    return Box(*values)


def fit(box: Box, into: Box, attributes: Mapping[str, str]) -> Affine:
    """The map from a view box to the viewport that shows it ([SVG2]_, section 8.2).

    Parameters
    ----------
    box, into : Box
    attributes : Mapping
        Those of the element, for ``preserveAspectRatio``.
    """
    words = attributes.get("preserveAspectRatio", "").split()
    if words[:1] == ["defer"]:
        words = words[1:]
    align = words[0] if words else "xMidYMid"
    across, down = _SHARES.get(align[1:4], 0.5), _SHARES.get(align[5:8], 0.5)
    x, y = into.width / box.width, into.height / box.height
    if align != "none":
        x = y = max(x, y) if words[1:2] == ["slice"] else min(x, y)
    return affine(
        x,
        0,
        0,
        y,
        into.x - box.x * x + across * (into.width - box.width * x),
        into.y - box.y * y + down * (into.height - box.height * y),
    )
