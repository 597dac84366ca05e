"""The results of commands that write files: `viscorig export`, `import`, `new`, `report`, `recover`."""

from instrument.facts.result import Result
from instrument.facts.session_result import SessionResult


class ExportResult(Result):
    """A session as files for other programs."""

    files: tuple[str, ...]
    notes: tuple[str, ...] = ()
    """Said of what the files leave out."""
    result: SessionResult | None = None
    """The law to sign; None without a sweep."""


class ImportResult(Result):
    """A file of another program as files of ours."""

    files: tuple[str, ...]
    found: tuple[str, ...] = ()
    """What was in it, a line each."""


class NewResult(Result):
    """A commented file to start from."""

    kind: str
    path: str


class ReportResult(Result):
    """A session's page."""

    report: str
    pdf: str | None = None
    """The same on sheets of A4, where it was asked for beside the page."""
    sheets: tuple[str, ...] = ()
    """Pictures of the sheets, where it was asked for as such."""


class RecoverResult(Result):
    """A session put together from a run that was killed."""

    session: str
    parts: int
    hits: int
    steps: tuple[int, ...]
    """Numbers of those that are complete."""
    lost_parts: int = 0
    """Sealed once, but damaged, or after a damaged one."""
    lost_steps: tuple[int, ...] = ()
    """Numbers of those that were complete in them."""
