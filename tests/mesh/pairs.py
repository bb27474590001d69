"""Pairs of matched outlines to mesh, and a check of meshes that shares nothing with the mesher."""

import numpy as np
import shapely

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.mesh import MatchedMesh
from shapetween.mesh.quality import MIN_CORNER_SINE

Pair = tuple[Points, Points, Mask]


def cross(a: Points, b: Points) -> Floats:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def clockwise(ring: Points) -> Points:
    return ring if cross(ring, np.roll(ring, -1, axis=0)).sum() > 0 else ring[::-1]


def untangled(rng: np.random.Generator, count: int) -> Points:
    """A random simple polygon: crossing sides of a random one are uncrossed until none are left."""
    ring = rng.random((count, 2))
    while True:
        step = np.roll(ring, -1, axis=0) - ring
        side = cross(step[:, None], ring[None] - ring[:, None])
        hit = side * np.roll(side, -1, axis=1) < 0
        hit &= hit.T
        own = np.arange(count)
        hit[own, own] = hit[own, own - 1] = hit[own - 1, own] = False
        if not hit.any():
            return clockwise(ring)
        i, j = np.argwhere(np.triu(hit))[0]
        ring[i + 1 : j + 1] = ring[i + 1 : j + 1][::-1].copy()


def regular(count: int) -> Points:
    turn = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(turn), np.sin(turn)], axis=1)


def star(points: int = 9, inner: float = 0.3) -> Points:
    return regular(2 * points) * np.where(np.arange(2 * points) % 2, inner, 1.0)[:, None]


def spiral(turns: float = 2.5, width: float = 0.035) -> Points:
    t = np.linspace(0, 1, 60)
    radius, angle = 0.15 + t, 2 * np.pi * turns * t
    along = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    outer, inner = (radius + width)[:, None] * along, (radius - width)[:, None] * along
    return clockwise(np.concatenate([outer, inner[::-1]]))


def comb(teeth: int, height: float = 1.0, width: float = 0.4) -> Points:
    ring = [(0.0, -0.3), (float(teeth), -0.3)]
    for middle in np.arange(teeth)[::-1] + 0.5:
        low, high = middle - width / 2, middle + width / 2
        ring += [(high, 0.0), (high, height), (low, height), (low, 0.0)]
    return clockwise(np.array(ring))


def matched(a: Points, b: Points, count: int, offset: float = 0.0) -> Pair:
    """Samples of two polygons matched by length, with the corners of both among them."""

    def measured(ring: Points) -> tuple[Floats, Points]:
        closed = np.concatenate([ring, ring[:1]])
        length = np.sqrt((np.diff(closed, axis=0) ** 2).sum(-1))
        return np.concatenate([[0], np.cumsum(length)]) / length.sum(), closed

    (u, ring_a), (v, ring_b) = measured(a), measured(b)
    joints = np.concatenate([u[:-1], (v[:-1] - offset) % 1])
    w = np.unique(np.concatenate([np.arange(count) / count, joints]))
    w = w[np.append(np.diff(w) > 1e-6, True) & (w < 1 - 1e-6)]
    at_joint = (abs(w[:, None] - joints) < 1e-6).any(axis=1)

    def at(knots: Floats, ring: Points, places: Floats) -> Points:
        places = places % 1
        return np.stack([np.interp(places, knots, ring[:, k]) for k in (0, 1)], axis=1)

    return at(u, ring_a, w), at(v, ring_b, w + offset), at_joint


def assert_valid(mesh: MatchedMesh, source: Points, target: Points) -> None:
    """Check what a matched mesh promises."""
    pair, count = mesh.pair, len(mesh.nodes)
    assert (np.diff(mesh.nodes) > 0).all()
    np.testing.assert_allclose(pair.source[:count], source[mesh.nodes], rtol=0, atol=0)
    np.testing.assert_allclose(pair.target[:count], target[mesh.nodes], rtol=0, atol=0)

    faces = [*pair.quads.tolist(), *pair.triangles.tolist()]
    assert sorted({v for face in faces for v in face}) == list(range(len(pair.source)))
    edges = [(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True)]
    assert len(edges) == len(set(edges)), "two faces lie on the same side of an edge"
    outer = {(a, b) for a, b in edges if (b, a) not in set(edges)}
    assert outer == {(k, (k + 1) % count) for k in range(count)}

    for points in (pair.source, pair.target):
        outline = shapely.Polygon(points[:count])
        assert outline.is_valid
        size = np.sqrt(outline.area)
        covered = sum(shapely.Polygon(points[face]).area for face in faces)
        assert abs(covered - outline.area) < 1e-9 * size**2
        for face in faces:
            corners = points[face]
            leaving = np.roll(corners, -1, axis=0) - corners
            turn = cross(np.roll(leaving, 1, axis=0), leaving)
            assert (turn > 0).all()
            if len(face) == 4:
                length = np.sqrt((leaving**2).sum(-1))
                sine = turn / (length * np.roll(length, 1))
                assert sine.min() >= MIN_CORNER_SINE * (1 - 1e-9)
                assert sine.min() >= mesh.sine * (1 - 1e-9)
