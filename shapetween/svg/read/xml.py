"""Bytes of an SVG file, packed or not, to a tree of elements: safely, and within limits.

Nothing here opens a file or the network: external entities are refused, and a document type that
names an address is not fetched.
"""

import gzip
import io
import re
import zlib
from xml.etree.ElementTree import Element, ParseError, TreeBuilder
from xml.parsers import expat

from shapetween.base.errors import BudgetError, InputError
from shapetween.svg.read.limits import Limits

__all__ = ["SVG", "XLINK", "label", "local_name", "parse_xml"]

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"

#: The first expat that stops entity bombs by itself; with an older one, documents that declare
#: entities are refused.
SAFE_EXPAT = (2, 4, 0)

GZIP_MAGIC = b"\x1f\x8b"
BYTE_ORDER_MARKS = (
    (b"\xef\xbb\xbf", "utf-8"),
    (b"\xff\xfe", "utf-16-le"),
    (b"\xfe\xff", "utf-16-be"),
)
#: UTF-16 without a mark shows by the zero byte of its first "<".
BARE_UTF16 = ((b"<\x00", "utf-16-le"), (b"\x00<", "utf-16-be"))
DECLARED_ENCODING = re.compile(rb"""^\s*<\?xml[^>]{0,200}?encoding\s*=\s*["']([A-Za-z0-9._-]+)""")
DECLARATION = re.compile(r"^\s*<\?xml[^>]*\?>")


def local_name(element: Element) -> str:
    """The name of an SVG element without its namespace, empty for any other element."""
    tag = element.tag
    if not isinstance(tag, str):
        return ""
    if not tag.startswith("{"):
        return tag
    namespace, _, name = tag[1:].partition("}")
    return name if namespace == SVG else ""


def parse_xml(data: bytes, name: str, limits: Limits) -> tuple[Element, list[str]]:
    """Parse a whole document, within limits.

    Parameters
    ----------
    data : bytes
        The file, gzipped or not.
    name : str
        The file, for messages.
    limits : Limits

    Returns
    -------
    root : Element
        The outermost ``svg`` element.
    warnings : list of str

    Raises
    ------
    InputError
        If it is not well-formed XML, its root is not ``svg``, or it refers to an entity outside.
    BudgetError
    """
    limits.check("file_bytes", len(data), name)
    if data.startswith(GZIP_MAGIC):
        data = _unpacked(data, name, limits)
    limits.check("unpacked_bytes", len(data), name)
    if not data.strip(b" \t\r\n\x00"):
        raise InputError(name, "the file is empty; an SVG drawing is needed")
    text, warnings = _decoded(data)
    root = _parsed(text, name, limits)
    if root.tag == "svg":
        warnings.append(f'the root has no xmlns="{SVG}"; browsers will not show this file')
    elif local_name(root) != "svg":
        shown = root.tag.rpartition("}")[2]
        raise InputError(name, f"the root element is <{shown}>; an SVG file starts with <svg>")
    return root, warnings


def _unpacked(data: bytes, name: str, limits: Limits) -> bytes:
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as packed:
            return packed.read(limits.unpacked_bytes + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(name, f"is damaged as a gzip file ({error})") from None


def _decoded(data: bytes) -> tuple[str, list[str]]:
    """The text in the encoding of its mark or its declaration, else in UTF-8."""
    encoding = "utf-8"
    declared = DECLARED_ENCODING.match(data)
    if declared:
        encoding = declared[1].decode("ascii")
    for start, marked in (*BARE_UTF16, *BYTE_ORDER_MARKS):
        if data.startswith(start):
            encoding = marked
    warnings = []
    try:
        text = data.decode(encoding)
    except (LookupError, ValueError):
        # Most files that claim to be UTF-8 and are not, came from a Western Windows program.
        text = data.decode("cp1252", errors="replace")
        warnings.append(f"is not {encoding} as it says; read as Windows-1252")
    text = text.lstrip("\ufeff \t\r\n")
    # The text is no longer in the encoding that its declaration names.
    return DECLARATION.sub("", text, count=1), warnings


class _CountingBuilder(TreeBuilder):
    """Builds the tree and stops it at a limit; a deep tree is never built."""

    def __init__(self, name: str, limits: Limits, length: int) -> None:
        super().__init__()
        self._name = name
        self._limits = limits
        self._elements = 0
        self._depth = 0
        self._characters = -2 * length  # what remains above 0, entities made

    def start(self, tag: str, attrs: dict[str, str], /) -> Element:
        self._elements += 1
        self._depth += 1
        self._limits.check("elements", self._elements, self._name)
        self._limits.check("nesting", self._depth, self._name)
        self._count(sum(map(len, attrs.values())))
        return super().start(tag, attrs)

    def end(self, tag: str, /) -> Element:
        self._depth -= 1
        return super().end(tag)

    def data(self, data: str, /) -> None:
        self._count(len(data))
        super().data(data)

    def _count(self, characters: int) -> None:
        self._characters += characters
        self._limits.check("entity_growth", self._characters, self._name)


def _parsed(text: str, name: str, limits: Limits) -> Element:
    from defusedxml.common import DefusedXmlException  # kept off the path of `import shapetween`
    from defusedxml.ElementTree import DefusedXMLParser

    builder = _CountingBuilder(name, limits, len(text))
    parser = DefusedXMLParser(
        target=builder,
        forbid_entities=expat.version_info < SAFE_EXPAT,
        forbid_external=True,
    )
    try:
        parser.feed(text)
        root: Element = parser.close()
    except BudgetError:
        raise
    except ParseError as error:
        line, column = error.position
        what = str(error).partition(": line")[0]
        raise InputError(
            name,
            f"is not well-formed XML: {what} at line {line}, column {column + 1}; "
            "expected an SVG drawing",
        ) from None
    except DefusedXmlException:
        raise InputError(
            name, "has an entity that this reader refuses; only entities with inline text are read"
        ) from None
    except (ValueError, AssertionError) as error:
        raise InputError(name, f"is not well-formed XML: {error}") from None
    return root


def label(element: Element) -> str:
    """What an element is called: its id, else the label its drawing program gave it."""
    return (
        element.get("id")
        or element.get("{http://www.inkscape.org/namespaces/inkscape}label")
        or element.get("data-name")
        or element.get("aria-label")
        or ""
    ).strip()
