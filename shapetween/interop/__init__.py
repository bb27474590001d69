"""Shapes of any kind in, shapes of the same kind out, for any time between.

Path data, shapely geometries, arrays of points and matplotlib paths, each turned into a drawing of
one shape and back; a file or a drawing stays one.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from shapetween.api import Morph, Pin, morph
from shapetween.base.arrays import Affine, Floats
from shapetween.base.errors import OptionError
from shapetween.interop.kinds import Kind, kind_of
from shapetween.model.drawing import Drawing

__all__ = ["Between", "between"]

Value = TypeVar("Value")

#: Turns y over: data has it upwards, drawings downwards, and a matching knows up from down.
FLIPPED: Affine = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


@dataclass(frozen=True, slots=True, eq=False)
class Between(Generic[Value]):
    """A function of time, from 0 to 1.

    Attributes
    ----------
    morph : Morph
        The movement behind it.
    kind : Kind
        Of both shapes.
    y_up : bool
        Whether y grows upwards in them.
    """

    morph: Morph
    kind: Kind = field(repr=False)
    y_up: bool

    @overload
    def __call__(self, t: float) -> Value: ...

    @overload
    def __call__(self, t: Sequence[float] | Floats) -> list[Value]: ...

    def __call__(self, t: float | ArrayLike) -> Value | list[Value]:
        """The shape at a time, or a list of them at several.

        Raises
        ------
        OptionError
            If a time is not from 0 to 1.
        """
        times = np.atleast_1d(np.asarray(t, dtype=np.float64))
        if times.ndim != 1 or not ((times >= 0) & (times <= 1)).all():
            raise OptionError(f"t: {t!r} is not from 0 to 1")
        drawings: Sequence[Drawing] = self.morph.prepared.movement.at(times)
        if self.y_up:
            drawings = [drawing.transformed(FLIPPED) for drawing in drawings]
        made = [self.kind.back(drawing) for drawing in drawings]
        return made if np.ndim(t) else made[0]


def between(
    a: Value,
    b: Value,
    *,
    pins: Iterable[Pin] = (),
    y_up: bool | None = None,
    **options: Any,
) -> Between[Value]:
    """A function from a time to the shape between two, of the kind that was given.

    Parameters
    ----------
    a, b : str, geometry, (N, 2) array_like, matplotlib Path, path or Drawing
        Two of one kind: path data (``"M0 0H9V9Z"``), a shapely Polygon or MultiPolygon, a
        LineString or MultiLineString, the corners of a polygon, a matplotlib Path, or a drawing,
        also as the name or the text of an SVG file.
    pins : iterable of (ax, ay, bx, by)
        Points that belong together, in the shapes' own coordinates.
    y_up : bool, optional
        Whether y grows upwards, as it does in data: by default in all but path data and drawings.
    **options
        Those of `shapetween.morph`; `fit` is "none" here unless it is given.

    Returns
    -------
    Between
        At every time of as many points as at any other; at 0 and 1 exactly the shapes given.

    Raises
    ------
    ShapetweenError
        If a shape is of no kind that is known, or the two are of different kinds.

    Notes
    -----
    Regions of a map that are moved one by one do not keep their common borders.

    Examples
    --------
    >>> f = between("M0 0H4V4H0Z", "M2 0L4 4H0Z")
    >>> f(0.5).startswith("M"), f(0.5).count("C") == f(0.0).count("C")
    (True, True)
    """
    kind = kind_of(a, "first")
    other = kind_of(b, "second")
    if kind.name != other.name:
        raise OptionError(f"the first shape is {kind.name}, and the second {other.name}")
    upward = kind.y_up if y_up is None else y_up
    drawings = [kind.drawing(shape) for shape in (a, b)]
    if upward:
        drawings = [_turned(drawing) for drawing in drawings]
        pins = [(ax, -ay, bx, -by) for ax, ay, bx, by in pins]
    made = morph(*drawings, pins=pins, **{"fit": "none", **kind.options, **options})
    return Between(made, kind, upward)


def _turned(drawing: Drawing) -> Drawing:
    """A drawing with y the other way."""
    from dataclasses import replace

    box = drawing.box
    turned = replace(box, y=-box.y - box.height)
    return replace(drawing.transformed(FLIPPED), box=turned)
