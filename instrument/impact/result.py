"""An impact test's result, read off its modes."""

from math import nan

import numpy as np

from fitting.dynamics.bare_modes import CarriedSensor
from fitting.modal.frf import DampingEstimate, Refusal
from instrument.facts.damping import DampingResult, HitUsed, ModeFound, RatioFound, SensorOnPlate
from instrument.impact.damping import Damping
from instrument.impact.mode import Mode


def damping_from(found: Damping) -> DampingResult:
    """The result of the command `damping`."""
    return DampingResult(
        modes=tuple(
            ModeFound(
                frequency_hz=m.frequency_hz,
                frequency_standard_error_hz=_frequency_error(m),
                damping_ratio=m.damping_ratio,
                channel=m.channel,
                half_power=_ratio(m.half_power),
                rational_fit=_ratio(m.rational_fit),
                lscf=_ratio(m.lscf),
                lines_in_bandwidth=m.lines_in_bandwidth,
                bandwidths_to_next=m.bandwidths_to_next,
                coherence=_coherence(found, m),
                accepted=bool(m.accepted),
                why=m.why,
            )
            for m in found.modes
        ),
        hits=tuple(HitUsed(source=j.hit.source, accepted=bool(j.accepted), why=j.why) for j in found.hits),
        warnings=found.warnings,
        band_hz=found.band_hz,
    )


def sensor_from(sensor: CarriedSensor) -> SensorOnPlate:
    """What sat on the plate."""
    return SensorOnPlate(mass_kg=sensor.mass_kg, x_m=sensor.x_m, y_m=sensor.y_m)


def _frequency_error(mode: Mode) -> float:
    adopted = mode.rational_fit
    return adopted.frequency_error_hz if isinstance(adopted, DampingEstimate) else nan


def _coherence(found: Damping, mode: Mode) -> float:
    """Mean over its bandwidth, over the nearest line at least."""
    if found.coherence is None:
        return nan
    f, half = found.plain[mode.channel].frequency_hz, mode.damping_ratio * mode.frequency_hz
    inside = np.abs(f - mode.frequency_hz) <= (half if half == half else 0.0)
    inside[np.argmin(np.abs(f - mode.frequency_hz))] = True
    return float(np.mean(found.coherence[mode.channel][inside]))


def _ratio(e: DampingEstimate | Refusal) -> RatioFound | None:
    return (
        RatioFound(ratio=e.ratio, standard_error=e.standard_error) if isinstance(e, DampingEstimate) else None
    )
