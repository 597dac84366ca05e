"""The result of `viscorig batch`; its rows are in batch.csv."""

from instrument.facts.result import Result


class BatchFailure(Result):
    """A row without a law, and why."""

    data: str
    reason: str


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
    known_before: int
    """Rows that an earlier run had done."""
    files: tuple[str, ...]
    """That were written."""
