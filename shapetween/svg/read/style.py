"""The cascade: which properties every element ends up with.

Presentation attributes, style sheets by specificity and order, ``style`` attributes, then what is
marked important, then inheritance (*CSS Cascading and Inheritance Level 4*, section 6).
"""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache, partial
from typing import TypeAlias
from xml.etree.ElementTree import Element

from shapetween.svg.read.properties import (
    INHERITED,
    PAINTS,
    is_plain,
    is_supported,
    is_too_long,
    is_valid,
    normal,
    reset,
    unfolded,
)
from shapetween.svg.read.queries import Medium, media_met
from shapetween.svg.read.sheets import Declaration, Rule, declarations_of, rules_of
from shapetween.svg.read.variables import is_of_the_page, with_scheme, with_variables
from shapetween.svg.read.xml import local_name

__all__ = ["ANIMATED", "Cascade", "Properties", "page_key"]

Properties = Mapping[str, str]

#: What is said of a drawing that moves by itself.
ANIMATED = "it is animated by itself: only what it shows at rest is read"

#: Properties of one element that may be custom ones; each is copied to everything inside it.
MOST_PROPERTIES = 200

#: Declarations in which no character but brackets means anything to CSS: drawing programs write
#: them by the thousand, each unlike the next, and a whole CSS parser would take most of the time.
_PLAIN = re.compile(r"""(?:[^-"'()\\/{}!@\[\]]|-(?!-)|\([^"'()\\/{}!@;\[\]]*\))*+""")

Spend: TypeAlias = Callable[[str, int], None]

_Layers: TypeAlias = Sequence[Sequence[Declaration]]


def page_key(name: str) -> str:
    """Where a property's own text is kept if the page has a say in it; inherited as custom ones."""
    return f"--({name})"


class Cascade:
    """All style of one document, ready to be asked for each element.

    Parameters
    ----------
    root : Element
    spend : callable
        Uses up some of a budget.
    warn : callable
        Told what in the style could not be followed.
    medium : Medium
        What the drawing is shown on.
    """

    def __init__(
        self, root: Element, spend: Spend, warn: Callable[[str], None], medium: Medium
    ) -> None:
        self._warn = warn
        self._keyframes = False
        sheets = [
            "".join(element.itertext())
            for element in root.iter()
            if local_name(element) == "style"
            and element.get("type", "text/css").strip().lower() in ("", "text/css")
            and media_met(element.get("media", ""), medium)
        ]
        # For each element its declarations layer by layer, then those marked important.
        self._matched: dict[Element, tuple[_Layers, _Layers]] = {}
        inline = {each.get("style", "") for each in root.iter()}
        involved = (text for text in inline if not _PLAIN.fullmatch(text))
        spend("style_characters", sum(map(len, sheets)) + sum(map(len, involved)))
        if any(sheet.strip() for sheet in sheets):
            try:
                self._match(root, "\n".join(sheets), spend, medium)
            except RecursionError:
                self._matched.clear()
                self._warn("its style sheet is nested too deeply and was left out")

    def properties(self, element: Element, parent: Properties) -> dict[str, str]:
        """Everything that is set for an element, or that it inherits.

        Parameters
        ----------
        element : Element
        parent : Properties
            The same for its parent; for what ``use`` draws, that is the ``use``.
        """
        own: dict[str, str] = {}
        for name, value in element.items():
            if is_plain(name) and self._reads(name, value, False):
                own[name] = value.strip()
        usual, important = self._matched.get(element, ((), ()))
        inline = _declarations(element.get("style", ""))
        for layers, mark in ((usual, False), (important, True)):
            for layer in (*layers, inline):
                below = dict(own)
                for name, value, marked in layer:
                    if marked == mark and self._reads(name, value):
                        _take(own, below, name, value)

        computed = {
            name: value
            for name, value in parent.items()
            if name in INHERITED or name.startswith("--")
        }
        self._set_custom(computed, own)
        # Colours may depend on the colour.
        for name in sorted(own, key=lambda name: name not in ("color", "color-scheme")):
            if not name.startswith("--"):
                self._set(computed, parent, name, own[name])
        if self._keyframes and _is_animated(computed):
            self._warn(ANIMATED)
        return computed

    def _reads(self, name: str, value: str, styled: bool = True) -> bool:
        """Whether a value can override another; of one that is too long it is told."""
        if is_too_long(name, value):
            self._warn(f"a value of {name[:40]} that is too long was left out")
        return is_valid(name, value, styled)

    def _set_custom(self, computed: dict[str, str], own: Mapping[str, str]) -> None:
        """Take in custom properties, each with what it names put in."""
        fresh = [name for name in own if name.startswith("--")]
        room = max(0, MOST_PROPERTIES - len(computed))
        if len(fresh) > room:
            self._warn("custom properties of its style were left out: there are too many")
        fresh = fresh[:room]
        computed.update((name, own[name]) for name in fresh)
        for name in fresh:
            value = computed[name]
            if "var(" in value.lower():
                resolved = with_variables(value, computed)
                if resolved is None:
                    del computed[name]
                else:
                    computed[name] = resolved

    def _set(self, computed: dict[str, str], parent: Properties, name: str, value: str) -> None:
        """Take in the value of one property."""
        if name in PAINTS:
            computed.pop(page_key(name), None)
            if is_of_the_page(value, computed):
                computed[page_key(name)] = value
        if "var(" in value.lower():
            resolved = with_variables(value, computed)
            if resolved is None or not is_valid(name, resolved):
                # Invalid at computed-value time: as if nothing had been said.
                if name not in INHERITED:
                    computed.pop(name, None)
                return
            value = resolved
        if name in PAINTS and "(" in value:
            value = with_scheme(
                value, computed.get("color-scheme", ""), computed.get("color", "black")
            )
        keyword = value.lower()
        if keyword == "inherit":
            if name in parent:
                computed[name] = parent[name]
            if page_key(name) in parent:
                computed[page_key(name)] = parent[page_key(name)]
        elif keyword == "initial":
            computed.pop(name, None)
        elif keyword not in ("unset", "revert", "revert-layer"):
            computed[name] = normal(name, value)

    def _match(self, root: Element, sheet: str, spend: Spend, medium: Medium) -> None:
        from shapetween.svg.read.selectors import compile_selectors, matches

        rules = []
        found, self._keyframes = rules_of(
            sheet, medium, is_supported, partial(spend, "style_characters"), self._warn
        )
        for rule in found:
            selectors = compile_selectors(rule.selector)
            if selectors is None:
                self._warn("some selectors of its style sheet are not understood")
                continue
            rules += [(selector, rule) for selector in selectors]
        for element, matched in matches(root, rules, partial(spend, "style_steps")):
            usual = _layers(matched, marked=False)
            important = _layers(matched, marked=True)[::-1]  # wins the other way round
            self._matched[element] = usual, important
            spend("style_steps", sum(map(len, usual)) + sum(map(len, important)))


def _layers(rules: Sequence[Rule], *, marked: bool) -> _Layers:
    """Declarations of rules that are marked important or not, layer by layer."""
    ranks = sorted({rule.layer for rule in rules})
    return [
        [d for rule in rules if rule.layer == rank for d in rule.declarations if d[2] == marked]
        for rank in ranks
    ]


def _take(own: dict[str, str], below: Properties, name: str, value: str) -> None:
    """Take in what a layer says of a property, or of all of them; `below` is without the layer."""
    word = value.strip().lower()
    if name == "all":
        custom = {each: own[each] for each in own if each.startswith("--")}
        own.clear()
        own.update(below if word == "revert-layer" else reset(word))
        own.update(custom)
    elif word == "revert-layer":
        own.pop(name, None)
        own.update({each: below[each] for each in below if each == name})
    else:
        own.update(unfolded(name, value))


def _is_animated(properties: Properties) -> bool:
    return any(
        properties.get(name, "none").strip().lower() not in ("none", "", "initial")
        for name in ("animation", "animation-name")
    )


@lru_cache(maxsize=4096)
def _declarations(text: str) -> tuple[Declaration, ...]:
    """Declarations of a ``style`` attribute."""
    if not _PLAIN.fullmatch(text):
        return declarations_of(text)
    pairs = (part.partition(":") for part in text.split(";") if ":" in part)
    return tuple((name.strip().lower(), value.strip(), False) for name, _, value in pairs)
