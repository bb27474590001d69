"""One closed line that becomes two: it is cut into two open ones, each of which closes."""

from collections.abc import Sequence

import numpy as np

from shapetween.fill.regions import Region
from shapetween.fill.splitting import split_alike
from shapetween.scene.asked import Group
from shapetween.scene.cuts.areas import families
from shapetween.scene.cuts.division import Division, Found, piece_of
from shapetween.scene.places import Places, run_of
from shapetween.scene.relations import Scene

__all__ = ["divided_rings"]

#: Places along a ring that are asked which piece they belong to.
ASKED = 360


def divided_rings(whole: Scene, parts: Scene, groups: Sequence[Group] = ()) -> Found:
    """Closed lines of a scene that two of the other one are made of, cut in two."""
    import shapely

    found: Found = {}
    for k, pieces in families(whole, parts, groups, filled=False):
        if len(pieces) != 2:
            continue
        item = whole.items[k]
        ring = item.outer.clockwise()
        regions = [Region(parts.items[j].outer.clockwise()) for j in pieces]
        cells = split_alike(Region(ring), regions)
        if cells is None:
            continue
        places = Places(ring)
        shares = (np.arange(ASKED) + 0.5) / ASKED
        points = shapely.points(places.point(shares))
        areas = [shapely.Polygon(Places(c.outer).point(np.arange(200) / 200)) for c in cells]
        nearer = shapely.distance(areas[0], points) <= shapely.distance(areas[1], points)
        turns = np.flatnonzero(nearer != np.roll(nearer, 1))
        if len(turns) != 2:
            continue
        first, second = (turns / ASKED).tolist()
        runs = [(first, second), (second, first + 1.0)]
        owners = [0, 1] if nearer[turns[0]] else [1, 0]
        made = [piece_of(item, run_of(places, *run)) for run in runs]
        pairs = [(piece, int(pieces[o])) for piece, o in zip(made, owners, strict=True)]
        found[k] = Division(made, pairs)
    return found
