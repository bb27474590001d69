"""Commands on drawings: an animated SVG, frames, the mesh."""

from pathlib import Path
from typing import Any

import click

from shapetween.base.errors import OptionError
from shapetween.cli.options import (
    A,
    B,
    Common,
    common,
    duration_option,
    easing_option,
    loop_option,
    out_option,
)
from shapetween.cli.project import no_drawings_beside, project_option
from shapetween.cli.values import PATH, Keyframes, Name, Real, Size, Whole
from shapetween.io.progress import Progress

__all__ = ["frames", "mesh", "morph"]

MORE = click.argument("more", type=PATH, nargs=-1, metavar="[C]...")
SIZE = click.option(
    "--size",
    type=Size(),
    metavar="WIDTH[xHEIGHT]",
    help="Of frames as pictures, in pixels.  [default: 800 along the longer side]",
)
PRECISION = click.option(
    "--precision",
    type=Whole(0, 12),
    metavar="N",
    help="Decimals of coordinates in SVG.  [default: by the size of the view box]",
)
BACKGROUND = click.option(
    "--background",
    metavar="COLOR",
    help="Behind the drawings in pictures.  [default: none, in .mp4 white]",
)


@click.command(
    epilog="Examples:  shapetween morph cat.svg dog.svg --duration 1.5 --loop alternate;  "
    "shapetween morph cat.svg dog.svg cow.svg cat.svg --hold 0.5 --loop repeat"
)
@A
@B
@MORE
@out_option(
    "OUT.svg",
    "Where to write; ending in .webp, .png, .gif or .mp4, as moving pictures, which keep patterns "
    "and pictures in shapes.  [default: A-to-B.svg]",
)
@duration_option("Length of one way, from each drawing to the next.")
@click.option(
    "--hold",
    type=Real(0, 86_400),
    default=0.0,
    show_default=True,
    metavar="SECONDS",
    help="How long each drawing stands still.",
)
@easing_option()
@loop_option("Stop at the last drawing, start again, or go back and forth.")
@click.option(
    "--easing-over",
    type=Name("leg", "chain"),
    default="leg",
    show_default=True,
    help="Of more than two drawings: ease each way, or all of them as one.",
)
@click.option(
    "--stagger",
    type=Real(0, 3600),
    default=0.0,
    show_default=True,
    metavar="SECONDS",
    help="Let parts set off one after another.",
)
@click.option(
    "--stagger-by",
    type=Name("order", "distance", "left"),
    default="order",
    show_default=True,
    help="As they are painted, from the middle outwards, or from left to right.",
)
@click.option(
    "--keyframes",
    type=Keyframes(),
    default="auto",
    show_default=True,
    help="How many shapes to write; auto takes as many as smooth movement needs.",
)
@PRECISION
@click.option(
    "--start",
    type=Name("load", "click", "hover", "seen", "scroll", "drag"),
    default="load",
    show_default=True,
    help="What sets it going: the page, a click and back on the next, or a pointer over it; in "
    ".mjs and .html also being seen, being scrolled past, or being dragged across.",
)
@click.option(
    "--css",
    type=Name("path", "shape", "d"),
    default="path",
    show_default=True,
    help="What .css animates: a clip path in pixels, one that scales with its box, or d of a path.",
)
@click.option(
    "--fps",
    type=Real(0.01, 240),
    metavar="N",
    help="Moving pictures: frames a second.  [default: 30]",
)
@SIZE
@BACKGROUND
@project_option
@common
def morph(
    a: Path,
    b: Path,
    more: tuple[Path, ...],
    out: Path | None,
    common: Common,
    **settings: Any,
) -> None:
    """Write a file that moves from A to B: an animated SVG, or another by OUT's ending.

    An SVG plays in every browser, in <img> too, without a script.

    With more drawings it goes on from B to C and so forth, all in the frame of A. Name A again at
    the end to close the round; with --loop repeat it then never jumps.
    """
    from shapetween.formats.options import write_options
    from shapetween.formats.table import writer_of

    no_drawings_beside()
    drawings = [a, b, *more]
    path = out or Path(f"{_joined(drawings)}.svg")
    writer, options = writer_of(path), write_options(settings)
    writer.check(options)
    with Progress(quiet=common.quiet) as run:
        result = common.prepare_all(drawings, path, run, pictures=writer.pictures)
        with run("write"):
            made = result.written(writer, options, name=path.stem, observe=run)
        common.finish(result, path, made, run)


@click.command(epilog="Example:  shapetween frames cat.svg dog.svg -o frames --frames 48")
@A
@B
@MORE
@out_option("DIR", "Folder for frame_0000.svg and so on.  [default: A-to-B]")
@click.option(
    "--frames",
    type=Whole(2, 100_000),
    default=24,
    show_default=True,
    metavar="N",
    help="How many frames from each drawing to the next, both counted.",
)
@easing_option()
@PRECISION
@click.option("--png", is_flag=True, help="Write PNG, which keeps patterns and pictures in shapes.")
@SIZE
@BACKGROUND
@common
def frames(
    a: Path,
    b: Path,
    more: tuple[Path, ...],
    out: Path | None,
    png: bool,
    common: Common,
    **settings: Any,
) -> None:
    """Write one SVG a frame, the first drawing A and the last drawing B.

    With more drawings it goes on from B to C and so forth, all in the frame of A; each is one
    frame. The paths of a frame have the same commands as far as the next drawing.
    """
    from shapetween.formats.options import write_options
    from shapetween.formats.table import FRAMES, WRITERS

    writer, options = FRAMES[".png" if png else ".svg"], write_options(settings)
    writer.check(options)
    drawings = [a, b, *more]
    folder = out or Path(_joined(drawings))
    a_file = folder.exists() or folder.suffix.lower() in WRITERS
    if a_file and not folder.is_dir():
        raise OptionError(
            f"{folder}: frames are written into a folder; expected the name of one, or "
            "'shapetween morph' for one file"
        )
    with Progress(quiet=common.quiet) as run:
        result = common.prepare_all(drawings, folder, run, pictures=writer.pictures)
        with run("write"):
            made = result.written(writer, options, name=folder.stem, observe=run)
        common.finish(result, folder, made, run)


@click.command(epilog="Example:  shapetween mesh cat.svg dog.svg -o cat-to-dog-mesh.svg")
@A
@click.argument("b", type=PATH, required=False)
@out_option(
    "OUT.svg|OUT.json",
    "A picture of both meshes, or the mesh itself.  [default: A-to-B-mesh.svg]",
)
@click.option(
    "--over",
    type=PATH,
    multiple=True,
    metavar="PICTURE",
    help="Draw over A's picture, repeated over B's too, as PNG. A alone may then be the quads or "
    "the mesh of 'image' in JSON.",
)
@common
def mesh(a: Path, b: Path | None, out: Path | None, over: tuple[Path, ...], common: Common) -> None:
    """Show what goes where: who becomes whom, and shapes with their quads and matched nodes.

    Ending in .json, OUT is a mesh to keep, edit and give back with --mesh.
    """
    if over and (b is None) == (a.suffix.lower() == ".json"):
        from shapetween.cli.image import draw_over

        no_use = "changes nothing here; expected no --over with it"
        vain = ("--match", common.matches), ("--mesh", common.mesh), ("--report", common.report)
        _check_vain(no_use, *vain)
        if b is None:
            _check_vain(no_use, ("--pin", common.pins), ("--quads", common.quads))
        draw_over(a, b, over, out, common)
        return
    if over:
        raise OptionError("--over: expected quads or a mesh in one JSON file, or two SVGs")
    if b is None:
        raise click.UsageError("Missing argument 'B'.")
    from shapetween.formats.table import Written
    from shapetween.io import files

    path = out or Path(f"{a.stem}-to-{b.stem}-mesh.svg")
    as_json = files.check_form(path, "a mesh", (".svg", ".json")) == ".json"
    with Progress(quiet=common.quiet) as run:
        result = common.prepare(a, b, path, run)
        with run("write"):
            text = result.mesh_json() if as_json else result.mesh_svg((a.name, b.name))
        common.finish(result, path, Written(text), run)


def _check_vain(reason: str, *options: tuple[str, object]) -> None:
    """Check that no option has a value, here beside its name, that would change nothing."""
    for name, value in options:
        if value not in (None, ()):
            raise OptionError(f"{name}: {reason}")


def _joined(drawings: list[Path]) -> str:
    """The name of an output for which none was given."""
    return "-to-".join(drawing.stem for drawing in drawings)
