"""Lines that stay on what their ends lie on.

A line and what it ends on ride on the same plane, but each becomes something else on the way, and
would leave the other. So an end that lies on another line is drawn to where that line is, and the
curves between the two ends follow.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.attach.riders import Rider, Tip
from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import evaluate

__all__ = ["Spot", "Tie", "Tied"]


@dataclass(frozen=True, slots=True, eq=False)
class Spot:
    """Where the end of a line lies on another line, in one drawing.

    Attributes
    ----------
    place : float
        Number of the other's curve plus the parameter on it.
    offset : (2,) float64
        From there to the end.
    """

    place: float
    offset: Points


@dataclass(frozen=True, slots=True, eq=False)
class Tie:
    """A place of a line tied to another line.

    Attributes
    ----------
    at : float
        Which place: number of the line's curve plus the parameter on it.
    host : Rider, Tip or Tied
    spots : (Spot or None, Spot or None)
        Where it lies on that one at the start and at the end; None where it does not.
    lasts : bool
        Whether it lasts all the way; else it loosens on the way to where it is none.
    """

    at: float
    host: "Rider | Tip | Tied"
    spots: tuple[Spot | None, Spot | None]
    lasts: bool

    def pull(self, curves: Curves, t: Floats) -> Points:
        """What takes its place on the line's curves (F, P, 4, 2) to the host's, (F, 2)."""
        first, last = self.spots
        start, end = first or last, last or first
        assert start is not None
        assert end is not None
        whole = self.host.whole(t)
        bounds = self.host.bounds
        numbers = np.arange(len(bounds))
        first_share, last_share = np.interp([start.place, end.place], numbers, bounds).tolist()
        ways = last_share - first_share
        if self.host.closed:
            ways -= round(ways)
        along = first_share + t * ways
        on = _point(whole, np.interp(along % 1 if self.host.closed else along, bounds, numbers))
        share = t[:, None]
        goal = on + (1 - share) * start.offset + share * end.offset
        pull = goal - _point(curves, np.full(len(t), self.at))
        if not self.lasts:
            pull *= (1 - share if last is None else share) ** 2
        return pull


def _point(curves: Curves, places: Floats) -> Points:
    """Where places (F,) lie on curves (F, P, 4, 2), one each, (F, 2)."""
    index = np.minimum(places.astype(np.intp), curves.shape[1] - 1)
    some = curves[np.arange(len(places)), index]
    return np.asarray(evaluate(some, (places - index)[:, None])[:, 0])


@dataclass(slots=True, eq=False)
class Tied:
    """A line tied to others; what was asked last is kept for those that are tied to it.

    Attributes
    ----------
    rider : Rider or Tip
        The line as it would move by itself.
    ties : tuple of Tie
        At least one.
    """

    rider: Rider | Tip
    ties: tuple[Tie, ...]
    _known: tuple[bytes, Curves] | None = None

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one line."""
        return self.rider.counts

    @property
    def closed(self) -> bool:
        """Its ends are apart."""
        return False

    @property
    def bounds(self) -> Floats:
        """Shares of its length at which its curves start and end, (P + 1,)."""
        return self.rider.bounds

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        return self.rider.shown(self.whole(t), t)

    def whole(self, t: Floats) -> Curves:
        """Control points of all of it, also where it has not grown yet."""
        key = t.tobytes()
        if self._known is None or self._known[0] != key:
            self._known = key, self._pulled(t)
        return self._known[1]

    def _pulled(self, t: Floats) -> Curves:
        """The curves moved as the ties pull, evenly in length between one tie and the next.

        A line without a partner goes with its only tie and is not stretched; of others an end
        that is not tied stays where it is.
        """
        curves, bounds = self.rider.whole(t), self.rider.bounds
        places: dict[float, Points] = {}
        if isinstance(self.rider, Rider):
            places = {end: np.zeros((len(t), 2)) for end in (0.0, float(len(bounds) - 1))}
        for tie in self.ties:
            pull = tie.pull(curves, t)
            # What was drawn is not pulled, not even by rounding.
            pull[self.rider.at_home(t)] = 0.0
            places[tie.at] = places[tie.at] + pull if tie.at in places else pull
        known = sorted(places)
        shares = np.interp(known, np.arange(len(bounds)), bounds)
        weights = np.stack([np.interp(bounds, shares, one) for one in np.eye(len(known))])
        pulls = np.einsum("kj,kfd->fjd", weights, np.stack([places[k] for k in known]))
        # Handles go with their joints, so that smooth joints stay smooth.
        first, last = pulls[:, :-1], pulls[:, 1:]
        return np.asarray(curves + np.stack([first, first, last, last], axis=2))
