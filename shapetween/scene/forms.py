"""Forms: what an item is, as far as it is something simple.

Discs, ellipses, rectangles with and without round corners, bars and capsules are one family, the
rounded box: one becomes another by blending six numbers.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias
from weakref import WeakKeyDictionary

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import end_tangents
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.model.outline import Outline
from shapetween.scene.items import Item, intersection_over_union

if TYPE_CHECKING:
    import shapely

__all__ = ["Blob", "Dot", "Form", "OpenLine", "RoundedBox", "Segment", "form_of", "is_straight"]

#: Least share of both together that a rounded box and an outline have in common for the outline to
#: be that box. Smaller, and hearts and shields count as boxes; larger, and circles drawn of few
#: curves do not. Between .95 and .98 it hardly matters.
LIKE_BOX = 0.965

#: What an upright box is preferred by.
UPRIGHT = 0.004

#: Least share of its bounding box that a rounded box fills, an ellipse's less a little.
LEAST_FILL = 0.75

#: Radii, as a share of the sides, and greatest ratio of the sides, from which on a box is round
#: and has no direction.
ROUND, EVEN = 0.45, 1.06

#: Greatest extent of a line, as a share of its width, that is seen as a dot.
DOT = 0.6

#: Greatest extent of a ring, as a share of its width, whose stroke leaves no hole to speak of.
FULL = 1.25

#: Distance of a line's control points from its chord, as a share of it, up to which it is straight.
STRAIGHT = 0.01

#: Least angle, in radians, at which two curves of a line meet in a corner; and length of a run of
#: curves, as a share of the line's, over which turning by such an angle is one rounded corner.
CORNER, ROUNDED = np.deg2rad(30.0), 1 / 6

#: Angles, in radians, through which a rounded corner turns.
ROUNDED_TURN = (1.0, 2.4)

#: Chords of a quarter of a corner that outlines are held against.
STEPS = 8

#: Share by which rounding may make a likeness larger than its bound.
ROUNDING = 1e-9

#: Handle of a quarter of a circle drawn as one cubic curve, as a share of its radius.
QUARTER = 0.5522847498


@dataclass(frozen=True, slots=True, eq=False)
class RoundedBox:
    """A rectangle whose corners are quarters of ellipses.

    Attributes
    ----------
    centre : (2,) float64
    sides : (2,) float64
        Width and height along its own axes.
    angle : float
        Of its own x axis, radians, between -pi / 4 and pi / 4.
    radii : (2,) float64
        Of its corners, along its own axes.
    """

    centre: Points
    sides: Floats
    angle: float
    radii: Floats

    @property
    def round(self) -> bool:
        """Whether it is a disc, or so nearly that it has no direction."""
        low, high = sorted(self.sides.tolist())
        return bool((self.radii > ROUND * self.sides).all() and high < EVEN * low)

    @property
    def joints(self) -> Points:
        """Where its sides and corners meet, clockwise from the left end of the upper side, (8, 2).

        Sides run from even to odd ones.
        """
        half, inner = self.sides / 2, self.sides / 2 - self.radii
        w, h = half.tolist()
        x, y = inner.tolist()
        local = [(-x, -h), (x, -h), (w, -y), (w, y), (x, h), (-x, h), (-w, y), (-w, -y)]
        return np.asarray(np.array(local) @ rotations(np.asarray(self.angle)).T + self.centre)


@dataclass(frozen=True, slots=True, eq=False)
class Segment:
    """A straight line."""

    start: Points
    end: Points


@dataclass(frozen=True, slots=True)
class Dot:
    """A line that is no longer than wide."""


@dataclass(frozen=True, slots=True, eq=False)
class OpenLine:
    """A bent line.

    Attributes
    ----------
    corners : (K,) float64
        Where it turns sharply, as shares of its length.
    turns : (K,) float64
        By how much, radians.
    """

    corners: Floats
    turns: Floats


@dataclass(frozen=True, slots=True)
class Blob:
    """A closed outline of no simple form."""


Form: TypeAlias = RoundedBox | Segment | Dot | OpenLine | Blob
"""What an item may be."""


#: Forms that have been found, for as long as their items are used.
_FORMS: "WeakKeyDictionary[Item, Form]" = WeakKeyDictionary()


def form_of(item: Item) -> Form:
    """What an item's outer ring is."""
    known = _FORMS.get(item)
    if known is None:
        known = _FORMS[item] = _form_of(item)
    return known


def _form_of(item: Item) -> Form:
    if not item.filled:
        extent = float(np.hypot(*np.ptp(item.box, axis=0)))
        if extent <= DOT * item.width or _is_full(item):
            return Dot()
    if not item.closed:
        if is_straight(item.outer):
            return Segment(item.outer.curves[0, 0], item.outer.curves[-1, 3])
        return OpenLine(*_corners(item.outer))
    return _box_of(item.enclosed) or Blob()


def _is_full(item: Item) -> bool:
    """Whether a ring is so small that its stroke leaves no hole in its middle."""
    low, high = np.sort(np.ptp(item.box, axis=0))
    return bool(item.closed and high < EVEN**2 * low and high < FULL * item.width)


def is_straight(line: Outline) -> bool:
    """Whether an open line is straight and does not run back on itself."""
    points = line.curves.reshape(-1, 2)
    chord = points[-1] - points[0]
    length = float(np.hypot(*chord))
    if line.closed or length == 0:
        return False
    along = (points - points[0]) @ chord / length**2
    off = np.abs(cross(points - points[0], chord)) / length**2
    steps = np.diff(line.curves[:, 0], axis=0) @ chord
    return bool(
        (off <= STRAIGHT).all()
        and (along >= -STRAIGHT).all()
        and (along <= 1 + STRAIGHT).all()
        and (steps >= -STRAIGHT * length**2).all()
    )


def _box_of(area: "shapely.Geometry") -> RoundedBox | None:
    """The rounded box that an area is, if it is one."""
    import shapely

    if area.geom_type != "Polygon" or not area.area > 0:
        return None
    hull, size = shapely.get_coordinates(area), area.area
    best: tuple[float, RoundedBox] | None = None
    for angle in _angles(area):
        if angle and best is not None and best[0] >= 1 + ROUNDING:
            break  # an upright box that nothing oblique can be more like
        turned = hull @ rotations(np.asarray(angle))
        low, high = turned.min(axis=0), turned.max(axis=0)
        sides = high - low
        whole = float(sides.prod())
        if not size > LEAST_FILL * whole:
            continue
        centre = rotations(np.asarray(angle)) @ ((low + high) / 2)
        # What rounding alone leaves of the corners is no radius.
        missing = whole - size if size < (1 - ROUNDING) * whole else 0.0
        radius = min(float(np.sqrt(missing / (4 - np.pi))), float(sides.min()) / 2)
        choices = [np.array([radius, radius])]
        if float(sides.max()) / 2 > (1 + ROUNDING) * radius:  # else it is the same one again
            choices.append(sides / 2)
        for radii in choices:
            box = RoundedBox(centre, sides, angle, radii)
            # No more than what the areas by themselves would let them have in common.
            small, large = sorted((size, _border_area(box)))
            bound = small / large + UPRIGHT * (angle == 0.0) + ROUNDING
            if bound < LIKE_BOX or (best is not None and bound <= best[0]):
                continue
            # All of an area lies in the box round it.
            like = (
                size / whole if radii.max() == 0 else intersection_over_union(area, _polygon(box))
            )
            like += UPRIGHT * (angle == 0.0)
            if like >= LIKE_BOX and (best is None or like > best[0]):
                best = like, box
    if best is None:
        return None
    box = best[1]
    return RoundedBox(box.centre, box.sides, 0.0, box.sides / 2) if box.round else box


def _angles(area: "shapely.Geometry") -> Iterator[float]:
    """Angles at which an area's box may lie, (-pi / 4, pi / 4], none first."""
    import shapely

    yield 0.0
    least = shapely.get_coordinates(area.minimum_rotated_rectangle)
    if len(least) >= 4:
        side = least[1] - least[0]
        angle = float(np.arctan2(side[1], side[0]))
        # Half a right angle is one, whichever way rounding has it.
        angle -= np.pi / 2 * np.ceil(angle / (np.pi / 2) - 0.5 - ROUNDING)
        if abs(angle) > 1e-3:
            yield angle


@lru_cache(maxsize=1)
def _quarters() -> tuple[Points, Points]:
    """Points of a unit circle, by quarters, (4, STEPS + 1, 2), and the signs of each, (4, 2)."""
    quarter = np.linspace(0, np.pi / 2, STEPS + 1)
    angles = np.arange(4)[:, None] * np.pi / 2 + quarter
    signs = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    return np.stack([np.cos(angles), np.sin(angles)], axis=-1), signs


def _polygon(box: RoundedBox) -> "shapely.Polygon":
    """What a rounded box's border encloses."""
    import shapely

    unit, signs = _quarters()
    local = unit * box.radii + (signs * (box.sides / 2 - box.radii))[:, None]
    turned = local.reshape(-1, 2) @ rotations(np.asarray(box.angle)).T
    return shapely.Polygon(turned + box.centre)


def _border_area(box: RoundedBox) -> float:
    """What the border encloses."""
    of_circle = 2 * STEPS * np.sin(np.pi / 2 / STEPS)
    return float(box.sides.prod() - (4 - of_circle) * box.radii.prod())


def _corners(line: Outline) -> tuple[Floats, Floats]:
    """Where an open line turns sharply, as shares of its length, and by how much."""
    from shapetween.scene.places import Places

    curves = _without_points(line.curves)
    if not len(curves):
        return np.zeros(0), np.zeros(0)
    joints = Places(Outline(curves, False)).joints
    leaving, reaching = end_tangents(curves)
    kinks = _turns(reaching[:-1], leaving[1:])
    within = _turns(leaving, reaching)
    found = [
        (float(joints[k + 1]), float(kink)) for k, kink in enumerate(kinks) if abs(kink) > CORNER
    ]
    for k, turn in enumerate(within):
        short = joints[k + 1] - joints[k] < ROUNDED
        inner = 0 < k < len(curves) - 1
        if inner and short and ROUNDED_TURN[0] < abs(turn) < ROUNDED_TURN[1]:
            found.append((float(joints[k] + joints[k + 1]) / 2, float(turn)))
    found.sort()
    return np.array([place for place, _ in found]), np.array([turn for _, turn in found])


def _turns(first: Points, second: Points) -> Floats:
    return np.asarray(np.arctan2(cross(first, second), (first * second).sum(-1)))


def _without_points(curves: Curves) -> Curves:
    return np.asarray(curves[np.ptp(curves, axis=1).max(axis=1) > 0])
