"""The table of writers: what writes a file of which ending, and which options it has a use for.

A writer is a pure function of a `Segments` and `WriteOptions` to what is `Written`; it opens no
file. To add a format, write a module here with such a function, and put it into `WRITERS`.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Protocol, TypeAlias

from shapetween.base.errors import OptionError
from shapetween.base.notices import Notice, distinct
from shapetween.base.observe import Observer, unobserved
from shapetween.base.threads import one_thread
from shapetween.formats.options import WriteOptions, write_names
from shapetween.formats.segments import Segments
from shapetween.io import files

__all__ = [
    "FEATURES",
    "FRAMES",
    "WRITERS",
    "Content",
    "Segments",
    "Writer",
    "WriterFunction",
    "Written",
    "formats_table",
    "put",
    "writer_of",
]

Content: TypeAlias = str | bytes | Callable[[Path], None]
"""A file's text or bytes; or what writes it as it comes, where that is too much to be held."""


@dataclass(frozen=True, slots=True, eq=False)
class Written:
    """What a writer has made.

    Attributes
    ----------
    content : str, bytes or callable
        Of the file.
    notices : tuple of Notice
        What of the movement its format could not hold.
    beside : Mapping
        Texts of files that go with it, by the ending that takes the place of the file's own.
    """

    content: Content
    notices: tuple[Notice, ...] = ()
    beside: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, content: Content, losses: Iterable[str]) -> "Written":
        """A file and what its format could not hold, each said once."""
        return cls(content, distinct(Notice("format", loss) for loss in losses))

    @property
    def warnings(self) -> tuple[str, ...]:
        """The notices, one line each."""
        return tuple(map(str, self.notices))


class WriterFunction(Protocol):
    """Makes a file's content."""

    def __call__(
        self, segments: Segments, options: WriteOptions, observe: Observer = unobserved
    ) -> Written:
        """Write `segments`, telling `observe` of long stages."""


@dataclass(frozen=True, slots=True)
class Writer:
    """One format.

    Attributes
    ----------
    ending : str
        Of its files.
    what : str
        What such a file is, for messages.
    home : str
        Where its function is, ``module:name``, imported when it is used.
    takes : tuple of str
        Names of the options that it has a use for.
    pictures : bool
        Whether it keeps patterns and pictures in shapes.
    keeps : tuple of str
        Those of `FEATURES` that it shows as the frames do; of the others a warning tells, or they
        are refused.
    """

    ending: str
    what: str
    home: str
    takes: tuple[str, ...]
    pictures: bool = False
    keeps: tuple[str, ...] = ()

    def check(self, options: WriteOptions) -> None:
        """Check that every option asked for has an effect.

        Raises
        ------
        OptionError
            If one has none, naming the endings that would take it.
        """
        alike = FRAMES if FRAMES.get(self.ending) is self else WRITERS
        for name in options.asked:
            if name not in self.takes:
                others = [other.ending for other in alike.values() if name in other.takes]
                hint = f"; it is for {', '.join(others)}" if others else ""
                raise OptionError(f"{name}: changes nothing in {self.what}{hint}")

    def write(
        self, segments: Segments, options: WriteOptions, observe: Observer = unobserved
    ) -> Written:
        """Make the file's content.

        Raises
        ------
        OptionError
            If an option has no effect here, or cannot be used.
        """
        from shapetween.formats.paced import paced

        self.check(options)
        segments, options = paced(segments, options)
        module, name = self.home.split(":")
        function: WriterFunction = getattr(import_module(module), name)
        with one_thread():
            return function(segments, options, observe)


FEATURES = (
    "several parts",
    "lines",
    "dashes",
    "gradients that change",
    "opacity of a group",
    "masks",
    "filters",
    "blending",
    "the page's own colour",
    "patterns and pictures",
)
"""What a drawing may have that not every format holds."""

_OWN = FEATURES[:4]  # what any format has that knows paths and paint
_GROUPS = FEATURES[4:8]
_COMPOSED = FEATURES[:6]  # where groups are drawn apart, and masks are mattes
_PAGE = (*_OWN, *_GROUPS, FEATURES[8])
_FLAT = (*_OWN, *_GROUPS, FEATURES[9])

_PACE = ("duration", "easing", "easing_over", "stagger", "stagger_by", "hold")
_TIMING = (*_PACE, "loop")
_FILM = (*_TIMING, "fps", "size", "background")


def _writers() -> Iterator[Writer]:
    """Every format, in the order in which they are told of."""
    svg = "shapetween.formats.svg:animated"
    options = (*_TIMING, "keyframes", "precision", "start")
    yield Writer(".svg", "an animated SVG", svg, options, keeps=_PAGE)
    for ending in (".webp", ".png", ".apng", ".gif", ".mp4"):
        home = f"shapetween.formats.pictures:{ending.removeprefix('.')}"
        yield Writer(ending, f"moving pictures ({ending})", home, _FILM, True, _FLAT)
    keyed = (*_TIMING, "keyframes", "precision")
    lottie = "shapetween.formats.lottie.writer"
    yield Writer(".json", "a Lottie animation", f"{lottie}:lottie", keyed, keeps=_COMPOSED)
    packed = "a packed Lottie animation"
    yield Writer(".lottie", packed, f"{lottie}:dot_lottie", keyed, keeps=_COMPOSED)
    home = "shapetween.formats.css:css"
    yield Writer(".css", "a style sheet", home, (*keyed, "size", "css"), keeps=FEATURES[8:9])
    home = "shapetween.formats.android:vector_drawable"
    once = (*_PACE, "keyframes", "precision")
    yield Writer(".xml", "an Android vector drawable", home, once, keeps=_OWN[:2])
    home = "shapetween.formats.module.writer:module"
    moved = (*_TIMING, "precision", "start")
    yield Writer(".mjs", "a JavaScript module", home, moved, keeps=_PAGE)
    home = "shapetween.formats.player.writer:html"
    yield Writer(".html", "a page", home, (*moved, "background"), keeps=_PAGE)


WRITERS: Mapping[str, Writer] = MappingProxyType({writer.ending: writer for writer in _writers()})
"""What writes a file of that ending."""

FRAMES: Mapping[str, Writer] = MappingProxyType(
    {
        ".svg": Writer(
            ".svg",
            "frames as SVG",
            "shapetween.formats.svg:frames",
            ("easing", "precision", "frames"),
        ),
        ".png": Writer(
            ".png",
            "frames as PNG",
            "shapetween.formats.pictures:frames",
            ("easing", "size", "background", "frames"),
            pictures=True,
        ),
    }
)
"""What writes a folder of frames of that ending."""


def formats_table() -> str:
    """What each format keeps of a drawing, and which options it takes, in Markdown."""
    writers = list(WRITERS.values())
    options = [name for name in write_names() if any(name in w.takes for w in writers)]
    head = " | ".join(f"`{writer.ending}`" for writer in writers)
    lines = [f"| | {head} |", f"|---|{':-:|' * len(writers)}"]
    for feature in FEATURES:
        marks = " | ".join("yes" if feature in writer.keeps else "" for writer in writers)
        lines.append(f"| {feature} | {marks} |")
    for name in options:
        marks = " | ".join("yes" if name in writer.takes else "" for writer in writers)
        lines.append(f"| `--{name.replace('_', '-')}` | {marks} |")
    return "\n".join(lines) + "\n"


def writer_of(path: Path) -> Writer:
    """The writer for an output's name; a pipe or a device without a known ending is given SVG.

    Raises
    ------
    OptionError
        If its ending is none that is written, or a folder has that name.
    """
    form = files.check_form(path, "a movement", tuple(WRITERS))
    return WRITERS.get(form, WRITERS[".svg"])


def put(path: Path, made: Written) -> None:
    """Write what has been made to its place, whole or not at all; a device has nothing beside."""
    content = made.content
    with ExitStack() as stack:  # what goes beside appears only once the file has been written
        for ending, text in made.beside.items() if not files.is_device(path) else ():
            fresh = stack.enter_context(files.fresh_file(path.with_suffix(ending)))
            fresh.write_text(text, "utf-8", newline="\n")
        if isinstance(content, str):
            files.write_text(path, content)
        elif isinstance(content, bytes):
            with files.fresh_file(path) as fresh:
                fresh.write_bytes(content)
        else:
            content(path)
