"""The result of `viscorig bench`."""

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result


class BenchRow(Result):
    """One line: a time, and how many times faster that is than what `to` names."""

    name: str
    seconds: Number
    ratio: MaybeNumber = None
    to: str | None = None
    max_relative_error: MaybeNumber = None


class BenchResult(Result):
    """What the reduced model buys, timed on this machine."""

    rows: tuple[BenchRow, ...]
