"""The result of `viscorig batch`; its rows are in batch.csv."""

from instrument.facts.comparison import SpecimenApart, SpreadAt
from instrument.facts.number import Number
from instrument.facts.result import Result


class BatchFailure(Result):
    """A row without a law, and why."""

    data: str
    reason: str


class BatchRepeat(Result):
    """A row whose data an earlier one has already, whatever they are called: not in the spread."""

    data: str
    repeats: str
    """The data of the earlier row that it repeats."""


class BatchSpread(Result):
    """Between the rows of one material and temperature, told from the uncertainty of each."""

    material: str | None = None
    """As the table has it."""
    temperature_c: Number | None
    """Mean of its rows'; null where none was measured."""
    rows: int
    frequencies: tuple[SpreadAt, ...]
    apart: tuple[SpecimenApart, ...] = ()
    """Rows that are not like the others."""
    without_apart: tuple[SpreadAt, ...] = ()
    """The same without them; empty where none is apart, or fewer than three are left."""


class BatchResult(Result):
    """What many sessions or sweeps came to."""

    rows: int
    done: int
    failed: int
    verdicts: dict[str, int]
    """Rows by verdict."""
    effects: dict[str, int]
    """Rows by effect, the most frequent first."""
    borrowed_models: int
    """Rows worked out on another specimen's reduced model."""
    failures: tuple[BatchFailure, ...]
    """In the order of the rows."""
    doubted: tuple[str, ...] = ()
    """Data whose law, not diagnosed, says of itself that it may be biased: not in the spread."""
    repeats: tuple[BatchRepeat, ...] = ()
    """In the order of the rows."""
    known_before: int
    """Rows that an earlier run had done."""
    spread: tuple[BatchSpread, ...] = ()
    """Of every material and temperature with three rows or more that have a band in common."""
    files: tuple[str, ...]
    """That were written."""
