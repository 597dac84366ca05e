"""The point that a sound reading makes: calibrated, with its error and what is to be said of it."""

from dataclasses import dataclass

import numpy as np

from instrument.stepped_sine.lost_velocity import noise_remarks
from instrument.stepped_sine.sine_fit import SineFit
from instrument.stepped_sine.step_context import StepContext
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import StepBegan

_BOUND = 3.0
"""What may be left of a transient is bounded; a third of that counts as a standard deviation of each part."""

NOT_CALIBRATED = "is not calibrated"
"""Of a range of the vibrometer: whoever counts or says remarks knows that one by it."""


@dataclass(frozen=True)
class Reading:
    """A sound reading, and how its step came to it."""

    first_sample: int
    dwell_s: float
    settle_s: float
    fit: SineFit
    left: float
    """What may be left of the transient: share of the velocity."""
    level_m_s2: float
    control_error: float
    """Relative error of the level."""
    drive_v: float
    range_name: str
    remarks: tuple[str, ...]


def point_of(reading: Reading, began: StepBegan, context: StepContext) -> PointMeasured:
    """The point measured by a step's reading."""
    fit, remarks = reading.fit, list(reading.remarks)
    velocity = fit.phasor[1]
    remarks += noise_remarks(float(abs(velocity)), float(fit.std[1]))
    velocity_std = np.hypot(fit.std[1], reading.left * abs(velocity) / _BOUND)
    if context.calibration is not None:
        calibration = context.calibration(reading.range_name)
        if calibration is None:
            remarks.append(f"range {reading.range_name} {NOT_CALIBRATED}")
        else:
            velocity = calibration.true_velocity(began.frequency_hz, velocity)
            velocity_std = velocity_std / calibration.gain
    if context.signal_level is not None and context.signal_level < context.settings.least_signal_level:
        remarks.append(f"weak light: signal level {context.signal_level:.2f}")
    return PointMeasured(
        step=began.step,
        purpose=began.purpose,
        segment=began.segment,
        sweep=began.sweep,
        frequency_hz=began.frequency_hz,
        level_m_s2=reading.level_m_s2,
        sample=reading.first_sample,
        dwell_s=reading.dwell_s,
        settle_s=reading.settle_s,
        drive_v=reading.drive_v,
        base_accel_re_m_s2=float(fit.phasor[0].real),
        base_accel_im_m_s2=float(fit.phasor[0].imag),
        base_accel_std_m_s2=float(fit.std[0]),
        velocity_re_m_s=float(velocity.real),
        velocity_im_m_s=float(velocity.imag),
        velocity_std_m_s=float(velocity_std),
        control_error_percent=100 * reading.control_error,
        base_distortion_percent=100 * float(fit.distortion[0]),
        velocity_distortion_percent=100 * float(fit.distortion[1]),
        range_name=reading.range_name,
        signal_level=context.signal_level,
        temperature_c=float(fit.mean[2]) if context.scaling.has("temperature") else context.temperature_c,
        remarks=tuple(remarks),
    )
