"""Which lines are drawn alike, wherever they lie and however large they are."""

from collections.abc import Iterable, Sequence

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.geometry.polygon import cross
from shapetween.scene.forms import Blob, Dot, Form, OpenLine, RoundedBox, Segment
from shapetween.scene.relations import Scene, colours_apart

__all__ = ["drawn_alike", "goes_elsewhere", "scaled_groups"]

#: Correlation of even samples from which on two outlines may be one drawn in two sizes, and from
#: which on they surely are. Smaller, and a dome is taken for an arc; at 1 a bolt that was drawn
#: again with rounder corners is another thing.
LIKE = (0.985, 0.995)

#: Greatest angle, in radians, between straight lines of one direction, and difference of boxes of
#: one form, as a share of their sides.
ANGLE, BOX = 0.1, 0.12

#: Sum of differences of colours that are one.
COLOUR = 0.05

#: How far from its place an item of a group may be, as a share of the group. Larger, and any two
#: lines are a group; smaller, and an arrow whose head keeps its size in a circle is none.
FITS = 0.07

#: Least share of a drawing's lines, by length, that a group has. Smaller, and a part in common
#: outweighs the rest.
COVERED = 0.8

#: Greatest logarithm of the scale of a group, and least size of an item, as a share of the drawing,
#: that tells of it.
MOST_SCALED, SIZED = 1.4, 0.08

#: Way of a group that lies where it was, as a share of the drawing: of that other evidence tells.
IN_PLACE = 0.03

#: How far beside a straight line, as a share of its length, the ends of one are that lies along it.
#: Larger, and a bar of a hat stays to be one of a list; smaller, and a handle is no part of an x.
ASIDE = 0.1

#: Most pairs that are looked at, and most of one form. More take seconds: with those of one form
#: the time grows with their square.
MOST_LOOKED, MOST_ALIKE = 4000, 400


def drawn_alike(a: Scene, b: Scene) -> Floats:
    """How surely each pair is one line moved and scaled, from 0 to 1, (N, M).

    Lines without a bend, dots and rounded boxes are like all others of their kind, and of areas
    place and paint tell more: of those it is 0.
    """
    found = np.zeros((len(a.items), len(b.items)))
    for kind in (OpenLine, Blob):
        own = [
            [
                k
                for k, form in enumerate(s.forms)
                if isinstance(form, kind) and not s.items[k].filled
            ]
            for s in (a, b)
        ]
        if own[0] and own[1]:
            normal = _normal(a, own[0]), _normal(b, own[1])
            alike = _correlation(*normal, closed=kind is Blob)
            found[np.ix_(*own)] = np.clip((alike - LIKE[0]) / (LIKE[1] - LIKE[0]), 0.0, 1.0)
    return found


def _normal(scene: Scene, items: Sequence[int]) -> Floats:
    """Even samples (N, SAMPLES, 2) about their own middles, in one size."""
    points = np.stack([scene.items[k].points for k in items])
    points = points - points.mean(axis=1, keepdims=True)
    size = np.sqrt(np.square(points).sum(axis=(1, 2)))
    return np.asarray(points / np.maximum(size, 1e-12 * scene.scale)[:, None, None])


def _correlation(one: Floats, other: Floats, *, closed: bool) -> Floats:
    """Greatest correlation of samples (N, S, 2) and (M, S, 2), from whichever end or start."""
    ways = []
    for way in (other, other[:, ::-1]):
        if closed:
            spectra = [np.fft.rfft(side, axis=1) for side in (one, way)]
            product = np.einsum("nsk,msk->nms", spectra[0], spectra[1].conj())
            ways.append(np.fft.irfft(product, one.shape[1], axis=2).max(axis=2))
        else:
            ways.append(np.tensordot(one, way, axes=((1, 2), (1, 2))))
    return np.asarray(np.maximum(*ways))


def scaled_groups(a: Scene, b: Scene) -> list[tuple[int, int]] | None:
    """Who becomes whom where one drawing is in the other one, moved and scaled; else nobody.

    An arrow that comes into a circle is, and so is a bell that makes room for a badge. What the
    other one has beside it does not matter. None where there is too much to look for it.
    """
    if len(a.items) * len(b.items) > MOST_LOOKED:
        return None
    firsts, seconds = np.nonzero(_of_one_form(a, b))
    if len(firsts) > MOST_ALIKE:
        return None
    if len(firsts) < 2:
        return []
    reach = [np.array([np.hypot(*np.ptp(item.box, axis=0)) for item in s.items]) for s in (a, b)]
    share = [np.array([item.length + item.width for item in s.items]) for s in (a, b)]
    share = [np.where(s.sheets, 0.0, own) for s, own in zip((a, b), share, strict=True)]
    share = [own / max(float(own.sum()), 1e-12) for own in share]
    best: tuple[tuple[float, float], list[tuple[int, int]]] | None = None
    for i, j in zip(firsts, seconds, strict=True):
        if min(reach[0][i] / a.scale, reach[1][j] / b.scale) < SIZED:
            continue
        scale = float(reach[1][j] / reach[0][i])
        if abs(np.log(scale)) > MOST_SCALED:
            continue
        there = scale * (a.centres - a.centres[i]) + b.centres[j]
        away = np.linalg.norm(there[firsts] - b.centres[seconds], axis=1)
        sizes = np.abs(scale * reach[0][firsts] - reach[1][seconds])
        least = FITS * min(scale * a.scale, b.scale)
        fits = np.flatnonzero((away < least) & (sizes < least))
        order = fits[np.lexsort((fits, np.round(away[fits] / b.scale, 6)))]
        pairs = _one_to_one(zip(firsts[order].tolist(), seconds[order].tolist(), strict=True))
        covered = max(sum(float(share[n][pair[n]]) for pair in pairs) for n in (0, 1))
        if len(pairs) < 2 or covered < COVERED:
            continue
        shift = float(np.linalg.norm(there - a.centres, axis=1).mean()) / a.scale
        rank = round(covered, 1), -round(shift + abs(np.log(scale)), 6)
        if best is None or rank > best[0]:
            best = rank, pairs
    return [] if best is None or -best[0][1] < IN_PLACE else sorted(best[1])


def goes_elsewhere(one: Form, other: Form) -> bool:
    """Whether two forms are straight lines, and one does not lie along the other."""
    if not (isinstance(one, Segment) and isinstance(other, Segment)):
        return False
    way = one.end - one.start
    ends = np.stack([other.start, other.end]) - one.start
    length = float(np.hypot(*way))
    return bool((np.abs(cross(ends, way)) > ASIDE * length**2).any())


def _of_one_form(a: Scene, b: Scene) -> Mask:
    """Which pairs of lines are of one form, whatever their sizes."""
    alike = drawn_alike(a, b) >= 1.0
    directions = [np.array([_direction(form) for form in scene.forms]) for scene in (a, b)]
    for i, j in np.argwhere(colours_apart(a.colours, b.colours) < COLOUR).tolist():
        one, other = a.forms[i], b.forms[j]
        if a.items[i].filled or b.items[j].filled:
            continue
        if isinstance(one, Segment) and isinstance(other, Segment):
            turn = abs(directions[0][i] - directions[1][j]) % np.pi
            alike[i, j] = min(turn, np.pi - turn) < ANGLE
        elif isinstance(one, RoundedBox) and isinstance(other, RoundedBox):
            alike[i, j] = _boxes_alike(one, other)
        elif isinstance(one, Dot) and isinstance(other, Dot):
            alike[i, j] = True
    return alike


def _direction(form: Form) -> float:
    """Of a straight line, modulo pi; 0 of others."""
    if not isinstance(form, Segment):
        return 0.0
    way = form.end - form.start
    return float(np.arctan2(way[1], way[0]))


def _boxes_alike(one: RoundedBox, other: RoundedBox) -> bool:
    """Whether one rounded box is another one scaled."""
    scale = float(np.sqrt(one.sides.prod() / other.sides.prod()))
    if not one.round and abs(one.angle - other.angle) > ANGLE:
        return False
    off = max(
        np.abs(one.sides - scale * other.sides).max(),
        np.abs(one.radii - scale * other.radii).max() / 2,
    )
    return bool(off < BOX * one.sides.max())


def _one_to_one(pairs: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """The pairs whose items no earlier one has."""
    kept: dict[int, int] = {}
    for i, j in pairs:
        if i not in kept and j not in kept.values():
            kept[i] = j
    return list(kept.items())
