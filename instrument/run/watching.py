"""Between two blocks of a run: is it to end, is the shaker well, do devices do what they were told."""

import logging
from contextlib import suppress
from dataclasses import dataclass
from time import monotonic, sleep

from drivers.errors import DriverError, Refused
from drivers.shaker import Alarm, ShakerStatus
from drivers.vibrometer import Range
from instrument.errors import RigStopped
from instrument.run.beats import LOST, Beats
from instrument.run.control import RunControl
from instrument.run.rig import Rig
from instrument.stepped_sine.soundness import MOST_OFF

log = logging.getLogger(__name__)

BEAT_S = 0.2
"""A tenth of the heartbeat's usual limit: a few may come late."""
_WORD_S, _LISTENS_S = 1.0, 0.01
"""How long the word of a stop may come after its deed, and how often it is listened for. A choice: by then
the shaker is silent."""
_LOST_SAID, _LOST_MORE = 3, 10
"""Answers of the shaker lost before the first word of it, and times as many for each further one."""


@dataclass
class Told:
    """What the runner has told shaker and vibrometer last."""

    frequency_hz: float = 0.0
    drive_v: float = 0.0
    range: Range | None = None
    """The vibrometer's; None until it has been set."""


class Watching:
    """Beats the heartbeat of one rig, and compares what its devices say with what they were told."""

    def __init__(self, rig: Rig, control: RunControl, told: Told) -> None:
        """`told` is kept up to date by whoever commands the devices."""
        self._rig, self._control, self._told = rig, control, told
        self.beats = Beats()
        self._say_lost = _LOST_SAID

    def look(self) -> None:
        """Beat the heartbeat where it is time to, and ask the shaker how it is.

        Raises `RigStopped` where the run is to end, `KeyboardInterrupt` where its user has stopped it.
        """
        self._heed()
        if not self.beats.due(BEAT_S):
            return
        with self.beats.asking("shaker"):
            self._rig.shaker.beat()
        self.beats.beaten()
        with self.beats.asking("shaker"):
            status = self._rig.shaker.status()
        self._count(status)
        if status.alarm != Alarm.NONE:
            why = f" ({self.beats.said})" if status.alarm is Alarm.HEARTBEAT else ""
            raise RigStopped(
                f"shaker alarm: {status.alarm.name.lower()}{why}: remove its cause, then reset the alarm"
            )
        if status.interlock_open:
            raise RigStopped("shaker interlock open: close it, then begin again")
        self._question(status)

    def _heed(self) -> None:
        if self._control.interrupted:
            raise KeyboardInterrupt
        if self._control.aborted is not None:
            raise RigStopped(self._control.aborted)

    def _heed_who_stopped_it(self) -> None:
        """A stop goes straight to the shaker, past the run: its word may be on its way still."""
        until = monotonic() + _WORD_S
        while monotonic() < until:
            self._heed()
            sleep(_LISTENS_S)

    def _question(self, status: ShakerStatus) -> None:
        """Whether the shaker does what it was told. Raises `RigStopped`."""
        told = self._told
        if told.drive_v == 0:
            return
        if not status.running:
            self._heed_who_stopped_it()
            raise RigStopped("the shaker was switched off by somebody else: begin again when it is free")
        if abs(status.frequency_hz / told.frequency_hz - 1) > MOST_OFF:
            raise RigStopped(
                f"the shaker says that it runs at {status.frequency_hz:g} Hz, "
                f"it was told {told.frequency_hz:g} Hz"
            )

    def _count(self, status: ShakerStatus) -> None:
        """The answers of the shaker that were lost; said while the run can still bear them."""
        lost = self.beats.lost_answers = status.lost_answers
        if lost >= self._say_lost:
            log.warning("shaker: %d answers lost or damaged so far: %s", lost, LOST)
            while lost >= self._say_lost:
                self._say_lost *= _LOST_MORE

    def confirm_range(self) -> None:
        """Before a reading counts: the range is still the one it is scaled by. Raises `RigStopped`.

        Somebody at its panel, or a mains plug, changes it, and every velocity is wrong by the ratio.
        """
        with self.beats.asking("vibrometer"):
            found = self._rig.vibrometer.range()
        wanted = self._told.range
        if wanted is not None and found.name != wanted.name:
            raise RigStopped(
                f"the vibrometer's range is {found.name}, it was set to {wanted.name}: "
                "was it changed at its panel, or switched off and on? this step does not count"
            )

    def explained(self, refusal: Refused) -> Refused:
        """A command's refusal; where the heartbeat went stale before it, with what held the beat up."""
        with suppress(DriverError):
            status = self._rig.shaker.status()
            self._count(status)
            if not status.running and self._told.drive_v:
                self._heed_who_stopped_it()
            if status.alarm is Alarm.HEARTBEAT:
                return Refused(f"{refusal}; {self.beats.said}")
        return refusal
