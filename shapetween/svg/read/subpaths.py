"""The subpaths that any element draws, in its own coordinates: a shape's, or a text's letters'."""

from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Placed
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.paths import in_range, path_of

__all__ = ["subpaths_of"]


def subpaths_of(document: Document, placed: Placed) -> tuple[Subpath, ...]:
    """The subpaths of an element in its local coordinates; what is unsound is counted.

    Raises
    ------
    BudgetError
    """
    if placed.tag != "text":
        return path_of(document, placed)
    if document.fonts is None:
        return ()
    from shapetween.svg.read.text import letters_of  # slow to import, and most drawings have none

    letters = letters_of(document, placed)
    return in_range(document, [sub for letter in letters for sub in letter.subpaths])
