"""What the page says of the fit whose curve it draws, and of the law that is drawn."""

from typing import Protocol

from fitting.digits import two_digits
from gui.actions.rediagnosis import ShownDiagnosis
from gui.state import SessionState
from instrument.results.diagnosis_words import UNKNOWN
from instrument.results.session_result import BEFORE_DIAGNOSIS
from instrument.results.standing import stage_before


class Computed(Protocol):
    """A fit's curve as it is computed."""

    failure: str

    @property
    def busy(self) -> bool:
        """Whether it is on its way."""


def said_of_fit(state: SessionState, curve: Computed, aside: int, doubt: str) -> str:
    """The last fit, and one that failed since; `aside`: how many points take no part."""
    failed = state.fit_failed
    if failed is None:
        return said_of_model(state, curve, aside, doubt)
    before = f"{said_of_model(state, curve, aside, doubt)}; " if state.contents.fit is not None else ""
    return before + failed.words


def said_of_model(state: SessionState, curve: Computed, aside: int, doubt: str) -> str:
    """The last fit by itself, as `said_of_fit` has it."""
    fit = state.contents.fit
    if fit is None:
        none = "no fit" if state.run.over else "no fit yet"
        return "fitting ..." if state.fit_running is not None else none
    if fit.result is None:
        return f"fit {fit.number}: {fit.message}"
    count, rms = len(fit.result.points), two_digits(fit.result.rms_percent)
    said = f"fit of {count} points, rms {rms} %"
    if doubt == BEFORE_DIAGNOSIS:
        said = f"rms {rms} % {BEFORE_DIAGNOSIS}"
    if aside:
        said += f", {aside} set aside"
    if doubt == UNKNOWN:
        said += f", {UNKNOWN}"
    if curve.failure:
        return f"{said}; no curve: {curve.failure}"
    return f"{said}; its curve is being computed" if curve.busy else said


def doubt_of(state: SessionState, shown: ShownDiagnosis | None) -> str:
    """Of the law that is drawn: nothing explains its fit, or it lacks what the diagnosis found."""
    own = state.contents.diagnosis
    if shown is not None and shown.found.verdict == "unknown":
        return UNKNOWN
    found = own.result if own is not None else None
    return BEFORE_DIAGNOSIS if found is not None and stage_before(found) is not None else ""
