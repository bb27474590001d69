"""Commands on one pair of drawings: an animated SVG, frames, the mesh."""

from pathlib import Path
from typing import Any

import click

from shapetween.cli.options import A, B, Common, Keyframes, Name, common
from shapetween.errors import OptionError
from shapetween.progress import Progress

__all__ = ["frames", "mesh", "morph"]


@click.command(epilog="Example:  shapetween morph cat.svg dog.svg --duration 1.5 --loop alternate")
@A
@B
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    metavar="OUT.svg",
    help="Where to write.  [default: A-to-B.svg]",
)
@click.option(
    "--duration",
    type=click.FloatRange(0.001, 86_400),
    default=2.0,
    show_default=True,
    metavar="SECONDS",
    help="Length of one way.",
)
@click.option(
    "--easing",
    default="linear",
    show_default=True,
    metavar="NAME",
    help="linear, ease, ease-in, ease-out, ease-in-out or cubic-bezier(x1,y1,x2,y2).",
)
@click.option(
    "--loop",
    type=Name("once", "repeat", "alternate"),
    default="once",
    show_default=True,
    help="Stop at B, start again, or go back and forth.",
)
@click.option(
    "--keyframes",
    type=Keyframes(),
    default="auto",
    show_default=True,
    help="How many shapes to write; auto takes as many as smooth movement needs.",
)
@common
def morph(a: Path, b: Path, out: Path | None, common: Common, **settings: Any) -> None:
    """Write one animated SVG that moves from A to B.

    It plays in every browser, in <img> too, without a script.
    """
    from shapetween.frames import easing_function

    easing_function(settings["easing"])
    path = out or Path(f"{a.stem}-to-{b.stem}.svg")
    with Progress(quiet=common.quiet) as run:
        result = common.prepare(a, b, path, run)
        with run("write"):
            text = result.svg(precision=common.precision, **settings)
        common.finish(result, path, text, run)


@click.command(epilog="Example:  shapetween frames cat.svg dog.svg -o frames --frames 48")
@A
@B
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder for frame_0000.svg and so on.  [default: A-to-B]",
)
@click.option(
    "--frames",
    "count",
    type=click.IntRange(2, 100_000),
    default=24,
    show_default=True,
    metavar="N",
    help="How many frames, both ends counted.",
)
@click.option(
    "--easing",
    default="linear",
    show_default=True,
    metavar="NAME",
    help="linear, ease, ease-in, ease-out, ease-in-out or cubic-bezier(x1,y1,x2,y2).",
)
@common
def frames(a: Path, b: Path, out: Path | None, count: int, easing: str, common: Common) -> None:
    """Write one SVG a frame, the first drawing A and the last drawing B."""
    from shapetween.frames import easing_function, even_times

    times = easing_function(easing)(even_times(count))
    folder = out or Path(f"{a.stem}-to-{b.stem}")
    with Progress(quiet=common.quiet) as run:
        result = common.prepare(a, b, folder, run)
        with run("write"):
            from shapetween.svg.sequence import frame_svg

            drawings = result.prepared.movement.at(times)
            texts = [frame_svg(drawing, common.precision) for drawing in drawings]
        common.finish(result, folder, texts, run)


@click.command(epilog="Example:  shapetween mesh cat.svg dog.svg -o cat-to-dog-mesh.svg")
@A
@click.argument("b", type=click.Path(path_type=Path), required=False)
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    metavar="OUT.svg|OUT.json",
    help="A picture of both meshes, or the mesh itself.  [default: A-to-B-mesh.svg]",
)
@click.option(
    "--over",
    type=click.Path(path_type=Path),
    multiple=True,
    metavar="PICTURE",
    help="Draw over A's picture, repeated over B's too, as PNG. A alone may then be the quads or "
    "the mesh of 'image' in JSON.",
)
@common
def mesh(a: Path, b: Path | None, out: Path | None, over: tuple[Path, ...], common: Common) -> None:
    """Show what goes where: both shapes with numbered quads and matched nodes.

    Ending in .json, OUT is a mesh to keep, edit and give back with --mesh.
    """
    if over and (b is None) == (a.suffix.lower() == ".json"):
        from shapetween.cli.image import draw_over

        draw_over(a, b, over, out, common)
        return
    if over:
        raise OptionError("--over: expected quads or a mesh in one JSON file, or two SVGs")
    if b is None:
        raise click.UsageError("Missing argument 'B'.")
    path = out or Path(f"{a.stem}-to-{b.stem}-mesh.svg")
    if path.suffix.lower() not in (".svg", ".json"):
        raise OptionError(f"{path}: a mesh is written as .svg or .json")
    with Progress(quiet=common.quiet) as run:
        result = common.prepare(a, b, path, run)
        with run("write"):
            as_json = path.suffix.lower() == ".json"
            text = result.mesh_json() if as_json else result.mesh_svg((a.name, b.name))
        common.finish(result, path, text, run)
