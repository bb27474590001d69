"""Which rules of a style sheet match which elements, within a budget.

cssselect2 does the matching. It is given elements that count every step it takes from one to
another: a chain of descendant or sibling selectors may walk each element's ancestors or siblings
over and over, and a few lines of style could keep a machine busy for days.
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Any
from xml.etree.ElementTree import Element

import cssselect2

__all__ = ["compile_selectors", "matches"]

#: Steps that making an element for the matcher counts for.
NEW_ELEMENT = 5


def compile_selectors(text: str) -> list[Any] | None:
    """The selectors in front of a rule's block; None if one is not understood.

    Those that name a pseudo-element, of which SVG has none, are left out.
    """
    try:
        selectors = cssselect2.compile_selector_list(text)
    # Selectors become Python expressions, which may be nested too deeply for Python.
    except (cssselect2.SelectorError, SyntaxError, MemoryError, RecursionError):
        return None
    return [selector for selector in selectors if selector.pseudo_element is None]


def matches(
    root: Element, rules: Iterable[tuple[Any, Any]], spend: Callable[[int], None]
) -> Iterator[tuple[Element, list[Any]]]:
    """Elements and what rules say of them, the strongest last.

    Parameters
    ----------
    root : Element
    rules : iterable of (selector, content)
        In the order of the style sheets.
    spend : callable
        Told of every test of a selector, and every step it takes; it may raise.
    """
    matcher = cssselect2.Matcher()
    for selector, content in rules:
        selector.test = _counted(selector.test, spend)
        matcher.add_selector(selector, content)

    class CountedElement(_CountedElement):
        spend_steps = staticmethod(spend)

    for wrapper in CountedElement.from_xml_root(root).iter_subtree():
        found = matcher.match(wrapper)
        if found:
            yield wrapper.etree_element, [content for *_, content in found]


def _counted(test: Callable[[Any], bool], spend: Callable[[int], None]) -> Callable[[Any], bool]:
    def run(element: Any) -> bool:
        spend(1)
        return test(element)

    return run


class _CountedElement(cssselect2.ElementWrapper):  # type: ignore[misc]
    """An element that counts the elements it leads to, and keeps no list of them."""

    spend_steps: Callable[[int], None]

    @property
    def ancestors(self) -> tuple[Any, ...]:
        found = []
        at = self.parent
        while at is not None:
            found.append(at)
            at = at.parent
        self.spend_steps(len(found))
        return tuple(reversed(found))

    @property
    def previous_siblings(self) -> tuple[Any, ...]:
        found = []
        at = self.previous
        while at is not None:
            found.append(at)
            at = at.previous
        self.spend_steps(len(found))
        return tuple(reversed(found))

    @property
    def etree_siblings(self) -> list[Element]:
        self.spend_steps(len(self._siblings))
        return self._siblings

    @etree_siblings.setter
    def etree_siblings(self, siblings: list[Element]) -> None:
        self._siblings = siblings

    def iter_children(self) -> Iterator[Any]:
        for child in super().iter_children():
            self.spend_steps(NEW_ELEMENT)
            yield child
