"""Intervals by a deeper method beside the linear ones."""

import math

from fitting.arrays import Array
from fitting.depth.intervals import Intervals
from instrument.cli.output import Output
from instrument.results.uncertainty_facts import InDepth


def print_in_depth(out: Output, looked: InDepth) -> None:
    """Tables, the sampler's own numbers, and the advice."""
    for intervals in looked.intervals:
        _table(out, intervals)
        out.say(intervals.advice)
    p = looked.posterior
    if p is None:
        return
    out.say(
        f"{p.samples} samples in {p.seconds:.1f} s, as long as {p.seconds / p.one_evaluation_s:.0f} full "
        f"evaluations; effective sample size {p.effective.min():.0f} to {p.effective.max():.0f}, "
        f"R-hat up to {p.r_hat.max():.3f}"
    )
    out.say(
        f"{p.checked} samples evaluated in full: their weights are worth {100 * p.weight_share:.0f} % of them"
    )
    if p.r_hat.max() > _RESTLESS:
        out.say("note: the chains do not agree yet, take more --samples")
    if p.weight_share < _FAR:
        out.say("note: the response in full differs from the sampled one: rely on --uncertainty profile")


_RESTLESS, _FAR = 1.05, 0.3
"""R-hat, as usually advised (Gelman and others, Bayesian Data Analysis, took 1.1); and the share of
weights."""


def _table(out: Output, i: Intervals) -> None:
    rows = [
        [
            name,
            f"{i.found[k]:.5g}",
            *(_range(b[level][k]) for level in (68, 95) for b in (i.linear, i.bounds)),
        ]
        for k, name in enumerate(i.names)
    ]
    columns = ["quantity", "found", "linear 68 %", f"{i.method} 68 %", "linear 95 %", f"{i.method} 95 %"]
    out.table(f"intervals by {i.method}", columns, rows)


def _range(bounds: Array) -> str:
    return " to ".join("open" if math.isnan(b) else f"{b:.4g}" for b in bounds.tolist())
