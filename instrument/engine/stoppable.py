"""A shaker that can be stopped for good: from then on it neither starts nor takes a command.

The device has no such latch. A stop that reaches it just before the run's own `start` would be undone by it;
so after a stop for good the start leads nowhere: no command follows it, and without one the drive is zero.
"""

from drivers.errors import Refused
from drivers.shaker import Echo, Shaker, ShakerStatus
from instrument.run.at_rest import bring_to_rest


class StoppableShaker:
    """`Shaker`; every method but `stop_for_good` is the shaker's own."""

    def __init__(self, shaker: Shaker) -> None:
        self._shaker = shaker
        self._stopped = False

    def stop_for_good(self) -> None:
        """Stop, and refuse every start and command from now on; returns once it is at rest.

        Waits for no command under way. Raises `DriverError` where it is not known to be at rest.
        """
        self._stopped = True
        bring_to_rest(self._shaker)

    def identity(self) -> str:
        """What the device states itself to be."""
        return self._shaker.identity()

    def start(self) -> None:
        """Allow output."""
        self._refuse()
        self._shaker.start()

    def command(self, frequency_hz: float, drive_v: float, ramp_v_s: float) -> Echo:
        """A new sine."""
        self._refuse()
        return self._shaker.command(frequency_hz, drive_v, ramp_v_s)

    def stop(self) -> None:
        """Ramp to zero and disallow output."""
        self._shaker.stop()

    def beat(self) -> None:
        """Send the heartbeat."""
        self._shaker.beat()

    def set_heartbeat_timeout_s(self, timeout_s: float) -> None:
        """How long the device waits for a beat."""
        self._shaker.set_heartbeat_timeout_s(timeout_s)

    def status(self) -> ShakerStatus:
        """What the device says of itself."""
        return self._shaker.status()

    def reset_alarm(self) -> None:
        """Clear a latched alarm."""
        self._shaker.reset_alarm()

    def close(self) -> None:
        """Let go of the connection."""
        self._shaker.close()

    def _refuse(self) -> None:
        if self._stopped:
            raise Refused("the shaker was stopped for good: begin a new run")
