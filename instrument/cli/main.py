"""The command `viscorig`: its commands, and one line instead of a traceback."""

import os
import sys
from contextlib import suppress
from importlib import import_module
from importlib.metadata import entry_points, version
from keyword import iskeyword

import click

from drivers.errors import DriverError
from fitting.errors import FittingError
from instrument.errors import BadInput, RigStopped, StoppedByUser
from instrument.models.background import VARIABLE as BACKGROUND
from instrument.models.background import step_back

BAD_INPUT = 2
RIG_STOPPED = 3
STOPPED_BY_USER = 130

COMMANDS = (
    "demo",
    "check",
    "run",
    "hammer",
    "sweep",
    "simulate",
    "replay",
    "recover",
    "modes",
    "predict",
    "damping",
    "identify",
    "diagnose",
    "report",
    "export",
    "import",
    "bench",
)
"""Each is a function of that name in the module of that name beside this file (or `import_`)."""
ELSEWHERE = "viscorig.commands"
"""Entry points of this group are commands too: so rooms above this one add theirs."""


class _Commands(click.Group):
    """Loads a command when it is asked for: the program answers at once."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """In the order of the work."""
        return [*COMMANDS, *sorted(entry_points(group=ELSEWHERE).names)]

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """The command, or None where there is none of that name."""
        if name in COMMANDS:
            known = f"{name}_" if iskeyword(name) else name
            found = getattr(import_module(f"instrument.cli.{known}"), known)
        else:
            found = next((e.load() for e in entry_points(group=ELSEWHERE, name=name)), None)
        return found if isinstance(found, click.Command) else None


@click.group(
    cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100}
)
@click.version_option(version("viscorig"), prog_name="viscorig")
def viscorig() -> None:
    """Measure damping materials: a core's complex shear modulus from a plate's response."""


def main(arguments: list[str] | None = None) -> None:
    """Run and exit: 0 done, 2 bad input or usage, 3 the rig stopped itself, 130 stopped by the user."""
    if os.environ.get(BACKGROUND):
        step_back()
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
    except (RigStopped, DriverError) as error:
        _say(str(error))
        return RIG_STOPPED
    except StoppedByUser as stop:
        _say(f"stopped: {stop}")
        return STOPPED_BY_USER
    except (click.Abort, KeyboardInterrupt):
        _say("stopped")
        return STOPPED_BY_USER
    except BrokenPipeError:
        # The reader of our output has gone; nothing is left to say.
        sys.stderr.close()
        return 0
    except OSError as error:
        return _refuse(f"{error.filename or 'output'}: {error.strerror or error}")


def _refuse(message: str) -> int:
    _say(message)
    return BAD_INPUT


def _say(message: str) -> None:
    """One line on standard error; a terminal that is gone hears nothing."""
    with suppress(OSError):
        click.echo("viscorig: " + " ".join(message.split()), err=True)
