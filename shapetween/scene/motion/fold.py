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
    anchor : CurveTrack or None
        Of what it hangs on, if that moves.
    end : End
        The end at which the line exists.
    scale : float
        Of the drawing.
    """

    pieces: Pieces
    anchor: CurveTrack | None
    end: End
    scale: float

    @cached_property
    def _followers(self) -> tuple[Follower, ...]:
        if self.anchor is None:
            return ()
        home = self.anchor.curves(np.array([float(self.end)]))[0]
        ends = self.pieces.source, self.pieces.target
        return tuple(Follower.of(home, own, self.scale) for own in ends)

    def curves(self, t: Floats, gone: Floats) -> Curves:
        """Control points at the times (F,) when it is folded so far (F,), (F, P, 4, 2)."""
        up, down = self.pieces.source[None], self.pieces.target[None]
        if self.anchor is not None:
            anchor = self.anchor.curves(t)
            up, down = (follower.moved(anchor) for follower in self._followers)
        part = gone[:, None, None, None]
        result = (1 - part) * up + part * down
        result[:, 1:, 0] = result[:, :-1, 3]
        return np.asarray(result)
