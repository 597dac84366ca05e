"""One hit as it was recorded: force and one or more responses on one clock."""

from dataclasses import dataclass

from fitting.arrays import Array
from fitting.modal.frf import Motion


@dataclass(frozen=True)
class ResponseChannel:
    """A response: its name and what it measures."""

    name: str
    motion: Motion
    samples: Array
    """SI units of `motion`."""


@dataclass(frozen=True)
class Hit:
    """Force in N and responses, all of one length."""

    source: str
    """File and number, as messages name it."""
    sample_rate_hz: float
    force_n: Array
    responses: tuple[ResponseChannel, ...]

    @property
    def seconds(self) -> float:
        """Length of the record."""
        return len(self.force_n) / self.sample_rate_hz
