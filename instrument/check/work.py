"""All the work of a run, piece by piece, with the time each will take: what a time to go is made of."""

import numpy as np

from fitting.specimen import Kind as Structure
from instrument.check.forecast import (
    Forecast,
    calibration_segments,
    distinct,
    planned_segments,
    with_next_coarser,
)
from instrument.check.piece import Kind, Region, TimedPiece
from instrument.files.devices import ranges_of
from instrument.session.configuration import Experiment
from instrument.session.setup import hammer_settings, setup_of

_MOUNT_S, _AIM_S, _STRIKE_S = 180.0, 60.0, 3.0
"""A person's time."""
_COMPUTED_S: dict[Structure, tuple[float, float]] = {
    "plate": (3.0, 60.0),
    "beam": (1.0, 4.0),
    "shear-pair": (0.5, 2.0),
}
"""Fit and diagnosis, by structure. Processor time measured of two plates: 0.7 to 2.7 s and 13 or 156 s; of
six beams: 0.5 to 1 s and 2 to 5 s; of three shear pairs: 0.1 to 0.4 s and 1 to 2.5 s. What it really takes
shows in the run."""

_ADAPTIVE_TURNS = 3
"""Steps of an adaptive sweep for every resonance and end of its band: a guess, nobody knows before."""


def planned_work(
    experiment: Experiment, forecast: Forecast, parts: tuple[str, ...]
) -> tuple[TimedPiece, ...]:
    """In order. Raises `BadInput`."""
    found: list[TimedPiece] = []
    person = experiment.rig.operator.kind == "person"
    configuration = experiment.configuration("", "")
    hammer = hammer_settings(configuration)
    if hammer is not None and "hammer" in parts:
        found += [TimedPiece("mount", _MOUNT_S)] * person
        found += [TimedPiece("hit", hammer.record_s + person * _STRIKE_S)] * hammer.hits
    if experiment.document.sweep is not None and "sweep" in parts:
        found += _sweep(experiment, forecast, person)
    return tuple(found)


def _sweep(experiment: Experiment, forecast: Forecast, person: bool) -> list[TimedPiece]:
    table, settings = experiment.document.sweep, setup_of(experiment.configuration("", "")).sweep
    assert table is not None
    ranges = distinct(ranges_of(experiment.rig.vibrometer))
    segments, sentinel = planned_segments(forecast, table, ranges)
    used = [s.range_name for s in segments] + ([sentinel[1]] if sentinel else [])
    wait = float(np.log(1 / settings.settle.tolerance))

    def step(kind: Kind, frequency_hz: float) -> TimedPiece:
        settling = min(wait / forecast.decay_1_s(frequency_hz), settings.settle.most_s)
        # A drive comes up, and two blocks are compared, before anything can be called settled.
        least = settings.control.ramp_s + 2 * settings.block_s(frequency_hz)
        return TimedPiece(kind, least + settings.dwell_s(frequency_hz), settling)

    watch = [step("sentinel", sentinel[0])] if sentinel else []
    calibration = calibration_segments(table, with_next_coarser(used, ranges), ranges)
    found = [TimedPiece("mount", _MOUNT_S)] * person
    if calibration:
        found += [TimedPiece("aim", _AIM_S)] * person
        found += [step("calibration", f) for s in calibration for f in s.frequencies_hz]
    found += [TimedPiece("aim", _AIM_S)] * person
    temperature = experiment.document.temperature
    if temperature is not None:
        # How long the chamber takes to its set point nobody knows before.
        found.append(TimedPiece("soak", temperature.soak_s))
    found += watch
    for segment in segments * (_ADAPTIVE_TURNS if table.plan == "adaptive" else 1):
        found += [step("step", f) for f in segment.frequencies_hz] + watch
    fit_s, diagnosis_s = _COMPUTED_S[experiment.the_specimen().kind]
    return [*found, TimedPiece("fit", fit_s), TimedPiece("diagnosis", diagnosis_s)]


def planned_regions(experiment: Experiment, forecast: Forecast) -> tuple[Region, ...]:
    """Of every segment, once; none without a sweep. Raises `BadInput`."""
    table = experiment.document.sweep
    if table is None:
        return ()
    segments, _ = planned_segments(forecast, table, distinct(ranges_of(experiment.rig.vibrometer)))
    return tuple((s.segment, min(s.frequencies_hz), max(s.frequencies_hz)) for s in segments if s.sweep == 1)
