"""Which place of one outline becomes which place of the other."""

from shapetween.base.arrays import Floats, Points
from shapetween.match.correspondence import Confidence, Correspondence
from shapetween.match.matcher import Matcher
from shapetween.model.outline import Outline

__all__ = ["Confidence", "Correspondence", "Matcher", "correspond"]


def correspond(
    source: Outline, target: Outline, pins: Points | Floats | None = None
) -> Correspondence:
    """Match two closed outlines.

    Parameters
    ----------
    source, target : Outline
        Closed, of positive area, each in its own unit, upright in the same sense.
    pins : (K, 4) or (K, 2) float64, optional
        Rows ax, ay, bx, by of points that must meet, each in its outline's own unit, or rows u, v
        of places.

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

    See Also
    --------
    Matcher : The same for many sets of pins.
    """
    return Matcher(source, target).match(pins)
