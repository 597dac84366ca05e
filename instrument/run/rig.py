"""The rig: devices opened as RIG.toml names them; or simulated ones, stood up for the run and taken down."""

import json
import logging
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Timer
from time import monotonic, sleep

from drivers.chamber import Chamber
from drivers.chamber.driver import ChamberOptions
from drivers.errors import Refused, Unreachable
from drivers.front_end import FrontEnd
from drivers.front_end.interface import ReadsMemories
from drivers.shaker import Shaker
from drivers.shaker.driver import ShakerOptions
from drivers.vibrometer import Vibrometer
from instrument.check.sensors import memory_remarks
from instrument.files.devices import CHAMBERS, FRONT_ENDS, SHAKERS, VIBROMETERS
from instrument.files.experiment_file import Hammer
from instrument.files.rig_file import RigDocument, SensorSection
from instrument.run.operator import Operator, Person, SimulatedOperator

log = logging.getLogger(__name__)

_SIMULATOR_STARTS_S = 120.0
"""A bound: one that has not come up by then is taken to hang. A beam is built when it is first used."""
_MARGIN_S = 1.0
"""Behind the shaker's watchdog, until one that is driven counts as somebody's."""
_LOOK_S = 0.05
"""Between two looks at it."""
_SIMULATOR_ENDS_S = 6.0
"""Until it is killed."""


@dataclass(frozen=True)
class Rig:
    """Everything at hand, connected."""

    shaker: Shaker
    vibrometer: Vibrometer
    front_end: FrontEnd
    operator: Operator
    sensors: dict[str, SensorSection]
    sample_rate_hz: float
    document: RigDocument
    """As opened: with the addresses of a rig that was simulated for the run."""
    chamber: Chamber | None = None
    """Or a thermometer."""

    @property
    def in_virtual_time(self) -> bool:
        """Whether samples are made only as they are asked for."""
        return self.document.front_end.paced_by_reader

    def identities(self) -> dict[str, str]:
        """What each device says it is."""
        found = {
            "shaker": self.shaker.identity(),
            "vibrometer": self.vibrometer.identity(),
            "front_end": self.front_end.identity(),
        }
        return found | ({"chamber": self.chamber.identity()} if self.chamber is not None else {})


@dataclass(frozen=True)
class Addresses:
    """Where the simulated devices answer: the first line of `viscorig simulate`."""

    modbus_tcp: str
    modbus_rtu: str
    vibrometer_tty: str
    frontend_url: str
    chamber_tcp: str
    """Empty where there is none."""


@contextmanager
def open_rig(
    document: RigDocument,
    path: Path,
    hammer: Hammer | None,
    spot_m: tuple[float, float] | None = None,
) -> Iterator[Rig]:
    """Connect everything; let go of it again at the end. Raises `DriverError`.

    `spot_m` is where a rig that is simulated for the run reads the published plate, None for (0.06, 0.06).
    """
    with ExitStack() as stack:
        if document.is_simulated:
            spot = ("--spot", *(f"{1e3 * v:g}" for v in spot_m)) if spot_m is not None else ()
            addresses = stack.enter_context(simulator(path, *spot))
            document = _at(document, addresses)
        shaker = open_shaker(document.shaker)
        stack.callback(shaker.close)
        wait_until_free(shaker, document.shaker.heartbeat_timeout_s)
        shaker.set_heartbeat_timeout_s(document.shaker.heartbeat_timeout_s)
        vibrometer = VIBROMETERS[document.vibrometer.kind].open(document.vibrometer)
        stack.callback(vibrometer.close)
        front_end = FRONT_ENDS[document.front_end.kind].open(document.front_end)
        stack.callback(front_end.close)
        if isinstance(front_end, ReadsMemories):
            for remark in memory_remarks(document, front_end.transducers):
                log.warning("%s", remark)
        chamber = open_chamber(document.chamber)
        if chamber is not None:
            stack.callback(chamber.close)
        yield Rig(
            shaker,
            vibrometer,
            front_end,
            _operator(document, hammer),
            document.channels.named(),
            document.front_end.sample_rate_hz,
            document,
            chamber,
        )


def wait_until_free(shaker: Shaker, watchdog_s: float) -> None:
    """Nothing of the rig is taken from a program that drives its shaker; one that was killed is waited out.

    Raises `Refused` where somebody still beats its heartbeat after that many seconds and a little.
    """
    deadline = monotonic() + watchdog_s + _MARGIN_S
    while shaker.status().drive_v > 0:
        if monotonic() > deadline:
            raise Refused(
                f"the shaker is driven, and was for {watchdog_s + _MARGIN_S:g} s: "
                "another program uses this rig, or its watchdog is off: stop it first"
            )
        sleep(_LOOK_S)


def open_shaker(table: ShakerOptions, *, timeout_s: float = 1.0, retries: int = 2) -> Shaker:
    """The shaker a rig file names; it may be connected to when first used."""
    return SHAKERS[table.kind].open(table, timeout_s=timeout_s, retries=retries)


def open_chamber(table: ChamberOptions | None) -> Chamber | None:
    """The chamber or thermometer a rig file names; it may be connected to when first used."""
    return None if table is None else CHAMBERS[table.kind].open(table)


@contextmanager
def simulator(path: Path, *options: str) -> Iterator[Addresses]:
    """The simulated instruments in their own process, in virtual time; it ends with its standard input.

    Raises `Unreachable` where they do not come up.
    """
    command = [sys.executable, "-m", "instrument.cli", "simulate", str(path), "--virtual-time", *options]
    # In a session of its own: a Ctrl-C for the run must not take the rig away before the shaker is silent.
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, start_new_session=True
    )
    assert process.stdin is not None
    assert process.stdout is not None
    watchdog = Timer(_SIMULATOR_STARTS_S, process.kill)
    watchdog.start()
    try:
        line = process.stdout.readline()
        watchdog.cancel()
        if not line.startswith("{"):
            raise Unreachable(f"simulated rig: {path} did not come up (exit {process.wait()})")
        facts = json.loads(line)
        yield Addresses(**{name: facts[name] for name in Addresses.__dataclass_fields__})
    finally:
        watchdog.cancel()
        process.stdin.close()
        try:
            process.wait(_SIMULATOR_ENDS_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        process.stdout.close()


def _at(document: RigDocument, addresses: Addresses) -> RigDocument:
    shaker = addresses.modbus_rtu if document.shaker.kind == "modbus-rtu" else addresses.modbus_tcp
    chamber = document.chamber
    if chamber is not None:
        chamber = chamber.model_copy(update={"address": addresses.chamber_tcp})
    return document.model_copy(
        update={
            "chamber": chamber,
            "shaker": document.shaker.model_copy(update={"address": shaker}),
            "vibrometer": document.vibrometer.model_copy(update={"address": addresses.vibrometer_tty}),
            "front_end": document.front_end.model_copy(
                update={"address": addresses.frontend_url, "paced_by_reader": True}
            ),
        }
    )


def _operator(document: RigDocument, hammer: Hammer | None) -> Operator:
    if document.operator.kind == "person":
        return Person()
    hit = (hammer.hit_x_mm * 1e-3, hammer.hit_y_mm * 1e-3) if hammer else (0.0, 0.0)
    response = (hammer.response_x_mm * 1e-3, hammer.response_y_mm * 1e-3) if hammer else (0.0, 0.0)
    return SimulatedOperator(document.front_end.address, hit, response)
