"""A style sheet to plain rules: nested ones unfolded, conditions settled, layers numbered.

.. [NEST] *CSS Nesting Module*. .. [CAS5] *CSS Cascading and Inheritance Level 5*, section 6.4.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import tinycss2

from shapetween.svg.read.queries import Medium, media_met, supports_met

__all__ = ["UNLAYERED", "Declaration", "Rule", "declarations_of", "rules_of"]

Declaration: TypeAlias = tuple[str, str, bool]
"""Name, value, and whether it is marked important."""

#: The rank of rules in no layer, which normal declarations in layers lose against.
UNLAYERED = 1 << 30

#: What has no say in a drawing at rest, or is told elsewhere.
PASSED_OVER = frozenset(
    {"charset", "namespace", "font-face", "font-feature-values", "page", "starting-style"}
    | {"font-palette-values", "counter-style", "view-transition"}
)


@dataclass(frozen=True, slots=True)
class Rule:
    """Declarations for what a selector matches.

    Attributes
    ----------
    selector : str
    declarations : tuple of Declaration
    layer : int
        Rank of its layer; the greater wins.
    """

    selector: str
    declarations: tuple[Declaration, ...]
    layer: int = UNLAYERED


@dataclass(slots=True)
class _Sheet:
    """What is found as a sheet is read.

    Attributes
    ----------
    rules : list
        Selector, declarations and path of the layer, in order.
    layers : dict
        A tree of layers, in the order in which they were first named.
    keyframes : bool
        Whether there are any.
    """

    medium: Medium
    supported: Callable[[str, str], bool]
    spend: Callable[[int], None]
    warn: Callable[[str], None]
    rules: list[tuple[str, tuple[Declaration, ...], tuple[str, ...]]] = field(default_factory=list)
    layers: dict[str, Any] = field(default_factory=dict)
    anonymous: int = 0
    keyframes: bool = False

    def collect(self, nodes: Sequence[Any], parent: str | None, layer: tuple[str, ...]) -> None:
        """Take in what a sheet, or the block of a rule, holds."""
        own: list[Declaration] = []

        def flush() -> None:
            if own and parent is not None:
                self.rules.append((parent, tuple(own), layer))
            own.clear()

        for node in nodes:
            if node.type == "declaration":
                own.append(_declaration(node))
            elif node.type == "qualified-rule":
                flush()
                selector = _nested(node.prelude, parent)
                self.spend(len(selector))
                self.collect(_contents(node.content), selector, layer)
            elif node.type == "at-rule":
                flush()
                self._at_rule(node, parent, layer)
        flush()

    def _at_rule(self, rule: Any, parent: str | None, layer: tuple[str, ...]) -> None:
        name = rule.lower_at_keyword
        if name == "layer":
            self._layer(rule, parent, layer)
        elif name == "import":
            self.warn("its style sheet imports another, which was not fetched")
        elif name.endswith("keyframes"):
            self.keyframes = True
        elif rule.content is None or name in PASSED_OVER:
            return
        elif name in ("media", "supports"):
            met = (
                media_met(tinycss2.serialize(rule.prelude), self.medium)
                if name == "media"
                else supports_met(rule.prelude, self.supported)
            )
            if met:
                self.collect(_inside(rule, parent), parent, layer)
        else:
            self.warn(f"a rule @{name} of its style sheet is not understood and was left out")

    def _layer(self, rule: Any, parent: str | None, layer: tuple[str, ...]) -> None:
        names = [n.strip() for n in tinycss2.serialize(rule.prelude).split(",") if n.strip()]
        if rule.content is None:
            for name in names:
                self._named((*layer, *name.split(".")))
            return
        if not names:
            self.anonymous += 1
            names = [f" {self.anonymous}"]  # no name can hold a space
        path = (*layer, *names[0].split("."))
        self._named(path)
        self.collect(_inside(rule, parent), parent, path)

    def _named(self, path: tuple[str, ...]) -> None:
        at = self.layers
        for name in path:
            at = at.setdefault(name, {})

    def ranks(self) -> dict[tuple[str, ...], int]:
        """Ranks of all layers: what a layer holds itself wins over the layers within it."""
        found: dict[tuple[str, ...], int] = {}

        def visit(tree: dict[str, Any], path: tuple[str, ...]) -> None:
            for name, inner in tree.items():
                visit(inner, (*path, name))
            if path:
                found[path] = len(found)

        visit(self.layers, ())
        return {**found, (): UNLAYERED}


def rules_of(
    sheet: str,
    medium: Medium,
    supported: Callable[[str, str], bool],
    spend: Callable[[int], None],
    warn: Callable[[str], None],
) -> tuple[list[Rule], bool]:
    """The rules of a sheet that apply, in order, and whether it has keyframes.

    Parameters
    ----------
    sheet : str
    medium : Medium
    supported : callable
        Whether a value of a property is understood.
    spend : callable
        Told of the characters that unfolded selectors take; it may raise.
    warn : callable
        Told what could not be followed.
    """
    found = _Sheet(medium, supported, spend, warn)
    nodes = tinycss2.parse_stylesheet(sheet, skip_comments=True, skip_whitespace=True)
    found.collect(nodes, None, ())
    ranks = found.ranks()
    rules = [Rule(selector, own, ranks[layer]) for selector, own, layer in found.rules]
    return rules, found.keyframes


def declarations_of(content: Any) -> tuple[Declaration, ...]:
    """The declarations of a block or a ``style`` attribute, without any nested rules."""
    try:
        return tuple(_declaration(n) for n in _contents(content) if n.type == "declaration")
    except RecursionError:  # brackets within brackets: no property that draws has them
        return ()


def _declaration(node: Any) -> Declaration:
    name = node.name if node.name.startswith("--") else node.lower_name
    return name, tinycss2.serialize(node.value).strip(), node.important


def _contents(content: Any) -> list[Any]:
    nodes: list[Any] = tinycss2.parse_blocks_contents(
        content, skip_comments=True, skip_whitespace=True
    )
    return nodes


def _inside(rule: Any, parent: str | None) -> list[Any]:
    """What the block of a conditional rule holds: rules, and within a rule declarations too."""
    if parent is not None:
        return _contents(rule.content)
    nodes: list[Any] = tinycss2.parse_rule_list(
        rule.content, skip_comments=True, skip_whitespace=True
    )
    return nodes


def _nested(prelude: Sequence[Any], parent: str | None) -> str:
    """The selector of a rule within a rule, as it would be written outside ([NEST]_, section 3)."""
    outer = ":root" if parent is None else f":is({parent})"
    parts: list[list[Any]] = [[]]
    for token in prelude:
        if token.type == "literal" and token.value == ",":
            parts.append([])
        else:
            parts[-1].append(token)
    texts = []
    for part in parts:
        text, named = _with_parent(part, outer)
        text = text.strip()
        texts.append(text if named or parent is None else f"{outer} {text}")
    return ", ".join(texts)


def _with_parent(tokens: Sequence[Any], outer: str) -> tuple[str, bool]:
    """A selector's text with ``&`` replaced, and whether there was any."""
    texts, named = [], False
    for token in tokens:
        if token.type == "literal" and token.value == "&":
            texts.append(outer)
            named = True
        elif token.type == "function":
            inner, found = _with_parent(token.arguments, outer)
            texts.append(f"{token.name}({inner})")
            named = named or found
        else:
            texts.append(token.serialize())
    return "".join(texts), named
