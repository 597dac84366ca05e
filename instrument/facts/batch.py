"""The result of `viscorig batch`; its rows are in batch.csv."""

from instrument.facts.comparison import SpreadAt
from instrument.facts.number import Number
from instrument.facts.result import Result


class BatchFailure(Result):
    """A row without a law, and why."""

    data: str
    reason: str


class BatchSpread(Result):
    """Between the rows of one temperature, told from the uncertainty of each."""

    temperature_c: Number | None
    """In whole degrees; null where none was measured."""
    rows: int
    frequencies: tuple[SpreadAt, ...]


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
    known_before: int
    """Rows that an earlier run had done."""
    spread: tuple[BatchSpread, ...] = ()
    """Of every temperature with three rows or more that have a band in common."""
    files: tuple[str, ...]
    """That were written."""
