"""Which place of one outline becomes which place of the other."""

from shapetween.correspond.correspondence import Confidence, Correspondence
from shapetween.correspond.match import match
from shapetween.correspond.register import register
from shapetween.errors import OutlineError
from shapetween.outline import Outline

__all__ = ["Confidence", "Correspondence", "correspond"]


def correspond(source: Outline, target: Outline) -> Correspondence:
    """Match two closed outlines.

    Parameters
    ----------
    source, target : Outline
        Closed, of positive area, each in its own unit; upright in the same sense.

    Returns
    -------
    Correspondence
        Exactly the affine map's where the target is an affine image of the source. The same
        whatever the outlines' starts, units, places and cuts; the inverse when they change roles.

    Raises
    ------
    OutlineError
        If an outline is open or encloses no area.
    """
    for name, outline in (("source", source), ("target", target)):
        if not outline.closed:
            raise OutlineError(f"the {name} outline is open; only closed ones can be matched")
        low, high = outline.curves.reshape(-1, 2).min(axis=0), outline.curves.reshape(-1, 2).max(0)
        if not outline.area > LEAST_AREA * float(((high - low) ** 2).sum()):
            raise OutlineError(f"the {name} outline encloses no area; it needs three points apart")
    exact = register(source, target)
    if exact is not None:
        return Correspondence(
            u=exact.u,
            v=exact.v,
            cost=0.0,
            runner_up=float("inf"),
            confidence="sure",
            turn=exact.turn,
            affine=exact.matrix,
        )
    return match(source, target)


#: Least area worth the name, as a share of the squared diagonal.
LEAST_AREA = 1e-9
