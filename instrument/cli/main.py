"""The command `viscorig`: its commands, and one line instead of a traceback."""

import logging
import os
import sys
from contextlib import suppress
from importlib import import_module
from importlib.metadata import version
from keyword import iskeyword
from pkgutil import resolve_name
from typing import Any

import click

from drivers.errors import DriverError
from fitting.errors import FittingError
from fitting.plugins import GROUPS, NoPlugin, Registry, others, package_of
from instrument.cli.printable import printable
from instrument.cli.stopping import ended_as_by_a_person, hear_no_more
from instrument.cli.summaries import SUMMARIES
from instrument.errors import BadInput, RigStopped, StoppedByUser, system_words
from instrument.processes.background import VARIABLE as BACKGROUND
from instrument.processes.background import step_back

SETTINGS = {"help_option_names": ["-h", "--help"], "max_content_width": 100}
"""How every command of ours shows its help."""
BAD_INPUT = 2
RIG_STOPPED = 3
STOPPED_BY_USER = 130

COMMANDS = (
    "demo",
    "new",
    "plan",
    "sensors",
    "doctor",
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
    "batch",
    "report",
    "card",
    "compare",
    "export",
    "import",
    "bench",
)
"""Each is a function of that name in the module of that name beside this file (or `import_`)."""


_SUMS = frozenset(
    ("plan", "predict", "damping", "identify", "diagnose", "batch", "compare", "report", "bench")
)
"""Those that take long and hold no instrument: SIGTERM ends them as Ctrl-C does, their processes too."""


def _place(name: str) -> str:
    known = f"{name}_" if iskeyword(name) else name
    return f"instrument.cli.{known}:{known}"


def _judge(name: str, found: Any) -> click.Command:
    if not isinstance(found, click.Command):
        raise NoPlugin(f"{found!r:.80} is no command of click")
    return found


BY_NAME: Registry[click.Command] = Registry(
    "viscorig.commands", {name: _place(name) for name in COMMANDS}, _judge
)
"""Ours, and those that rooms above this one and other packages add by entry points."""


_KEPT_IN = {
    "viscorig.laws": "fitting.laws:LAWS",
    "viscorig.effects": "fitting.effects:CATALOGUE",
    "viscorig.shakers": "instrument.files.devices:SHAKERS",
    "viscorig.vibrometers": "instrument.files.devices:VIBROMETERS",
    "viscorig.front_ends": "instrument.files.devices:FRONT_ENDS",
    "viscorig.chambers": "instrument.files.devices:CHAMBERS",
    "viscorig.readers": "instrument.interchange.readers:READERS",
    "viscorig.commands": "instrument.cli.main:BY_NAME",
}
"""The registry of a group of entry points, imported when it is asked for."""


class _Commands(click.Group):
    """Loads a command when it is asked for: the program answers at once."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """In the order of the work."""
        return [*COMMANDS, *sorted(set(BY_NAME) - set(COMMANDS))]

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """The command, or None where there is none of that name."""
        if name in COMMANDS:
            # Without a look at what is installed: that takes longer than the command's own module.
            module, _, attribute = _place(name).partition(":")
            found = getattr(import_module(module), attribute)
            return found if isinstance(found, click.Command) else None
        return BY_NAME.get(name)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that `args` begin with. Raises `UsageError` with what was probably meant."""
        name = args[0]
        if not name.startswith("-") and self.get_command(ctx, name) is None:
            raise click.UsageError(_no_command(name, self.list_commands(ctx)), ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Ours by their summaries, which loads none of them; what other packages add by its own words."""
        names = self.list_commands(ctx)
        room = formatter.width - 6 - max(map(len, names))
        rows = []
        for name in names:
            said = SUMMARIES.get(name)
            command = click.Command(name, help=said) if said else self.get_command(ctx, name)
            if command is not None:
                rows.append((name, command.get_short_help_str(room)))
        with formatter.section("Commands"):
            formatter.write_dl(rows)


def _no_command(name: str, known: list[str]) -> str:
    """What to say of it."""
    from instrument.files.nearest import nearest

    if os.path.exists(name):
        return f"{name!r} is a file, expected a command before it, as in 'viscorig identify {name}'"
    near = nearest(name, known)
    return f"No such command {name!r}{f': is it {near!r}?' if near else ''}"


def _version(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    """The version, and what other packages add, without loading any of it."""
    if not wanted:
        return
    click.echo(f"viscorig, version {version('viscorig')}")
    for entry in others():
        package = " ".join(package_of(entry))
        # Pages are the window's, which is above this room.
        kept_in = _KEPT_IN.get(entry.group)
        why = resolve_name(kept_in).taken(entry) if kept_in else ""
        left_out = f": left out, {why}" if why else ""
        click.echo(f"  {GROUPS[entry.group]} {entry.name}, from {package}{left_out}")
    ctx.exit()


@click.group(cls=_Commands, context_settings=SETTINGS)
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version,
    help="Show the version, and what other packages add to it.",
)  # fmt: skip
@click.pass_context
def viscorig(ctx: click.Context) -> None:
    """Measure damping materials: a core's complex shear modulus from a structure's response."""
    if ctx.invoked_subcommand in _SUMS:
        ctx.with_resource(ended_as_by_a_person(even_ignored=False))


def main(
    arguments: list[str] | None = None, program: click.Command = viscorig, name: str = "viscorig"
) -> None:
    """Run and exit: 0 done, 2 bad input or usage, 3 the rig stopped itself, 130 stopped by the user."""
    if os.environ.get(BACKGROUND):
        step_back()
    # A library's warning is for the log; what a reader has to know a command says itself.
    logging.captureWarnings(True)
    logging.getLogger("py.warnings").addHandler(logging.NullHandler())
    status, alone = STOPPED_BY_USER, arguments is None
    try:
        status = run(arguments, program, name)
        hear_no_more(alone=alone)
    except KeyboardInterrupt:  # while its last words were said
        hear_no_more(alone=alone)
    sys.exit(status)


def run(arguments: list[str] | None = None, program: click.Command = viscorig, name: str = "viscorig") -> int:
    """Run one command of `program`; its exit status."""
    try:
        status = program.main(arguments, prog_name=name, standalone_mode=False)
        return status if isinstance(status, int) else 0
    except click.exceptions.NoArgsIsHelpError as asked:
        click.echo(asked.format_message(), err=True)
        return BAD_INPUT
    except click.ClickException as error:
        return _refuse(program, error.format_message())
    except (BadInput, FittingError) as error:
        return _refuse(program, str(error))
    except (RigStopped, DriverError) as error:
        _say(program, str(error))
        return RIG_STOPPED
    except StoppedByUser as stop:
        _say(program, f"stopped: {stop}")
        return STOPPED_BY_USER
    except (click.Abort, KeyboardInterrupt):
        _say(program, "stopped")
        return STOPPED_BY_USER
    except BrokenPipeError:
        # The reader of our output has gone; nothing is left to say.
        sys.stderr.close()
        return 0
    except OSError as error:
        return _refuse(program, f"{error.filename or 'output'}: {system_words(error)}")


def _refuse(program: click.Command, message: str) -> int:
    _say(program, message)
    return BAD_INPUT


def _say(program: click.Command, message: str) -> None:
    """One line on standard error, by the program's name; a terminal that is gone hears nothing."""
    with suppress(OSError):
        click.echo(f"{program.name}: {printable(' '.join(message.split()))}", err=True)
