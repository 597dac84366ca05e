"""A shaker controller as a state machine: no clock, no socket. Every method is told the time.

`now_s` is sample time and never goes back. `wall_s` is wall time: the heartbeat lives by it.
Pieces of drive come out in the order they begin. A ramp's end is given out by the first call at or after it:
whoever renders samples up to a time calls `advance` with that time first.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from drivers.errors import Refused
from drivers.shaker.interface import Alarm, ShakerStatus
from drivers.shaker.protocol import Identity, heartbeat_timeout_objection
from drivers.simulated.drive import DrivePiece

MODEL = Identity("simulated shaker 1.0", serial_number=1)
STOP_RAMP_S = 0.1
"""A stop is a stop, however gently the last command ramped."""
OVERDRIVE = 2.0
"""Asking more than so many times the limit is a mistake, not an ambition."""


@dataclass(frozen=True)
class LogEntry:
    """One change, as the device saw it."""

    wall_s: float | None
    """None where the caller knew none."""
    now_s: float
    what: str
    drive_v: float
    """Amplitude at the output at that moment."""


class _Sine:
    """A sine of one frequency whose amplitude is still or on a straight way to its target."""

    def __init__(self, on_drive: Callable[[DrivePiece], None]) -> None:
        self._on_drive = on_drive
        self._piece = DrivePiece(0.0, 0.0, 0.0, 0.0, 0.0)
        self._target_v = 0.0
        self.ends_s: float | None = None
        """When the ramp ends; None where there is none."""

    @property
    def frequency_hz(self) -> float:
        return self._piece.frequency_hz

    @property
    def target_v(self) -> float:
        return self._target_v

    def amplitude_at(self, now_s: float) -> float:
        # Rounding may carry a ramp to zero a hair below it.
        return self._target_v if self.ends_s is None else max(self._piece.amplitude_at(now_s), 0.0)

    def aim(self, now_s: float, frequency_hz: float, target_v: float, rate_v_s: float) -> None:
        """From the amplitude of this moment to the target; phase continuous."""
        present = self.amplitude_at(now_s)
        way = abs(target_v - present)
        ends_s = now_s + way / rate_v_s if way else now_s
        self._target_v = target_v
        if ends_s > now_s:
            self.ends_s = ends_s
            self._give(now_s, frequency_hz, present, math.copysign(rate_v_s, target_v - present))
        else:
            self.ends_s = None
            self._give(now_s, frequency_hz, target_v, 0.0)

    def end_ramp(self) -> None:
        """Stand still at the target from the ramp's own end on."""
        assert self.ends_s is not None
        self._give(self.ends_s, self.frequency_hz, self._target_v, 0.0)
        self.ends_s = None

    def _give(self, begin_s: float, frequency_hz: float, amplitude_v: float, slope_v_s: float) -> None:
        phase = self._piece.phase_at(begin_s) % math.tau
        self._piece = DrivePiece(begin_s, frequency_hz, amplitude_v, slope_v_s, phase)
        self._on_drive(self._piece)


class ShakerDevice:
    """Commands in, pieces of drive out; silent by itself where something is wrong.

    Parameters
    ----------
    on_drive
        Told each new piece.
    limit_v
        The device's own limit. A command above it is held at it, one above twice of it is an alarm.
    heartbeat_timeout_s
        Wall time without a beat, while running, after which the device goes silent.
    emergency_ramp_s
        How long the drive takes to zero in an alarm; 0: at once.
    """

    def __init__(
        self,
        on_drive: Callable[[DrivePiece], None],
        *,
        limit_v: float = 5.0,
        heartbeat_timeout_s: float = 2.0,
        emergency_ramp_s: float = 0.1,
        identity: Identity = MODEL,
    ) -> None:
        self.identity = identity
        self.limit_v = limit_v
        self.emergency_ramp_s = emergency_ramp_s
        self.log: list[LogEntry] = []
        self._sine = _Sine(on_drive)
        self._now_s = 0.0
        self._running = self._limited = self._interlock_open = self._amplifier_tripped = False
        self._alarm = Alarm.NONE
        self._last_beat_s: float | None = None
        self._beaten_since_alarm = True
        self.set_heartbeat_timeout(heartbeat_timeout_s)

    @property
    def heartbeat_timeout_s(self) -> float:
        """Wall time without a beat, while running, after which the device goes silent."""
        return self._heartbeat_timeout_s

    def set_heartbeat_timeout(self, timeout_s: float) -> None:
        """Refused outside what a heartbeat makes sense for."""
        objection = heartbeat_timeout_objection(timeout_s)
        if objection:
            raise Refused(objection)
        self._heartbeat_timeout_s = timeout_s

    def status(self, now_s: float, wall_s: float | None = None) -> ShakerStatus:
        """What the device reports at this moment."""
        self.advance(now_s, wall_s)
        return ShakerStatus(
            running=self._running,
            ramping=self._sine.ends_s is not None,
            limited=self._limited,
            interlock_open=self._interlock_open,
            alarm=self._alarm,
            drive_v=self._sine.amplitude_at(now_s),
            frequency_hz=self._sine.frequency_hz,
            limit_v=self.limit_v,
        )

    def advance(self, now_s: float, wall_s: float | None = None) -> None:
        """Time has come this far: give out a ramp's end that lies behind.

        Raises
        ------
        ValueError
            Sample time went back.
        """
        if now_s < self._now_s:
            raise ValueError(f"sample time went back from {self._now_s:g} s to {now_s:g} s")
        self._now_s = now_s
        ends_s = self._sine.ends_s
        if ends_s is not None and now_s >= ends_s:
            self._sine.end_ramp()
            self._note("ramp ended" if self._sine.target_v else "silent", ends_s, wall_s)

    def start(self, now_s: float, wall_s: float | None = None) -> None:
        """Allow output. Refused in an alarm or with an open interlock."""
        self.advance(now_s, wall_s)
        if self._alarm is not Alarm.NONE:
            raise Refused(f"alarm {self._alarm.name} is latched: reset it first")
        if self._interlock_open:
            raise Refused("the interlock is open: close it first")
        if not self._running:
            self._running = True
            self._last_beat_s = wall_s
            self._note("started", now_s, wall_s)

    def command(
        self, frequency_hz: float, drive_v: float, ramp_v_s: float, now_s: float, wall_s: float | None = None
    ) -> float:
        """A new sine; returns the amplitude accepted.

        Refused where output is not allowed. Refused with an alarm above twice the limit.
        """
        self.advance(now_s, wall_s)
        if not self._running:
            raise Refused("output is not allowed: start first")
        if drive_v > OVERDRIVE * self.limit_v:
            self._latch(Alarm.OVERDRIVE, now_s, wall_s)
            raise Refused(f"{drive_v:g} V is over {OVERDRIVE:g} times the limit of {self.limit_v:g} V")
        accepted = min(drive_v, self.limit_v)
        self._limited = drive_v > self.limit_v
        self._sine.aim(now_s, frequency_hz, accepted, ramp_v_s)
        held = f", held at {accepted:g} V" if self._limited else ""
        self._note(f"command {frequency_hz:g} Hz {drive_v:g} V at {ramp_v_s:g} V/s{held}", now_s, wall_s)
        return accepted

    def stop(self, now_s: float, wall_s: float | None = None) -> None:
        """Ramp to zero within `STOP_RAMP_S` and disallow output. In any state, also twice."""
        self.advance(now_s, wall_s)
        if not self._running:
            return
        self._disallow()
        self._note("stopped", now_s, wall_s)
        self._silence(self._sine.amplitude_at(now_s) / STOP_RAMP_S, now_s, wall_s)

    def beat(self, wall_s: float) -> None:
        """Take note of a heartbeat: the program is alive."""
        self._last_beat_s = wall_s
        self._beaten_since_alarm = True

    def check_heartbeat(self, wall_s: float, now_s: float) -> None:
        """Go silent where, while running, the last beat is too long ago."""
        self.advance(now_s, wall_s)
        if not self._running:
            return
        if self._last_beat_s is None:
            self._last_beat_s = wall_s
        if wall_s - self._last_beat_s > self._heartbeat_timeout_s:
            self._latch(Alarm.HEARTBEAT, now_s, wall_s)

    def open_interlock(self, now_s: float, wall_s: float | None = None) -> None:
        """An alarm where there is output; else only start is refused."""
        self.advance(now_s, wall_s)
        self._interlock_open = True
        self._note("interlock opened", now_s, wall_s)
        if self._running or self._sine.amplitude_at(now_s) > 0:
            self._latch(Alarm.INTERLOCK, now_s, wall_s)

    def close_interlock(self, now_s: float, wall_s: float | None = None) -> None:
        """The alarm stays until it is reset."""
        self.advance(now_s, wall_s)
        self._interlock_open = False
        self._note("interlock closed", now_s, wall_s)

    def trip_amplifier(self, now_s: float, wall_s: float | None = None) -> None:
        """A fault of the amplifier, until `restore_amplifier`."""
        self.advance(now_s, wall_s)
        self._amplifier_tripped = True
        self._note("amplifier tripped", now_s, wall_s)
        self._latch(Alarm.AMPLIFIER, now_s, wall_s)

    def restore_amplifier(self, now_s: float, wall_s: float | None = None) -> None:
        """The alarm stays until it is reset."""
        self.advance(now_s, wall_s)
        self._amplifier_tripped = False
        self._note("amplifier restored", now_s, wall_s)

    def reset_alarm(self, now_s: float, wall_s: float | None = None) -> None:
        """Clear the alarm; output stays disallowed until a start. Refused while a cause stands."""
        self.advance(now_s, wall_s)
        if self._alarm is Alarm.NONE:
            return
        cause = self._standing_cause()
        if cause:
            raise Refused(f"alarm {self._alarm.name} stays: {cause}")
        self._alarm = Alarm.NONE
        self._note("alarm reset", now_s, wall_s)

    def _standing_cause(self) -> str | None:
        if self._interlock_open:
            return "the interlock is open"
        if self._amplifier_tripped:
            return "the amplifier is tripped"
        if self._alarm is Alarm.HEARTBEAT and not self._beaten_since_alarm:
            return "no heartbeat has come since"
        return None

    def _latch(self, alarm: Alarm, now_s: float, wall_s: float | None) -> None:
        """The first alarm names the cause; a later one is only noted."""
        self._note(f"alarm {alarm.name}", now_s, wall_s)
        self._disallow()
        if self._alarm is not Alarm.NONE:
            return
        self._alarm = alarm
        self._beaten_since_alarm = False
        present = self._sine.amplitude_at(now_s)
        rate = present / self.emergency_ramp_s if self.emergency_ramp_s > 0 else math.inf
        self._silence(rate, now_s, wall_s)

    def _disallow(self) -> None:
        self._running = self._limited = False

    def _silence(self, rate_v_s: float, now_s: float, wall_s: float | None) -> None:
        # At its very beginning a ramp is still at zero, but on its way up.
        if self._sine.amplitude_at(now_s) > 0 or self._sine.target_v > 0:
            self._sine.aim(now_s, self._sine.frequency_hz, 0.0, rate_v_s)
        # Without a ramp there is no end of one to say so.
        if self._sine.ends_s is None:
            self._note("silent", now_s, wall_s)

    def _note(self, what: str, now_s: float, wall_s: float | None) -> None:
        self.log.append(LogEntry(wall_s, now_s, what, self._sine.amplitude_at(now_s)))
