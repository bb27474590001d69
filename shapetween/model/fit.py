"""Bringing the second drawing into the first one's frame.

.. [SVG2] *Scalable Vector Graphics 2*, section 8.6, preserveAspectRatio.
"""

from typing import Literal, TypeAlias, get_args

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.base.errors import OptionError
from shapetween.model.drawing import Drawing

__all__ = ["Fit", "Flip", "fit_matrix"]

Fit: TypeAlias = Literal["view", "geometry", "none"]
"""What is fitted: the view boxes, the boxes of what is drawn, or nothing."""

Flip: TypeAlias = Literal["none", "b"]
"""Which drawing is mirrored: none, or the second one."""


def fit_matrix(source: Drawing, target: Drawing, fit: Fit, flip: Flip = "none") -> Affine:
    """Map from the target's user units to the source's.

    Parameters
    ----------
    source, target : Drawing
    fit : Fit
    flip : Flip
        "b" mirrors the target about the upright axis of what is fitted, of its view box where
        nothing is.

    Returns
    -------
    (2, 3) float64
        Scaled evenly, and centred, as ``xMidYMid meet`` asks ([SVG2]_).

    Raises
    ------
    OptionError
        If there is no such fit or flip.
    """
    if flip not in get_args(Flip):
        raise OptionError(f"flip: {flip!r} is none of {', '.join(get_args(Flip))}")
    if flip == "b":
        box = target.drawn if fit == "geometry" else target.box
        plain = fit_matrix(source, target, fit)
        middle = 2 * (box.x + box.width / 2)
        return np.column_stack([-plain[:, 0], plain[:, 1], plain[:, 2] + middle * plain[:, 0]])
    if fit not in get_args(Fit):
        raise OptionError(f"fit: {fit!r} is none of {', '.join(get_args(Fit))}")
    if fit == "none":
        return np.eye(2, 3)
    if fit == "geometry":
        inner, outer = target.drawn, source.drawn
    else:
        inner, outer = target.box, source.box
    ratios = [
        wide / narrow
        for wide, narrow in ((outer.width, inner.width), (outer.height, inner.height))
        if narrow > 0
    ]
    scale = min(ratios, default=1.0)
    x = outer.x + outer.width / 2 - scale * (inner.x + inner.width / 2)
    y = outer.y + outer.height / 2 - scale * (inner.y + inner.height / 2)
    return np.array([[scale, 0.0, x], [0.0, scale, y]])
