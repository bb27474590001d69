"""A drawing at rest as SVG: one file of a sequence of frames.

Everything drawn is a ``<path>`` in the drawing's own coordinates, without transforms, so that any
program that reads path data can use the frames.
"""

from shapetween.model.drawing import Drawing
from shapetween.svg.write.elements import GradientDefs, document, named, text_of
from shapetween.svg.write.groups import add_shapes
from shapetween.svg.write.numbers import decimals_of

__all__ = ["frame_svg"]


def frame_svg(drawing: Drawing, precision: int | None = None, *, in_page: bool = True) -> str:
    """Write one drawing.

    Parameters
    ----------
    drawing : Drawing
    precision : int, optional
        Decimals of coordinates; by default about 1/10000 of the larger side of the view
        box, or of what is drawn where that is smaller.

    in_page : bool
        Whether colours that are the page's to choose are asked of it, which not every program that
        draws SVG understands.

    Returns
    -------
    str
        An SVG document whose paths hold only absolute ``M``, ``C`` and ``Z``.

    Raises
    ------
    OptionError
        If coordinates cannot be written with that precision.
    """
    gradients = GradientDefs(decimals_of(drawing, precision), box=drawing.box, in_page=in_page)
    root = document(drawing.box, drawing.title, drawing.page)
    root.append(gradients.element)
    add_shapes(root, drawing.shapes, gradients, named([shape.name for shape in drawing.shapes]))
    if not len(gradients.element):
        root.remove(gradients.element)
    return text_of(root)
