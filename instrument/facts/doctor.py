"""The result of `viscorig doctor`."""

from typing import Literal

from instrument.facts.result import Result

State = Literal["good", "remark", "fault"]


class Finding(Result):
    """One thing looked at."""

    group: Literal["installation", "window", "rig", "instruments"]
    name: str
    state: State
    """`remark`: something is missing that not everybody needs; `fault`: it has to be mended."""
    found: str
    cure: str = ""
    """What to do about it."""


class DoctorResult(Result):
    """All of them."""

    healthy: bool
    """Whether there is no fault."""
    findings: tuple[Finding, ...]
