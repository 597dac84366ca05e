"""One step, followed on a station made of formulas from its command to its point."""

from dataclasses import replace

import numpy as np
from station import BASE_V, RANGE, RATE, began, of_kind

from instrument.stepped_sine.settings import SweepSettings
from instrument.stepped_sine.step import StepAnalysis
from instrument.stepped_sine.step_context import StepContext
from instrument.stream.derived import (
    DriveRequested,
    LimitExceeded,
    PointMeasured,
    RangeRequested,
)
from instrument.stream.scaling import Scaling

SCALING = Scaling({"base": 0, "velocity": 1}, {"base": 1 / BASE_V, "velocity": 1.0})
SETTINGS = SweepSettings()


def context_of(station, light=0.8):
    """A step that begins now, in a fine range without a calibration."""
    return StepContext(SETTINGS, SCALING, RATE, RANGE, station.now, signal_level=light)


def follow(
    station,
    step=None,
    settings=SETTINGS,
    *,
    wider=(),
    calibration=None,
    light=0.8,
    told=True,
    most=200,
    settled_at=None,
    range_is_new=False,
):
    """Do what the step asks for until it is done or gives up; every event."""
    step = step or began()
    ask = (lambda name: calibration) if calibration else None
    context = replace(
        context_of(station, light),
        settings=settings,
        wider=wider,
        calibration=ask,
        settled_at=settled_at,
        range_is_new=range_is_new,
    )
    analysis = StepAnalysis(step, context)
    analysis.commanded(station.command(step.frequency_hz, step.drive_v, told=told))
    events = []
    for _ in range(most):
        if analysis.done or of_kind(events, LimitExceeded) or of_kind(events, RangeRequested):
            break
        first, volts = station.read(analysis.wanted())
        overload = tuple(bool(v) for v in (np.abs(volts) > 10.0).any(axis=1))
        new = analysis.block(first, volts, overload)
        for request in of_kind(new, DriveRequested):
            analysis.commanded(station.command(step.frequency_hz, request.drive_v, told=told))
        events += new
    return events


def point_of(events):
    (point,) = of_kind(events, PointMeasured)
    return point
