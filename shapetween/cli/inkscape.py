"""The command that puts the extension into Inkscape."""

from pathlib import Path

import click

from shapetween.base.errors import OptionError
from shapetween.cli.values import PATH

__all__ = ["inkscape"]


@click.command(epilog="Example:  shapetween inkscape --install")
@click.option("--install", "put", is_flag=True, help="Put the extension there.")
@click.option("--uninstall", "take", is_flag=True, help="Take it away again.")
@click.option(
    "--folder",
    type=PATH,
    metavar="DIR",
    help="Inkscape's folder for extensions.  [default: the one that Inkscape names]",
)
def inkscape(put: bool, take: bool, folder: Path | None) -> None:
    """Make in-betweens inside Inkscape: an extension that calls this program.

    After a new start of Inkscape it is under Extensions > Generate from Path.
    """
    from shapetween.inkscape import extensions_folder, install, uninstall

    place = extensions_folder() if folder is None else folder
    if put == take:
        raise OptionError(f"expected either --install or --uninstall; the folder is {place}")
    done = install(place) if put else uninstall(place)
    for path in done:
        click.echo(f"{'wrote' if put else 'removed'} {path}")
    if not done:
        click.echo(f"there was nothing to remove in {place}")
