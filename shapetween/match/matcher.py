"""Two outlines made ready to be matched, once for whatever pins."""

from functools import cached_property

import numpy as np

from shapetween.base.arrays import Floats, Points, frozen
from shapetween.base.errors import OutlineError
from shapetween.match.candidate import DISTINCT, apart
from shapetween.match.correspondence import Correspondence
from shapetween.match.costs import Prepared, prepare
from shapetween.match.facing import faces_other_way
from shapetween.match.match import best_matching, best_matchings
from shapetween.match.pins import pinned_places, places_in_order
from shapetween.match.register import AffineMatch, register
from shapetween.model.outline import Outline
from shapetween.model.remembered import by_curves

__all__ = ["ALTERNATIVES", "Matcher", "registered"]

#: Matchings offered to choose from. Of 283 landmarks on hand-matched pairs the first one has 54
#: wrong, the best of three some 40, of six 34 and of ten 30.
ALTERNATIVES = 6

#: Pairs of outlines of which it is kept whether an affine map takes one to the other. With fewer,
#: each stage that asks finds it anew; more would keep memory for drawings that are done.
KEPT = 16

#: Least area worth the name, as a share of the squared diagonal of the control points' box.
LEAST_AREA = 1e-9


class Matcher:
    """Two closed outlines and all that is known of them before any pin is set.

    What pins do not change is found once, when it is first needed: whether the target is an affine
    image of the source, both outlines' samples, features, salient vertices and axes, and which of
    them comes first.

    Parameters
    ----------
    source, target : Outline
        Closed, of positive area, each in its own unit, upright in the same sense.

    Raises
    ------
    OutlineError
        If an outline is open or encloses no area.
    """

    def __init__(self, source: Outline, target: Outline) -> None:
        for name, outline in (("source", source), ("target", target)):
            if not outline.closed:
                raise OutlineError(f"the {name} outline is open; only closed ones can be matched")
            if not outline.area > LEAST_AREA * _squared_size(outline):
                raise OutlineError(
                    f"the {name} outline encloses no area; it needs three points that are not in "
                    "line"
                )
        self.source, self.target = source, target

    def match(self, pins: Points | Floats | None = None) -> Correspondence:
        """The best matching that keeps the pins.

        Parameters
        ----------
        pins : (K, 2) or (K, 4) float64, optional
            What must meet: rows u, v of places, as fractions of the two lengths from the outlines'
            starts, of any turn; or rows ax, ay, bx, by of points, each in its outline's own unit.

        Raises
        ------
        OptionError
            If a pin is off its outline, or does not follow the others in order round both.
        """
        places = self._places(pins)
        exact = self._affine
        if exact is not None and len(places):
            # No pin makes a map fit that fits nowhere, but it may choose among several that do.
            exact = register(self.source, self.target, places)
        if exact is None:
            return best_matching(*self._prepared, places)
        return Correspondence(
            u=exact.u,
            v=exact.v,
            cost=0.0,
            runner_up=float("inf"),
            confidence="sure",
            turn=exact.turn,
            affine=exact.matrix,
        )

    def alternatives(self, count: int = ALTERNATIVES) -> list[Correspondence]:
        """Distinct matchings without pins, the best one first, at most `count`.

        Beside those that `match` compares they hold the best ones that take a salient tip of the
        source to one of the target, whichever.
        """
        best = self.match()
        rest = best_matchings(*self._prepared, np.zeros((0, 2)), count, forced=True)
        return [best, *(other for other in rest if apart(best, other) > DISTINCT)][:count]

    def faces_other_way(self, found: Correspondence) -> bool:
        """Whether the source seems to face the other way than the target, by their matching."""
        return found.affine is None and faces_other_way(*self._prepared, found)

    def _places(self, pins: Points | Floats | None) -> Floats:
        if pins is None or np.shape(pins)[-1] != 2:
            return pinned_places(self.source, self.target, pins)
        return places_in_order(frozen(pins, np.float64, ndim=2))

    @property
    def _affine(self) -> AffineMatch | None:
        return registered(self.source, self.target)

    @cached_property
    def _prepared(self) -> tuple[Prepared, Prepared]:
        return prepare(self.source), prepare(self.target)


@by_curves(KEPT)
def registered(source: Outline, target: Outline) -> AffineMatch | None:
    """The affine map of positive determinant from source onto target, if there is one."""
    return register(source, target)


def _squared_size(outline: Outline) -> float:
    """Squared diagonal of the control points' box."""
    return float((np.ptp(outline.curves.reshape(-1, 2), axis=0) ** 2).sum())
