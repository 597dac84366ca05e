"""The one result line: which law is to be signed, and its words. Any other law is labelled as what it is."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from fitting.data.level import LEAST_PERCENT
from fitting.digits import written_out
from fitting.gravity import STANDARD_GRAVITY_M_S2
from fitting.identification.doubt import BIASED
from fitting.identification.quoted import quoted_hz
from fitting.sweep import Sweep
from instrument.facts.diagnosis import DiagnosisResult, StageFitted
from instrument.facts.doubts import doubts_of
from instrument.facts.identification import IdentificationResult
from instrument.facts.rows import LawRow
from instrument.facts.session_result import SessionResult, Standing
from instrument.results.diagnosis_words import verdict_line
from instrument.results.numbers import with_error
from instrument.session.contents import Contents
from instrument.stream.derived import DiagnosisFound, FitUpdated, PointMeasured

BEFORE_DIAGNOSIS = "before the diagnosis"
"""What every other law of a diagnosed session is called."""
_DOUBT = "nothing explains what this fit leaves: the law may be far off its band"


@dataclass(frozen=True)
class Conditions:
    """What a law was measured under: lowest and highest, None where nobody said."""

    points: int
    level_m_s2: tuple[float, float] | None = None
    """Asked for; reached, where the drive's limit kept the base from that."""
    temperature_c: tuple[float, float] | None = None
    short_percent: float = 0.0
    """Most that the drive's limit kept the base under its level by."""

    @classmethod
    def of_points(cls, points: Sequence[PointMeasured]) -> "Conditions":
        """Of a session's steps and sentinels."""
        swept = [p for p in points if p.purpose != "calibration"]
        read = [p.temperature_c for p in swept if p.temperature_c is not None]
        asked = [p.level_m_s2 for p in swept]
        reached = [p.level_reached_m_s2 for p in swept]
        return cls(len(swept), _range(reached), _range(read), _short_percent(asked, reached))

    @classmethod
    def of_sweep(cls, sweep: Sweep, temperature_c: float | None = None) -> "Conditions":
        """The conditions that a sweep's file tells of."""
        read = [] if temperature_c is None else [temperature_c]
        asked, reached = sweep.commanded_m_s2.tolist(), sweep.level_m_s2.tolist()
        return cls(len(sweep), _range(reached), _range(read), _short_percent(asked, reached))

    @classmethod
    def of_diagnosis(cls, found: DiagnosisResult) -> "Conditions":
        """Of the points it was made of."""
        return cls(len(found.points) + len(found.set_aside_hz), _range([p.level_m_s2 for p in found.points]))


def result_of(
    identified: IdentificationResult | None,
    diagnosed: DiagnosisResult | None,
    conditions: Conditions,
    why: str = "",
) -> SessionResult:
    """The law after the diagnosis; that of the identification where nothing was diagnosed.

    `why` there is no law, or no diagnosis.
    """
    if diagnosed is not None:
        points = len(diagnosed.points) + len(diagnosed.set_aside_hz)
        standing: Standing = "by hand" if diagnosed.by_hand else "diagnosed"
        return _said(standing, diagnosed.after, verdict_line(diagnosed), conditions, points, diagnosed)
    if identified is not None:
        said = f"not diagnosed: {why}" if why else "not diagnosed"
        points = len(identified.points) + len(identified.points_set_aside)
        return _said("not diagnosed", identified, said, conditions, points, None)
    return SessionResult(
        words=f"no law identified{': ' if why else ''}{why}",
        standing="no law",
        points=0,
        points_measured=conditions.points,
    )


def result_of_events(
    fit: FitUpdated | None, diagnosis: DiagnosisFound | None, points: Sequence[PointMeasured]
) -> SessionResult:
    """Of what a run found last."""
    identified = fit.result if fit is not None else None
    diagnosed = diagnosis.result if diagnosis is not None else None
    why = next((e.message for e in (diagnosis, fit) if e is not None and e.message), "")
    return result_of(identified, diagnosed, Conditions.of_points(points), why)


def recorded_result(contents: Contents) -> SessionResult:
    """Of a session, from what was recorded; where the run ended early, that and how to go on."""
    fit, diagnosis = contents.fit, contents.diagnosis
    if diagnosis is not None or (fit is not None and fit.message) or not (early := _ended_early(contents)):
        return result_of_events(fit, diagnosis, contents.measured)
    return result_of(fit.result if fit else None, None, Conditions.of_points(contents.measured), early)


def _ended_early(contents: Contents) -> str:
    """What happened and what to do; empty for a run that was done."""
    ended, points = contents.ended, Conditions.of_points(contents.measured).points
    if ended is not None and ended.why == "done":
        return ""
    happened = "the run was killed" if ended is None else f"the run was {ended.why}"
    more = f" ({' '.join(ended.message.split())})" if ended is not None and ended.message else ""
    folder = f"{contents.configuration.name}.running"
    # A whole run sweeps only after its hammer test: without one it was begun as a sweep alone.
    alone = contents.configuration.experiment.hammer is not None and contents.damping is None and points > 0
    again = contents.configuration.resumed("sweep" if alone else "run", folder)
    return (
        f"{happened}{more} after {points} point{'' if points == 1 else 's'}; to go on: {again}; a law of "
        f"what is there: viscorig identify {shlex.quote(contents.path.name)}"
    )


def _doubt(fit: IdentificationResult | StageFitted, diagnosed: DiagnosisResult | None) -> str:
    """What is to be said beside the law; empty where nothing is doubted."""
    if diagnosed is not None and diagnosed.verdict == "unknown":
        return _DOUBT
    said = diagnosed if diagnosed is not None else fit
    doubted = isinstance(said, DiagnosisResult | IdentificationResult) and bool(doubts_of(said))
    return f"{BIASED}: see the notes" if doubted else ""


def _said(
    standing: Standing,
    fit: IdentificationResult | StageFitted,
    verdict: str,
    conditions: Conditions,
    points: int,
    diagnosed: DiagnosisResult | None,
) -> SessionResult:
    law = _shown(fit.law)
    f = [row.frequency_hz for row in fit.law]
    band = (min(f), max(f)) if f else None
    parts = [
        "; ".join(law_words(row) for row in law),
        ", ".join(_valid(band, conditions)),
        f"{points} of {conditions.points} points" if points < conditions.points else "",
        f"rms {written_out(fit.rms_percent, 3)} %",
        verdict,
        _doubt(fit, diagnosed),
    ]
    level, temperature = conditions.level_m_s2, conditions.temperature_c
    return SessionResult(
        words="; ".join(p for p in parts if p),
        standing=standing,
        verdict=diagnosed.verdict if diagnosed is not None else None,
        effects=tuple(diagnosed.equivalent) if diagnosed is not None else (),
        law_kind=fit.law_kind,
        law=law,
        rms_percent=fit.rms_percent,
        low_hz=band[0] if band else None,
        high_hz=band[1] if band else None,
        low_level_m_s2=level[0] if level else None,
        high_level_m_s2=level[1] if level else None,
        temperature_range_c=temperature,
        points=points,
        points_measured=conditions.points,
    )


def _shown(law: Sequence[LawRow]) -> tuple[LawRow, ...]:
    quoted = quoted_hz(row.frequency_hz for row in law)
    return tuple(row for row in law if row.frequency_hz in quoted)


def law_words(row: LawRow) -> str:
    """G' and eta at one frequency."""
    G = _banded(row.storage_modulus_pa, row.storage_modulus_standard_error_pa, 1e-6)
    eta = _banded(row.loss_factor, row.loss_factor_standard_error)
    return f"{row.frequency_hz:.4g} Hz: G' {G} MPa, loss factor {eta}"


def _banded(value: float, error: float, scale: float = 1.0) -> str:
    return with_error(value, error, scale).replace("±", "+-")


def _valid(band: tuple[float, float] | None, conditions: Conditions) -> list[str]:
    """Band, level, temperature."""
    said = [f"valid {band[0]:.4g} to {band[1]:.4g} Hz"] if band else []
    if conditions.level_m_s2 is not None:
        level = _between(conditions.level_m_s2, 1.0, "m/s^2", 4)
        said.append(f"at {level} ({_between(conditions.level_m_s2, 1 / STANDARD_GRAVITY_M_S2, 'g', 3)})")
    if conditions.short_percent > LEAST_PERCENT:
        by = written_out(conditions.short_percent, 2)
        said.append(f"the drive's limit kept the base up to {by} % under its level")
    if conditions.temperature_c is None:
        return [*said, "temperature not known"]
    return [*said, _between(conditions.temperature_c, 1.0, "degC", 3)]


def _between(ends: tuple[float, float], scale: float, unit: str, digits: int) -> str:
    low, high = (f"{scale * end:.{digits}g}" for end in ends)
    return f"{low} {unit}" if low == high else f"{low} to {high} {unit}"


def _short_percent(asked_m_s2: Sequence[float], reached_m_s2: Sequence[float]) -> float:
    short = (1 - reached / asked for asked, reached in zip(asked_m_s2, reached_m_s2, strict=True) if asked)
    return 100 * max(short, default=0.0)


def _range(values: Sequence[float]) -> tuple[float, float] | None:
    known = [v for v in values if isfinite(v)]
    return (min(known), max(known)) if known else None
