"""The distinct matchings of one pair as moving pictures, with the option that takes each."""

import base64
from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from typing import Any

import numpy as np

from shapetween.api import Morph, Source, morph
from shapetween.base.errors import OptionError
from shapetween.match import Correspondence, Matcher
from shapetween.outline.body import RingMatch

__all__ = ["Alternatives", "alternatives"]

#: Angle, degrees, from which on a page says that a matching turns the first drawing.
SHOWN_TURN = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class Alternatives:
    """Movements by different matchings of two drawings.

    Attributes
    ----------
    names : (str, str)
        What the drawings are called.
    morphs : tuple of Morph
        The best matching first; the number to ask for it by is its place, counted from 1.
    matchings : tuple of Correspondence
        Of each.
    """

    names: tuple[str, str]
    morphs: tuple[Morph, ...]
    matchings: tuple[Correspondence, ...]

    def html(self, *, duration: float = 2.0) -> str:
        """A page that needs nothing else."""
        title = " to ".join(self.names)
        shown = zip(self.morphs, self.matchings, strict=True)
        figures = "".join(_figure(k, *pair, duration) for k, pair in enumerate(shown, start=1))
        style = (files("shapetween.compare") / "alternatives.css").read_text("utf-8")
        return (
            "<!DOCTYPE html>\n"
            '<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width,initial-scale=1">\n'
            '<meta name="color-scheme" content="light dark">\n'
            f"<title>{escape(title)} · alternatives · shapetween</title>\n"
            f"<style>\n{style}</style>\n</head>\n<body>\n"
            f'<header><h1>{escape(self.names[0])} <span aria-label="to">→</span> '
            f"{escape(self.names[1])}</h1>\n"
            "<p>What may become what, the likeliest first. The option under a picture takes its "
            "matching.</p></header>\n"
            f"<main>\n{figures}</main>\n</body>\n</html>\n"
        )


def alternatives(a: Source, b: Source, names: tuple[str, str], **settings: Any) -> Alternatives:
    """Prepare the movement between two drawings of one outline each by every distinct matching.

    Parameters
    ----------
    a, b : path or Drawing
    names : (str, str)
        What the drawings are called.
    **settings
        As for `shapetween.morph`, without what says what becomes what.

    Raises
    ------
    OptionError
        If the drawings are not of one filled outline each, or pins, matches or a mesh are given.
    ShapetweenError
        As for `shapetween.morph`.
    """
    for name in ("pins", "matches", "mesh"):
        if settings.get(name):
            raise OptionError(f"alternatives: {name} say what becomes what; expected none")
    make: Callable[..., Morph] = morph
    # What goes by its corners alone has but one matching; the outline engine's have numbers.
    first = make(a, b, **{"together": False, **settings})
    ring = _only_ring(first)
    if ring is None:
        raise OptionError("alternatives: expected two drawings of one filled outline each")
    known = Matcher(*ring.ends).alternatives()
    rest = [make(a, b, **{**settings, "matching": k}) for k in range(2, len(known) + 1)]
    return Alternatives(names, (first, *rest), tuple(known))


def _only_ring(found: Morph) -> RingMatch | None:
    """The one outer ring of a movement that has no other part."""
    prepared = found.prepared
    bodies = [body for part in prepared.meshed for body in part.bodies]
    if prepared.scene is not None or len(bodies) != 1:
        return None
    outer = [ring for ring in bodies[0].nodes.rings if not ring.hole]
    return outer[0] if len(outer) == 1 else None


def _figure(number: int, shown: Morph, matching: Correspondence, duration: float) -> str:
    svg = shown.svg(duration=duration, loop="alternate", easing="ease-in-out")
    data = base64.b64encode(svg.encode("utf-8")).decode("ascii")
    captions = [f"cost {matching.cost:.2f}"]
    turn = float(np.degrees(matching.turn))
    if abs(turn) >= SHOWN_TURN:
        captions.append(f"turned by {turn:.0f}°")
    crossing = sum(notice.kind == "crossing" for notice in shown.notices)
    captions += ["crosses itself"] * bool(crossing)
    return (
        f'<figure><img src="data:image/svg+xml;base64,{data}" '
        f'alt="The movement by matching {number}">'
        f"<figcaption><code>--matching {number}</code>"
        f"<span>{escape(', '.join(captions))}</span></figcaption></figure>\n"
    )
