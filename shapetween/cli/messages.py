"""Messages of commands about what they have done."""

from collections.abc import Iterable
from pathlib import Path

import click

from shapetween.base.errors import OptionError

__all__ = ["warn", "wrote"]


def warn(warnings: Iterable[str]) -> None:
    """Tell what was lost or is doubtful, on the error stream, a line each."""
    for warning in warnings:
        click.echo(f"shapetween: warning: {' '.join(warning.split())}", err=True)


def wrote(place: Path, what: str = "") -> None:
    """Tell that something, else the file itself, has been written.

    Of a device there is no message: it may be the very stream that shows the message.

    Raises
    ------
    OptionError
        If the message cannot be shown, as on a full disk.
    """
    from shapetween.io.files import is_device

    if is_device(place):
        return
    try:
        click.echo(f"wrote {what}{place}")
    except BrokenPipeError:  # nobody listens any more, which `main` knows how to end
        raise
    except OSError as error:
        raise OptionError(f"{place} is written, but standard output cannot be") from error
