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
from shapetween.match.candidate import Candidate
from shapetween.match.costs import Prepared, sample_features

__all__ = [
    "Frame",
    "Standing",
    "handicap",
    "margin_over",
    "other_way_round",
    "standing",
    "tilted_sides",
    "turn_between",
    "worth_trying",
]

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

#: Weight of the upright and level sides that a turn takes from both outlines, as a share of their
#: lengths, and the share from which on more of them does not count. Less, and a triangle that
#: stands on its leg is turned, as it is even about its diagonal; more leaves a key upright that is
#: meant to be turned, and no turned frame of letters is offered among others.
SIDES, MOST_TILTED = 3.0, 0.4

#: Angle, radians, up to which a side is upright or level, and from twice of which on it is not.
#: Less, and sides drawn by hand are none; much more, and those of a star are.
LEVEL = 0.05

#: How many times cheaper it must be to turn the other way round where that turns more, and the
#: logarithm of what that is multiplied by where it is well past a right angle. Less, and rounding
#: decides how a bone or a bolt comes to lie, and a guitar turns on its head where its neck could
#: come up; more, and a pencil or a brush is laid on its head.
BOTH_WAYS, BOTH_WAYS_OVER = 1.02, 0.18


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
    tilted : float
        What `tilted_sides` says of it.
    """

    turn: float
    unlike: float
    tilted: float = 0.0


def worth_trying(turns: Iterable[float]) -> list[float]:
    """Those of some angles that are frames of their own beside the upright one and each other."""
    kept: list[float] = []
    for turn in turns:
        away = np.abs(wrapped((turn - np.array([0.0, *kept])) / (2 * np.pi))) * 2 * np.pi
        if (away >= MIN_TURN).all():
            kept.append(turn)
    return kept


def turn_between(a: Prepared, b: Prepared, candidate: Candidate) -> float:
    """Angle of the rotation that takes the first's matched points nearest the second's."""
    places = ((a, candidate.a), (b, candidate.b))
    za, zb = (sample_features(side, at).points @ [1, 1j] for side, at in places)
    return float(np.angle((zb * za.conj()).sum()))


def standing(prepared: Prepared) -> Standing:
    """How an outline lies, by its samples."""
    z = prepared.samples.points @ [1, 1j]
    z = z - z.mean()
    spread, aside = float((np.abs(z) ** 2).mean()), complex((z * z).mean())
    ratio = (spread + abs(aside)) / max(spread - abs(aside), 1e-9 * spread)
    length = prepared.samples.arcs.length / prepared.samples.size
    return Standing(float(np.log(ratio)), float(np.angle(aside)) / 2, 4 * np.pi / length**2)


def tilted_sides(a: Prepared, b: Prepared, turn: float) -> float:
    """Share of their upright and level sides that both outlines lose by a turn onto the other.

    The one that loses less counts: of two that are the same but turned, one gains what the other
    loses. At most `MOST_TILTED`.
    """
    lost = [_level(side, 0.0) - _level(side, by) for side, by in ((a, turn), (b, -turn))]
    return min(max(0.0, min(lost)), MOST_TILTED)


def other_way_round(turn: float) -> float:
    """The turn that is half a turn from one."""
    return float(turn - np.copysign(np.pi, turn))


def margin_over(turn: float, plain: float) -> float:
    """How many times cheaper a turn past a right angle must be than the one half a turn from it.

    Parameters
    ----------
    turn : float
        The greater of both.
    plain : float
        How plainly the two are the same in its frame, from 0 to 1.
    """
    over = _ramp(abs(turn), OVER_FROM, OVER_TO)
    return float(BOTH_WAYS * np.exp(BOTH_WAYS_OVER * (1 - plain) * over))


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
    upright_weight += SIDES * turned.tilted
    return float(np.exp(weight + (1 - plain) * upright_weight))


#: Unlikeness below which it does not matter; the logarithm of 0 is none.
LEAST = 0.1


def _ramp(value: float, low: float, high: float) -> float:
    """From 0 at the low one to 1 at the high one."""
    return min(max((value - low) / (high - low), 0.0), 1.0)


def _level(prepared: Prepared, turn: float) -> float:
    """Share of an outline's length that is upright or level once it is turned."""
    points = prepared.samples.points @ [1, 1j]
    bearing = np.angle(np.roll(points, -1) - points) + turn
    quarter = np.pi / 2
    off = np.abs((bearing + quarter / 2) % quarter - quarter / 2)
    return float(np.clip(2 - off / LEVEL, 0, 1).mean())


def _apart(angle: float) -> float:
    """Angle between two lines, from 0 to a right one."""
    return abs((angle + np.pi / 2) % np.pi - np.pi / 2)
