"""``python -m shapetween.truth``: print the error of every method in every kind of scene."""

import sys

import click

from shapetween.base.errors import ShapetweenError
from shapetween.io.progress import Progress
from shapetween.truth.table import format_table, table

HEAD = """\
Error at t = 1/4, 1/2, 3/4 as a share of the scene's radius: median / worst in percent, and the
share of scenes in which no other method was better. Views: distance of in-betweens from any view
of the solid. {count} scenes of each kind, seed {seed}.
"""


@click.command()
@click.option("--seed", type=int, default=0, show_default=True, help="Which scenes.")
@click.option("--count", type=int, default=40, show_default=True, help="Scenes of each kind.")
def truth(seed: int, count: int) -> None:
    """Compare all methods with what really happened, in generated scenes."""
    with Progress() as run:
        rows = table(seed, count, observe=run)
    click.echo(HEAD.format(seed=seed, count=count))
    click.echo(format_table(rows))


def main() -> None:
    """Run the command; what the user can put right becomes one line and exit code 2."""
    try:
        truth.main(prog_name="python -m shapetween.truth", standalone_mode=False)
    except (click.ClickException, ShapetweenError) as error:
        text = error.format_message() if isinstance(error, click.ClickException) else str(error)
        click.echo(f"shapetween: error: {' '.join(text.split())}", err=True)
        sys.exit(2)
    except (click.Abort, KeyboardInterrupt):
        click.echo("shapetween: stopped", err=True)
        sys.exit(130)


if __name__ == "__main__":
    main()
