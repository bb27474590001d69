"""The command that draws the gallery anew."""

from pathlib import Path

import click

from shapetween.base.errors import OptionError
from shapetween.cli.messages import wrote
from shapetween.cli.options import QUIET
from shapetween.cli.values import PATH
from shapetween.io.progress import Progress

__all__ = ["gallery"]


@click.command(epilog="Example:  shapetween gallery -o gallery")
@click.option(
    "-o",
    "--out",
    type=PATH,
    default=Path("gallery"),
    show_default=True,
    metavar="DIR",
    help="Folder for index.html and its pictures, made if it is not there.",
)
@QUIET
def gallery(out: Path, quiet: bool) -> None:
    """Draw the figures of the paper and a showcase, and a page that shows them.

    The same version draws the same files.
    """
    with Progress(quiet=quiet) as run:
        with run("import"):
            from shapetween.gallery import (
                draw_rooms,
                gallery_folder,
                index_html,
                write_pictures,
            )
            from shapetween.io import files

            folder = gallery_folder()
        if out.exists() and not out.is_dir():
            raise OptionError(f"{out}: is a file; expected a folder for the gallery")
        files.check_outputs([out / "index.html"] if out.is_dir() else [out], [])
        rooms = draw_rooms(folder, run)
        with run("write"):
            try:
                out.mkdir(exist_ok=True)
            except OSError as error:
                raise OptionError(f"{out}: not a folder that can be written to") from error
            write_pictures(rooms, out)
            files.write_text(out / "index.html", index_html(rooms))
    if not quiet:
        wrote(out / "index.html")
