"""A line that folds down onto what it hangs on by both its ends."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.base.ends import End
from shapetween.model.part import CurveTrack
from shapetween.scene.motion.carried import Follower
from shapetween.scene.places import Pieces

__all__ = ["Fold"]


@dataclass(frozen=True, eq=False)
class Fold:
    """A line, and what it lies on when it is folded down.

    Attributes
    ----------
    pieces : Pieces
        The line's, and what each lies on at last.
    anchor : CurveTrack
        Of what it hangs on.
    end : End
        The end at which the line exists.
    scale : float
        Of the drawing.
    """

    pieces: Pieces
    anchor: CurveTrack
    end: End
    scale: float

    @cached_property
    def _followers(self) -> tuple[Follower, Follower]:
        home = self.anchor.curves(np.array([float(self.end)]))[0]
        return (
            Follower.of(home, self.pieces.source, self.scale),
            Follower.of(home, self.pieces.target, self.scale),
        )

    def curves(self, t: Floats, gone: Floats) -> Curves:
        """Control points at the times (F,) when it is folded so far (F,), (F, P, 4, 2)."""
        anchor = self.anchor.curves(t)
        up, down = (follower.moved(anchor) for follower in self._followers)
        part = gone[:, None, None, None]
        result = (1 - part) * up + part * down
        result[:, 1:, 0] = result[:, :-1, 3]
        return np.asarray(result)
