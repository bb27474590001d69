"""Rounded boxes that become each other: sides to sides and corners to corners."""

import numpy as np

from shapetween.scene.forms import RoundedBox
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Places, cut_alike

__all__ = ["HALF_TIE", "box_blend"]

#: What turning a box by a right angle costs beside a factor e in its sides. Less, and a short bar
#: that grows long in place turns over; more, and a bar does not turn upright.
RIGHT_ANGLE = 1.0

#: The same of boxes that are no bars, and the ratio of sides up to which one is none. Less, and a
#: wall turns over with its windows; at a larger ratio a card that is laid down changes its sides.
BLOCK_ANGLE, BLOCK = 3.0, 2.0

#: Turn that is a tie between both ways, radians: it goes clockwise.
HALF_TIE = 1e-6


def box_blend(one: RoundedBox, other: RoundedBox, source: Places, target: Places) -> Blend:
    """Sides to sides and corners to corners, by the turn that is least."""
    if one.round and not other.round:
        one = RoundedBox(one.centre, one.sides, other.angle, one.radii)
    if other.round:
        other = RoundedBox(other.centre, other.sides, one.angle, other.radii)
    choices = []
    # A line is a box of no height.
    least = 1e-9 * float(max(one.sides.max(), other.sides.max()))
    block = any(box.sides.max() < BLOCK * box.sides.min() for box in (one, other))
    right_angle = BLOCK_ANGLE if block else RIGHT_ANGLE
    for quarter in range(-1, 3):
        turn = other.angle - one.angle + quarter * np.pi / 2
        turn = float((turn + np.pi) % (2 * np.pi) - np.pi)
        turn += np.pi * 2 * (turn < HALF_TIE - np.pi)
        sides = other.sides[::-1] if quarter % 2 else other.sides
        change = float(
            np.abs(np.log(np.maximum(one.sides, least) / np.maximum(sides, least))).sum()
        )
        cost = change + right_angle * abs(turn) / (np.pi / 2)
        choices.append((round(cost, 6), turn < 0, turn, quarter))
    _, _, turn, quarter = min(choices)
    knots = []
    for box, places, rolled in ((one, source, 0), (other, target, 2 * quarter)):
        shares = places.nearest(np.roll(box.joints, -rolled, axis=0))
        ahead = (shares - shares[0]) % 1.0
        # Joints of no distance may come out in either order.
        ahead[:4][ahead[:4] > 0.98] = 0.0
        ahead[4:][ahead[4:] < 0.02] = 1.0
        ahead[0] = 0.0
        ahead = np.maximum.accumulate(ahead)
        knots.append(shares[0] + np.append(ahead, 1.0))
    pieces = cut_alike(source, target, *knots)
    return Blend(pieces, np.stack([one.centre, other.centre]), turn)
