"""A finished run as a person sees it, and as JSON."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from instrument.cli.output import Output
from instrument.cli.print_diagnosis import print_before_after, print_story
from instrument.facts.damping import METHODS, RatioFound
from instrument.facts.follow_up import FollowedUp
from instrument.facts.rows import LawRow
from instrument.facts.run import RunResult
from instrument.facts.session_result import SessionResult
from instrument.results.error_words import ratio_words
from instrument.results.followed import followed_lines, followed_of
from instrument.results.numbers import with_error
from instrument.results.quality import how_long
from instrument.results.session_result import BEFORE_DIAGNOSIS, result_of_events
from instrument.stream.derived import DampingFound, DiagnosisFound, FitUpdated, PointMeasured

if TYPE_CHECKING:
    from instrument.run.experiment import Finished  # identify prints a result, and needs no rig


def run_result(finished: "Finished") -> RunResult:
    """The result of `run`, `hammer` and `sweep`."""
    swept = finished.points or finished.fit is not None
    return RunResult(
        session=str(finished.session),
        points=len(finished.points),
        damping=finished.damping.result if finished.damping is not None else None,
        identify=finished.fit.result if finished.fit is not None else None,
        diagnose=finished.diagnosis.result if finished.diagnosis is not None else None,
        **_followed(finished),
        result=result_of_events(finished.fit, finished.diagnosis, finished.points) if swept else None,
    )


def _followed(finished: "Finished") -> dict[str, tuple[FollowedUp, ...]]:
    followed = followed_of(finished.following)
    return {"followed": followed} if followed else {}


def print_finished(out: Output, finished: "Finished") -> None:
    """Damping, quality of the points, law, diagnosis, and where the session is."""
    if finished.damping is not None:
        print_damping(out, finished.damping)
    if finished.points:
        print_quality(out, list(finished.points))
    print_found(out, finished.fit, finished.diagnosis, finished.points)
    for line in followed_lines(followed_of(finished.following)):
        out.say(line)
    out.say(f"session: {finished.session}")


def print_found(
    out: Output,
    fit: FitUpdated | None,
    diagnosis: DiagnosisFound | None,
    points: Sequence[PointMeasured],
) -> None:
    """The law, the diagnosis, and last the one result."""
    diagnosed = diagnosis is not None and diagnosis.result is not None
    if fit is not None:
        print_fit(out, fit, BEFORE_DIAGNOSIS if diagnosed else "")
    if diagnosis is not None:
        print_found_diagnosis(out, diagnosis)
    if fit is not None or diagnosis is not None:
        print_result(out, result_of_events(fit, diagnosis, points))


def print_result(out: Output, result: SessionResult) -> None:
    """Print the law that a session ends with."""
    out.say(f"result: {result.words}")


def print_damping(out: Output, found: DampingFound) -> None:
    """The bare plate's modes, three methods side by side."""
    rows = [
        [
            f"{m.frequency_hz:.3f}",
            *(_percent(m.by(method)) for method in METHODS),
            m.why or "-",
        ]
        for m in found.result.modes
    ]
    out.table(
        "bare plate: damping ratio by three methods, +- one standard error by these hits' noise, half "
        "power's with what it is off the fit",
        ["f/Hz", "rational fit/%", "half power/%", "LSCF/%", "remarks"],
        rows,
    )
    for said in found.result.warnings:
        out.say(f"bare plate: {said}")


def print_quality(out: Output, points: list[PointMeasured]) -> None:
    """A line for the whole sweep."""
    steps = [p for p in points if p.purpose == "step"]
    if not steps:
        out.say("no step of the sweep was measured")
        return
    off = max(abs(p.control_error_percent) for p in steps)
    noise = float(np.median([100 * p.velocity_std_m_s / abs(p.velocity_m_s) for p in steps]))
    marked = sum(bool(p.remarks) for p in steps)
    out.say(
        f"{how_long(points)}; base within {off:.2f} % of its level; "
        f"noise {noise:.3f} % (median); {marked} steps with remarks"
    )


def print_fit(out: Output, fit: FitUpdated, which: str = "") -> None:
    """The law over the band; `which` law it is, where there is another."""
    result = fit.result
    if result is None:
        out.say(f"no law identified: {fit.message}")
        return
    law = result.law
    shown = [law[k] for k in sorted({0, len(law) - 1, *_near(law, (20.0, 50.0, 100.0, 200.0, 280.0))})]
    rows = [
        [
            f"{r.frequency_hz:.4g}",
            with_error(r.storage_modulus_pa, r.storage_modulus_standard_error_pa, 1e-6, "+-"),
            with_error(r.loss_factor, r.loss_factor_standard_error, sign="+-"),
        ]
        for r in shown
    ]
    at = f" at {result.temperature_c:.1f} degC" if result.temperature_c is not None else ""
    of = f"core, {which}" if which else "core"
    out.table(f"{of}: shear modulus with one standard error{at}", ["f/Hz", "G'/MPa", "loss factor"], rows)
    chi2, held = result.chi2_per_dof, result.held_out_rms_percent
    out.say(
        f"residual {result.rms_percent:.2f} % rms"
        + (f", each segment from the others {held:.2f} %" if held is not None else "")
        + (f", chi-square per degree of freedom {chi2:.2f}" if chi2 is not None else "")
    )
    for warning in result.warnings:
        out.say(f"note: {warning}")


def print_found_diagnosis(out: Output, found: DiagnosisFound) -> None:
    """Verdict, explanation, error before and after."""
    out.say()
    if found.result is None:
        out.say(f"no diagnosis: {found.message}")
        return
    print_story(out, found.result)
    out.say()
    print_before_after(out, found.result)
    out.say()


def _near(law: Sequence[LawRow], wanted: tuple[float, ...]) -> list[int]:
    return [k for k, r in enumerate(law) if any(abs(r.frequency_hz - f) < 1e-9 * f for f in wanted)]


def _percent(e: RatioFound | None) -> str:
    return ratio_words(e.ratio, e.standard_error) if e else "refused"
