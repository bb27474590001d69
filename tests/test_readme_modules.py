"""The README's examples for pages and apps run as they stand there."""

import gzip
import re
from pathlib import Path
from typing import Any

import pytest

import shapetween as st
from tests.browser import Browser
from tests.node import install, run_node

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text("utf-8")

SNIPPETS = {
    (kind, (re.match(r"// (\w+)", text) or ["", ""])[1]): text
    for kind, text in re.findall(r"^```(html|js|jsx)\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
}

#: Where packages that a page imports by name have their modules.
PACKAGES = {
    "gsap": "gsap/index.js",
    "motion": "motion/dist/es/index.mjs",
    "motion-dom": "motion-dom/dist/es/index.mjs",
    "motion-utils": "motion-utils/dist/es/index.mjs",
    "framer-motion/dom": "framer-motion/dist/es/dom.mjs",
    "framer-motion": "framer-motion/dist/es/index.mjs",
    **{
        f"d3-{name}": f"d3-{name}/dist/d3-{name}.mjs"
        for name in (
            "selection",
            "transition",
            "color",
            "dispatch",
            "ease",
            "interpolate",
            "timer",
        )
    },
}

#: A bundler would set `process`.
PAGE = """<!doctype html><body style="height: 3000px">
<script>var process = {{env: {{NODE_ENV: "production"}}}}</script>
<script type="importmap">{{"imports": {imports}}}</script>
<div id="animal" style="width: 200px"></div><svg><path id="path"/></svg>{body}"""

#: The address that tests answer themselves.
HOME = "http://readme.test/"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the module of the examples."""
    place = tmp_path_factory.mktemp("modules")
    inputs = ROOT / "gallery" / "inputs"
    st.morph(inputs / "horse.svg", inputs / "kangaroo.svg").write(place / "animal.mjs")
    return place


def open_page(browser: Browser, folder: Path, script: str, packages: Path | None = None) -> Any:
    """Open a page with a script, whose files are answered out of folders."""
    page = browser.page
    page.unroute_all()

    def answer(route: Any) -> None:
        name = route.request.url.removeprefix(HOME)
        if name in ("", "favicon.ico"):
            imports = {key: f"{HOME}packages/{path}" for key, path in PACKAGES.items()}
            text = PAGE.format(imports=str(imports).replace("'", '"'), body=script)
            route.fulfill(body=text, content_type="text/html")
            return
        inside = name.startswith("packages/") and packages is not None
        home = packages if inside and packages else folder
        place = home / name.removeprefix("packages/")
        kind = "text/javascript" if place.suffix in (".js", ".mjs") else "text/plain"
        route.fulfill(path=str(place), content_type=kind)

    page.route(f"{HOME}**", answer)
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.goto(HOME)
    assert not wrong
    return page


def module_script(text: str) -> str:
    return f'<script type="module">{text}</script>'


def wait_for(page: Any, condition: str) -> None:
    page.wait_for_function(condition, timeout=15_000)


def test_there_is_one_of_each() -> None:
    assert set(SNIPPETS) == {
        ("html", ""),
        ("jsx", ""),
        *(("js", name) for name in ("scroll", "gsap", "motion", "d3", "an")),
    }


@pytest.mark.browser
def test_plain_html(browser: Browser, folder: Path) -> None:
    page = open_page(browser, folder, SNIPPETS["html", ""].replace("<div id", "<div data-id"))
    wait_for(page, "document.querySelector('#animal path')?.getAttribute('d')?.length > 100")
    first = page.locator("#animal path").get_attribute("d")
    wait_for(page, f"document.querySelector('#animal path').getAttribute('d') != {first!r}")


@pytest.mark.browser
def test_scroll(browser: Browser, folder: Path) -> None:
    page = open_page(browser, folder, module_script(SNIPPETS["js", "scroll"]))
    wait_for(page, "document.querySelector('#animal path')?.getAttribute('d')?.length > 100")
    first = page.locator("#animal path").get_attribute("d")
    page.evaluate("scrollTo(0, 90)")
    wait_for(page, f"document.querySelector('#animal path').getAttribute('d') != {first!r}")


@pytest.mark.browser
@pytest.mark.parametrize(
    ("name", "packages"),
    [
        ("gsap", ("gsap@3",)),
        ("motion", ("motion@14",)),
        ("d3", ("d3-transition@3", "d3-selection@3")),
    ],
)
def test_libraries(
    browser: Browser,
    folder: Path,
    tmp_path_factory: pytest.TempPathFactory,
    name: str,
    packages: tuple[str, ...],
) -> None:
    library = install(packages, tmp_path_factory.mktemp("packages"))
    end = run_node('import d from "./animal.mjs"; console.log(JSON.stringify(d(1)))', folder)
    page = open_page(browser, folder, module_script(SNIPPETS["js", name]), library)
    wait_for(page, f"document.querySelector('path').getAttribute('d') == {end!r}")


@pytest.mark.browser
def test_custom_element(browser: Browser, folder: Path) -> None:
    element = '<shape-tween src="animal.mjs" loop="alternate"></shape-tween>'
    assert element in SNIPPETS["js", "an"]
    page = open_page(browser, folder, element + module_script(SNIPPETS["js", "an"]))
    wait_for(page, "document.querySelector('shape-tween path')?.getAttribute('d')?.length > 100")
    assert page.evaluate("document.querySelector('shape-tween').animation.playState") == "running"


def test_react(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    place = tmp_path_factory.mktemp("react")
    install(("react@19", "react-dom@19", "typescript@5"), place)
    (place / "animal.mjs").write_text((folder / "animal.mjs").read_text("utf-8"), "utf-8")
    (place / "morph.jsx").write_text(SNIPPETS["jsx", ""], "utf-8")
    run_node(
        'import ts from "typescript"; import { readFileSync, writeFileSync } from "node:fs";\n'
        'const options = { jsx: "react-jsx", module: "esnext", target: "esnext" };\n'
        'const made = ts.transpile(readFileSync("morph.jsx", "utf8"), options);\n'
        'writeFileSync("morph.mjs", made);',
        place,
    )
    text, end = run_node(
        'import { createElement } from "react";\n'
        'import { renderToString } from "react-dom/server";\n'
        'import { Morph, Player } from "./morph.mjs"; import d from "./animal.mjs";\n'
        "const shown = renderToString(createElement(Morph, { t: 1 }));\n"
        "renderToString(createElement(Player));\n"
        "console.log(JSON.stringify([shown, d(1)]))",
        place,
    )
    assert f'd="{end}"' in text
    assert 'viewBox="0 0 24 24"' in text


def test_types_are_those_that_typescript_takes(
    folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    place = tmp_path_factory.mktemp("types")
    install(("typescript@5",), place)
    for name in ("animal.mjs", "animal.d.mts"):
        (place / name).write_text((folder / name).read_text("utf-8"), "utf-8")
    (place / "use.mts").write_text(
        'import d, { mount, play, style, timing, viewBox } from "./animal.mjs";\n'
        "const text: string = d(0.5, 0) + viewBox + style(1).fill;\n"
        'const run: Animation = play("#a", { loop: "alternate", hold: timing.hold, delay: 3 });\n'
        "const show: (t: number) => void = mount(document.body);\n"
        "// @ts-expect-error there is no such loop\n"
        'play("#a", { loop: "sometimes" });\n'
        "// @ts-expect-error what it waits for is as the file was written\n"
        'play("#a", { start: "click" });\n'
        "console.log(text, run, show);\n",
        "utf-8",
    )
    told = run_node(
        'import ts from "typescript";\n'
        "const options = { strict: true, noEmit: true, module: ts.ModuleKind.NodeNext,\n"
        "  moduleResolution: ts.ModuleResolutionKind.NodeNext, target: ts.ScriptTarget.ESNext,\n"
        '  lib: ["lib.esnext.d.ts", "lib.dom.d.ts"], types: [] };\n'
        'const program = ts.createProgram(["use.mts"], options);\n'
        "const found = ts.getPreEmitDiagnostics(program);\n"
        "console.log(JSON.stringify(found.map(({ messageText }) =>\n"
        '  ts.flattenDiagnosticMessageText(messageText, " "))))',
        place,
    )
    assert told == []


def test_the_module_of_two_animals_weighs_less_than_5_kilobytes(folder: Path) -> None:
    assert len(gzip.compress((folder / "animal.mjs").read_bytes(), 9)) <= 5_000
