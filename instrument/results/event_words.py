"""One line for people of an event: what the log of a window and the console of a run say."""

from dataclasses import replace

from instrument.facts.doubts import doubts_of
from instrument.facts.identification import IdentificationResult
from instrument.files.acceleration import shown_quantity
from instrument.results.diagnosis_words import DOUBTED, verdict_line
from instrument.results.next_words import apart_words
from instrument.results.numbers import with_error
from instrument.stepped_sine.point_of_reading import NOT_CALIBRATED
from instrument.stream.derived import (
    CalibrationFound,
    DampingFound,
    DiagnosisFound,
    FitUpdated,
    HitJudged,
    LimitWarned,
    PointMeasured,
    SentinelCompared,
    StepsChosen,
)
from instrument.stream.event import Event
from instrument.stream.raw import (
    DiagnosisStarted,
    FollowUpDecided,
    FollowUpProposed,
    PlanOverruled,
    SoakBegan,
    SoakEnded,
    StepDeclined,
)


class Saying:
    """What is said of one event after the other: what is so of a whole range of the vibrometer, once."""

    def __init__(self) -> None:
        self._said: set[str] = set()

    def line(self, event: Event) -> str | None:
        """As `said_of`; None also where it has been said."""
        if not isinstance(event, PointMeasured):
            return said_of(event)
        new = tuple(remark for remark in event.remarks if remark not in self._said)
        self._said |= {remark for remark in new if NOT_CALIBRATED in remark}
        return said_of(replace(event, remarks=new))


def said_of(event: Event) -> str | None:
    """One line for people; None for what speaks for itself."""
    match event:
        case HitJudged():
            verdict = "good" if event.accepted else f"left out: {event.why}"
            return f"hit {event.hit}: {event.peak_n:.0f} N, {verdict}"
        case DampingFound():
            modes = event.result.accepted
            return f"bare plate: {len(modes)} modes, {modes[0].frequency_hz:.2f} Hz on" if modes else None
        case CalibrationFound():
            gain = with_error(event.gain, event.gain_std, sign="+-")
            delay = with_error(event.delay_s, event.delay_std_s, 1e6, "+-")
            return f"vibrometer in {event.range_name}: gain {gain}, delay {delay} us"
        case SentinelCompared():
            change = f"{event.change_percent:+.3f} %, {event.change_degree:+.3f} deg"
            return f"sentinel {event.frequency_hz:g} Hz: {change} since the first time"
        case LimitWarned():
            value, unit = shown_quantity(event.value, event.unit)
            limit, _ = shown_quantity(event.limit, event.unit)
            return f"warning: {event.place}: {event.what} {value:.4g} of {limit:.4g} {unit}"
        case SoakBegan():
            goal = f"{event.set_point_c:g} °C, within {event.within_c:g} °C for {event.soak_s:g} s"
            return f"soaking at {goal}"
        case SoakEnded():
            return f"soaked: at the set point after {event.seconds:.0f} s"
        case PointMeasured() if event.remarks:
            return f"{event.frequency_hz:g} Hz: {'; '.join(event.remarks)}"
        case FitUpdated():
            return _fit_said(event)
        case StepsChosen():
            return _choice_said(event)
        case DiagnosisStarted():
            return "tracing what the fit cannot explain"
        case FollowUpProposed():
            best = event.offers[0]
            return f"{apart_words(best.between)}: {best.todo} {best.why}"
        case FollowUpDecided():
            said = "measured next" if event.agreed else "declined"
            return f"follow-up {event.number}: {said}, by the {event.by}'s word"
        case PlanOverruled():
            added = f"a person adds {event.frequency_hz:g} Hz" if event.frequency_hz is not None else ""
            return added or "a person ends the sweep"
        case StepDeclined():
            return f"{event.frequency_hz:g} Hz: left out on a person's word"
        case DiagnosisFound():
            return verdict_line(event.result) if event.result else f"no diagnosis: {event.message}"
    return None


def _choice_said(event: StepsChosen) -> str:
    """What an adaptive sweep measures next, and why."""
    if event.ended:
        return f"the sweep ends: {event.why}"
    if len(event.frequencies_hz) != 1:
        return event.why
    return f"next {event.frequencies_hz[0]:g} Hz: {event.why}"


def _fit_said(event: FitUpdated) -> str:
    if event.result is None:
        return f"fit {event.number}: not yet: {event.message}"
    middle = min(event.result.law, key=lambda row: abs(row.frequency_hz - 100))
    g, s = 1e-6 * middle.storage_modulus_pa, 1e-6 * middle.storage_modulus_standard_error_pa
    eta, e = middle.loss_factor, middle.loss_factor_standard_error
    return (
        f"fit {event.number}, {len(event.result.points)} points: at {middle.frequency_hz:.4g} Hz "
        f"G' {with_error(g, s, sign='+-')} MPa, eta {with_error(eta, e, sign='+-')}; "
        f"rms {event.result.rms_percent:.2f} %{_doubt(event.result)}"
    )


def _doubt(fit: IdentificationResult) -> str:
    """Said where the error stated beside a law is not all that is wrong with it."""
    if not doubts_of(fit):
        return ""
    left = (
        f", chi-square per degree of freedom {fit.chi2_per_dof:.3g}" if fit.chi2_per_dof is not None else ""
    )
    return f"; {DOUBTED}{left}"
