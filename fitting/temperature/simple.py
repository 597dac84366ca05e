"""Whether a material is thermorheologically simple: one law, shifted, explains all temperatures.

By chi-square: one law for all against one for each, on the responses themselves, both with the same plate.
For people also by the wicket plot: a simple material has one curve of eta over G'.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.temperature.causes import REFUSED, Cause, explains
from fitting.temperature.joint import ShiftedFit

_POINTS = 25
"""Over a sweep's band: the wicket plot is compared at them."""
_NEAR = 6.0
"""In cost, -2 ln of a probability ratio of twenty: causes so near the best are named beside it."""


@dataclass(frozen=True)
class Verdict:
    """`simple` is None where nothing can be told: the noise is unknown, or something else may explain it."""

    simple: bool | None
    p_value: float
    wicket_percent: float
    """Largest distance of eta from the joint law's, at one G', over all temperatures."""
    wicket_at_c: float
    words: str


def in_doubt(fit: ShiftedFit) -> bool:
    """Whether a common cause is to be looked for before anything is said."""
    return fit.noise_known and not (explains(fit) and fit.p_value >= REFUSED)


def serving(causes: Sequence[Cause]) -> list[Cause]:
    """Causes beside which one law serves: the best, and those that are about as good."""
    able = [c for c in causes if c.serves]
    return [c for c in able if c.cost < able[0].cost + _NEAR]


def judge(fit: ShiftedFit, causes: Sequence[Cause] = ()) -> Verdict:
    """What the checks say together; `causes` are those looked at where `in_doubt`."""
    able = serving(causes)
    best = able[0].fit if able else fit
    off, at = _wicket(best)

    def told(simple: bool | None, words: str, p: float = best.p_value) -> Verdict:
        return Verdict(simple, p, off, at, words)

    if not fit.noise_known:
        return told(
            None, "whether one shifted law serves cannot be told: the noise of the readings is unknown"
        )
    if not in_doubt(fit):
        return told(True, f"thermorheologically simple as far as these data tell: {_gain(fit)}")
    if able:
        said = " or ".join(story(c) for c in able)
        cure = able[0].effect.discriminating_test
        if explains(fit):
            return told(
                None,
                f"not simple, or not the plate as stated: one shifted law serves where {said} in all sweeps, "
                f"which is counted in ({_gain(best)}); without it no one law does ({_gain(fit)}). "
                f"What decides: {cure}",
            )
        return told(
            True,
            f"the readings fit no law as they are; where {said} in all sweeps, which is counted in, the "
            f"material is thermorheologically simple as far as these data tell: {_gain(best)}. "
            f"To be rid of it: {cure}",
        )
    other = next((c for c in causes if explains(c.fit)), None)
    if explains(fit):
        return told(False, _refusal(fit, f"differs by up to {off:.2g} % at {at:g} degC"))
    if other is not None:
        beside = _refusal(other.fit, f"differs even where {story(other)} in all sweeps")
        return told(False, beside, other.fit.p_value)
    return told(
        None,
        "whether one shifted law serves cannot be told: not even a law for each temperature explains the "
        f"readings (chi-square per degree of freedom {fit.own.chi2_per_dof:.3g}), nor one effect in all "
        "sweeps; 'viscorig diagnose' each of them first",
    )


def story(cause: Cause) -> str:
    """What the plate or the rig does, in half a sentence with numbers."""
    u = cause.fit.one.of(cause.effect)
    names = [q.key for q in cause.effect.parameters]
    return cause.effect.story(dict(zip(names, u.tolist(), strict=True)))


def _gain(fit: ShiftedFit) -> str:
    more = fit.chi2 - fit.chi2_own
    return f"chi-square {more:+.1f} for {fit.degrees:.0f} parameters fewer, p {fit.p_value:.2g}"


def _refusal(fit: ShiftedFit, difference: str) -> str:
    how = {"wlf": "by WLF", "arrhenius": "by Arrhenius", "free": "freely"}[fit.shift.kind]
    words = (
        f"no one law shifted {how} explains all temperatures ({_gain(fit)}): at the same G' the loss factor "
        f"{difference}; "
    )
    if fit.shift.kind == "free":
        return words + "the material is not thermorheologically simple here, identify each temperature alone"
    return words + "try --shift free: if it is refused too, the material is not thermorheologically simple"


def _wicket(fit: ShiftedFit) -> tuple[float, float]:
    """Percent, and the temperature it is at: each law by itself against the joint one at equal G'."""
    worst, where = 0.0, float(fit.shift.temperature_c[0])
    for k, (low, high) in enumerate(fit.bands_hz):
        omega = 2 * np.pi * np.geomspace(low, high, _POINTS)
        storage, eta = fit.own_law(k).storage_and_loss(omega)
        a, up = np.exp(fit.log_shift[k]), np.exp(fit.log_vertical[k])
        wide = np.geomspace(omega[0] / 10, omega[-1] * 10, 400) * a
        joint_storage, joint_eta = fit.law.storage_and_loss(wide)
        off = 100 * np.abs(eta / np.interp(storage, up * joint_storage, joint_eta) - 1)
        if off.max() > worst:
            worst, where = float(off.max()), float(fit.shift.temperature_c[k])
    return worst, where
