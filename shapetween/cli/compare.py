"""The command that shows methods side by side."""

from pathlib import Path

import click

from shapetween.cli.options import (
    A,
    B,
    Common,
    common,
    duration_option,
    out_option,
)
from shapetween.io.progress import Progress

__all__ = ["compare"]


@click.command(epilog="Example:  shapetween compare cat.svg dog.svg -o cat-and-dog.html")
@A
@B
@out_option(
    "OUT.html|OUT.svg|OUT.json",
    "A page, the animations alone, or the figures.  [default: A-to-B-compared.html]",
)
@duration_option("Length of one way, of the animations alone (OUT.svg).")
@common
def compare(a: Path, b: Path, out: Path | None, duration: float, common: Common) -> None:
    """Show every method on one pair, with figures: a page that needs nothing else.

    First comes --method where folds are prevented, then every method by itself. All share one
    matching and one mesh. A method that fails is shown with the reason in its place.
    """
    from shapetween.formats.table import Written
    from shapetween.io import files

    path = out or Path(f"{a.stem}-to-{b.stem}-compared.html")
    form = files.check_form(path, "a comparison", (".html", ".htm", ".svg", ".json"))
    with Progress(quiet=common.quiet) as run:
        with run("import"):
            from shapetween.compare import compare as compare_methods
        result = compare_methods(a, b, observe=run, **common.settings(a, b, path))
        with run("write"):
            if form == ".json":
                text = result.json()
            elif form == ".svg":
                text = result.svg(duration=duration)
            else:
                text = result.html()
        common.finish(result.morph, path, Written(text), run)
