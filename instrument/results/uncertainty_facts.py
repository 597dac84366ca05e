"""A deeper look at an identification's uncertainty: by profile, posterior or bootstrap."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.depth.bootstrap import bootstrap
from fitting.depth.intervals import Intervals
from fitting.depth.many import ManyResiduals
from fitting.depth.posterior import SAMPLES, Posterior, sample
from fitting.depth.profile import profile
from fitting.depth.quantities import Quantities
from fitting.identification.quoted import REFERENCE_FREQUENCIES_HZ
from instrument.facts.intervals import IntervalsFound, QuantityInterval
from instrument.finding.identification import Identified
from instrument.progress import Progress, quiet

Depth = Literal["profile", "posterior", "bootstrap"]


@dataclass(frozen=True)
class InDepth:
    """Intervals that one method gave, with the posterior where it was sampled."""

    intervals: tuple[Intervals, ...]
    """The bootstrap's are two: of points and of segments."""
    posterior: Posterior | None = None


def in_depth(
    found: Identified, method: Depth, samples: int = SAMPLES, progress: Progress = quiet
) -> InDepth | None:
    """At the band's ends and reference frequencies inside; None for the paper's method, or without errors.

    Of several fitted together by profile alone.
    """
    quantities = quantities_of(found)
    if quantities is None or found.joint is None:
        return None
    if method == "profile":
        return by_profile(quantities, progress)
    if found.joint.reduced is None:
        return None
    with threadpool_limits(1, "blas"), progress(f"uncertainty by {method}") as report:
        many = ManyResiduals(found.joint.task, found.joint.reduced)
        if method == "bootstrap":
            return InDepth((bootstrap(quantities, many), bootstrap(quantities, many, "segments")))
        drawn = sample(quantities, many, samples, report=report)
        return InDepth((drawn.intervals,), drawn)


def by_profile(quantities: Quantities, progress: Progress = quiet) -> InDepth:
    """Look at a fit of sweeps, tables or temperatures, whatever the quantities are of."""
    with threadpool_limits(1, "blas"), progress("uncertainty by profile") as report:
        return InDepth((profile(quantities, report),))


def quantities_of(found: Identified) -> Quantities | None:
    """What `in_depth` looks at; None where it has nothing to look at."""
    if found.joint is None or np.isnan(found.result.uncertainty.covariance).any():
        return None
    f = found.result.band.frequency_hz
    return found.joint.quantities(looked_at_hz(float(f[0]), float(f[-1])))


def looked_at_hz(low: float, high: float) -> Array:
    """The ends of a band, and the reference frequencies inside. Shape (frequencies,)."""
    return np.array(sorted({low, high, *(r for r in REFERENCE_FREQUENCIES_HZ if low < r < high)}))


def in_depth_facts(looked: InDepth) -> list[IntervalsFound]:
    """Intervals as JSON holds them, an item a method."""
    found = [_intervals(i) for i in looked.intervals]
    p = looked.posterior
    if p is not None:
        found[0] = found[0].but(
            samples=p.samples,
            seconds=p.seconds,
            full_evaluations_in_that_time=p.seconds / p.one_evaluation_s,
            acceptance=p.acceptance,
            effective_samples=dict(zip(p.intervals.names, p.effective.tolist(), strict=True)),
            r_hat=dict(zip(p.intervals.names, p.r_hat.tolist(), strict=True)),
            checked_in_full=p.checked,
            weights_effective_share=p.weight_share,
            weights_log_standard_deviation=p.log_error,
        )
    return found


def _intervals(i: Intervals) -> IntervalsFound:
    quantities = tuple(
        QuantityInterval(
            quantity=name,
            value=i.found[k],
            interval_68_percent=i.bounds[68][k],
            interval_95_percent=i.bounds[95][k],
            linear_68_percent=i.linear[68][k],
            linear_95_percent=i.linear[95][k],
        )
        for k, name in enumerate(i.names)
    )
    return IntervalsFound(method=i.method, quantities=quantities, advice=i.advice)
