"""One row of a batch, as files and tables ask for it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class BatchTask:
    """Paths as text: a task goes to other processes and other machines."""

    data: str
    specimen: str | None = None
    """None for a session's own."""
    hammer: str | None = None
    temperature_c: float | None = None
    """As the table has it."""
    material: str | None = None
    """What rows are grouped by; None where the table does not say."""
    like: str | None = None
    """A specimen file whose models may serve this one."""
    diagnose: bool = False
    insist: bool = False
    """Nothing is questioned."""
