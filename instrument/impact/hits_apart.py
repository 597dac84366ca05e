"""Hits beside each other: one of another plate (a hand on it, a clamp that slipped, another temperature).

Their mean is then no plate's: a peak from two frequencies is a wide one. So every hit is fitted by itself,
and of a mode that differs from hit to hit the median of theirs is adopted, with an error by their scatter.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array, Mask
from fitting.modal.frf import DampingEstimate, Frf
from fitting.modal.rational_fit import MOST_TERMS, RationalFit, rational_fit
from instrument.impact.judge import Judged
from instrument.impact.mode import Mode

_ERRORS = 6.0
"""Standard errors from the median of all: those of few lines are too small by up to a half."""
_RATIO, _FREQUENCY = 0.04, 0.06
"""The least that counts: of the damping ratio, and of a frequency in shares of half its bandwidth, where the
mean of all is off by half a percent. Choices."""
_OF_A_MEDIAN = 1.25
"""Its standard error over a mean's, of a normal scatter."""


def told_apart(
    good: Sequence[Judged], alone: Sequence[Mapping[str, Frf]], modes: Sequence[Mode]
) -> tuple[tuple[Mode, ...], list[str]]:
    """Modes with the median of the hits where these differ, and which hits do, for people.

    `alone` are the FRFs of each by itself.
    """
    if len(good) < 2:
        return tuple(modes), []
    found, off = list[Mode](), dict[int, list[float]]()
    with threadpool_limits(1, "blas"):
        for mode in modes:
            if not mode.accepted:
                found.append(mode)
                continue
            others = tuple(m.frequency_hz for m in modes if m is not mode)
            fits = [
                rational_fit(of[mode.channel], mode.frequency_hz, mode.damping_ratio, others, MOST_TERMS)
                for of in alone
            ]
            each = {k: f.estimate for k, f in enumerate(fits) if isinstance(f, RationalFit)}
            apart = _apart(list(each.values()))
            if not apart.any():
                found.append(mode)
                continue
            for k in np.array(list(each))[apart].tolist():
                off.setdefault(k, []).append(mode.frequency_hz)
            found.append(_median(mode, list(each.values())))
    return tuple(found), _said(good, off)


def _numbers(each: Sequence[DampingEstimate]) -> tuple[Array, Array, Array]:
    """Frequencies, ratios and the ratios' errors. Shape (hits,) each."""
    f, ratio, error = np.array([(e.frequency_hz, e.ratio, e.standard_error) for e in each]).reshape(-1, 3).T
    return f, ratio, error


def _apart(each: Sequence[DampingEstimate]) -> Mask:
    """Which differ from the median of all. Shape (hits,)."""
    if len(each) < 2:
        return np.zeros(len(each), bool)
    f, ratio, error = _numbers(each)
    usual = float(np.median(ratio))
    # A frequency is known, as a share of itself, as well as its ratio is.
    known = _ERRORS * np.hypot(error, np.median(error) / np.sqrt(len(each)))
    by_ratio = np.abs(ratio - usual) > np.maximum(known, _RATIO * usual)
    by_frequency = np.abs(f / np.median(f) - 1) > np.maximum(known, _FREQUENCY * usual)
    return np.asarray(by_ratio | by_frequency)


def _median(mode: Mode, each: Sequence[DampingEstimate]) -> Mode:
    f, ratio, error = _numbers(each)
    scatter = float(np.std(ratio, ddof=1)) / np.sqrt(len(each))
    known = max(scatter, float(np.median(error)) / np.sqrt(len(each)))
    of_f = _OF_A_MEDIAN * float(np.std(f, ddof=1)) / np.sqrt(len(each))
    made = DampingEstimate(float(np.median(f)), float(np.median(ratio)), _OF_A_MEDIAN * known, of_f)
    why = f"hits differ: {len(each)} fitted one by one, their median adopted"
    return replace(
        mode,
        frequency_hz=made.frequency_hz,
        damping_ratio=made.ratio,
        rational_fit=made,
        why="; ".join(part for part in (why, mode.why) if part),
    )


def _said(good: Sequence[Judged], off: dict[int, list[float]]) -> list[str]:
    if not off:
        return []
    most = max(map(len, off.values()))
    named = [k for k, modes in off.items() if 2 * len(modes) > most]
    at = ", ".join(f"{f:.4g}" for f in sorted({f for modes in off.values() for f in modes}))
    if len(named) < len(good) / 2:
        which = " and ".join(good[k].hit.source for k in sorted(named))
        verb = "differs" if len(named) == 1 else "differ"
        return [
            f"{which} {verb} from the other hits at {at} Hz: did something touch it? The median of all is "
            "adopted there; better without it"
        ]
    return [
        f"the hits differ from one another at {at} Hz: did the temperature or the clamp change? The median "
        "of all is adopted there"
    ]
