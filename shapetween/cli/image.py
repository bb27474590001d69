"""The command that makes a transition of two pictures."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from shapetween.base.errors import OptionError
from shapetween.cli.messages import warn, wrote
from shapetween.cli.options import (
    QUIET,
    A,
    B,
    Common,
    easing_option,
    loop_option,
    method_option,
    out_option,
    report_option,
)
from shapetween.cli.values import PATH, Real, Size, Whole
from shapetween.io.progress import Progress
from shapetween.timing.defaults import DURATION, FPS, MOST_FRAMES

if TYPE_CHECKING:
    from shapetween.photo.quads import PictureQuad
    from shapetween.raster.picture import Picture

__all__ = ["draw_over", "image"]


@click.command(
    epilog="Example:  shapetween image before.jpg after.jpg --quads boards.json -o swap.webp"
)
@A
@B
@click.option(
    "--quads",
    type=PATH,
    multiple=True,
    metavar="FILE",
    help="Which quads of A become which of B: JSON; or two SVGs, one drawn over each picture, "
    "with a four-sided polygon of the same id in both. Repeatable.",
)
@click.option(
    "--mesh",
    type=PATH,
    metavar="FILE.json",
    help="A mesh over both pictures instead, in pixels. With --method linear the edges of a mesh "
    "over whole pictures stay in place.",
)
@click.option(
    "--outlines",
    type=PATH,
    nargs=2,
    metavar="A.svg B.svg",
    help="Outlines drawn over both pictures instead; meshes are found inside them.",
)
@out_option(
    "OUT",
    "By its ending: .webp, .png or .apng, .gif, .mp4; none: a folder of PNG frames.  "
    "[default: A-to-B.webp]",
)
@click.option("--frames", type=Whole(2, MOST_FRAMES), metavar="N", help="How many frames.")
@click.option("--fps", type=Real(0.01, 240), metavar="N", help="Frames a second.  [default: 30]")
@click.option(
    "--duration",
    type=Real(0.01, 3600),
    metavar="SECONDS",
    help="Length of one way.  [default: 2]",
)
@click.option(
    "--size",
    type=Size(),
    metavar="WIDTH[xHEIGHT]",
    help="Of the frames. A and B are each scaled evenly to fit, and centred.  [default: A's]",
)
@click.option(
    "--background",
    metavar="fill|dissolve|keep|COLOR|FILE",
    help="Behind the quads: A that dissolves into B, what the quads leave behind being filled from "
    "around it; just that; A; a colour, or a picture.  [default: fill, with OpenCV; else dissolve]",
)
@easing_option("ease-in-out")
@loop_option("Stop at B, start again, or go back and forth. MP4 holds one turn of it.")
@method_option("How quads and meshes move.")
@click.option(
    "--slip",
    type=Real(0, 100_000),
    metavar="PIXELS",
    help="How far neighbours may part along a shared side before they are mapped bilinearly.  "
    "[default: 1]",
)
@click.option(
    "--max-megapixels",
    type=Real(0.001, 300),
    metavar="N",
    help="Largest picture that is read.  [default: 64]",
)
@report_option("Write what was moved, and how far neighbours part.")
@QUIET
def image(
    a: Path,
    b: Path,
    quads: tuple[Path, ...],
    mesh: Path | None,
    outlines: tuple[Path, Path] | None,
    out: Path | None,
    background: str | None,
    loop: str,
    report: Path | None,
    quiet: bool,
    **settings: Any,
) -> None:
    """Turn quads of picture A into quads of B, each as a plane seen in perspective.

    A and B may be one picture, whose boards then change places. Coordinates are pixels from the
    top left corner; parts of quads outside a picture are left out. Of crossing quads the one of
    greater "depth" is in front, at equal depth the larger one. Quads that share corners in both
    pictures move as one mesh.
    """
    from shapetween.io import files
    from shapetween.timing.easing import easing_function, even_times

    for path in (a, b):
        if path.suffix.lower() in (".svg", ".svgz"):
            raise OptionError(
                f"{path}: is a drawing; expected a picture, or 'shapetween morph A.svg B.svg -o "
                "OUT.webp', which keeps pictures in drawings"
            )
    ways = [bool(quads), mesh is not None, outlines is not None]
    if sum(ways) != 1:
        raise OptionError("expected one of --quads, --mesh or --outlines, to say what moves")
    if len(quads) > 2:
        raise OptionError(f"--quads: {len(quads)} files; expected one JSON or two SVGs")
    given = [*quads, *([mesh] if mesh else []), *(outlines or ())]
    if background is not None and Path(background).is_file():
        given.append(Path(background))
    out = out or Path(f"{a.stem}-to-{b.stem}.webp")
    files.check_outputs([out, *([report] if report else [])], [a, b, *given])
    if report is not None:
        files.check_file(report)
    count, fps = _timing(settings["frames"], settings["fps"], settings["duration"])
    easing = easing_function(settings["easing"])

    with Progress(quiet=quiet) as run:
        with run("import"):
            from shapetween.photo import sources
            from shapetween.photo.transition import SLIP_TOLERANCE, Transition
            from shapetween.raster import load
            from shapetween.raster.encode import Clock, writer_for
            from shapetween.raster.streams import counted, workers

            write = writer_for(out)
        megapixels = settings["max_megapixels"] or load.DEFAULT_MEGAPIXELS
        with run("read"):
            first = load.read_picture(a, megapixels)
            second = first if files.same_file(a, b) else load.read_picture(b, megapixels)
            behind = _background(background, megapixels)
            moving = sources.read_moving(
                (first, second), quads=quads, mesh=mesh, outlines=outlines, observe=run
            )
        with run("prepare"):
            tolerance = SLIP_TOLERANCE if settings["slip"] is None else settings["slip"]
            size = _size(settings["size"], first, megapixels)
            transition = Transition.between(
                first,
                second,
                moving.pieces,
                easing(even_times(count)),
                size=size,
                background=behind,
                method=settings["method"],
                tolerance=tolerance,
            )
        order = list(range(count))
        if loop == "alternate":
            order += order[-2:0:-1]
        frames = counted(transition.frames(order, workers()), len(order), run)
        write(out, frames, Clock(len(order), fps, loop != "once"))
        if report is not None:
            text = json.dumps(transition.report() | {"warnings": list(moving.warnings)}, indent=1)
            files.write_text(report, text + "\n")
    if quiet:
        return
    for path, picture in ((a, first), (b, second))[: 1 if first is second else 2]:
        warn(f"{path}: {warning}" for warning in picture.warnings)
    warn((*moving.warnings, *transition.warnings))
    if background is None and behind == "dissolve":
        warn(["what the quads leave behind is not filled: pip install shapetween[fill]"])
    wrote(out)


def draw_over(
    a: Path, b: Path | None, over: tuple[Path, ...], out: Path | None, common: Common
) -> None:
    """Draw what `mesh` was asked for over pictures: quads or a mesh in JSON, or outlines' mesh.

    Parameters
    ----------
    a, b : Path
        One JSON file, or an SVG over each picture.
    over : tuple of Path
        A's picture, or A's and B's.
    out : Path, optional
        A PNG.
    common : Common
    """
    from shapetween.io import files
    from shapetween.photo import overlay, sources
    from shapetween.raster.load import read_picture

    out = out or Path(f"{a.stem}-over-{over[0].stem}.png")
    if out.suffix.lower() != ".png":
        raise OptionError(f"{out}: with --over the mesh is drawn as .png")
    if len(over) > 2:
        raise OptionError(f"--over: {len(over)} pictures; expected A's, or A's and B's")
    given = [a, *([b] if b else []), *over]
    files.check_outputs([out], given)
    with Progress(quiet=common.quiet) as run:
        pictures = [read_picture(path) for path in over]
        quads: list[PictureQuad] = []
        if b is None:
            quads, meshes = sources.read_json(a)
        else:
            pieces = sources.meshes_in_outlines(
                (a, b),
                (pictures[0], pictures[-1]),
                run,
                method=common.method,
                quads=common.quads,
                pins=common.pins_of_pair,
            )
            meshes = [piece.pair for piece in pieces]
        sides: tuple[overlay.Side, ...] = ("a", "b")
        faces = [
            overlay.faces_of_quads(quads, side) + overlay.faces_of_meshes(meshes, side)
            for side in sides[: len(pictures)]
        ]
        overlay.write_overlay(out, pictures, faces)
    if not common.quiet:
        wrote(out)


def _timing(count: int | None, fps: float | None, duration: float | None) -> tuple[int, float]:
    """How many frames, and how many a second."""
    if count is not None and fps is not None and duration is not None:
        raise OptionError("--frames, --fps and --duration: expected at most two of the three")
    if count is None:
        fps = fps or FPS
        count = max(2, round(fps * (duration or DURATION)))
        if count > MOST_FRAMES:
            raise OptionError(f"--fps and --duration: {count} frames; expected {MOST_FRAMES}")
    elif fps is None:
        fps = count / duration if duration else FPS
    return count, fps


def _size(
    size: tuple[int, ...] | None, picture: "Picture", megapixels: float
) -> tuple[int, int] | None:
    """Width and height of the frames, None for A's."""
    if size is None:
        return None
    height = size[1] if len(size) > 1 else max(1, round(size[0] * picture.height / picture.width))
    if size[0] * height > megapixels * 1e6:
        raise OptionError(
            f"--size {size[0]}x{height}: more than the {megapixels:g} megapixels "
            "that --max-megapixels allows"
        )
    return size[0], height


def _background(
    value: str | None, megapixels: float
) -> "Picture | tuple[float, float, float, float] | str":
    """A background's picture or light, or its name."""
    if value is None:
        from shapetween.photo.filling import can_fill

        return "fill" if can_fill() else "dissolve"
    if value in ("fill", "dissolve", "keep"):
        return value
    from shapetween.photo.sources import light_of_colour
    from shapetween.raster.load import read_picture

    light = light_of_colour(value)
    if light is not None:
        return light
    if not Path(value).exists():
        raise OptionError(
            f"--background {value!r}: expected fill, dissolve, keep, a colour such as #fff, or a "
            "picture"
        )
    return read_picture(Path(value), megapixels)
