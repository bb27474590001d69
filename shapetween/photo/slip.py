"""Slip: how far the maps of two neighbours disagree along the side they share.

Two homographies that agree on a side's ends need not agree between them. Where the third
coordinate w changes by the factor r from one end to the other, the share t of the way goes to
r t / (1 - t + r t); for two factors in the ratio r these differ by at most
(sqrt(r) - 1) / (sqrt(r) + 1) of the side's length. Triangles and bilinear maps have r = 1.
"""

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points, Quads
from shapetween.geometry.polygon import cross
from shapetween.mesh.pair import MeshPair

__all__ = ["bilinear_quads", "corner_weights", "greatest_slip"]

#: Frames in which slip is looked for. It changes slowly; more cost time.
FRAMES_LOOKED_AT = 9


def corner_weights(source: Quads, target: Quads) -> Floats:
    """Third coordinate w at the corners of homographies between quads, up to a factor, (..., 4).

    Parameters
    ----------
    source, target : (..., 4, 2) float64

    Notes
    -----
    Corners (x, y, 1) of a quad have one linear dependency, with the areas of the triangles that
    leave one corner out as coefficients of alternating sign. A homography carries the source's to
    the target's, so each w is the quotient of the target's triangle by the source's.
    """
    return _left_out(target) / _left_out(source)


def _left_out(quads: Quads) -> Floats:
    """Areas of the triangles without the corner, (..., 4)."""
    following = [np.roll(quads, -k, axis=-2) for k in (1, 2, 3)]
    return cross(following[1] - following[0], following[2] - following[0])


def bilinear_quads(
    pair: MeshPair, ends: tuple[Points, Points], vertices: Points, tolerance: float
) -> Mask:
    """Choose quads to map bilinearly so that no slip is over the tolerance, (Q,).

    Parameters
    ----------
    pair : MeshPair
    ends : ((V, 2) float64, (V, 2) float64)
        Vertices in the two pictures.
    vertices : (F, V, 2) float64
        Vertices in the frames.
    tolerance : float
        In the frames' pixels.

    Notes
    -----
    A bilinear quad may newly disagree with its other neighbours, so the choice goes on until it
    stands still.
    """
    count = len(pair.quads)
    chosen = np.zeros(count, bool)
    sides = _sides(pair)
    while True:
        over = _slips(pair, ends, vertices, chosen, sides) > tolerance
        faces = sides[over][..., 0] // 4  # faces count four corners each
        fresh = np.unique(faces[faces < count])
        if chosen[fresh].all():
            return chosen
        chosen[fresh] = True


def greatest_slip(
    pair: MeshPair, ends: tuple[Points, Points], vertices: Points, bilinear: Mask
) -> float:
    """Greatest slip in the frames' pixels with some quads mapped bilinearly; 0 without sides."""
    return float(_slips(pair, ends, vertices, bilinear, _sides(pair)).max(initial=0.0))


def _sides(pair: MeshPair) -> Index:
    """Corners at both ends of every shared side, in both faces, (E, 2 faces, 2 ends).

    Corner k of face n is 4 n + k, quads before triangles.
    """
    starts, ends, names = [], [], []
    first = 0
    for faces in (pair.quads, pair.triangles):
        size = faces.shape[1]
        local = 4 * (first + np.arange(len(faces)))[:, None] + np.arange(size)
        starts.append(np.stack([local, np.roll(local, -1, axis=1)], axis=-1).reshape(-1, 2))
        ends.append(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2))
        first += len(faces)
    corners, vertices = np.concatenate(starts), np.concatenate(ends)
    turned = vertices[:, 0] > vertices[:, 1]
    corners[turned], vertices[turned] = corners[turned, ::-1], vertices[turned, ::-1]
    order = np.lexsort((vertices[:, 1], vertices[:, 0]))
    same = np.flatnonzero((vertices[order[1:]] == vertices[order[:-1]]).all(axis=1))
    names = [corners[order[same]], corners[order[same + 1]]]
    return np.stack(names, axis=1)


def _slips(
    pair: MeshPair,
    ends: tuple[Points, Points],
    vertices: Points,
    bilinear: Mask,
    sides: Index,
) -> Floats:
    """Greatest slip on each shared side over frames and both pictures, (E,)."""
    looked = np.unique(np.linspace(0, len(vertices) - 1, FRAMES_LOOKED_AT).astype(int))
    frames = vertices[looked]
    faces = len(pair.quads) + len(pair.triangles)
    index = np.zeros(4 * faces, np.intp)
    index[: 4 * len(pair.quads)] = pair.quads.ravel()
    padded = np.concatenate([pair.triangles, pair.triangles[:, :1]], axis=1)
    index[4 * len(pair.quads) :] = padded.ravel()
    places = frames[:, index[sides[:, 0]]]  # (F, E, 2 ends, 2)
    lengths = np.linalg.norm(places[:, :, 1] - places[:, :, 0], axis=-1)
    worst = np.zeros(len(sides))
    for end in ends:
        weights = np.ones((len(frames), faces, 4))
        found = corner_weights(end[pair.quads][None], frames[:, pair.quads])
        weights[:, : len(pair.quads)] = np.where(bilinear[:, None], 1.0, found)
        at = weights.reshape(len(frames), -1)[:, sides]  # (F, E, 2 faces, 2 ends)
        factor = at[..., 1] / at[..., 0]
        root = np.sqrt(np.maximum(factor[..., 0] / factor[..., 1], factor[..., 1] / factor[..., 0]))
        worst = np.maximum(worst, ((root - 1) / (root + 1) * lengths).max(axis=0, initial=0.0))
    return worst
