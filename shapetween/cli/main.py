"""The group of all commands, each imported only when it is asked for, and the exit codes."""

import gc
import os
import sys
from importlib import import_module

import click

from shapetween.base.errors import ShapetweenError
from shapetween.base.threads import ONE_THREAD

__all__ = ["cli", "main"]

#: Every command: the module it lives in, and its line in the help.
COMMANDS = {
    "morph": ("shapetween.cli.pair", "Write one animated SVG that moves from A to B."),
    "frames": ("shapetween.cli.pair", "Write one SVG a frame."),
    "mesh": ("shapetween.cli.pair", "Show what goes where, or keep the mesh."),
    "compare": ("shapetween.cli.compare", "Show every method side by side, with figures."),
    "alternatives": ("shapetween.cli.alternatives", "Show what else may become what."),
    "studio": ("shapetween.cli.studio", "See the matching, drag it right, save the movement."),
    "inkscape": ("shapetween.cli.inkscape", "Make in-betweens inside Inkscape."),
    "batch": ("shapetween.cli.batch", "Make many pairs at once."),
    "image": ("shapetween.cli.image", "Turn quads of a picture into quads of another."),
    "gallery": ("shapetween.cli.gallery", "Draw the paper's figures and a showcase, as a page."),
}

#: Objects that come to be, more than go, before it is looked for circles of such as nobody uses.
#: The usual 700 come with every other module, of which all stay: a twentieth of the time of a
#: command went for that. Many more, and a folder of pairs piles up.
COLLECTED = 20_000


class Commands(click.Group):
    """Commands that are imported by name, so that help and a wrong option come at once."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names in the order of the help."""
        del ctx
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import one command."""
        del ctx
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = getattr(import_module(COMMANDS[cmd_name][0]), cmd_name)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command, or say which it may be."""
        if args[0] not in COMMANDS and not args[0].startswith("-"):
            from shapetween.cli.values import nearest

            ctx.fail(f"No such command {args[0]!r}; {nearest(args[0], COMMANDS)}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without importing them."""
        del ctx
        with formatter.section("Commands"):
            formatter.write_dl([(name, line) for name, (_, line) in COMMANDS.items()])


def _show_version(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    del param
    if value and not ctx.resilient_parsing:
        from shapetween.base.version import installed_version

        click.echo(f"shapetween, version {installed_version()}")
        ctx.exit()


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Example:  shapetween morph cat.svg dog.svg -o cat-to-dog.svg",
)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_version,
    help="Show the version and exit.",
)
def cli() -> None:
    """Turn two SVG drawings into the movement between them."""


def main() -> None:
    """Run the command line; whatever the user can mend becomes one line and exit code 2."""
    os.environ.setdefault(*ONE_THREAD)
    gc.set_threshold(COLLECTED)
    try:
        code = cli.main(prog_name="shapetween", standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        sys.exit(2)
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
    click.echo(f"shapetween: error: {' '.join(message.split())}", err=True)
    sys.exit(2)
