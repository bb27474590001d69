"""Options that several commands share, and what a command on a pair of drawings does with them."""

import difflib
import functools
import json
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from shapetween.errors import MeshError
from shapetween.progress import Progress

if TYPE_CHECKING:
    from shapetween.api import Morph

__all__ = ["METHOD_NAMES", "A", "B", "Common", "Keyframes", "Match", "Name", "Pin", "common"]

#: `shapetween.interpolate.METHODS` by name, without importing it.
METHOD_NAMES = ("projective", "projective-2007", "arap", "arap-2000", "linear")


class Pin(click.ParamType[Any]):
    """``AX,AY:BX,BY``: a point of A and the point of B that it becomes."""

    name = "AX,AY:BX,BY"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the four numbers."""
        if isinstance(value, tuple):
            return value
        halves = [half.split(",") for half in str(value).split(":")]
        try:
            numbers = tuple(float(x) for half in halves for x in half)
        except ValueError:
            numbers = ()
        if not numbers or [len(half) for half in halves] != [2, 2]:
            self.fail(f"{value!r} is not AX,AY:BX,BY, such as 12,30.5:14,28")
        return numbers


class Match(click.ParamType[Any]):
    """``IDA:IDB``: a shape of A and the shape of B that it becomes."""

    name = "IDA:IDB"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Split at the colon."""
        if isinstance(value, tuple):
            return value
        first, colon, second = str(value).partition(":")
        if not (first and colon and second):
            self.fail(f"{value!r} is not IDA:IDB, such as tail:tail-fin")
        return first, second


class Name(click.ParamType[Any]):
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
        return self.fail(f"{value!r} is not known; {hint}")


class Keyframes(click.ParamType[Any]):
    """``auto``, or how many keyframes."""

    name = "auto|N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the number."""
        if value == "auto" or isinstance(value, int):
            return value
        if not (str(value).isdecimal() and int(value) >= 2):
            self.fail(f"{value!r} is neither 'auto' nor a number of 2 or more")
        return int(value)


@dataclass(frozen=True, slots=True)
class Common:
    """The options that every command on a pair takes."""

    method: str
    folds: str
    quads: int | None
    pins: tuple[tuple[float, float, float, float], ...]
    matches: tuple[tuple[str, str], ...]
    mesh: Path | None
    fit: str
    precision: int | None
    report: Path | None
    quiet: bool
    verbose: bool

    def prepare(self, a: Path, b: Path, out: Path, progress: Progress) -> "Morph":
        """Check the places to write to, then prepare the movement."""
        settings = self.settings(a, b, out)
        with progress("import"):
            from shapetween.api import morph
        try:
            return morph(a, b, observe=progress, **settings)
        except MeshError as error:
            if self.mesh is None:
                raise
            raise MeshError(f"{self.mesh}: {error}") from error

    def settings(self, a: Path, b: Path, out: Path) -> dict[str, Any]:
        """Check the places to write to; what `shapetween.morph` takes besides the drawings."""
        from shapetween import files

        outputs = [out, *([self.report] if self.report else [])]
        files.check_outputs(outputs, [a, b, *([self.mesh] if self.mesh else [])])
        meshes: list[tuple[str, Any]] = []
        if self.mesh is not None:
            from shapetween.meshfile import load_meshes

            meshes = load_meshes(files.read_text(self.mesh), str(self.mesh))
        return {
            "method": self.method,
            "folds": self.folds,
            "quads": self.quads,
            "pins": self.pins,
            "mesh": meshes,
            "fit": self.fit,
        }

    def finish(self, result: "Morph", out: Path, content: str | list[str], run: Progress) -> None:
        """Write the output, and the report if one is wanted, and say what there is to say."""
        from shapetween import files

        with run("check"):
            report = result.report()
        report["seconds"] = {stage: round(value, 4) for stage, value in run.seconds.items()}
        with ExitStack() as stack:  # the report appears only once the output has been written
            if self.report is not None:
                fresh = stack.enter_context(files.fresh_file(self.report))
                fresh.write_text(json.dumps(report, indent=1) + "\n", "utf-8", newline="\n")
            if isinstance(content, str):
                files.write_text(out, content)
            else:
                files.write_frames(out, content)
        run.close()
        if self.quiet:
            return
        for warning in result.warnings:
            click.echo(f"shapetween: warning: {warning}", err=True)
        if self.verbose:
            click.echo(json.dumps(report, indent=1), err=True)
        click.echo(f"wrote {out}")


def common(function: Callable[..., None]) -> Callable[..., None]:
    """Add the options of `Common`, handed over as one argument of that name."""

    @functools.wraps(function)
    def gathered(**values: Any) -> None:
        shared = Common(**{field.name: values.pop(field.name) for field in fields(Common)})
        function(common=shared, **values)

    command: Callable[..., None] = gathered
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
                "--folds",
                type=Name("prevent", "allow"),
                default="prevent",
                show_default=True,
                help="Move the plane around the shape along, so that nothing folds; or move the "
                "bare mesh, as the paper does.",
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
                "--match",
                "matches",
                type=Match(),
                multiple=True,
                help="Ids of a shape of A and the shape of B that it becomes. Repeatable.",
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
        command = option(command)
    return command


A = click.argument("a", type=click.Path(path_type=Path))
B = click.argument("b", type=click.Path(path_type=Path))
