"""The command `viscorig`: its commands, and one line instead of a traceback."""

import sys
from importlib import import_module
from importlib.metadata import version

import click

from fitting.errors import FittingError
from instrument.errors import BadInput

BAD_INPUT = 2
STOPPED_BY_USER = 130

COMMANDS = ("modes", "predict", "damping", "identify", "demo", "bench")
"""Each is a function of that name in the module of that name beside this file."""


class _Commands(click.Group):
    """Loads a command when it is asked for: the program answers at once."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """In the order of the work."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """The command, or None where there is none of that name."""
        if name not in COMMANDS:
            return None
        found = getattr(import_module(f"instrument.cli.{name}"), name)
        return found if isinstance(found, click.Command) else None


@click.group(
    cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100}
)
@click.version_option(version("viscorig"), prog_name="viscorig")
def viscorig() -> None:
    """Measure damping materials: a core's complex shear modulus from a plate's response."""


def main(arguments: list[str] | None = None) -> None:
    """Run and exit: 0 done, 2 bad input or usage, 130 stopped by the user."""
    sys.exit(run(arguments))


def run(arguments: list[str] | None = None) -> int:
    """Run one command; its exit status."""
    try:
        status = viscorig.main(arguments, prog_name="viscorig", standalone_mode=False)
        return status if isinstance(status, int) else 0
    except click.exceptions.NoArgsIsHelpError as asked:
        click.echo(asked.format_message(), err=True)
        return BAD_INPUT
    except click.ClickException as error:
        return _refuse(error.format_message())
    except (BadInput, FittingError) as error:
        return _refuse(str(error))
    except (click.Abort, KeyboardInterrupt):
        click.echo("viscorig: stopped", err=True)
        return STOPPED_BY_USER
    except BrokenPipeError:
        # The reader of our output has gone; nothing is left to say.
        sys.stderr.close()
        return 0


def _refuse(message: str) -> int:
    click.echo("viscorig: " + " ".join(message.split()), err=True)
    return BAD_INPUT
