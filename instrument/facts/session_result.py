"""The one law to sign: what a session, a run or a diagnosis ends with, and where it holds."""

from typing import Literal

from instrument.facts.diagnosis import Verdict
from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result
from instrument.facts.rows import LawRow

Standing = Literal["diagnosed", "by hand", "not diagnosed", "no law"]


class SessionResult(Result):
    """The law of the joint inference, after the diagnosis where there is one; verdict, validity."""

    words: str
    """All of it in one line, as report, window and commands say it."""
    standing: Standing
    verdict: Verdict | None = None
    """None where nothing was diagnosed."""
    effects: tuple[str, ...] = ()
    """Those the law was found with."""
    law_kind: str = ""
    law: tuple[LawRow, ...] = ()
    """At the reference frequencies inside the band; at its ends where none lies inside."""
    rms_percent: MaybeNumber = None
    """That the law leaves of the amplitudes."""
    low_hz: MaybeNumber = None
    """Of the band in which the law holds."""
    high_hz: MaybeNumber = None
    low_level_m_s2: MaybeNumber = None
    """Commanded at the base; reached, where the drive's limit kept it under that. None where nobody said."""
    high_level_m_s2: MaybeNumber = None
    temperature_range_c: tuple[Number, Number] | None = None
    """Lowest and highest over the points; None where it was not measured."""
    points: int = 0
    """That the law was found from."""
    points_measured: int = 0

    @property
    def is_complete(self) -> bool:
        """Whether there is a law of every point."""
        return self.points > 0 and (self.verdict is not None or self.points >= self.points_measured)
