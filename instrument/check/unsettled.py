"""Steps that will not have come to rest when `most_s` ends their wait: said before they are measured."""

from collections.abc import Sequence

from fitting.digits import two_digits
from instrument.check.forecast import Forecast
from instrument.stepped_sine.expected_time import left_at_most_s, settling_s
from instrument.stepped_sine.patience import enough_s
from instrument.stepped_sine.plan import PlannedSegment
from instrument.stepped_sine.settings import SweepSettings


def unsettled_remark(
    forecast: Forecast, planned: Sequence[PlannedSegment], settings: SweepSettings
) -> str | None:
    """One line where readings of the plan are not of the steady response; None where all are."""
    every = [(f, forecast.decay_1_s(f)) for s in planned for f in s.frequencies_hz]
    most = settings.settle.most_s
    waits = [settling_s(f, decay, settings) for f, decay in every]
    slow = [at for at, wait in zip(every, waits, strict=True) if wait > most]
    if not slow:
        return None
    longest, left = max(waits), max(left_at_most_s(f, decay, settings) for f, decay in slow)
    enough = enough_s(longest)
    cure = (
        f"[sweep.settle] most_s = {enough:g} would do"
        if longest <= enough
        else f"not even most_s = {enough:g} would do"
    )
    return (
        f"{len(slow)} of {len(every)} readings (calibration and sentinel among them) do not settle within "
        f"most_s = {most:g}: up to {longest:.0f} s are needed, {two_digits(100 * left)} % left then, limit "
        f"{100 * settings.settle.tolerance:.2g} %; {cure}"
    )
