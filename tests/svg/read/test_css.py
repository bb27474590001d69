"""Style sheets as browsers read them today: nesting, layers, conditions, functions, transforms."""

import numpy as np
import pytest

from shapetween.model.drawing import Drawing
from shapetween.model.paint import Colour
from shapetween.svg.read.calc import calculated
from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.queries import Medium, media_met
from shapetween.svg.read.reader import read_svg
from shapetween.svg.read.variables import with_variables


def drawn(body: str, attributes: str = "") -> Drawing:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" {attributes}>{body}</svg>'
    return read_svg(text.encode(), "a.svg")


def colour(sheet: str, attributes: str = 'class="a"') -> str:
    body = f"<style>{sheet}</style><g class='o'><rect width='9' height='9' {attributes}/></g>"
    fill = drawn(body).shapes[0].style.fill
    assert isinstance(fill, Colour)
    return "".join(f"{round(15 * part):x}" for part in (fill.red, fill.green, fill.blue))


@pytest.mark.parametrize(
    ("sheet", "expected"),
    [
        # Nesting.
        (".o{ .a{fill:#f00} }", "f00"),
        (".o{ &amp; .a{fill:#f00} }", "f00"),
        (".o{ > .a{fill:#f00} }", "f00"),
        (".o{ rect&amp;{fill:#f00} } .a{fill:#0f0}", "0f0"),
        ("rect{ &amp;.a{fill:#f00} } rect{fill:#00f}", "f00"),
        (".x, .o{ .a{fill:#f00} }", "f00"),
        (".a{ fill:#f00; @media screen{fill:#0f0} }", "0f0"),
        (".a{ @media print{fill:#f00} fill:#00f }", "00f"),
        ("g{ .o &amp;{fill:#f00} .a{ &amp;{fill:#00f} } }", "00f"),
        # What is nested is as specific as what is around it.
        ("#x, .o{ .a{fill:#f00} } .o .a{fill:#0f0}", "f00"),
        # Layers: unlayered wins, then later ones; with !important the other way round.
        ("@layer x{.a{fill:#f00}}", "f00"),
        (".a{fill:#0f0} @layer x{rect.a{fill:#f00}}", "0f0"),
        ("@layer x,y; @layer y{.a{fill:#00f}} @layer x{.a{fill:#000}}", "00f"),
        ("@layer x{.a{fill:#f00!important}} @layer y{.a{fill:#00f!important}}", "f00"),
        ("@layer x{.a{fill:#f00!important}} .a{fill:#00f!important}", "f00"),
        ("@layer x{@layer y{.a{fill:#00f}} .a{fill:#f00}}", "f00"),
        ("@layer x.y{.a{fill:#00f}} @layer x{.a{fill:#f00}}", "f00"),
        ("@layer{.a{fill:#00f}} @layer{.a{fill:#f00}}", "f00"),
        # Conditions.
        ("@supports (fill:red){.a{fill:#f00}}", "f00"),
        ("@supports not (fill:red){.a{fill:#f00}}", "000"),
        ("@supports (fill:red) and (fill:nonsense){.a{fill:#f00}}", "000"),
        ("@supports (fill:red) or (fill:nonsense){.a{fill:#f00}}", "f00"),
        ("@supports selector(a > b){.a{fill:#f00}}", "f00"),
        ("@media (max-width: 100px){.a{fill:#f00}}", "f00"),
        ("@media (max-width: 99px){.a{fill:#f00}}", "000"),
        ("@media (width &gt;= 50px) and (orientation: landscape){.a{fill:#f00}}", "f00"),
        ("@media (prefers-color-scheme: dark){.a{fill:#f00}}", "000"),
        ("@media not all and (prefers-color-scheme: dark){.a{fill:#f00}}", "f00"),
        # Variables within functions.
        (":root{--h:120}.a{fill:hsl(var(--h) 100% 50%)}", "0f0"),
        (":root{--c:255,0,0}.a{fill:rgba(var(--c),1)}", "f00"),
        (".a{fill:rgb(var(--none, 255) 0 0)}", "f00"),
        (":root{--a:var(--b);--b:#f00}.a{fill:var(--a)}", "f00"),
        (":root{--a:var(--b);--b:var(--a)}.a{fill:var(--a, #00f)}", "00f"),
        (".o{--a:#f00}.a{--a:var(--a);fill:var(--a,#0f0)}", "0f0"),
        # What is asked for and not known is not supported.
        ("@supports not (foo: bar){.a{fill:#f00}}", "f00"),
        ("@supports (display: grid) and (fill: red){.a{fill:#f00}}", "f00"),
        # Colours of colours.
        (".o{color:#f00}.a{fill:color-mix(in srgb, currentColor, #f00)}", "f00"),
        (".a{fill:light-dark(#f00, #00f)}", "f00"),
        (":root{color-scheme:dark}.a{fill:light-dark(#f00, #00f)}", "00f"),
        (".a{fill:color-mix(in srgb, light-dark(#f00, #000) 100%, #00f)}", "f00"),
        # What takes back what was said: of one property, or of all.
        (".a{fill:#f00} .a{fill:revert}", "000"),
        (".o{fill:#00f} .a{fill:#f00;all:inherit;width:9px;height:9px}", "00f"),
        (".o{fill:#00f} .a{fill:#f00;all:revert;width:9px;height:9px}", "00f"),
        (".o{fill:#00f} .a{fill:#f00;all:unset;width:9px;height:9px}", "00f"),
        (".o{fill:#00f} .a{fill:#f00;all:initial;width:9px;height:9px}", "000"),
        (".a{all:revert;fill:#f00;width:9px;height:9px} rect{fill:#00f}", "f00"),
        (".a{fill:#f00} .a{all:nonsense}", "f00"),
        (".a{fill:#f00!important} .a{all:revert;width:9px;height:9px}", "f00"),
        (".a{--c:#f00;all:unset;width:9px;height:9px;fill:var(--c)}", "f00"),
        ("@layer x,y; @layer x{.a{fill:#f00}} @layer y{.a{fill:#00f;fill:revert-layer}}", "f00"),
        ("@layer x{.a{fill:#f00}} .a{fill:#00f} .a{all:revert-layer}", "f00"),
        # What is not sound loses against what came before.
        (".a{fill:#f00;fill:color-mix(in nothing, red, blue)}", "f00"),
    ],
)
def test_style_sheets(sheet: str, expected: str) -> None:
    assert colour(sheet) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("color-mix(in srgb, red 30%, white)", (1, 0.7, 0.7, 1)),
        ("color-mix(in srgb, red 30%, blue 30%)", (0.5, 0, 0.5, 0.6)),
        ("color-mix(in srgb, red, transparent)", (1, 0, 0, 0.5)),
        ("color-mix(in hsl, red, lime)", (1, 1, 0, 1)),
        ("color-mix(in hsl longer hue, red, lime)", (0, 0, 1, 1)),
        # Half a turn apart, and alike: the longer way is the one onwards.
        ("color-mix(in hsl longer hue, red, cyan)", (0.5, 1, 0, 1)),
        ("color-mix(in hsl longer hue, red, red)", (0, 1, 1, 1)),
        ("color-mix(in hsl increasing hue, blue, red)", (1, 0, 1, 1)),
        ("color-mix(in hsl decreasing hue, red, blue)", (1, 0, 1, 1)),
        ("color-mix(in lab, white, white)", (1, 1, 1, 1)),
        ("color-mix(in oklch, white, red 0%)", (1, 1, 1, 1)),
        ("color-mix(red 0%, lime)", (0, 1, 0, 1)),
        ("rgb(from #3498db r g b / .5)", (0.2039, 0.5961, 0.8588, 0.5)),
        ("rgb(from red calc(r / 2) 0 b)", (0.5, 0, 0, 1)),
        ("hsl(from red calc(h + 120) s l)", (0, 1, 0, 1)),
        ("oklch(from blue l c h)", (0, 0, 1, 1)),
        ("lab(from #123456 l a b)", (0.0706, 0.2039, 0.3373, 1)),
        ("color(from red display-p3 r g b)", (1, 0, 0, 1)),
        ("hwb(from lime h w b)", (0, 1, 0, 1)),
        ("rgb(calc(100 + 155) 0 0)", (1, 0, 0, 1)),
    ],
)
def test_colours_made_of_colours(text: str, expected: tuple[float, ...]) -> None:
    value = parse_paint(text)
    assert value is not None
    assert isinstance(value.colour, Colour)
    found = value.colour.red, value.colour.green, value.colour.blue, value.colour.alpha
    assert found == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize(
    "text",
    [
        "color-mix(in srgb, red)",
        "color-mix(in srgb, red 0%, blue 0%)",
        "rgb(from r g b)",
        "hsl(from)",
        "color-mix()",
        "rgb(from red r g)",
        "color(from red nowhere r g b)",
        "color-mix(in)",
    ],
)
def test_malformed_colour_functions_are_no_colours(text: str) -> None:
    assert parse_paint(text) is None


@pytest.mark.parametrize(
    ("query", "met"),
    [
        ("", True),
        ("screen", True),
        ("print", False),
        ("print, screen", True),
        ("not print", True),
        ("only screen and (min-width: 100px)", True),
        ("(50px &lt; width &lt;= 100px)".replace("&lt;", "<"), True),
        ("(100px < width)", False),
        ("(aspect-ratio: 5/4)", True),
        ("(hover)", True),
        ("(prefers-reduced-motion)", False),
        ("(prefers-reduced-motion: no-preference)", True),
        ("not ((width > 1px) or (hover))", False),
        ("(unheard-of: 3)", False),
        ("((", False),
    ],
)
def test_media_queries(query: str, met: bool) -> None:
    assert media_met(query, Medium(100.0, 80.0)) is met


def test_sums_are_calculated() -> None:
    def unit(value: float, name: str) -> float | None:
        return {"": value, "px": value, "%": value / 2}.get(name)

    assert calculated("calc(10px + 50% * 2)", unit) == 60
    assert calculated("clamp(1px, max(3px, 2px), 2px)", unit) == 2
    assert calculated("calc((1px - 2px) / 4)", unit) == -0.25
    for text in ("calc()", "calc(1px /)", "calc(1 / 0)", "calc(1em)", "sin()", "calc(1px 2px)"):
        assert calculated(text, unit) is None


def test_variables_that_multiply_end() -> None:
    names = {f"--v{k}": f"var(--v{k + 1})" * 8 for k in range(12)} | {"--v12": "0123456789"}
    assert with_variables("var(--v0)", names) is None


@pytest.mark.parametrize(
    ("style", "box"),
    [
        ("rotate:90deg;transform-origin:50px 50px", (30, 30, 40, 40)),
        ("translate:10px 5px", (40, 35, 40, 40)),
        ("translate:10%", (40, 30, 40, 40)),
        ("scale:2", (60, 60, 80, 80)),
        ("scale:50% 100%", (15, 30, 20, 40)),
        ("scale:2;transform-box:fill-box;transform-origin:center", (10, 10, 80, 80)),
        ("transform:translate(10%, 0)", (40, 30, 40, 40)),
        ("transform:translate(25%, 0);transform-box:fill-box", (40, 30, 40, 40)),
        ("transform:translate(calc(5px + 5px), 0)", (40, 30, 40, 40)),
        ("transform:translate3d(10px, 0, 99px)", (40, 30, 40, 40)),
        ("transform:rotateY(180deg);transform-origin:50px 0", (30, 30, 40, 40)),
        ("transform:scale3d(2, 1, 5)", (60, 30, 80, 40)),
        ("transform:matrix(1, 0, 0, 1, 10, 0)", (40, 30, 40, 40)),
        ("transform:rotate(0.25turn);transform-origin:50px 50px", (30, 30, 40, 40)),
        # What is not sound is as if it were not there.
        ("transform:translate(10, 0)", (30, 30, 40, 40)),
        ("transform:rotate(45)", (30, 30, 40, 40)),
        ("transform:scale(2);transform:translate(1px 2px)", (60, 60, 80, 80)),
        # Each in its turn.
        ("translate:10px;scale:2;transform:translate(5px)", (80, 60, 80, 80)),
    ],
)
def test_transforms_by_style(style: str, box: tuple[float, ...]) -> None:
    shape = drawn(f'<rect x="30" y="30" width="40" height="40" style="{style}"/>').shapes[0]
    low, high = shape.rings[0].box
    assert np.array([*low, *(high - low)]) == pytest.approx(np.array(box), abs=1e-9)


def test_a_transform_attribute_takes_no_units() -> None:
    drawing = drawn('<rect id="r" x="1" width="9" height="9" transform="rotate(45deg)"/>')
    assert drawing.shapes[0].rings[0].box[0].tolist() == [1, 0]
    assert drawing.warnings == ("a malformed transform was left out: r",)


def test_lengths_of_style_need_their_unit() -> None:
    shape = drawn('<rect width="20" height="20" style="width:50;height:50px"/>').shapes[0]
    assert shape.rings[0].box[1].tolist() == [20, 50]


@pytest.mark.parametrize(
    ("body", "word"),
    [
        ("<rect width='9' height='9'><animate attributeName='x'/></rect>", "animated"),
        (
            "<style>@keyframes m{} rect{animation:m 2s}</style><rect width='9' height='9'/>",
            "animated",
        ),
        ("<script>1</script><rect width='9' height='9'/>", "script"),
        ("<style>@container (width){}</style><rect width='9' height='9'/>", "@container"),
        ("<rect width='9' height='9' style='offset-path:none;mask-border:url(a)'/>", "mask-border"),
        ("<rect width='9' height='9' style='mask:linear-gradient(red,blue)'/>", "mask element"),
    ],
)
def test_what_is_not_followed_is_told(body: str, word: str) -> None:
    (warning,) = drawn(body).warnings
    assert word in warning


def test_inline_style_takes_back_itself_alone() -> None:
    assert colour("rect{fill:#0f0}", 'fill="#f00" style="fill:#00f;fill:revert-layer"') == "0f0"
    assert colour("rect{fill:#0f0}", 'style="fill:#00f;all:revert-layer"') == "0f0"


@pytest.mark.parametrize("word", ["initial", "inherit", "unset", "revert"])
def test_attributes_say_nothing_of_what_style_resets_whole(word: str) -> None:
    """Where it is and how it is transformed are properties too: in browsers nothing is left."""
    body = '<path d="M0 0H9V9Z"/><path d="M0 0H50V50Z" style="all:{}{}"/>'
    assert len(drawn(body.format(word, "")).shapes) == 1
    again = drawn(
        body.format(word, ";d:path('M0 0H5V5Z')").replace("/>", ' transform="scale(4)"/>')
    )
    assert again.shapes[1].rings[0].box[1].tolist() == [5, 5]


@pytest.mark.parametrize("tag", ["flowPara", "flowSpan"])
def test_text_that_only_inkscape_shows_is_told(tag: str) -> None:
    shape = "<rect width='9' height='9'/>"
    flowed = f"<flowRoot><flowRegion>{shape}</flowRegion><{tag}>{{}}</{tag}></flowRoot>"
    (warning,) = drawn(shape + flowed.format("Hello")).warnings
    assert "flowRoot" in warning
    assert "Inkscape" in warning
    # Inkscape leaves empty ones behind, and ones that nobody sees.
    assert not drawn(shape + flowed.format(" ")).warnings
    assert not drawn(f"{shape}<g display='none'>{flowed.format('Hello')}</g>").warnings


def test_keyframes_that_nothing_uses_are_no_matter() -> None:
    assert not drawn("<style>@keyframes m{}</style><rect width='9' height='9'/>").warnings
