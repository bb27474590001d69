"""Options that several commands share, and what a command on drawings does with them."""

import functools
import json
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from shapetween.base.errors import MeshError, OptionError
from shapetween.cli.legs import Match, Matching, OfLeg, Pin, by_leg
from shapetween.cli.messages import warn, wrote
from shapetween.cli.values import PATH, Name, Real, Whole
from shapetween.io.progress import Progress
from shapetween.timing import defaults

if TYPE_CHECKING:
    from shapetween.api import Morph
    from shapetween.formats.moving import Moving
    from shapetween.formats.table import Written

__all__ = [
    "METHOD_NAMES",
    "QUIET",
    "A",
    "B",
    "Common",
    "common",
    "duration_option",
    "easing_option",
    "loop_option",
    "method_option",
    "out_option",
    "report_option",
]

Option: TypeAlias = Callable[[Callable[..., None]], Callable[..., None]]
"""Adds an option to a command."""

#: `shapetween.interpolate.METHODS` by name, without importing it.
METHOD_NAMES = ("projective", "projective-2007", "arap", "arap-2000", "linear")

A = click.argument("a", type=PATH)
B = click.argument("b", type=PATH)
QUIET = click.option("-q", "--quiet", is_flag=True, help="Say nothing but errors.")


def out_option(metavar: str, text: str) -> Option:
    """Where to write, for a command that has a name of its own to propose."""
    return click.option("-o", "--out", type=PATH, metavar=metavar, help=text)


def duration_option(text: str) -> Option:
    """Seconds, 2 if left out."""
    return click.option(
        "--duration",
        type=Real(0.001, 86_400),
        default=defaults.DURATION,
        show_default=True,
        metavar="SECONDS",
        help=text,
    )


def easing_option(default: str = defaults.EASING) -> Option:
    """How evenly time goes by."""
    return click.option(
        "--easing",
        default=default,
        show_default=True,
        metavar="NAME",
        help="linear, ease, ease-in, ease-out, ease-in-out, cubic-bezier(x1,y1,x2,y2), "
        "spring(mass,stiffness,damping) or linear(0, .3 20%, 1); it may overshoot.",
    )


def loop_option(text: str) -> Option:
    """What comes after the end."""
    return click.option(
        "--loop",
        type=Name("once", "repeat", "alternate"),
        default="once",
        show_default=True,
        help=text,
    )


def method_option(text: str) -> Option:
    """What moves faces and meshes."""
    return click.option(
        "--method", type=Name(*METHOD_NAMES), default="projective", show_default=True, help=text
    )


def report_option(text: str) -> Option:
    """A file beside the output, for figures."""
    return click.option("--report", type=PATH, metavar="FILE.json", help=text)


@dataclass(frozen=True, slots=True)
class Common:
    """The options that every command on drawings takes."""

    method: str
    folds: str
    quads: int | None
    pins: tuple[OfLeg, ...]
    matches: tuple[OfLeg, ...]
    loose: bool
    strict: bool
    change: str | None
    mesh: Path | None
    matchings: tuple[OfLeg, ...]
    fit: str
    font: Path | None
    flip: str
    report: Path | None
    quiet: bool
    verbose: bool

    def prepare_all(
        self, drawings: Sequence[Path], out: Path, progress: Progress, *, pictures: bool = False
    ) -> "Moving":
        """Check the places to write to, then prepare the movement through two or more drawings."""
        if len(drawings) == 2:
            return self.prepare(drawings[0], drawings[1], out, progress, pictures=pictures)
        of_a_pair = {"--mesh": self.mesh, "--flip": self.flip != "none"}
        for name, value in of_a_pair.items():
            if value:
                raise OptionError(
                    f"{name}: concerns one pair, and here are {len(drawings)} drawings; "
                    "expected two, or none of it"
                )
        self.check_places(drawings, out)
        with progress("import"):
            from shapetween.api import chain
        known = self._of_legs(len(drawings) - 1)
        settings = self._for_any_pair()
        return chain(drawings, pictures=pictures, observe=progress, **known, **settings)

    def prepare(
        self, a: Path, b: Path, out: Path, progress: Progress, *, pictures: bool = False
    ) -> "Morph":
        """Check the places to write to, then prepare the movement."""
        settings = self.settings(a, b, out)
        with progress("import"):
            from shapetween.api import morph
        try:
            return morph(a, b, pictures=pictures, observe=progress, **settings)
        except MeshError as error:
            if self.mesh is None:
                raise
            raise MeshError(f"{self.mesh}: {error}") from error

    def settings(self, a: Path, b: Path, out: Path) -> dict[str, Any]:
        """Check the places to write to; what `shapetween.morph` takes besides the drawings."""
        from shapetween.io import files

        self.check_places([a, b, *([self.mesh] if self.mesh else [])], out)
        meshes: list[tuple[str, Any]] = []
        if self.mesh is not None:
            from shapetween.mesh.file import load_meshes

            meshes = load_meshes(files.read_text(self.mesh), str(self.mesh))
        return {
            **self._for_any_pair(),
            "pins": self.pins_of_pair,
            "matches": tuple(self._of_legs(1)["matches"].get(1, ())),
            "mesh": meshes,
            "matching": self.matching,
            "flip": self.flip,
        }

    @property
    def pins_of_pair(self) -> tuple[tuple[float, float, float, float], ...]:
        """The pins, where there is but one leg."""
        return tuple(self._of_legs(1)["pins"].get(1, ()))

    @property
    def matching(self) -> int:
        """Which matching is asked for, where there is but one leg."""
        return int(self._of_legs(1)["matching"].get(1, 1))

    def _of_legs(self, count: int) -> dict[str, Any]:
        """What is settled of each leg, as `shapetween.chain` takes it."""
        matchings = by_leg("--matching", self.matchings, count)
        for leg, some in matchings.items():
            if len(some) > 1:
                raise OptionError(f"--matching: {len(some)} of leg {leg}; expected one")
        return {
            "pins": by_leg("--pin", self.pins, count),
            "matches": by_leg("--match", self.matches, count),
            "matching": {leg: some[0] for leg, some in matchings.items()},
        }

    def check_places(self, inputs: Sequence[Path], out: Path) -> None:
        """Check that neither the output nor the report would overwrite anything that is read."""
        from shapetween.io import files

        files.check_outputs([out, *([self.report] if self.report else [])], inputs)
        if self.report is not None:
            files.check_file(self.report)

    def finish(
        self,
        result: "Moving",
        out: Path,
        made: "Written",
        run: Progress,
    ) -> None:
        """Write the output, and the report if one is wanted, and say what there is to say."""
        from shapetween.formats.table import put
        from shapetween.io import files

        report: dict[str, Any] = {}
        if self.report is not None or self.verbose:
            with run("check"):
                report = result.report()
            report["warnings"] += made.warnings
            report["notices"] += [notice.as_json() for notice in made.notices]
            report["seconds"] = {stage: round(value, 4) for stage, value in run.seconds.items()}
        with ExitStack() as stack:  # the report appears only once the output has been written
            if self.report is not None:
                fresh = stack.enter_context(files.fresh_file(self.report))
                fresh.write_text(json.dumps(report, indent=1) + "\n", "utf-8", newline="\n")
            put(out, made)
        run.close()
        if self.quiet:
            return
        warn((*result.warnings, *made.warnings))
        if self.verbose:
            click.echo(json.dumps(report, indent=1), err=True)
        wrote(out)

    def _for_any_pair(self) -> dict[str, Any]:
        """What serves every pair of a chain alike."""
        if self.loose and self.strict:
            raise OptionError("--loose and --strict: expected one of them at most")
        return {
            "method": self.method,
            "folds": self.folds,
            "quads": self.quads,
            "fit": self.fit,
            "font": self.font,
            "pairing": "loose" if self.loose else "strict" if self.strict else "normal",
            "change": self.change,
        }


#: The options of `Common`, in the order of the help.
_OPTIONS: tuple[Option, ...] = (
    method_option("How the mesh moves."),
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
        type=Whole(1, 10_000),
        metavar="N",
        help="About how many quads.  [default: as few as the shapes need]",
    ),
    click.option(
        "--pin",
        "pins",
        type=Pin(),
        multiple=True,
        help="A point of A and what it becomes in B, each in its file's own units. With more "
        "drawings say of which leg, as of --match and --matching: 2/AX,AY:BX,BY is from the second "
        "to the third. Repeatable.",
    ),
    click.option(
        "--match",
        "matches",
        type=Match(),
        multiple=True,
        help="Ids of a shape of A and the shape of B that it becomes, or #N for the N-th. Of one "
        "side there may be several, a:b1,b2, or none: a: goes and :b comes alone. Repeatable.",
    ),
    click.option(
        "--loose",
        is_flag=True,
        help="Let parts become others more readily than come and go, even those of drawings that "
        "have little in common.",
    ),
    click.option("--strict", is_flag=True, help="Let parts come and go more readily."),
    click.option(
        "--change",
        type=Name("fade", "draw", "grow", "slide"),
        help="How parts without a partner come and go.  [default: each as it lies]",
    ),
    click.option(
        "--mesh",
        type=PATH,
        metavar="FILE.json",
        help="A mesh from 'shapetween mesh', perhaps edited, or drawn by hand.",
    ),
    click.option(
        "--matching",
        "matchings",
        type=Matching(),
        multiple=True,
        help="Which of the distinct ways for one outline to become the other, the best being 1; "
        "see 'shapetween alternatives'. Repeatable, of other legs.",
    ),
    click.option(
        "--fit",
        type=Name("view", "geometry", "none"),
        default="view",
        show_default=True,
        help="Fit B's view box into A's, B's drawn box into A's, or leave B as it is.",
    ),
    click.option(
        "--font",
        type=PATH,
        metavar="DIR",
        help="A folder with fonts for text, looked at before those installed.",
    ),
    click.option(
        "--flip",
        type=Name("none", "b"),
        default="none",
        show_default=True,
        help="Mirror B about its upright axis first, where the two face opposite ways.",
    ),
    report_option("Write how the movement was found, and its figures."),
    QUIET,
    click.option("-v", "--verbose", is_flag=True, help="Say how the movement was found."),
)


def common(function: Callable[..., None]) -> Callable[..., None]:
    """Add the options of `Common`, handed over as one argument of that name."""

    @functools.wraps(function)
    def gathered(**values: Any) -> None:
        shared = Common(**{field.name: values.pop(field.name) for field in fields(Common)})
        if shared.quiet and shared.verbose:
            raise OptionError("--quiet and --verbose: expected one of them at most")
        function(common=shared, **values)

    command: Callable[..., None] = gathered
    for option in reversed(_OPTIONS):
        command = option(command)
    return command
