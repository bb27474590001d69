"""What lies on a thing that stands still and goes from there goes as one: a sign on a folder."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.scene.forms import RoundedBox, Segment
from shapetween.scene.hosts import lies_on, stands_still
from shapetween.scene.relations import Scene
from shapetween.scene.sets import components
from shapetween.scene.unmatched.clusters import Cluster, contact
from shapetween.scene.unmatched.going import Side

__all__ = ["joined_on_hosts"]

#: Gap between two things of one sign, as a share of the longer side of the smaller one. Larger,
#: and the windows of a wall crowd into one place; smaller, and the dot of a letter leaves alone.
GAP = 0.75

#: Share of a thing's own size along which the border of what it lies on runs next to it if it is
#: that one's own edge or band. Smaller, and a sign near a corner is; larger, and a lid shrinks
#: with the sign below it.
EDGE = 0.35

#: Ratio of sizes of boxes and discs that are a set. Larger, and a bar and its dot are, which leave
#: each other; smaller, and keys drawn by hand crowd into one place.
ONE_SIZE = 1.5

#: Share of what it lies on that a straight line goes across to divide it. Smaller, and a dash in
#: a sign does; larger, and the head line of a calendar shrinks with its digits.
DIVIDES = 0.5


def joined_on_hosts(found: Sequence[Cluster], side: Side) -> list[Cluster]:
    """Clusters, those put together that are one sign on a thing that stands still.

    Parameters
    ----------
    found : sequence of Cluster
    side : Side
    """
    if len(found) < 2:
        return list(found)
    scene = side.scene
    hosts = _hosts(found, side)
    if not any(host is not None for host in hosts):
        return list(found)
    result: list[Cluster] = []
    for host in dict.fromkeys(hosts):
        own = [cluster for cluster, on in zip(found, hosts, strict=True) if on == host]
        if host is None or (side.faces is not None and side.faces[host]):
            result += own  # features of a face go each in its place
            continue
        free = [
            not _is_edge(c.members, host, scene)
            and not _divides(c.members, host, scene)
            and not (c.lines and _hangs(c.members, host, side))
            for c in own
        ]
        result += [c for c, may in zip(own, free, strict=True) if not may]
        result += _signs([c for c, may in zip(own, free, strict=True) if may], host, scene)
    return result


def _signs(found: Sequence[Cluster], host: int, scene: Scene) -> list[Cluster]:
    """Clusters on one thing, those put together that are near each other."""
    import shapely

    if len(found) < 2:
        return list(found)
    drawn = np.array([shapely.union_all(scene.drawn[list(c.members)]) for c in found], dtype=object)
    bounds = shapely.bounds(drawn)
    longest = (bounds[:, 2:] - bounds[:, :2]).max(axis=1)
    gaps = shapely.distance(drawn[:, None], drawn)
    near = np.round(gaps / np.minimum(longest[:, None], longest), 6) <= GAP
    labels = components(near)
    result = []
    for label in dict.fromkeys(labels.tolist()):
        own = [c for c, at in zip(found, labels, strict=True) if at == label]
        if len(own) == 1 or _are_rows(own, scene):
            result += own
            continue
        members = tuple(sorted(k for c in own for k in c.members))
        result.append(Cluster(members, host, all(c.lines for c in own), sign=True))
    return result


def _hosts(found: Sequence[Cluster], side: Side) -> list[int | None]:
    """Of each cluster the smallest thing standing still that it lies on."""
    scene = side.scene
    standing = []
    for j, tracks in side.anchors.items():
        if not scene.sheets[j] and scene.items[j].closed:
            first, second = (_box(curves) for curves in tracks[0].curves(np.array([0.0, 1.0])))
            if stands_still(first, second, scene.scale):
                standing.append((round(scene.items[j].enclosed.area / scene.scale**2, 9), -j))
    hosts: list[int | None] = [None] * len(found)
    for _, k in sorted(standing, reverse=True):
        on_it = lies_on(scene, -k)
        for n, cluster in enumerate(found):
            if on_it[list(cluster.members)].all():
                hosts[n] = -k
    return hosts


def _box(curves: Curves) -> Points:
    points = curves.reshape(-1, 2)
    return np.stack([points.min(axis=0), points.max(axis=0)])


def _is_edge(members: Sequence[int], host: int, scene: Scene) -> bool:
    """Whether items lie within another one along its border."""
    import shapely

    own = shapely.union_all(scene.drawn[list(members)])
    if not scene.items[host].enclosed.buffer(0.004 * scene.scale).covers(own):
        return False
    length = contact(members, host, scene, inside=True)[1]
    return round(length / max(float(scene.sizes[k]) for k in members), 6) > EDGE


def _divides(members: Sequence[int], host: int, scene: Scene) -> bool:
    """Whether a straight line goes across what it lies on."""
    if len(members) > 1 or not isinstance(scene.forms[members[0]], Segment):
        return False
    across = np.ptp(scene.items[members[0]].box, axis=0) / np.ptp(scene.items[host].box, axis=0)
    return round(float(across.max()), 6) > DIVIDES


def _hangs(members: Sequence[int], host: int, side: Side) -> bool:
    """Whether lines touch what else stays there, as veins of a leaf its stem: they go into that."""
    scene = side.scene
    return any(
        j != host and scene.outlined[j] != host and not scene.sheets[j] and lies_on(scene, host)[j]
        for j in side.anchors
        if scene.touching[list(members), j].any()
    )


def _are_rows(found: Sequence[Cluster], scene: Scene) -> bool:
    """Whether all are bars of a text, or boxes or discs of one size, as keys and windows."""
    leads = [
        max(c.members, key=lambda k: (round(float(scene.sizes[k]) / scene.scale, 9), -k))
        for c in found
    ]
    if all(isinstance(scene.forms[k], Segment) for k in leads):
        return True
    sizes = scene.sizes[leads]
    plain = all(isinstance(scene.forms[k], RoundedBox) for k in leads)
    return plain and round(float(sizes.max() / sizes.min()), 6) < ONE_SIZE
