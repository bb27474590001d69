"""Outlines the correspondence is tried on, and ways to write the same outline otherwise."""

import numpy as np

from shapetween.base.arrays import Affine, Floats, Points
from shapetween.geometry.bezier import line_curves, sub_curves
from shapetween.match.correspondence import Correspondence
from shapetween.model.outline import Outline


def polygon(points: Points) -> Outline:
    """The closed polygon, of positive area."""
    outline = Outline(line_curves(points, np.roll(points, -1, axis=0)))
    return outline if outline.area > 0 else outline.reversed()


def star(seed: int, corners: int = 9) -> Points:
    """A star-shaped polygon, no two of which look alike, as (corners, 2)."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * (np.arange(corners) + rng.uniform(-0.3, 0.3, corners)) / corners
    radius = rng.uniform(0.4, 1.5, corners)
    return np.asarray(radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def rounded(points: Points) -> Outline:
    """A smooth closed outline through points."""
    handle = (np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)) / 6
    following = np.roll(points, -1, axis=0)
    curves = np.stack(
        [points, points + handle, following - np.roll(handle, -1, axis=0), following], axis=1
    )
    return Outline(curves)


def disc() -> Outline:
    """Four cubics, all alike."""
    k = 0.5522847498
    arc = np.array([[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]])
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    curves = np.stack([arc @ np.linalg.matrix_power(turn, i) for i in range(4)])
    curves[:-1, 3], curves[-1, 3] = curves[1:, 0], curves[0, 0]
    return Outline(curves)


def rewritten(outline: Outline, first: int, cut: float) -> Outline:
    """The same curve from another start, each command cut in two."""
    curves = np.roll(outline.curves, -first, axis=0)
    t = np.full(len(curves), cut)
    halves = [sub_curves(curves, 0 * t, t), sub_curves(curves, t, 0 * t + 1)]
    joined = np.stack(halves, axis=1).reshape(-1, 4, 2)
    joined[1:, 0], joined[0, 0] = joined[:-1, 3], joined[-1, 3]
    return Outline(joined)


def rotation(angle: float, scale: float = 1.0) -> Affine:
    """A turn about the origin, scaled, and moved by (3, -1) of the scale."""
    c, s = scale * np.cos(angle), scale * np.sin(angle)
    return np.array([[c, -s, 3 * scale], [s, c, -scale]])


def target_at(found: Correspondence, u: Floats) -> Floats:
    """Places on the target, in [0, 1), of places on the source."""
    return _follow(found.u, found.v, u)


def source_at(found: Correspondence, v: Floats) -> Floats:
    """Places on the source, in [0, 1), of places on the target."""
    return _follow(found.v, found.u, v)


def _follow(knots: Floats, values: Floats, at: Floats) -> Floats:
    """Piecewise linear from `knots` to `values`, both over one turn, at places modulo 1."""
    x = at - knots[0]
    result = np.interp(x - np.floor(x), knots - knots[0], values)
    return np.asarray(result - np.floor(result))


def apart(a: Floats, b: Floats) -> float:
    """Greatest distance of places on a closed outline, as a share of its length."""
    gap = a - b
    return float(np.abs(gap - np.round(gap)).max())


def dense(points: Points, count: int = 400) -> Points:
    """As many points evenly along a closed polygon, but for its corners."""
    closed = np.vstack([points, points[:1]])
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    at = np.arange(count) / count * arc[-1]
    return np.stack([np.interp(at, arc, closed[:, k]) for k in (0, 1)], axis=1)


def swirled(points: Points, centre: Points, angle: float, reach: float) -> Points:
    """The plane turned about a centre, less and less with the distance: limbs bend."""
    offset = points - centre
    turn = angle * np.exp(-((np.linalg.norm(offset, axis=1) / reach) ** 2))
    c, s = np.cos(turn), np.sin(turn)
    x, y = offset.T
    return np.asarray(centre + np.stack([c * x - s * y, s * x + c * y], axis=1))


def bowed(points: Points, strength: float) -> Points:
    """The plane bent like a bow, upwards at both sides."""
    x, y = points.T
    return np.stack([x + 0.3 * strength * y, y - strength * x * x], axis=1)
