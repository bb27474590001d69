"""Faces that turn as rigidly as they can, each alone: quads and triangles alike.

A face is turned about its centre at an even rate while what is left, its change of shape, is
blended straight. The angle is the one that leaves least over in least squares, but for what the
faces of a mesh have in common: that is read off as one affine map first, so that an affine image
of a mesh is reached through affine images although its faces differ.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.homography import triangle_affinities
from shapetween.geometry.polygon import cross, diagonal_crossings
from shapetween.geometry.rotation import coherent_angles, polar, rotations
from shapetween.interpolate.faces import shared_edges
from shapetween.mesh.pair import MeshPair

__all__ = ["RigidFaces"]


@dataclass(frozen=True, slots=True, eq=False)
class RigidFaces:
    """Faces of one number of corners, and how far each turns.

    Attributes
    ----------
    source, target : (N, C, 2) float64
        Corners at both ends.
    angles : (N,) float64
        Whole turns included.
    """

    source: Points
    target: Points
    angles: Floats

    @classmethod
    def of(cls, pair: MeshPair, weights: Floats, parts: Index) -> "tuple[RigidFaces, RigidFaces]":
        """The quads and the triangles of a valid mesh.

        Parameters
        ----------
        pair : MeshPair
        weights : (Q + T,) float64
            What each face counts for what its part has in common; the same in both directions
            of time, so that the way back is the same.
        parts : (Q + T,) intp
            Connected part of each face.
        """
        faces = [pair.quads, pair.triangles]
        linear = np.concatenate([_bimedian_maps(pair.source[f], pair.target[f]) for f in faces])
        angles, stretches = polar(linear)
        angles = coherent_angles(angles, shared_edges([f for f in faces if len(f)]), weights)
        half_way = rotations(angles / 2)
        strains = half_way @ _logarithms(stretches) @ np.swapaxes(half_way, 1, 2)
        common = _means(angles, weights, parts)
        strain = _means(strains, weights, parts)
        # Source and target brought half way to each other by the map they have in common.
        forth = _exponentials(strain / 2) @ rotations(common / 2)
        back = _exponentials(-strain / 2) @ rotations(-common / 2)
        owner = np.split(np.arange(len(angles)), [len(pair.quads)])
        own = common + np.concatenate(
            [
                _angles(
                    pair.source[f] @ np.swapaxes(forth[k], 1, 2),
                    pair.target[f] @ np.swapaxes(back[k], 1, 2),
                )
                for f, k in zip(faces, owner, strict=True)
            ]
        )
        own += 2 * np.pi * np.round((angles - own) / (2 * np.pi))
        quads, triangles = (
            cls(pair.source[f], pair.target[f], own[k]) for f, k in zip(faces, owner, strict=True)
        )
        return quads, triangles

    def turned(self, t: Floats) -> Points:
        """Corners at the times (F,), (F, N, C, 2), turned and blended; `placed` says where."""
        time = t[:, None, None, None]
        turned_back = self.target @ rotations(self.angles)  # row vectors: R(-angle)
        turn = np.swapaxes(rotations(t[:, None] * self.angles), -1, -2)
        return np.asarray(((1 - time) * self.source + time * turned_back) @ turn)

    def placed(self, corners: Points, t: Floats) -> Points:
        """Corners (F, N, C, 2) at the times (F,), moved so that each face's centre goes straight.

        Quads must be convex.

        Notes
        -----
        The centre of a quad is where its diagonals cross: of a flat thing that moves straight in
        space, what is seen there is nearer to going straight than the mean of its corners.
        """
        time = t[:, None, None]
        straight = (1 - time) * _centres(self.source) + time * _centres(self.target)
        return np.asarray(corners + (straight - _centres(corners))[..., None, :])


def _centres(corners: Points) -> Points:
    """Crossing of a quad's diagonals, mean of a triangle's corners, (..., 2)."""
    return diagonal_crossings(corners) if corners.shape[-2] == 4 else corners.mean(axis=-2)


def _bimedian_maps(source: Points, target: Points) -> Floats:
    """Linear map of each face, (N, 2, 2), exact where it moves affinely.

    For quads the one that takes diagonals to diagonals, and so bimedians to bimedians: unlike a
    fit it is the inverse of the one from target to source.
    """
    if source.shape[1] == 3:
        return triangle_affinities(source, target)
    p, q = (np.swapaxes(x[:, 2:] - x[:, :2], 1, 2) for x in (source, target))
    return np.asarray(q @ np.linalg.inv(p))


def _angles(source: Points, target: Points) -> Floats:
    """Angle of the rotation that brings each face nearest to its target, (N,)."""
    a = source - source.mean(axis=1, keepdims=True)
    b = target - target.mean(axis=1, keepdims=True)
    return np.asarray(np.arctan2(cross(a, b).sum(axis=1), (a * b).sum(axis=(1, 2))))


def _logarithms(stretches: Floats) -> Floats:
    """Logarithm of symmetric positive matrices, (N, 2, 2)."""
    sizes, axes = np.linalg.eigh(stretches)
    return np.asarray(axes @ (np.log(sizes)[..., None] * np.swapaxes(axes, 1, 2)))


def _exponentials(strains: Floats) -> Floats:
    """Exponential of symmetric matrices, (N, 2, 2)."""
    sizes, axes = np.linalg.eigh(strains)
    return np.asarray(axes @ (np.exp(sizes)[..., None] * np.swapaxes(axes, 1, 2)))


def _means(values: Floats, weights: Floats, parts: Index) -> Floats:
    """Weighted mean of the values (N, ...) over each part, given to all of its faces, (N, ...)."""
    flat = values.reshape(len(values), -1)
    sums = np.zeros((int(parts.max()) + 1, flat.shape[1]))
    np.add.at(sums, parts, weights[:, None] * flat)
    means = sums / np.bincount(parts, weights=weights)[:, None]
    return np.asarray(means[parts].reshape(values.shape))
