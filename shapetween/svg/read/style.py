"""The cascade: which properties every element ends up with.

Presentation attributes, style sheets by specificity and order, ``style`` attributes, then what is
marked important, then inheritance (*CSS Cascading and Inheritance Level 4*, section 6).
"""

import re
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import Any, TypeAlias
from xml.etree.ElementTree import Element

import tinycss2

from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.shapes import GEOMETRY
from shapetween.svg.read.xml import local_name

__all__ = ["Cascade", "Properties"]

Properties = Mapping[str, str]

INHERITED = frozenset(
    {
        "clip-rule",
        "color",
        "fill",
        "fill-opacity",
        "fill-rule",
        "font-size",
        "marker-end",
        "marker-mid",
        "marker-start",
        "paint-order",
        "stroke",
        "stroke-dasharray",
        "stroke-dashoffset",
        "stroke-linecap",
        "stroke-linejoin",
        "stroke-miterlimit",
        "stroke-opacity",
        "stroke-width",
        "visibility",
    }
)
#: Properties of one element alone, which presentation attributes set as well.
OWN = frozenset(
    {
        "clip-path",
        "display",
        "filter",
        "mask",
        "mix-blend-mode",
        "opacity",
        "overflow",
        "stop-color",
        "stop-opacity",
        "transform",
        "transform-origin",
        "vector-effect",
    }
)
#: Properties with colours or paints: a value that is neither loses against what it would override.
PAINTS = frozenset({"fill", "stroke", "color", "stop-color"})

#: References between custom properties followed from one value; more is taken for a circle.
MOST_REFERENCES = 16

#: Media that a drawing is made for. Queries beyond these are taken as not met.
MET_QUERIES = frozenset(
    {"all", "screen", "(prefers-color-scheme:light)", "(prefers-reduced-motion:no-preference)"}
)

#: Properties of one element that may be custom ones; each is copied to everything inside it.
MOST_PROPERTIES = 200

#: Characters of a paint or of a transform that are read; what somebody drew has a few dozen.
MOST_CHARACTERS = 10_000

#: Declarations in which no character but brackets means anything to CSS: drawing programs write
#: them by the thousand, each unlike the next, and a whole CSS parser would take most of the time.
_PLAIN = re.compile(r"""(?:[^-"'()\\/{}!@\[\]]|-(?!-)|\([^"'()\\/{}!@;\[\]]*\))*+""")

Spend: TypeAlias = Callable[[str, int], None]
_Declaration: TypeAlias = tuple[str, str, bool]


class Cascade:
    """All style of one document, ready to be asked for each element.

    Parameters
    ----------
    root : Element
    spend : callable
        Uses up some of a budget.

    Attributes
    ----------
    warnings : list of str
        What in the style sheets could not be followed.
    """

    def __init__(self, root: Element, spend: Spend) -> None:
        self.warnings: list[str] = []
        sheets = [
            "".join(element.itertext())
            for element in root.iter()
            if local_name(element) == "style"
            and element.get("type", "text/css").strip().lower() in ("", "text/css")
            and _media_met(element.get("media", ""))
        ]
        self._matched: dict[Element, list[_Declaration]] = {}
        inline = {each.get("style", "") for each in root.iter()}
        involved = (text for text in inline if not _PLAIN.fullmatch(text))
        spend("style_characters", sum(map(len, sheets)) + sum(map(len, involved)))
        if any(sheet.strip() for sheet in sheets):
            try:
                self._match(root, "\n".join(sheets), spend)
            except RecursionError:
                self._matched.clear()
                self.warnings.append("its style sheet is nested too deeply and was left out")

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
            if (name in INHERITED or name in OWN or name in GEOMETRY) and _valid(name, value):
                own[name] = value.strip()
        sheet = self._matched.get(element, [])
        inline = _declarations(element.get("style", ""))
        for important in (False, True):
            own.update(
                (name, value)
                for name, value, mark in (*sheet, *inline)
                if mark == important and _valid(name, value)
            )

        computed = {
            name: value
            for name, value in parent.items()
            if name in INHERITED or name.startswith("--")
        }
        for name, value in own.items():
            if name.startswith("--") and len(computed) < MOST_PROPERTIES:
                computed[name] = value
        for name, value in own.items():
            if name.startswith("--"):
                continue
            if "var(" in value:
                resolved = _with_variables(value, computed)
                if resolved is None or not _valid(name, resolved):
                    continue
                value = resolved
            keyword = value.lower()
            if keyword == "inherit":
                if name in parent:
                    computed[name] = parent[name]
            elif keyword == "initial":
                computed.pop(name, None)
            elif keyword not in ("unset", "revert"):
                computed[name] = value
        return computed

    def _match(self, root: Element, sheet: str, spend: Spend) -> None:
        from shapetween.svg.read.selectors import compile_selectors, matches

        rules = []
        for rule in self._rules(sheet):
            selectors = compile_selectors(rule.prelude)
            if selectors is None:
                self._warn("some selectors of its style sheet are not understood")
                continue
            declarations = _parsed(rule.content)
            rules += [(selector, declarations) for selector in selectors]
        for element, found in matches(root, rules, partial(spend, "style_steps")):
            self._matched[element] = [declaration for each in found for declaration in each]
            spend("style_steps", len(self._matched[element]))

    def _rules(self, sheet: str) -> list[Any]:
        """Qualified rules of a sheet, with those of the media that apply."""
        rules = []
        pending = tinycss2.parse_stylesheet(sheet, skip_comments=True, skip_whitespace=True)
        pending.reverse()
        while pending:
            rule = pending.pop()
            if rule.type == "qualified-rule":
                rules.append(rule)
            elif rule.type == "at-rule" and rule.lower_at_keyword == "media":
                if rule.content and _media_met(tinycss2.serialize(rule.prelude)):
                    inner = tinycss2.parse_rule_list(
                        rule.content, skip_comments=True, skip_whitespace=True
                    )
                    pending.extend(reversed(inner))
            elif rule.type == "at-rule" and rule.lower_at_keyword == "import":
                self._warn("its style sheet imports another, which was not fetched")
        return rules

    def _warn(self, text: str) -> None:
        if text not in self.warnings:
            self.warnings.append(text)


def _media_met(query: str) -> bool:
    """Whether a media query list is met; an empty one is."""
    if not query.strip():
        return True
    for option in query.lower().split(","):
        words = re.sub(r"\s*([():])\s*", r"\1", option.strip().removeprefix("only ")).strip()
        if all(re.sub(r"\s+", "", part) in MET_QUERIES for part in re.split(r"\band\b", words)):
            return True
    return False


@lru_cache(maxsize=4096)
def _declarations(text: str) -> tuple[_Declaration, ...]:
    """Declarations of a ``style`` attribute."""
    if not _PLAIN.fullmatch(text):
        return _parsed(text)
    pairs = (part.partition(":") for part in text.split(";") if ":" in part)
    return tuple((name.strip().lower(), value.strip(), False) for name, _, value in pairs)


def _parsed(content: Any) -> tuple[_Declaration, ...]:
    try:
        return tuple(
            (
                declaration.name if declaration.name.startswith("--") else declaration.lower_name,
                tinycss2.serialize(declaration.value).strip(),
                declaration.important,
            )
            for declaration in tinycss2.parse_blocks_contents(
                content, skip_comments=True, skip_whitespace=True
            )
            if declaration.type == "declaration"
        )
    except RecursionError:  # brackets within brackets: no property that draws has them
        return ()


def _valid(name: str, value: str) -> bool:
    """Whether a value can override another: a paint that cannot be parsed may not."""
    if len(value) > MOST_CHARACTERS and name != "d":
        return False
    if name not in PAINTS or "var(" in value:
        return True
    if value.lower() in ("inherit", "initial", "unset", "revert"):
        return True
    return parse_paint(value) is not None


def _with_variables(value: str, properties: Properties) -> str | None:
    """The value with its ``var()`` replaced; None if one has neither value nor fallback."""
    for _ in range(MOST_REFERENCES):
        tokens = tinycss2.parse_component_value_list(value)
        at = next(
            (i for i, t in enumerate(tokens) if t.type == "function" and t.lower_name == "var"),
            None,
        )
        if at is None:
            return value.strip()
        arguments = tinycss2.serialize(tokens[at].arguments)
        name, comma, fallback = arguments.partition(",")
        replacement = properties.get(name.strip(), fallback if comma else None)
        if replacement is None:
            return None
        before, after = tinycss2.serialize(tokens[:at]), tinycss2.serialize(tokens[at + 1 :])
        value = f"{before}{replacement}{after}"
    return None
