"""Drawings to measure on, by category: those of the repository, made ones, or a folder of pairs."""

import json
from pathlib import Path

import numpy as np

from shapetween.model.drawing import Drawing
from shapetween.svg.read.reader import read_svg
from tests.benchmarks.measuring import PAIRS, ROOT, read

__all__ = ["PARTS", "POINTS", "categories", "made_of_parts", "made_of_points"]

#: Points of made outlines, and parts of made drawings, by which growth is measured.
POINTS, PARTS = (1_000, 3_000, 10_000, 30_000), (30, 100, 300)

_HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 800">'


def categories(
    folder: Path | None, most: int, only: tuple[str, ...] = ()
) -> dict[str, list[tuple[Drawing, Drawing]]]:
    """Pairs of drawings by the name of their category.

    Parameters
    ----------
    folder : Path or None
        Where ``pairs.json`` is, a list of objects with ``category`` and paths ``a`` and ``b``; None
        for the repository's own drawings and made ones.
    most : int
        Most pairs of a category, taken evenly from all.
    only : tuple of str
        The categories that are wanted; all without any.
    """
    found: dict[str, list[tuple[Drawing, Drawing]]] = {}
    if folder is None:
        found["silhouettes"] = [(read(a), read(b)) for a, b in PAIRS]
        scene = ROOT / "tests/data/scene"
        firsts = sorted(scene.glob("*.a.svg"))
        pairs = [(file, file.with_name(file.name.replace(".a.svg", ".b.svg"))) for file in firsts]
        found["small drawings"] = [(_read(a), _read(b)) for a, b in _evenly(pairs, most)]
        found["large, made"] = [
            (made_of_points(10_000), made_of_points(12)),
            (made_of_parts(100, 1), made_of_parts(100, 2)),
        ]
        return {name: pairs for name, pairs in found.items() if not only or name in only}
    rows = json.loads((folder / "pairs.json").read_text("utf-8"))
    for name in dict.fromkeys(row["category"] for row in rows):
        if only and name not in only:
            continue
        own = [(folder / r["a"], folder / r["b"]) for r in rows if r["category"] == name]
        found[name] = [(_read(a), _read(b)) for a, b in _evenly(own, most)]
    return found


def _evenly(pairs: list[tuple[Path, Path]], most: int) -> list[tuple[Path, Path]]:
    count = min(most, len(pairs))
    return [pairs[k * len(pairs) // count] for k in range(count)]


def _read(file: Path) -> Drawing:
    return read_svg(file.read_bytes(), file.name)


def made_of_points(count: int) -> Drawing:
    """A wavy outline of so many points."""
    angle = 2 * np.pi * np.arange(count) / count
    radius = 300 + 60 * np.sin(5 * angle) + 8 * np.sin(97 * angle) * (count > 200)
    points = 400 + radius * np.array([np.cos(angle), np.sin(angle)])
    text = "L".join(f"{x:.3f} {y:.3f}" for x, y in points.T.tolist())
    return read_svg(f'{_HEAD}<path d="M{text}Z"/></svg>'.encode(), f"{count} points")


def made_of_parts(count: int, seed: int) -> Drawing:
    """So many boxes and discs, strewn about."""
    random = np.random.default_rng(seed)
    rows = zip(*random.uniform(0, 780, (2, count)), random.uniform(5, 15, count), strict=True)
    parts = [
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size:.1f}" fill="#37a"/>'
        if k % 2
        else f'<path d="M{x:.1f} {y:.1f}h{size:.1f}v{1.3 * size:.1f}h-{size:.1f}z" fill="#a37"/>'
        for k, (x, y, size) in enumerate(rows)
    ]
    return read_svg(f"{_HEAD}{''.join(parts)}</svg>".encode(), f"{count} parts")
