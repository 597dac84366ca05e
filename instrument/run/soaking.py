"""Bring the chamber to its temperature and wait there: the shaker silent, the heartbeat beating.

Time is that of the samples, which are read and let go of: nothing of a soak is kept but the temperature.
"""

from collections.abc import Callable
from contextlib import suppress

from drivers.errors import DriverError, Refused
from drivers.front_end import InputChannel
from instrument.errors import RigStopped
from instrument.files.experiment_file import TemperatureTable
from instrument.run.control import RunControl
from instrument.run.rig import Rig
from instrument.stepped_sine.soak import Soak
from instrument.stream.event import Event
from instrument.stream.raw import Held, SoakBegan, SoakEnded, TemperatureRead

_LOOK_S = 5.0
"""Between two readings of the temperature."""
_READ_S = 0.5
"""At most so many samples at once: a stop is asked for in between."""


class Soaking:
    """Of one rig with a chamber.

    Parameters
    ----------
    emit
        Takes what happens.
    control
        Hold and resume. After a hold the soak begins again.
    watch
        Called between reads: beats the heartbeat, raises `RigStopped` where the run is to end.
    """

    def __init__(
        self,
        rig: Rig,
        emit: Callable[[Event], object],
        control: RunControl,
        watch: Callable[[], None],
    ) -> None:
        self._rig, self._emit, self._control, self._watch = rig, emit, control, watch

    def run(self, wanted: TemperatureTable) -> None:
        """Until it is done. Raises `RigStopped` where it takes too long, `DriverError`."""
        chamber, front_end = self._rig.chamber, self._rig.front_end
        if chamber is None:
            raise RigStopped(f"no chamber to bring to {wanted.set_point_c:g} °C")
        kept = chamber.go_to(wanted.set_point_c)
        base = self._rig.sensors["base"]
        front_end.start(
            (InputChannel(base.input, "base", base.iepe, base.range_v),), self._rig.sample_rate_hz
        )
        try:
            began = SoakBegan(kept, wanted.within_c, wanted.soak_s, wanted.most_s)
            while not self._soaked(began):
                self._emit(Held())
                while self._control.held:
                    self._let_pass(_READ_S)
        finally:
            with suppress(DriverError):
                front_end.stop()

    def _soaked(self, began: SoakBegan) -> bool:
        """From its beginning; False where it is held."""
        self._emit(began)
        soak, elapsed_s = Soak(began), 0.0
        while not self._control.held:
            read = read_temperature(self._rig, elapsed_s)
            if read is not None:
                self._emit(read)
                soak.take(read)
            if soak.done:
                self._emit(SoakEnded(elapsed_s))
                return True
            if soak.too_late:
                raise RigStopped(_too_late(soak))
            elapsed_s += self._let_pass(_LOOK_S)
        return False

    def _let_pass(self, seconds: float) -> float:
        """Samples of so much time, read and let go of; what went by. Less where a hold is asked for."""
        front_end, passed_s = self._rig.front_end, 0.0
        held = self._control.held
        while passed_s < seconds and self._control.held == held:
            self._watch()
            wanted_s = min(_READ_S, seconds - passed_s)
            block = front_end.read(max(1, round(wanted_s * front_end.sample_rate_hz)))
            passed_s += block.samples / front_end.sample_rate_hz
        return passed_s


def ask_set_point(rig: Rig, wanted: TemperatureTable | None) -> None:
    """Whether the chamber takes the set point, asked before anything moves; it goes back to the one it had.

    Raises `RigStopped` where it does not, `DriverError`.
    """
    chamber = rig.chamber
    if wanted is None or chamber is None:
        return
    before = chamber.set_point_c()
    try:
        chamber.go_to(wanted.set_point_c)
    except Refused as error:
        raise RigStopped(
            f"{error}: is temperature.set_point_c = {wanted.set_point_c:g} within the chamber's range? set "
            "it there, or the chamber's own limits, and begin a new run"
        ) from None
    finally:
        if before is not None:
            with suppress(DriverError):
                chamber.go_to(before)


def read_temperature(rig: Rig, soak_s: float | None = None) -> TemperatureRead | None:
    """Now, with the set point that is kept; None where the rig has neither chamber nor thermometer."""
    if rig.chamber is None:
        return None
    return TemperatureRead(rig.chamber.temperature_c(), rig.chamber.set_point_c(), soak_s)


def _too_late(soak: Soak) -> str:
    b = soak.began
    return (
        f"chamber at {soak.temperature_c:.1f} °C after {soak.elapsed_s:.0f} s, {soak.near_s:.0f} s within "
        f"{b.within_c:g} °C of {b.set_point_c:g} °C, {b.soak_s:g} s expected: is its door shut, does it heat "
        "and cool? else raise temperature.most_s or within_c"
    )
