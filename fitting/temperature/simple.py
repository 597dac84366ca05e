"""Whether a material is thermorheologically simple: one law, shifted, explains all temperatures.

By chi-square: one law for all against one for each, on the responses themselves. For people also by the
wicket plot: a simple material has one curve of eta over G'.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.diagnosis.begin import Begun
from fitting.temperature.joint import ShiftedFit

REFUSED = 1e-3
"""Tail probability below which one law is refused."""
_POINTS = 25
"""Over a sweep's band: the wicket plot is compared at them."""


@dataclass(frozen=True)
class Verdict:
    """`simple` is None where the noise is unknown and nothing can be told."""

    simple: bool | None
    p_value: float
    wicket_percent: float
    """Largest distance of eta from the joint law's, at one G', over all temperatures."""
    wicket_at_c: float
    words: str


def judge(fit: ShiftedFit, begun: Sequence[Begun]) -> Verdict:
    """What the checks say together."""
    off, at = _wicket(fit, begun)
    p = fit.p_value
    if np.isnan(p):
        words = "whether one shifted law serves cannot be told: the noise of the readings is unknown"
        return Verdict(None, p, off, at, words)
    gain = f"chi-square {fit.chi2 - fit.chi2_free:+.1f} for {fit.degrees:.0f} parameters fewer, p {p:.2g}"
    if p >= REFUSED:
        words = f"thermorheologically simple as far as these data tell: {gain}"
        return Verdict(True, p, off, at, words)
    how = {"wlf": "by WLF", "arrhenius": "by Arrhenius", "free": "freely"}[fit.shift.kind]
    words = (
        f"no one law shifted {how} explains all temperatures ({gain}): at the same G' the loss factor "
        f"differs by up to {off:.2g} % at {at:g} degC; "
    )
    if fit.shift.kind == "free":
        words += "the material is not thermorheologically simple here, identify each temperature alone"
    else:
        words += "try --shift free: if it is refused too, the material is not thermorheologically simple"
    return Verdict(False, p, off, at, words)


def _wicket(fit: ShiftedFit, begun: Sequence[Begun]) -> tuple[float, float]:
    """Percent, and the temperature it is at: each law by itself against the joint one at equal G'."""
    worst, where = 0.0, float(fit.shift.temperature_c[0])
    for k, b in enumerate(begun):
        f = b.problem.sweep.frequency_hz
        omega = 2 * np.pi * np.geomspace(f.min(), f.max(), _POINTS)
        storage, eta = b.none.law.storage_and_loss(omega)
        a, up = np.exp(fit.log_shift[k]), np.exp(fit.log_vertical[k])
        wide = np.geomspace(omega[0] / 10, omega[-1] * 10, 400) * a
        joint_storage, joint_eta = fit.law.storage_and_loss(wide)
        off = 100 * np.abs(eta / np.interp(storage, up * joint_storage, joint_eta) - 1)
        if off.max() > worst:
            worst, where = float(off.max()), float(fit.shift.temperature_c[k])
    return worst, where
