"""Words: letters in a row, of which none becomes another one.

Half-way between two letters is a blot that nobody reads. What both words have slides to its place,
none past another; the rest goes where it stands, and the other word's letters come where they will.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.scene.forms import Dot, RoundedBox, Segment
from shapetween.scene.relations import Scene, in_common, picture

__all__ = ["other_letters"]

#: Fewest letters of either word, and of the longer one. Fewer, and two halves of a thing are a
#: word; more, and "on" does not become "off".
FEWEST, LONGER = 2, 3

#: Least height of a letter, as a share of the highest one; greatest gap to the next one, as a share
#: of that too; and how far the middle of its height is from that of all. Looser, and scattered
#: things are a row; stricter, and a p beside an l is none.
HEIGHT, GAP, LEVEL = 0.4, 0.6, 0.4

#: Share of the narrower one's width that is above or below the other one in one letter. Smaller,
#: and slanted letters are one; larger, and an i has no dot.
ABOVE = 0.6

#: Share of letters that are more than boxes and straight lines. Smaller, and the bars of a chart
#: are a word; larger, and a word with an l and an i is none.
WRITTEN = 0.5

#: Share that pictures of one letter have in common. Smaller, and an e is an o; larger, and the same
#: letter set a little bolder is another one.
SAME = 0.85


@dataclass(frozen=True, slots=True, eq=False)
class _Word:
    """A row of letters from left to right.

    Attributes
    ----------
    letters : tuple of tuple of int
        Items of each, in paint order.
    pictures : (N, C, C) float64
    places : (N,) float64
        Where each begins, as a share of the drawing.
    """

    letters: tuple[tuple[int, ...], ...]
    pictures: Floats
    places: Floats


def other_letters(a: Scene, b: Scene) -> Mask:
    """Pairs of things in two words that are not one letter of both, (N, M)."""
    found = np.zeros((len(a.items), len(b.items)), dtype=bool)
    words = [_words(scene) for scene in (a, b)]
    for one in words[0]:
        for other in words[1]:
            if max(len(one.letters), len(other.letters)) >= LONGER:
                found[np.ix_(*(sum(word.letters, ()) for word in (one, other)))] = True
                for i, j in _kept(one, other):
                    for first, second in zip(one.letters[i], other.letters[j], strict=True):
                        found[first, second] = False
    return found


def _kept(one: _Word, other: _Word) -> list[tuple[int, int]]:
    """Letters that both words have, in the order of both: most, and those that go least far."""
    same = in_common(one.pictures, other.pictures) > SAME
    counts = [np.array([len(letter) for letter in word.letters]) for word in (one, other)]
    same &= counts[0][:, None] == counts[1]
    best: list[list[tuple[float, tuple[tuple[int, int], ...]]]] = [
        [(0.0, ())] * (len(other.letters) + 1) for _ in range(len(one.letters) + 1)
    ]
    for i in range(len(one.letters)):
        for j in range(len(other.letters)):
            options = [best[i][j + 1], best[i + 1][j]]
            if same[i, j]:
                way = min(abs(float(one.places[i] - other.places[j])), 1.0)
                score, pairs = best[i][j]
                options.append((score + 1.5 - round(way, 6), (*pairs, (i, j))))
            best[i + 1][j + 1] = max(options, key=lambda option: option[0])
    return list(best[-1][-1][1])


def _words(scene: Scene) -> list[_Word]:
    """Rows of letters, each all that lies on one thing, or loose."""
    parents = np.where(scene.sheets, -2, scene.parents)
    rows = [np.flatnonzero(parents == k) for k in np.unique(parents[parents >= -1])]
    words = [_word(row, scene) for row in rows if len(row) >= FEWEST]
    return [word for word in words if word is not None]


def _word(row: Index, scene: Scene) -> _Word | None:
    """Things that stand side by side, about as high, in one colour, and most of them written."""
    if np.isin(scene.parents, row).any() or np.ptp(scene.colours[row], axis=0).max() > 1e-6:
        return None
    letters, boxes = _letters(row, scene)
    heights = boxes[:, 1, 1] - boxes[:, 0, 1]
    most = heights.max()
    gaps = boxes[1:, 0, 0] - boxes[:-1, 1, 0]
    middle = (boxes[:, 0, 1].min() + boxes[:, 1, 1].max()) / 2
    off = np.abs(boxes[:, :, 1].mean(axis=1) - middle)
    if len(letters) < FEWEST or heights.min() < HEIGHT * most or off.max() > LEVEL * most:
        return None
    if (
        gaps.max() > GAP * most
        or np.mean([_written(letter, scene) for letter in letters]) < WRITTEN
    ):
        return None
    return _Word(letters, _pictures(letters, boxes, scene), boxes[:, 0, 0] / scene.scale)


def _letters(row: Index, scene: Scene) -> tuple[tuple[tuple[int, ...], ...], Points]:
    """Things put together that are above each other, from left to right, and their boxes."""
    boxes = {}
    for k in row.tolist():
        item = scene.items[k]
        half = 0.0 if item.filled else item.width / 2
        boxes[k] = item.box + np.array([[-half], [half]])
    letters: list[tuple[list[int], Points]] = []
    for k in sorted(boxes, key=lambda k: (round(float(boxes[k][0, 0]) / scene.scale, 9), k)):
        box = boxes[k]
        if letters:
            own, before = letters[-1]
            shared = min(box[1, 0], before[1, 0]) - max(box[0, 0], before[0, 0])
            if shared > ABOVE * min(np.ptp(box[:, 0]), np.ptp(before[:, 0])):
                whole = np.stack([np.minimum(box[0], before[0]), np.maximum(box[1], before[1])])
                letters[-1] = [*own, k], whole
                continue
        letters.append(([k], box))
    return tuple(tuple(sorted(own)) for own, _ in letters), np.array([box for _, box in letters])


def _written(letter: tuple[int, ...], scene: Scene) -> bool:
    """Whether something is more than boxes and straight lines that do not meet."""
    own = list(letter)
    if scene.touching[np.ix_(own, own)].sum() > len(own):
        return True
    return any(
        not isinstance(scene.forms[k], RoundedBox | Segment | Dot) or bool(scene.items[k].holes)
        for k in letter
    )


def _pictures(letters: tuple[tuple[int, ...], ...], boxes: Points, scene: Scene) -> Floats:
    import shapely

    return np.array(
        [
            picture(shapely.union_all(scene.drawn[list(letter)]), box)
            for letter, box in zip(letters, boxes, strict=True)
        ]
    )
