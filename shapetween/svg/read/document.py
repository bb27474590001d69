"""A parsed document with what every stage of reading it looks up."""

from collections import Counter
from collections.abc import Callable, Iterable
from typing import TypeAlias
from xml.etree.ElementTree import Element

from shapetween.model.drawing import Box, Shape
from shapetween.model.paint import Colour, Stop
from shapetween.svg.read.frames import Placed
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.pathdata import PathData
from shapetween.svg.read.queries import Medium
from shapetween.svg.read.style import ANIMATED, Cascade, Properties
from shapetween.svg.read.units import GREATEST, Viewport
from shapetween.svg.read.viewbox import parse_view_box
from shapetween.svg.read.xml import XLINK, local_name, parse_xml

__all__ = ["Document", "Fonts", "Losses", "Pictures", "href", "title_of"]

Pictures: TypeAlias = Callable[[str], str | None]
"""The ``data:`` address of a picture beside the document for its own address; None if it cannot be
had."""

Fonts: TypeAlias = Callable[[str, int, bool], tuple[str, bytes, int] | None]
"""The name of a font, its file and its number there for a family in lower case (empty for any), a
weight, and whether it is slanted; None if there is no such family."""


#: Elements that let a drawing move by itself.
ANIMATIONS = frozenset({"animate", "animateTransform", "animateMotion", "animateColor", "set"})


class Losses:
    """What could not be carried, counted, one line for each kind."""

    def __init__(self) -> None:
        self._counts: Counter[str] = Counter()
        self._details: dict[str, str] = {}

    def add(self, what: str, detail: str = "") -> None:
        """Count one more of a kind of loss.

        Parameters
        ----------
        what : str
            The kind, in words for a single case.
        detail : str
            Where and why; only the first of a kind is kept.
        """
        self._counts[what] += 1
        self._details.setdefault(what, detail)

    def lines(self) -> list[str]:
        """One line for each kind, in the order in which they first came."""
        lines = []
        for what, count in self._counts.items():
            times = f" ({count} times)" if count > 1 else ""
            detail = self._details[what]
            first = "first, " if count > 1 else ""
            lines.append(f"{what}{times}{': ' if detail else ''}{first if detail else ''}{detail}")
        return lines


class Document:
    """A document's tree, ids, style and budgets.

    Parameters
    ----------
    data : bytes
    name : str
        The file, for messages.
    limits : Limits
    pictures : callable, optional
        Where pictures are found. If given, patterns and pictures are read as textures.
    fonts : callable, optional
        Where fonts are found. If given, text is read as the outlines of its letters.

    Attributes
    ----------
    root : Element
    ids : dict
        The first element with each id.
    cascade : Cascade
    losses : Losses
        Filled as the document is drawn.
    stops : dict
        Stops of gradients at an opacity, without any that they inherit.
    geometry : dict
        What elements draw in viewports, kept for those that are drawn again.
    boxes : dict
        Boxes around what elements draw in viewports, in their own coordinates.
    shown : Box
        What is shown of the drawing, in the units of its root.
    reach : float
        How far from the origin anything is drawn, in user units.
    painted : callable
        Who paints placed elements, as shapes.
    patterns : dict
        What is in the tiles of patterns, as shapes, and its mean colour.
    within : list of Element
        Patterns whose tiles are being read.
    textures : int
        How many textures were made so far.
    definitions : str or None
        All of the document as the definitions of a texture, once that was asked for.

    Raises
    ------
    InputError
        If it is not a sound SVG document.
    BudgetError
    """

    def __init__(
        self,
        data: bytes,
        name: str,
        limits: Limits,
        pictures: Pictures | None = None,
        fonts: Fonts | None = None,
    ) -> None:
        self.name = name
        self.fonts = fonts
        self.pictures = pictures
        self.textures = 0
        self.definitions: str | None = None
        self.limits = limits
        self.losses = Losses()
        self.root, warnings = parse_xml(data, name, limits)
        self._spent: Counter[str] = Counter()
        for warning in warnings:
            self.losses.add(warning)
        self._warned: set[str] = set()
        self.cascade = Cascade(self.root, self.spend, self.warn, _medium(self.root))
        for element in self.root.iter():
            if local_name(element) in ANIMATIONS:
                self.warn(ANIMATED)
            elif local_name(element) == "script" and (
                href(element) or (element.text or "").strip()
            ):
                self.warn("its script was not run: what that draws or changes is not read")
        self.ids: dict[str, Element] = {}
        for element in self.root.iter():
            identity = element.get("id")
            if identity:
                self.ids.setdefault(identity, element)
        self.painted: Callable[[Iterable[Placed]], list[Shape]] = lambda _: []
        self.patterns: dict[object, tuple[tuple[Shape, ...], Colour]] = {}
        self.within: list[Element] = []
        self.stops: dict[tuple[Element, float], tuple[Stop, ...]] = {}
        self.geometry: dict[tuple[Element, Viewport], PathData] = {}
        self.boxes: dict[tuple[Element, Viewport], Box | None] = {}
        self.shown = Box(0.0, 0.0, 0.0, 0.0)
        self.reach = GREATEST
        self._parents: dict[Element, Element] | None = None
        self._styles: dict[Element, Properties] = {}

    def warn(self, what: str) -> None:
        """Note something about the document as a whole, once."""
        if what not in self._warned:
            self._warned.add(what)
            self.losses.add(what)

    def spend(self, limit: str, amount: int = 1) -> None:
        """Use up some of a budget.

        Raises
        ------
        BudgetError
        """
        self._spent[limit] += amount
        self.limits.check(limit, self._spent[limit], self.name)

    def target(self, element: Element) -> Element | None:
        """The element that an element's ``href`` names, within this document."""
        address = href(element)
        return self.ids.get(address[1:]) if address.startswith("#") else None

    def style(self, element: Element) -> Properties:
        """The properties of an element where it stands, with all that it inherits there."""
        chain: list[Element] = []
        at: Element | None = element
        while at is not None and at not in self._styles:
            chain.append(at)
            at = self._parent(at)
        found: Properties = self._styles[at] if at is not None else {}
        for each in reversed(chain):
            found = self._styles[each] = self.cascade.properties(each, found)
        return found

    def _parent(self, element: Element) -> Element | None:
        if self._parents is None:
            self._parents = {child: parent for parent in self.root.iter() for child in parent}
        return self._parents.get(element)

    def is_within(self, element: Element, container: Element) -> bool:
        """Whether an element is another, or lies within it."""
        at: Element | None = element
        while at is not None and at is not container:
            at = self._parent(at)
        return at is not None


def _medium(root: Element) -> Medium:
    """What style is told of the size: the view box, else the page."""
    box = parse_view_box(root.get("viewBox"))
    if box is not None:
        return Medium(box.width, box.height)
    sizes = [Viewport(0.0, 0.0).length(root.get(side), 0.0) for side in ("width", "height")]
    return Medium(sizes[0] or 300.0, sizes[1] or 150.0)


def href(element: Element) -> str:
    """The address an element refers to, empty if it has none."""
    return (element.get("href") or element.get(f"{{{XLINK}}}href") or "").strip()


def title_of(root: Element) -> str:
    """Text of the document's own title, white space folded."""
    for child in root:
        if local_name(child) == "title":
            return " ".join("".join(child.itertext()).split())
    return ""
