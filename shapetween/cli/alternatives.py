"""The command that shows what else may become what."""

from pathlib import Path

import click

from shapetween.cli.options import A, B, Common, common, duration_option, out_option
from shapetween.io.progress import Progress

__all__ = ["alternatives"]


@click.command(epilog="Example:  shapetween alternatives cat.svg dog.svg -o cat-and-dog.html")
@A
@B
@out_option("OUT.html", "A page.  [default: A-to-B-alternatives.html]")
@duration_option("Length of one way.")
@common
def alternatives(a: Path, b: Path, out: Path | None, duration: float, common: Common) -> None:
    """Show the distinct ways in which one outline may become the other, as a page.

    Under each is the option that takes it: --matching K, for morph and frames.
    """
    from shapetween.base.errors import OptionError
    from shapetween.formats.table import Written
    from shapetween.io import files

    path = out or Path(f"{a.stem}-to-{b.stem}-alternatives.html")
    files.check_form(path, "a page of alternatives", (".html", ".htm"))
    if common.matchings:
        raise OptionError("--matching: all are shown; expected none here")
    with Progress(quiet=common.quiet) as run:
        settings = common.settings(a, b, path)
        with run("import"):
            from shapetween.compare.alternatives import alternatives as made
        result = made(a, b, (a.name, b.name), observe=run, **settings)
        with run("write"):
            text = result.html(duration=duration)
        common.finish(result.morphs[0], path, Written(text), run)
