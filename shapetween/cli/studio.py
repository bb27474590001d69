"""The command that opens the studio."""

import secrets
import tempfile
import webbrowser
from pathlib import Path

import click

from shapetween.cli.values import PATH, Whole

__all__ = ["studio"]


@click.command(epilog="Example:  shapetween studio cat.svg dog.svg")
@click.argument("drawings", type=PATH, nargs=-1, metavar="[A B]... | [PROJECT.json]")
@click.option(
    "--port", type=Whole(0, 65535), default=0, metavar="N", help="Of this machine.  [default: any]"
)
@click.option("--no-open", is_flag=True, help="Print the address, and open no browser.")
def studio(drawings: tuple[Path, ...], port: int, no_open: bool) -> None:
    """Open a page where the matching can be seen, set right by dragging, and saved.

    It is served by this program to this machine alone, and asks nothing of any other. Drawings can
    be dropped on it, too. End it with Ctrl-C.
    """
    from shapetween.studio.server import Server
    from shapetween.studio.session import Session

    with tempfile.TemporaryDirectory(prefix="shapetween-studio-") as folder:
        session = Session(Path(folder))
        try:
            session.open_paths(list(drawings))
            server = Server(session, secrets.token_urlsafe(24), port)
            thread = server.start()
            try:  # from here on: who reads the address may end it at once
                click.echo(f"The studio is at {server.address}\nEnd it with Ctrl-C.")
                if not no_open:
                    webbrowser.open(server.address)
                while thread.is_alive():
                    thread.join(1.0)
            except KeyboardInterrupt:
                click.echo("\nThe studio has ended.")
            finally:
                server.shutdown()
                server.server_close()
        finally:
            session.close()
