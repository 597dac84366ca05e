"""An experiment before it is run: everything wrong with its files at once, then a dry run on the forecast."""

from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Literal

import numpy as np

from fitting.errors import FittingError
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.check.bare_test import bare_test_remarks
from instrument.check.coarse_steps import coarse_remarks
from instrument.check.faults import experiment_objections
from instrument.check.few_frequencies import few_frequencies_remark
from instrument.check.follow_up_remark import follow_up_remarks
from instrument.check.forecast import (
    Forecast,
    calibration_segments,
    distinct,
    expected_seconds,
    planned_segments,
    with_next_coarser,
)
from instrument.check.odd_segments import odd_segment_remarks
from instrument.check.sensors import sensor_remarks
from instrument.check.unsettled import unsettled_remark
from instrument.errors import BadInput
from instrument.facts.check import CheckResult, SegmentForecast, SoakForecast
from instrument.files.acceleration import in_both
from instrument.files.devices import ranges_of
from instrument.files.experiment_file import experiment_faults, read_experiment
from instrument.files.rig_file import RigDocument
from instrument.files.structure_file import read_structure
from instrument.files.toml import document_faults, read_tables
from instrument.remarks.theory import theory_remark
from instrument.remarks.tolerance_words import tolerances_used
from instrument.session.configuration import Experiment, read_whole_experiment
from instrument.session.setup import hammer_settings, setup_of
from instrument.stepped_sine.plan import PlannedSegment
from instrument.stepped_sine.settings import SweepSettings

_HIT_AND_RING_S = 3.0
"""A person's time for a hit, beside its record."""


@dataclass(frozen=True)
class DryRun:
    """A run that was not made."""

    segments: tuple[SegmentForecast, ...]
    mode_hz: tuple[float, ...]
    hammer_record_s: float | None
    seconds: float
    specimen: AnySpecimen
    warnings: tuple[str, ...]
    temperature: SoakForecast | None = None

    @property
    def result(self) -> CheckResult:
        """That of `viscorig check`."""
        return CheckResult(
            segments=self.segments,
            modes_hz=self.mode_hz,
            hammer_record_s=self.hammer_record_s,
            temperature=self.temperature,
            seconds=self.seconds,
            exact=self.specimen.exact,
            tolerances=tolerances_used(self.specimen),
            warnings=self.warnings,
        )


def all_faults(path: Path) -> list[str]:
    """Everything wrong with an experiment file and the files it names; empty for none."""
    found = experiment_faults(path)
    if found:
        return found + _faults_of_named(path)
    experiment = read_experiment(path)
    found = document_faults(path.parent / experiment.rig, RigDocument)
    found = _missing(path, experiment.rig, "rig") or found
    found += _missing(path, experiment.specimen, "specimen") or _specimen_faults(
        path.parent / experiment.specimen
    )
    if found:
        return found
    whole = read_whole_experiment(path)
    try:
        return experiment_objections(whole, Forecast.of(whole.the_specimen()), ("hammer", "sweep"))
    except FittingError as error:
        return [f"{path}: {error}"]


def dry_run(path: Path) -> DryRun:
    """Predicted levels, ranges, travel and times. Raises `BadInput`."""
    experiment = read_whole_experiment(path)
    specimen = experiment.the_specimen()
    configuration = experiment.configuration("check", "")
    settings = setup_of(configuration).sweep
    hammer = hammer_settings(configuration)
    try:
        forecast = Forecast.of(specimen)
        segments, seconds, warnings = _sweep(experiment, forecast, settings)
    except FittingError as error:
        raise BadInput(f"{path}: {error}") from None
    warnings += [*sensor_remarks(experiment.rig, date.today()), *follow_up_remarks(experiment)]
    band = np.array([f for s in segments for f in (s.low_hz, s.high_hz)])
    if len(band) and specimen.core is not None:
        outside = specimen.core.law.outside(band)
        warnings += [outside] if outside else []
        plate = specimen if isinstance(specimen, PlateSpecimen) else None
        remark = theory_remark(plate, specimen.core.law, band) if plate is not None else ""
        warnings += [f"with the law to start from, {remark}"] if remark else []
    table = experiment.document.hammer
    if hammer is not None and table is not None:
        warnings += bare_test_remarks(experiment, table)
        seconds += hammer.hits * (hammer.record_s + _HIT_AND_RING_S)
    asked = experiment.document.temperature if experiment.document.sweep is not None else None
    seconds += asked.soak_s if asked is not None else 0.0
    return DryRun(
        segments,
        tuple(float(f) for f in forecast.mode_hz),
        hammer.record_s if hammer is not None else None,
        seconds,
        specimen,
        tuple(warnings),
        SoakForecast(**asked.model_dump()) if asked is not None else None,
    )


def _sweep(
    experiment: Experiment, forecast: Forecast, settings: SweepSettings
) -> tuple[tuple[SegmentForecast, ...], float, list[str]]:
    table = experiment.document.sweep
    if table is None:
        return (), 0.0, []
    ranges = distinct(ranges_of(experiment.rig.vibrometer))
    planned, sentinel = planned_segments(forecast, table, ranges)
    names = with_next_coarser([s.range_name for s in planned], ranges)
    calibration = calibration_segments(table, names, ranges)
    level = table.level_g * PUBLISHED_G_M_S2
    segments = tuple(_segment(forecast, s, settings) for s in planned)
    warnings = [w for s in segments for w in _warnings(s, settings)]
    if table.plan == "fixed":
        once = [s for s in planned if s.sweep == 1]
        warnings += [*odd_segment_remarks(table.segments, once)]
        warnings += [w for s in once for w in coarse_remarks(forecast, s)]
        core = experiment.the_specimen().core
        few = few_frequencies_remark(core.law if core is not None else None, planned)
        warnings += [few] if few else []
    if level > settings.limits.base_m_s2:
        warnings.append(f"level {in_both(level)} is over the base limit {in_both(settings.limits.base_m_s2)}")
    unverified = [r.name for r in ranges if r.name in names and not r.verified]
    if unverified:
        warnings.append(
            f"vibrometer range {', '.join(unverified)}: from memory, not from a manual; calibrate in place"
        )
    highest = max(s.high_hz for s in segments)
    if experiment.rig.front_end.sample_rate_hz < 10 * highest:
        rate = experiment.rig.front_end.sample_rate_hz
        warnings.append(
            f"{rate:g} samples/s for {highest:g} Hz: take {10 * highest:g} or more to see harmonics"
        )
    repeats = (len(planned) + 1) * (sentinel is not None)
    watches = [PlannedSegment(0, 0, (sentinel[0],), (level,), "")] * repeats if sentinel else []
    every = [*planned, *calibration, *watches]
    slow = unsettled_remark(forecast, every, settings)
    return segments, expected_seconds(forecast, every, settings), warnings + ([slow] if slow else [])


def _segment(forecast: Forecast, planned: PlannedSegment, settings: SweepSettings) -> SegmentForecast:
    f, level = np.array(planned.frequencies_hz), np.array(planned.level_m_s2)
    return SegmentForecast(
        segment=planned.segment,
        low_hz=float(f.min()),
        high_hz=float(f.max()),
        steps=len(f),
        range_name=planned.range_name,
        velocity_m_s=float(forecast.velocity_m_s(f, float(level[0])).max()),
        travel_m=float((level / (2 * np.pi * f) ** 2).max()),
        seconds=expected_seconds(forecast, [planned], settings),
    )


def _warnings(s: SegmentForecast, settings: SweepSettings) -> list[str]:
    limits, said = settings.limits, []
    if s.velocity_m_s > limits.velocity_m_s:
        said.append(
            f"segment {s.segment}: {s.velocity_m_s:.3g} m/s predicted, limit {limits.velocity_m_s:.3g} m/s"
        )
    if s.travel_m > limits.travel_m:
        said.append(
            f"segment {s.segment}: travel {1e3 * s.travel_m:.3g} mm, limit {1e3 * limits.travel_m:.3g} mm"
        )
    return said


def _faults_of_named(path: Path) -> list[str]:
    """Of the rig and the specimen, where the experiment is well enough to name them."""
    try:
        named = read_tables(path)
    except (BadInput, RecursionError, ValueError):
        return []
    found = []
    if isinstance(rig := named.get("rig"), str):
        found += _missing(path, rig, "rig") or document_faults(path.parent / rig, RigDocument)
    if isinstance(specimen := named.get("specimen"), str):
        found += _missing(path, specimen, "specimen") or _specimen_faults(path.parent / specimen)
    return found


def _missing(path: Path, named: str, key: Literal["rig", "specimen"]) -> list[str]:
    """A line where there is no file of a name that an experiment gives."""
    where = path.parent / named
    return [] if where.exists() else [f"{where}: no such file, named by {key} = {named!r} in {path}"]


def _specimen_faults(path: Path) -> list[str]:
    try:
        read_structure(path)
    except BadInput as error:
        return [str(error)]
    return []
