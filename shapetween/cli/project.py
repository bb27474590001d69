"""A project of the studio on the command line: its drawings, and defaults of its own."""

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from shapetween.base.errors import OptionError
from shapetween.cli.legs import OfLeg
from shapetween.cli.values import PATH

__all__ = ["project_option"]


def project_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add the option; what the command line says besides goes before what the project says."""
    return click.option(
        "--project",
        type=PATH,
        metavar="FILE.json",
        is_eager=True,
        expose_value=False,
        callback=_read,
        help="Instead of drawings: work saved in the studio, with its pins and options, which "
        "others here replace.",
    )(command)


def no_drawings_beside() -> None:
    """Check that a project, if the running command is given one, stands alone.

    Raises
    ------
    OptionError
        If there are drawings beside it.
    """
    ctx = click.get_current_context()
    given = [ctx.get_parameter_source(name) for name in ("a", "b")]
    if ctx.default_map and ParameterSource.COMMANDLINE in given:
        raise OptionError("--project: has drawings of its own; expected no others beside it")


def _read(ctx: click.Context, param: click.Parameter, path: Path | None) -> None:
    """Make what the project says the defaults of the command."""
    del param
    if path is None or ctx.resilient_parsing:
        return
    from shapetween.io import files
    from shapetween.studio.project import plain_name, project_of
    from shapetween.studio.settings import SETTINGS

    def beside(name: str) -> bytes:
        return files.read_bytes(path.parent / name)

    project = project_of(files.read_text(path), str(path), beside)
    folder = Path(ctx.with_resource(tempfile.TemporaryDirectory(prefix="shapetween-")))
    places: dict[str, Path] = {}
    for k, (name, data) in enumerate(project.files.items(), start=1):
        place = folder / plain_name(name)
        if place.exists():  # two that differ in what names may not hold
            place = folder / f"{k}-{plain_name(name)}"
        place.write_bytes(data)
        places[name] = place
    a, b, *more = (places[name] for name in project.job.drawings)
    legs = project.job.legs
    values: dict[str, Any] = {"a": a, "b": b, "more": tuple(more)}
    for setting in SETTINGS:
        if setting.name in project.job.options:
            value = project.job.options[setting.name]
            values.update({value: True} if value in setting.flags else {setting.name: value})
    several = len(legs) > 1
    known: dict[str, list[OfLeg]] = {"pins": [], "matches": [], "matchings": []}
    for k, leg in enumerate(legs, start=1):
        at = k if several else None
        known["pins"] += [OfLeg(at, pin) for pin in leg.pins]
        known["matches"] += [OfLeg(at, tuple(match.split(":", 1))) for match in leg.matches]
        known["matchings"] += [OfLeg(at, leg.matching)] if leg.matching != 1 else []
    values |= {name: some for name, some in known.items() if some}
    ctx.default_map = {**(ctx.default_map or {}), **values}
