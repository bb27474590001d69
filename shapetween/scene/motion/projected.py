"""Rings and lines that move with a quad of a mesh, by the homography that the quad moves by."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Quads
from shapetween.geometry.homography import (
    apply_homography,
    homography_jacobians,
    quad_homographies,
)
from shapetween.interpolate.base import Tween
from shapetween.model.outline import Outline
from shapetween.scene.motion.tracks import OfPieces
from shapetween.scene.places import Pieces, Places, cut_alike

__all__ = ["MovingQuads", "Projected", "pieces_between", "projected"]

#: Distance, as a share of an outline's length, of a place from a joint that it is taken for.
#: Smaller, and corners that all but coincide are cut off; larger, and small steps are lost.
NEAR = 0.01


def projected(matrix: Floats, curves: Curves) -> Curves:
    """Cubics under homographies: the ends and the directions there exact, what is between nearly.

    As near as circles drawn as four cubics are to circles, so no curve is cut for it.

    Parameters
    ----------
    matrix : (..., 3, 3) float64
    curves : (..., N, 4, 2) float64
    """
    ends = curves[..., (0, 3), :].reshape(*curves.shape[:-3], -1, 2)
    images = apply_homography(matrix, ends).reshape(*curves.shape[:-2], 2, 2)
    slopes = homography_jacobians(matrix, ends).reshape(*curves.shape[:-2], 2, 2, 2)
    handles = curves[..., 1:3, :] - curves[..., (0, 3), :]
    moved = images + (slopes @ handles[..., None])[..., 0]
    return np.concatenate([images[..., :1, :], moved, images[..., 1:, :]], axis=-2)


class MovingQuads:
    """Quads that a method moves as one mesh.

    Parameters
    ----------
    tween : Tween
        The mesh's movement.
    source : (Q, 4, 2) float64
        Each quad's corners at the start.
    faces : (Q, 4) intp
        Which vertices of the mesh they are.
    """

    def __init__(self, tween: Tween, source: Quads, faces: Index) -> None:
        self._tween, self._source, self._faces = tween, source, faces
        self._last: tuple[bytes, Floats] | None = None

    def matrices(self, k: int, t: Floats) -> Floats:
        """The homographies from where a quad is at the start to where it is at times, (F, 3, 3)."""
        key = t.tobytes()
        last = self._last
        if last is None or last[0] != key:
            corners = self._tween.vertices(t)[:, self._faces]
            found = quad_homographies(np.broadcast_to(self._source, corners.shape), corners)
            # What moves with them asks for the same times in turn.
            self._last = last = key, found
        return last[1][:, k]


@dataclass(frozen=True, eq=False)
class Projected(OfPieces):
    """One ring or line on a quad that moves; what differs besides goes over evenly on the quad.

    Attributes
    ----------
    pieces : Pieces
    quads : MovingQuads
    quad : int
        Which of them.
    """

    quads: MovingQuads
    quad: int

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); exactly the ends' own at 0 and 1."""
        whole = self.quads.matrices(self.quad, np.ones(1))[0]
        target = projected(np.linalg.inv(whole), self.pieces.target)
        part = t[:, None, None, None]
        result = projected(
            self.quads.matrices(self.quad, t), (1 - part) * self.pieces.source + part * target
        )
        result[t == 0] = self.pieces.source
        result[t == 1] = self.pieces.target
        return result


def pieces_between(source: Outline, target: Outline, matrix: Floats) -> Pieces:
    """Two outlines cut at places that a homography takes to each other.

    Parameters
    ----------
    source, target : Outline
        Nearly each other's images, and run the same way if they are closed.
    matrix : (3, 3) float64
        From the first to the second.
    """
    moved = Outline(projected(matrix, source.curves), source.closed)
    if not source.closed and _is_reversed(moved, target):
        target = target.reversed()
    places = Places(source), Places(target)
    there = Places(moved)
    u, v = places[0].joints[:-1] if source.closed else places[0].joints, places[1].joints
    curve, at = there.locate(_to_joints(there, there.nearest(places[1].point(v))))
    back = places[0].share(curve, at)
    forth = _to_joints(places[1], places[1].nearest(there.point(there.joints[: len(u)])))
    knots = np.concatenate([np.stack([u, forth]), np.stack([back, v])], axis=1)
    ends = np.array([[0.0, 1.0], [0.0, 1.0]])
    if source.closed:
        # Both run from where the first begins. What lies next to there may be just before it.
        knots[1] -= forth[0]
        knots[1] -= np.round(knots[1] - knots[0])
        knots = np.clip(knots, 0.0, 1.0)
    knots = np.concatenate([knots, ends], axis=1)
    knots = knots[:, np.lexsort((knots[1], knots[0]))]
    knots[1] = np.maximum.accumulate(knots[1]) + (forth[0] if source.closed else 0.0)
    return cut_alike(*places, *knots)


def _to_joints(places: Places, shares: Floats) -> Floats:
    """Shares with those next to a joint moved to it."""
    after = np.clip(np.searchsorted(places.joints, shares), 1, len(places.joints) - 1)
    around = places.joints[[after - 1, after]]
    nearest = around[np.abs(around - shares).argmin(axis=0), np.arange(len(shares))]
    return np.where(np.abs(nearest - shares) < NEAR, nearest, shares)


def _is_reversed(moved: Outline, target: Outline) -> bool:
    ends = [np.stack([line.curves[0, 0], line.curves[-1, 3]]) for line in (moved, target)]
    return bool(np.abs(ends[0] - ends[1][::-1]).sum() < np.abs(ends[0] - ends[1]).sum())
