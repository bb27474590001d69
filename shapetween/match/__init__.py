"""Which place of one outline becomes which place of the other."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.errors import OutlineError
from shapetween.match.correspondence import Confidence, Correspondence
from shapetween.match.match import best_matching
from shapetween.match.pins import pinned_places
from shapetween.match.register import register
from shapetween.model.outline import Outline

__all__ = ["Confidence", "Correspondence", "correspond"]

#: Least area worth the name, as a share of the squared diagonal of the control points' box.
LEAST_AREA = 1e-9


def correspond(source: Outline, target: Outline, pins: Points | None = None) -> Correspondence:
    """Match two closed outlines.

    Parameters
    ----------
    source, target : Outline
        Closed, of positive area, each in its own unit, upright in the same sense.
    pins : (K, 4) float64, optional
        Rows ax, ay, bx, by of points that must meet, each in its outline's own unit.

    Returns
    -------
    Correspondence
        Exactly the affine map's where the target is an affine image of the source and the pins
        agree. The same whatever the outlines' starts, units, places and cuts; the inverse when
        they change roles.

    Raises
    ------
    OutlineError
        If an outline is open or encloses no area.
    OptionError
        If a pin is off its outline, or does not follow the others in order round both.
    """
    for name, outline in (("source", source), ("target", target)):
        if not outline.closed:
            raise OutlineError(f"the {name} outline is open; only closed ones can be matched")
        if not outline.area > LEAST_AREA * _squared_size(outline):
            raise OutlineError(
                f"the {name} outline encloses no area; it needs three points that are not in line"
            )
    places = pinned_places(source, target, pins)
    exact = register(source, target, places)
    if exact is None:
        return best_matching(source, target, places)
    return Correspondence(
        u=exact.u,
        v=exact.v,
        cost=0.0,
        runner_up=float("inf"),
        confidence="sure",
        turn=exact.turn,
        affine=exact.matrix,
    )


def _squared_size(outline: Outline) -> float:
    """Squared diagonal of the control points' box."""
    return float((np.ptp(outline.curves.reshape(-1, 2), axis=0) ** 2).sum())
