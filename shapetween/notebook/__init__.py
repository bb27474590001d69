"""A movement in a notebook: a slider, and pins that can be dragged and read in the next cell.

Works wherever anywidget does: JupyterLab, VS Code, Colab, marimo (by ``mo.ui.anywidget``). Needs
``pip install 'shapetween[notebook]'``.
"""

from collections.abc import Iterable
from importlib.resources import files
from typing import Any

from shapetween.api import Morph, Pin, Source, morph
from shapetween.base.errors import OptionError, ShapetweenError

try:
    import anywidget
    import traitlets
except ImportError as error:
    raise ImportError(f"{error}; pip install 'shapetween[notebook]'", name=error.name) from error

__all__ = ["Tween"]

#: Shapes of the movement that is sent to the page after each change: as the studio's previews.
KEYFRAMES = 25


class Tween(anywidget.AnyWidget):
    """The movement between two drawings, to be looked at and set right.

    Parameters
    ----------
    a, b : path or Drawing
        SVG files, or drawings already read.
    pins : iterable of (ax, ay, bx, by)
        Points that belong together, each in its own drawing's user units.
    **options
        Those of `shapetween.morph`.

    Attributes
    ----------
    pins : list of [ax, ay, bx, by]
        As they are now; set it, or drag them.
    t : float
        Where the slider is, from 0 to 1.
    warnings : list of str
        What there is to say of the movement.

    Examples
    --------
    In a cell ``w = Tween("horse.svg", "kangaroo.svg"); w``, and in one after it, whatever has been
    dragged, ``w.morph.write("out.svg")`` or ``st.morph("horse.svg", "kangaroo.svg", pins=w.pins)``.
    """

    _esm = (files("shapetween.notebook") / "tween.js").read_text("utf-8")
    pins = traitlets.List(traitlets.List(traitlets.Float())).tag(sync=True)
    t = traitlets.Float(0.0, min=0.0, max=1.0).tag(sync=True)
    warnings = traitlets.List(traitlets.Unicode()).tag(sync=True)
    _view = traitlets.Dict().tag(sync=True)

    def __init__(self, a: Source, b: Source, pins: Iterable[Pin] = (), **options: Any) -> None:
        self._given = a, b, options
        self._morph = morph(a, b, pins=pins, **options)
        super().__init__(pins=[list(map(float, pin)) for pin in pins])
        self._show()
        self.observe(self._moved, names="pins")

    @property
    def morph(self) -> Morph:
        """The movement with the pins as they are."""
        return self._morph

    def _repr_html_(self) -> None:
        """Nothing: the widget shows itself."""

    def _moved(self, change: Any) -> None:
        """Find the movement anew; a pin that cannot be kept is told of, and changes nothing."""
        a, b, options = self._given
        try:
            if any(len(pin) != 4 for pin in change.new):
                raise OptionError("pins: expected [ax, ay, bx, by]")
            self._morph = morph(a, b, pins=change.new, **options)
        except ShapetweenError as error:
            self.warnings = [str(error)]
            return
        self._show()

    def _show(self) -> None:
        movement = self._morph.prepared.movement
        ends = self._morph.at(0.0), self._morph.at(1.0)
        rings = [
            {"a": ring.source.round(4).tolist(), "b": ring.target.round(4).tolist()}
            for ring in self._morph.correspondence
        ]
        box = movement.box
        self.warnings = list(self._morph.warnings)
        self._view = {
            "svg": self._morph.svg(duration=1.0, keyframes=KEYFRAMES),
            "box": [box.x, box.y, box.width, box.height],
            "ends": [_still(end) for end in ends],
            "rings": rings,
            "back": _back(self._morph),
        }


def _still(drawing: Any) -> str:
    from shapetween.svg.write.sequence import frame_svg

    return frame_svg(drawing)


def _back(made: Morph) -> list[float]:
    """The map from the second drawing's own units to the movement's: scale and shift."""
    fit = made.prepared.fit
    return [float(x) for x in (fit[0, 0], fit[0, 2], fit[1, 2])]
