"""The command line: arguments to library calls, files, and exit codes.

Heavy modules are imported inside the commands, so that help and a wrong option come at once.
"""

import difflib
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from shapetween.errors import OptionError, ShapetweenError

__all__ = ["cli", "main"]

#: `shapetween.interpolate.METHODS` by name, without importing it.
METHOD_NAMES = ("projective",)

FunctionT = TypeVar("FunctionT", bound=Callable[..., Any])


class Pin(click.ParamType):
    """``AX,AY:BX,BY``: a point of A and the point of B that it becomes."""

    name = "AX,AY:BX,BY"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the four numbers."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(x) for half in str(value).split(":") for x in half.split(","))
        except ValueError:
            numbers = ()
        if len(numbers) != 4 or str(value).count(":") != 1:
            self.fail(f"{value!r} is not AX,AY:BX,BY, such as 12,30.5:14,28")
        return numbers


class Name(click.ParamType):
    """One of a few names; a wrong one is answered with the nearest."""

    name = "name"

    def __init__(self, *choices: str) -> None:
        self.choices = choices

    def get_metavar(self, param: click.Parameter, ctx: click.Context) -> str:
        """List the names in the help."""
        return "[" + "|".join(self.choices) + "]"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Check the name."""
        if value in self.choices:
            return value
        near = difflib.get_close_matches(str(value), self.choices, n=1, cutoff=0.4)
        hint = f"did you mean {near[0]}?" if near else f"expected {', '.join(self.choices)}"
        self.fail(f"{value!r} is not known; {hint}")


class Keyframes(click.ParamType):
    """``auto``, or how many keyframes."""

    name = "auto|N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the number."""
        if value == "auto" or isinstance(value, int):
            return value
        if not (str(value).isdecimal() and int(value) >= 2):
            self.fail(f"{value!r} is neither 'auto' nor a number of 2 or more")
        return int(value)


def common(function: FunctionT) -> FunctionT:
    """Add the options that every command on a pair takes."""
    for option in reversed(
        [
            click.option(
                "--method",
                type=Name(*METHOD_NAMES),
                default="projective",
                show_default=True,
                help="How the mesh moves.",
            ),
            click.option(
                "--quads",
                type=click.IntRange(1, 10_000),
                metavar="N",
                help="About how many quads.  [default: as few as the shapes need]",
            ),
            click.option(
                "--pin",
                "pins",
                type=Pin(),
                multiple=True,
                help="A point of A and what it becomes in B, each in its file's own units. "
                "Repeatable.",
            ),
            click.option(
                "--mesh",
                type=click.Path(path_type=Path),
                metavar="FILE.json",
                help="A mesh from 'shapetween mesh', perhaps edited, or drawn by hand.",
            ),
            click.option(
                "--fit",
                type=Name("view", "geometry", "none"),
                default="view",
                show_default=True,
                help="Fit B's view box into A's, B's drawn box into A's, or leave B as it is.",
            ),
            click.option(
                "--precision",
                type=click.IntRange(0, 12),
                metavar="N",
                help="Decimals of coordinates.  [default: by the size of the view box]",
            ),
            click.option(
                "--report",
                type=click.Path(path_type=Path),
                metavar="FILE.json",
                help="Write how the movement was found, and its figures.",
            ),
            click.option("-q", "--quiet", is_flag=True, help="Say nothing but errors."),
            click.option("-v", "--verbose", is_flag=True, help="Say how the movement was found."),
        ]
    ):
        function = option(function)
    return function


@click.group(
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Example:  shapetween morph cat.svg dog.svg -o cat-to-dog.svg",
)
@click.version_option(package_name="shapetween")
def cli() -> None:
    """Turn two SVG drawings into the movement between them."""


@cli.command(epilog="Example:  shapetween morph cat.svg dog.svg --duration 1.5 --loop alternate")
@click.argument("a", type=click.Path(path_type=Path))
@click.argument("b", type=click.Path(path_type=Path))
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
    default="ease-in-out",
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
def morph(
    a: Path,
    b: Path,
    out: Path | None,
    duration: float,
    easing: str,
    loop: str,
    keyframes: int | str,
    precision: int | None,
    **options: Any,
) -> None:
    """Write one animated SVG that moves from A to B.

    It plays in every browser, in <img> too, without a script.
    """
    from shapetween.frames import easing_function

    easing_function(easing)
    path = out or Path(f"{a.stem}-to-{b.stem}.svg")
    with _Run(a, b, path, **options) as run:
        with run.progress("write"):
            text = run.result.svg(
                duration=duration,
                easing=easing,
                loop=loop,
                keyframes=keyframes,
                precision=precision,
            )
        run.write(path, text)


@cli.command(epilog="Example:  shapetween frames cat.svg dog.svg -o frames --frames 48")
@click.argument("a", type=click.Path(path_type=Path))
@click.argument("b", type=click.Path(path_type=Path))
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
def frames(
    a: Path,
    b: Path,
    out: Path | None,
    count: int,
    easing: str,
    precision: int | None,
    **options: Any,
) -> None:
    """Write one SVG a frame, the first drawing A and the last drawing B."""
    from shapetween.frames import easing_function, even_times

    ease = easing_function(easing)
    folder = out or Path(f"{a.stem}-to-{b.stem}")
    with _Run(a, b, folder, **options) as run:
        with run.progress("write"):
            from shapetween.svg.sequence import frame_svg

            drawings = run.result.prepared.movement.at(ease(even_times(count)))
            texts = [frame_svg(drawing, precision) for drawing in drawings]
        run.write(folder, texts)


@cli.command(epilog="Example:  shapetween mesh cat.svg dog.svg -o cat-to-dog-mesh.svg")
@click.argument("a", type=click.Path(path_type=Path))
@click.argument("b", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    metavar="OUT.svg|OUT.json",
    help="A picture of both meshes, or the mesh itself.  [default: A-to-B-mesh.svg]",
)
@common
def mesh(a: Path, b: Path, out: Path | None, precision: int | None, **options: Any) -> None:
    """Show what goes where: both shapes with numbered quads and matched nodes.

    Ending in .json, OUT is a mesh to keep, edit and give back with --mesh.
    """
    path = out or Path(f"{a.stem}-to-{b.stem}-mesh.svg")
    if path.suffix.lower() not in (".svg", ".json"):
        raise OptionError(f"{path}: a mesh is written as .svg or .json")
    with _Run(a, b, path, **options) as run:
        with run.progress("write"):
            text = (
                run.result.mesh_json()
                if path.suffix.lower() == ".json"
                else (run.result.mesh_svg((a.name, b.name)))
            )
        run.write(path, text)


class _Run:
    """One command on a pair: prepared on entry; what it writes is written at the end, or not."""

    def __init__(
        self,
        a: Path,
        b: Path,
        out: Path,
        *,
        method: str,
        quads: int | None,
        pins: tuple[tuple[float, float, float, float], ...],
        mesh: Path | None,
        fit: str,
        report: Path | None,
        quiet: bool,
        verbose: bool,
    ) -> None:
        from shapetween import files
        from shapetween.progress import Progress

        files.check_outputs([out, *([report] if report else [])], [a, b, *([mesh] if mesh else [])])
        self._paths = a, b
        self._settings = {"method": method, "quads": quads, "pins": pins, "fit": fit}
        self._mesh, self._report, self._quiet, self._verbose = mesh, report, quiet, verbose
        self.progress = Progress(quiet=quiet)

    def __enter__(self) -> "_Run":
        with_progress = self.progress.__enter__()
        try:
            with with_progress("import"):
                from shapetween import files
                from shapetween.morph import morph
            meshes = None
            if self._mesh is not None:
                from shapetween.meshfile import load_meshes

                text = files.read_text(self._mesh)
                meshes = dict(load_meshes(text, str(self._mesh)))
            self.result = morph(*self._paths, mesh=meshes, observe=self.progress, **self._settings)
        except BaseException:
            self.progress.__exit__()
            raise
        return self

    def write(self, path: Path, content: str | list[str]) -> None:
        """Write a file, or a folder of frames, and the report if one is wanted."""
        from shapetween import files

        report = self.result.report(self.progress.seconds)
        if isinstance(content, str):
            files.write_text(path, content)
        else:
            files.write_frames(path, content)
        if self._report is not None:
            files.write_text(self._report, json.dumps(report, indent=1) + "\n")
        self.progress.__exit__()
        if self._quiet:
            return
        for warning in self.result.warnings:
            click.echo(f"shapetween: warning: {warning}", err=True)
        if self._verbose:
            click.echo(json.dumps(report, indent=1), err=True)
        click.echo(f"wrote {path}")

    def __exit__(self, *_: object) -> None:
        self.progress.__exit__()


def main() -> None:
    """Run the command line; whatever the user can mend becomes one line and exit code 2."""
    try:
        code = cli.main(prog_name="shapetween", standalone_mode=False)
    except click.ClickException as error:
        _fail(error.format_message())
    except ShapetweenError as error:
        _fail(str(error))
    except (click.Abort, KeyboardInterrupt):
        click.echo("shapetween: stopped", err=True)
        sys.exit(130)
    else:
        sys.exit(code if isinstance(code, int) else 0)


def _fail(message: str) -> None:
    line = " ".join(message.split())
    click.echo(f"shapetween: error: {line}", err=True)
    sys.exit(2)
