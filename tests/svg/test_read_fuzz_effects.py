"""Documents of masks, filters, style and text put together at random: drawn, or refused."""

import random

import pytest

from shapetween.base.errors import ShapetweenError
from shapetween.io.fonts import fonts_in
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg

#: So low that no document takes long.
LIMITS = Limits(path_commands=20_000, clip_points=50_000)

#: How many of each seed. More find more; ten thousand of them found nothing.
DOCUMENTS = 150

NUMBERS = ("0", "1", "-1", "50%", "1e9", "nan", "", "10px", "2em", "calc(1px*2)", "calc(", "1e40")
KEPT = (
    '<mask id="m"><rect width="50" height="90" fill="#fff"/><use href="#a"/></mask>'
    '<filter id="f"><feGaussianBlur stdDeviation="2"/></filter>'
    '<clipPath id="c"><circle r="40"/></clipPath><rect id="a" width="20" height="20"/>'
    '<radialGradient id="l" fr=".1"><stop/><stop offset="1" stop-color="red"/></radialGradient>'
    '<marker id="k"><path d="M0 0L4 2 0 4z" fill="context-stroke"/></marker>'
)
TAGS = (
    *("g", "g", "rect", "path", "circle", "text", "tspan", "use", "mask", "filter", "clipPath"),
    *("marker", "feFlood", "feOffset", "feColorMatrix", "feImage", "linearGradient", "pattern"),
    *("svg", "symbol", "textPath", "animate", "polygon", "line", "foreignObject"),
)


class Maker:
    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)

    def number(self) -> str:
        return self.random.choice(NUMBERS)

    def colour(self) -> str:
        n = self.number()
        return self.random.choice(
            [
                *("red", "#fff", "none", "currentColor", "light-dark(red,blue)", "url(#m)"),
                *(f"color-mix(in oklch, red, blue {n})", f"rgb(from red r g b / {n})"),
                *("hsl(from var(--a) h s l)", "context-fill", "lab(50% 0 0)"),
            ]
        )

    def style(self) -> str:
        n, m, colour = self.number(), self.number(), self.colour()
        return self.random.choice(
            [
                *(f"transform:rotate({n})", f"translate:{n} {m}", f"scale:{n}", f"rotate:x {n}"),
                *("transform-box:fill-box", f"transform-origin:{n} {m}", f"fill:{colour}"),
                *(f"--a:{colour}", "--a:var(--b)", "--b:var(--a)", f"opacity:{n}"),
                *("mix-blend-mode:multiply", "isolation:isolate", f"filter:hue-rotate({n})"),
                *("mask-type:alpha", f"font:{n} serif", f"stroke:{colour};stroke-width:{n}"),
                *(f"filter:drop-shadow({n} {m} {colour})", f"clip-path:circle({n} at {m} {n})"),
                f"clip-path:inset({n} round {m})",
                f"clip-path:inset(1px round {n} {m} / {n} 3px)",
                *("mask:url(#m) alpha", "mask-mode:alpha", "mask-image:none", f"offset-path:{n}"),
                *("color-interpolation:linearRGB", "text-decoration:underline overline"),
                *(f"stroke:red;stroke-dasharray:{n} {m};stroke-dashoffset:{m}", "mask-border:none"),
            ]
        )

    def attribute(self) -> str:
        n, m = self.number(), self.number()
        return self.random.choice(
            [
                *('mask="url(#m)"', 'filter="url(#f)"', 'clip-path="url(#c)"', 'class="k"'),
                *(f'opacity="{n}"', f'fill="{self.colour()}"', f'stroke="{self.colour()}"'),
                *(f'style="{self.style()};{self.style()}"', f'd="M0 0L{n} 5"', 'd="M5 5h0"'),
                *(f'x="{n}"', f'width="{n}"', f'height="{m}"', f'r="{n}"', f'font-size="{n}"'),
                *('href="#a"', 'href="#m"', f'textLength="{n}"', f'viewBox="0 0 {n} {m}"'),
                *('maskUnits="userSpaceOnUse"', 'maskContentUnits="objectBoundingBox"'),
                *('marker-mid="url(#k)"', f'transform="scale({n})"', f'dx="{n} {m}"'),
                *('transform="scale(1 3)"', 'transform="skewX(60)"', f'fr="{n}"'),
                *('stroke-linejoin="round"', 'stroke-linecap="square"', 'fill="url(#l)"'),
                *('id="a"', 'id="m"', f'values="{n} {m}"', f'stdDeviation="{n}"', 'orient="auto"'),
            ]
        )

    def sheet(self) -> str:
        n, colour = self.number(), self.colour()
        rules = [
            *(f".k{{fill:{colour};&amp;:not(.z){{stroke:red}}}}", f"@layer x{{.k{{opacity:{n}}}}}"),
            *(f"@media (width > {n}){{rect{{fill:{colour}}}}}", "@media not all and (("),
            *(f"@supports (fill:{colour}) or (x:y){{*{{fill:red}}}}", "&amp;{fill:red}", "}", "{{"),
            *("g{g{g{g &amp;{fill:red}}}}", "@layer a.b, c;", f"*{{translate:{n}}}"),
        ]
        return "<style>" + "".join(self.random.choices(rules, k=3)) + "</style>"

    def element(self, depth: int = 0) -> str:
        tag = self.random.choice(TAGS)
        many = 0 if depth > 3 else self.random.choice([0, 0, 1, 2])
        inner = "".join(self.element(depth + 1) for _ in range(many))
        if tag in ("text", "tspan", "textPath"):
            inner = self.random.choice(["ab ", "שלום", "e\u0301", "\U0001f600", " x "]) + inner
        given = {a.partition("=")[0]: a for a in (self.attribute() for _ in range(4))}
        return f"<{tag} {' '.join(given.values())}>{inner}</{tag}>"

    def document(self) -> str:
        body = "".join(self.element() for _ in range(self.random.randint(1, 5)))
        root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
        return f"{root}{KEPT}{self.sheet()}{body}</svg>"


@pytest.mark.parametrize("seed", range(3))
def test_documents_are_drawn_or_refused(seed: int) -> None:
    maker, fonts = Maker(seed), fonts_in()
    drawn = 0
    for _ in range(DOCUMENTS):
        text = maker.document()
        try:
            drawing = read_svg(text.encode(), "a.svg", LIMITS, fonts=fonts)
            read_svg(frame_svg(drawing).encode(), "b.svg", LIMITS)
            drawn += 1
        except ShapetweenError:
            continue
        except Exception as error:
            raise AssertionError(text) from error
    assert drawn > DOCUMENTS / 3
