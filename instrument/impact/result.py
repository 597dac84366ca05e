"""An impact test's result, read off its modes."""

from fitting.bare_modes import CarriedSensor
from fitting.modal.frf import DampingEstimate, Refusal
from instrument.facts.damping import DampingResult, HitUsed, ModeFound, RatioFound, SensorOnPlate
from instrument.impact.damping import Damping


def damping_from(found: Damping) -> DampingResult:
    """The result of `damping`."""
    return DampingResult(
        modes=tuple(
            ModeFound(
                frequency_hz=m.frequency_hz,
                damping_ratio=m.damping_ratio,
                channel=m.channel,
                half_power=_ratio(m.half_power),
                rational_fit=_ratio(m.rational_fit),
                lscf=_ratio(m.lscf),
                lines_in_bandwidth=m.lines_in_bandwidth,
                bandwidths_to_next=m.bandwidths_to_next,
                accepted=bool(m.accepted),
                why=m.why,
            )
            for m in found.modes
        ),
        hits=tuple(HitUsed(source=j.hit.source, accepted=bool(j.accepted), why=j.why) for j in found.hits),
        warnings=found.warnings,
    )


def sensor_from(sensor: CarriedSensor) -> SensorOnPlate:
    """What sat on the plate."""
    return SensorOnPlate(mass_kg=sensor.mass_kg, x_m=sensor.x_m, y_m=sensor.y_m)


def _ratio(e: DampingEstimate | Refusal) -> RatioFound | None:
    return (
        RatioFound(ratio=e.ratio, standard_error=e.standard_error) if isinstance(e, DampingEstimate) else None
    )
