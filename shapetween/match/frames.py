"""The frames two outlines are compared in, and what a turned one has to be better by.

Drawings are meant upright, so a turned frame is taken only for good reason. What tells was rounded
on hand-matched pairs of drawings and on outlines that were bent and turned by known maps, by
logistic regression of which frame's matching was right; the figures below are its weights, rounded,
over that of the cost.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from shapetween.geometry.circlemap import wrapped
from shapetween.match.costs import Prepared

__all__ = ["Frame", "Standing", "handicap", "standing", "worth_trying"]

#: Least angle, radians, between two frames that are both worth trying.
MIN_TURN = 0.25

#: Logarithm of what a turned frame's cost is multiplied by. Lower turns trees upside down; higher
#: leaves upright what is the same but drawn another way, as a plane that flies up and one that
#: flies to the side.
TURNED = 0.41

#: The same where the turn is past a right angle, beside it, and the angles between which it comes
#: in. Lower turns a leg heel first into a shoe; higher leaves upright even a bent copy that lies on
#: its head.
OVER, OVER_FROM, OVER_TO = 0.5, 1.7, 1.9

#: Weight of how much more alike two outlines are, whatever their angles, as the turned frame
#: matches them than as the upright one does. Less and what is plainly the same is left upright;
#: more and the frames' own costs do not count.
ALIKE = 0.6

#: Weight of an angle by which the turn brings their long axes nearer to each other, times how
#: slender both are (the logarithm, at most `MOST_SLENDER`). A long tool lies any way round, what is
#: as wide as it is tall stands. Less leaves a hammer upright beside a wrench that lies.
ALONG, MOST_SLENDER = 0.12, 2.0

#: The same where both outlines are round, and how round they are there: their areas over those of
#: discs of as long an outline. Of 320 hand-matched pairs none over 0.67 was meant turned; blobs
#: whose radii differ by a quarter have 0.8. Less lets blobs that idle roll instead of wobble; from
#: lower on, a mug is left on its side.
ROLLING, ROUND_FROM, ROUND_TO = 0.8, 0.7, 0.8

#: For symmetric outlines whose axes point the same way as drawn, instead of all that. Less turns a
#: spoon upside down to become a screwdriver; more leaves upright even an arrow that becomes one the
#: other way.
STANDING = 1.05

#: For symmetric outlines that the turned frame alone lays axis onto axis. None leaves a paint brush
#: that leans upright, its tip on one side of a broad one; much more turns an L, which is even about
#: its diagonal.
ONTO = 0.26

#: Angle between their long axes, times how slender they are, from which on they do not stand alike,
#: whatever axes they have, if they have one in common when turned, too: one is upright and the
#: other lies. More leaves a battery upright that becomes one that lies; less tells a tall box from
#: a wide one.
ASKEW = 1.2


@dataclass(frozen=True, slots=True)
class Standing:
    """How an outline lies.

    Attributes
    ----------
    slender : float
        Logarithm of the ratio of its two principal variances.
    along : float
        Angle of its long axis, radians, of any turn.
    roundness : float
        Its area over that of the disc of as long an outline.
    """

    slender: float
    along: float
    roundness: float


@dataclass(frozen=True, slots=True)
class Frame:
    """What is known of a frame once its best matching has been found.

    Attributes
    ----------
    turn : float
        Angle by which the first outline is turned, radians.
    unlike : float
        Mean unlikeness of the places matched that no turning changes.
    """

    turn: float
    unlike: float


def worth_trying(turns: Iterable[float]) -> list[float]:
    """Those of some angles that are frames of their own beside the upright one and each other."""
    kept: list[float] = []
    for turn in turns:
        away = np.abs(wrapped((turn - np.array([0.0, *kept])) / (2 * np.pi))) * 2 * np.pi
        if (away >= MIN_TURN).all():
            kept.append(turn)
    return kept


def standing(prepared: Prepared) -> Standing:
    """How an outline lies, by its samples."""
    z = prepared.samples.points @ [1, 1j]
    z = z - z.mean()
    spread, aside = float((np.abs(z) ** 2).mean()), complex((z * z).mean())
    ratio = (spread + abs(aside)) / max(spread - abs(aside), 1e-9 * spread)
    length = prepared.samples.arcs.length / prepared.samples.size
    return Standing(float(np.log(ratio)), float(np.angle(aside)) / 2, 4 * np.pi / length**2)


def handicap(
    upright: Frame,
    turned: Frame,
    a: Standing,
    b: Standing,
    *,
    even: tuple[bool, bool],
    plain: float,
) -> float:
    """What the costs of a turned frame's matchings are multiplied by.

    Parameters
    ----------
    upright, turned : Frame
    a, b : Standing
        Of the two outlines.
    even : (bool, bool)
        Whether both are symmetric about axes that point the same way as drawn, and so in the turned
        frame.
    plain : float
        How plainly the two are the same but for the turn, from 0 to 1. Then it counts no more that
        things stand upright.
    """
    slender = min((a.slender + b.slender) / 2, MOST_SLENDER)
    apart = _apart(a.along - b.along)
    over = _ramp(abs(turned.turn), OVER_FROM, OVER_TO)
    rolling = _ramp(min(a.roundness, b.roundness), ROUND_FROM, ROUND_TO)
    nearer = apart - _apart(a.along + turned.turn - b.along)
    alike = float(np.log(max(turned.unlike, LEAST) / max(upright.unlike, LEAST)))
    weight = TURNED + ALIKE * alike - ALONG * slender * nearer
    weight += ROLLING * rolling
    upright_weight = OVER * over
    if even[0] and (slender * apart < ASKEW or not even[1]):
        upright_weight = STANDING - weight
    elif even[1] and not even[0]:
        weight -= ONTO
    return float(np.exp(weight + (1 - plain) * upright_weight))


#: Unlikeness below which it does not matter; the logarithm of 0 is none.
LEAST = 0.1


def _ramp(value: float, low: float, high: float) -> float:
    """From 0 at the low one to 1 at the high one."""
    return min(max((value - low) / (high - low), 0.0), 1.0)


def _apart(angle: float) -> float:
    """Angle between two lines, from 0 to a right one."""
    return abs((angle + np.pi / 2) % np.pi - np.pi / 2)
