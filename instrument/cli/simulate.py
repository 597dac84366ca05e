"""`viscorig simulate`: the simulated instruments on loopback and pseudo-terminals, for any client."""

import json
import logging
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import click

from instrument.cli.stopping import ended_as_by_a_person
from instrument.errors import BadInput
from instrument.files.sensor_file import read_rig
from instrument.progress import bar
from instrument.simulated_case.simulation import simulated_rig

_log = logging.getLogger(__name__)

_LOOKS_EVERY_S = 0.2
"""Whether it was interrupted."""


@click.command()
@click.argument("rig", type=click.Path(path_type=Path))
@click.option(
    "--virtual-time",
    is_flag=True,
    help="Make samples only as a reader asks for them, as fast as it asks. Real time otherwise.",
)
@click.option(
    "--log", type=click.Path(path_type=Path), help="The rig's own record of its shaker, JSON lines."
)
@click.option("--modbus-port", type=click.IntRange(0, 65535), default=0, help="0 for a free one.")
@click.option("--frontend-port", type=click.IntRange(0, 65535), default=0, help="0 for a free one.")
@click.option(
    "--spot",
    type=float,
    nargs=2,
    metavar="X Y",
    help="Where the published plate is read, in mm from the clamp and a long edge; 60 60 if nobody says.",
)
def simulate(
    rig: Path,
    virtual_time: bool,
    log: Path | None,
    modbus_port: int,
    frontend_port: int,
    spot: tuple[float, float] | None,
) -> None:
    """Stand up the instruments of RIG.toml's [simulation] until interrupted.

    The first line of output is JSON: modbus_tcp, modbus_rtu, vibrometer_tty, frontend_url,
    chamber_tcp (empty without a [chamber]). Everything is bound to loopback. With --virtual-time the end
    of standard input is the end.
    """
    document = read_rig(rig)
    ports = modbus_port, frontend_port
    with ended_as_by_a_person(), ExitStack() as stack:
        try:
            addresses = stack.enter_context(
                simulated_rig(
                    document,
                    rig,
                    virtual_time=virtual_time,
                    log=log,
                    ports=ports,
                    spot_m=None if spot is None else (1e-3 * spot[0], 1e-3 * spot[1]),
                    progress=bar,
                )
            )
        except (ArithmeticError, LookupError, RuntimeError, TypeError, ValueError) as error:
            _log.debug("%s", rig, exc_info=True)
            raise BadInput(
                f"{rig}: [simulation] cannot be built ({type(error).__name__}: {error}): "
                "are all sizes in its specimen file of the order meant?"
            ) from None
        click.echo(json.dumps(addresses))
        sys.stdout.flush()
        if virtual_time:
            sys.stdin.read()
        else:
            # A wait without an end sleeps through a signal that comes just before it.
            while True:
                time.sleep(_LOOKS_EVERY_S)
