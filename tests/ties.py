"""Drawings with much that is equal, by formula: what rounding must not decide there."""

import numpy as np

__all__ = ["TIES", "svg"]


def _star(points: int, outer: float, inner: float) -> str:
    angles = np.arange(2 * points) * np.pi / points
    radii = np.tile([outer, inner], points)
    corners = np.stack([50 + radii * np.sin(angles), 50 - radii * np.cos(angles)], axis=1)
    return "M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in corners) + "Z"


def _discs(count: int, away: float, r: float) -> str:
    angles = np.arange(count) * 2 * np.pi / count
    places = np.stack([50 + away * np.sin(angles) - r, 50 - away * np.cos(angles)], axis=1)
    return "".join(
        f"M{x:.3f} {y:.3f}a{r} {r} 0 1 0 {2 * r} 0a{r} {r} 0 1 0 {-2 * r} 0Z" for x, y in places
    )


_DRAWN = {
    "arch": "M20 90V40A30 30 0 0 1 80 40V90H70V40A20 20 0 0 0 30 40V90Z",
    "plus": "M40 10h20v30h30v20h-30v30h-20v-30h-30v-20h30z",
    "eight": _star(8, 45, 30) + _discs(4, 16, 5),
    "six": _star(6, 45, 26) + _discs(3, 12, 5),
    "twelve": _star(12, 45, 35) + _discs(6, 20, 4),
    "gear": _star(12, 45, 32) + _discs(1, 0, 14),
}

#: Pairs of them that once moved otherwise in another unit or on another processor.
TIES = (("arch", "plus"), ("eight", "six"), ("twelve", "gear"))


def svg(name: str) -> bytes:
    shape = f'<path fill-rule="evenodd" d="{_DRAWN[name]}"/>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{shape}</svg>'.encode()
