"""What a plan's steps wait for: a plate that decays slowly needs more patience than a sweep usually has."""

from dataclasses import replace

from fitting.arrays import Array, Complex
from instrument.facts.plan import SettlingForecast
from instrument.planning.costs import decay_of, settle_seconds
from instrument.stepped_sine.expected_time import left_at_most_s
from instrument.stepped_sine.patience import enough_s
from instrument.stepped_sine.settings import Settle, SweepSettings


def settling_forecast(
    frequency_hz: Array, poles_hz: Complex, settings: SweepSettings
) -> SettlingForecast | None:
    """Of a plan's steps; None where all settle within the usual `most_s`. Shapes (steps,), (poles,)."""
    waits = settle_seconds(frequency_hz, poles_hz, settings)
    usual = replace(settings, settle=replace(settings.settle, most_s=Settle().most_s))
    slow = waits > usual.settle.most_s
    if not slow.any():
        return None
    decay, most = decay_of(poles_hz), enough_s(float(waits.max()))
    left = max(left_at_most_s(f, decay(f), usual) for f in frequency_hz[slow].tolist())
    return SettlingForecast(
        steps=int(slow.sum()),
        usual_s=usual.settle.most_s,
        left_percent=100 * left,
        longest_s=float(waits.max()),
        most_s=most,
        never=int((waits > most).sum()),
    )
