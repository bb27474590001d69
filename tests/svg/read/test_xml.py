"""Documents as files have them: packed, mislabelled, hostile."""

import gzip

import pytest

from shapetween.base.errors import BudgetError, InputError
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.reader import read_svg
from shapetween.svg.read.xml import parse_xml

SVG = 'xmlns="http://www.w3.org/2000/svg"'
SQUARE = f'<svg {SVG} viewBox="0 0 9 9"><title>{{}}</title><path d="M1 1h5v5h-5z"/></svg>'


def title(data: bytes) -> str:
    return read_svg(data, "a.svg").title


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
def test_unicode_encodings(encoding: str) -> None:
    assert title(SQUARE.format("déformé ✓").encode(encoding)) == "déformé ✓"


@pytest.mark.parametrize("encoding", ["ISO-8859-1", "windows-1252", "shift_jis", "koi8-r"])
def test_declared_encodings(encoding: str) -> None:
    words = {"shift_jis": "四角", "koi8-r": "квадрат"}.get(encoding, "Carré")
    text = f'<?xml version="1.0" encoding="{encoding}"?>' + SQUARE.format(words)
    assert title(text.encode(encoding)) == words


@pytest.mark.parametrize("encoding", [None, "UTF-8", "no-such-thing", "zlib_codec"])
def test_a_wrong_encoding_is_survived_with_a_warning(encoding: str | None) -> None:
    declaration = f'<?xml version="1.0" encoding="{encoding}"?>' if encoding else ""
    drawing = read_svg((declaration + SQUARE.format("Carré")).encode("latin-1"), "a.svg")
    assert drawing.title == "Carré"
    assert any("Windows-1252" in warning for warning in drawing.warnings)


def test_gzip_is_known_by_its_first_bytes() -> None:
    packed = gzip.compress(SQUARE.format("packed").encode())
    assert title(packed) == "packed"
    with pytest.raises(InputError, match="damaged"):
        read_svg(packed[:-12], "a.svg")
    with pytest.raises(InputError, match="damaged"):
        read_svg(packed[:20] + b"xxxx" + packed[24:], "a.svg")


def test_a_missing_namespace_is_a_warning() -> None:
    drawing = read_svg(SQUARE.format("").replace(SVG, "").encode(), "a.svg")
    assert len(drawing.shapes) == 1
    assert any("xmlns" in warning for warning in drawing.warnings)


def test_illustrators_entities_are_read() -> None:
    text = """<?xml version="1.0"?>
    <!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN"
      "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [
      <!ENTITY ns_svg "http://www.w3.org/2000/svg"> <!ENTITY st0 "fill:#FF0000;">]>
    <svg xmlns="&ns_svg;" viewBox="0 0 9 9"><path style="&st0;" d="M1 1h5v5h-5z"/></svg>"""
    fill = read_svg(text.encode(), "a.svg").shapes[0].style.fill
    assert fill is not None
    assert getattr(fill, "red", 0) == 1


def bomb(levels: int) -> bytes:
    entities = '<!ENTITY e0 "lollollollol">' + "".join(
        f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, levels)
    )
    return f"<!DOCTYPE svg [{entities}]>{SQUARE.format(f'&e{levels - 1};')}".encode()


HOSTILE = {
    "empty": (b"", "empty"),
    "blank": (b" \n\t\n", "empty"),
    "json": (b'{"this": "is JSON"}', "well-formed"),
    "html": (b"<html><body><svg/></body></html>", "<html>"),
    "binary": (bytes(range(256)) * 20, "well-formed"),
    "unclosed": (f"<svg {SVG}><g></svg>".encode(), "line 1"),
    "two roots": ((SQUARE.format("") * 2).encode(), "well-formed"),
    "unbound prefix": (f"<svg {SVG}><use xlink:href='#a'/></svg>".encode(), "unbound prefix"),
    "undefined entity": (SQUARE.format("&nbsp;").encode(), "undefined entity"),
    "entity bomb": (bomb(9), "entit"),
    "small bomb": (bomb(6), "entit"),
    "quadratic": (
        f'<!DOCTYPE svg [<!ENTITY a "{"x" * 50_000}">]>{SQUARE.format("&a;" * 500)}'.encode(),
        "entit",
    ),
    "external": (
        f'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>{SQUARE.format("&a;")}'.encode(),
        "entity",
    ),
    "deep": (f"<svg {SVG}>".encode() + b"<g>" * 200_000, "nesting"),
    "many": (f"<svg {SVG}>".encode() + b"<g/>" * 200_000, "elements"),
    "gzip bomb": (gzip.compress(b" " * 40_000_000), "unpacked"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_documents_are_refused_in_one_line(name: str) -> None:
    data, word = HOSTILE[name]
    with pytest.raises(InputError, match=r"^a\.svg: ") as caught:
        read_svg(data, "a.svg")
    assert word in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_external_parameter_entity_is_never_fetched() -> None:
    declared = '<!DOCTYPE svg [<!ENTITY % a SYSTEM "file:///etc/passwd"> %a;]>'
    root, _ = parse_xml((declared + SQUARE.format("plain")).encode(), "a.svg", Limits())
    assert "".join(root.itertext()) == "plain"


def test_a_budget_says_how_to_raise_it() -> None:
    data = f'<svg {SVG}>{"<g/>" * 20}<path d="M1 1h5v5z"/></svg>'.encode()
    with pytest.raises(BudgetError, match=r"Limits\(elements=\.\.\.\)"):
        read_svg(data, "a.svg", Limits(elements=10))
    assert len(read_svg(data, "a.svg", Limits(elements=30)).shapes) == 1


def test_no_file_and_no_socket_is_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    read_svg(SQUARE.format("").encode(), "warm.svg")  # imports may open files

    def refuse(*args: object, **kwargs: object) -> None:
        raise AssertionError(f"opened {args}")

    monkeypatch.setattr("builtins.open", refuse)
    monkeypatch.setattr("socket.socket", refuse)
    text = f"""<!DOCTYPE svg SYSTEM "http://example.invalid/a.dtd">
    <svg {SVG} xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">
    <style>@import url(http://example.invalid/a.css); path {{fill: url(file:///etc/passwd#a)}}</style>
    <image href="file:///etc/passwd"/><use xlink:href="http://example.invalid/a.svg#b"/>
    <script href="http://example.invalid/a.js"/><rect width="5" height="5"/></svg>"""
    assert len(read_svg(text.encode(), "a.svg").shapes) == 1
