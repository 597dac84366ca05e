"""Whether a material is thermorheologically simple: one law, shifted, explains all temperatures.

By chi-square: one law for all against one for each, on the responses themselves, both with the same plate.
For people also by the wicket plot: a simple material has one curve of eta over G'.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.digits import tail, two_digits
from fitting.temperature.causes import Cause, explains, one_law_serves
from fitting.temperature.shifted_fit import ShiftedFit
from fitting.temperature.thermometers import Misread, misread, rising

_POINTS = 25
"""Over a sweep's band: the wicket plot is compared at them."""
AGREED = 0.01
"""Tail probability above which one law explains the members that are left. A choice, ten times that of a
refusal."""
_NEAR = 6.0
"""In cost, -2 ln of a probability ratio of twenty: causes so near the best are named beside it."""


@dataclass(frozen=True)
class OddOne:
    """A member without which one law explains all others."""

    place: int
    """Among the members, from 0."""
    p_value: float
    """Of one law for the others."""


@dataclass(frozen=True)
class Verdict:
    """`simple` is None where nothing can be told: something else may explain it."""

    simple: bool | None
    p_value: float
    wicket_percent: float
    """Largest distance of eta from the joint law's, at one G', over all temperatures."""
    said: str
    """What was found."""
    advice: tuple[str, ...] = ()
    """What to do about it, or what else to know; nothing of it belongs to the sentence of `said`."""
    wrong: Misread | None = None
    """The one temperature that does not go with the others."""
    law_stands: bool = True
    """False where nothing explains the readings: then the law of the fit is no material's."""

    @property
    def words(self) -> str:
        """Finding and advice in one line."""
        return "; ".join((self.said, *self.advice))


def in_doubt(fit: ShiftedFit) -> bool:
    """Whether a common cause is to be looked for before anything is said."""
    return not one_law_serves(fit)


def serving(causes: Sequence[Cause]) -> list[Cause]:
    """Causes beside which one law serves: the best, and those that are about as good."""
    able = [c for c in causes if c.serves]
    return [c for c in able if c.cost < able[0].cost + _NEAR]


def judge(
    fit: ShiftedFit,
    causes: Sequence[Cause] = (),
    apart: ShiftedFit | None = None,
    names: Sequence[str] = (),
    scale_known: bool = True,
    odd: Sequence[str] = (),
    odd_ones: Sequence[OddOne] = (),
) -> Verdict:
    """What the checks say together; `causes` are those looked at where `in_doubt`.

    `apart` is one law with a factor for every sweep: where it serves, temperatures or form are refused and
    not the material. `names` of the sweeps; their numbers otherwise. Without `scale_known` the size of errors
    is a guess: by it one law may serve, and none is refused. `odd` readings are said to be wrong before
    anything else is. One of the `odd_ones` may be all that is wrong.
    """
    if odd and in_doubt(fit):
        said = (
            f"whether one shifted law serves cannot be told ({_gain(fit)}), and this law is not to be used, "
            f"before this is: {'; '.join(odd)}"
        )
        return Verdict(None, fit.p_value, _wicket(fit)[0], said, law_stands=False)
    found = _judged(fit, causes, apart, names, odd_ones)
    if scale_known or found.simple is not False:
        return found
    words = (
        "whether one shifted law serves cannot be told: the errors of the modes are not stated; were they "
        f"the usual ones: {found.said}"
    )
    return replace(found, simple=None, said=words)


def _judged(
    fit: ShiftedFit,
    causes: Sequence[Cause],
    apart: ShiftedFit | None,
    names: Sequence[str],
    odd_ones: Sequence[OddOne],
) -> Verdict:
    if not in_doubt(fit):
        words = f"thermorheologically simple as far as these data tell: {_gain(fit)}"
        return Verdict(True, fit.p_value, _wicket(fit)[0], words)
    able = serving(causes)
    if able:
        return _beside_a_cause(fit, able)
    if apart is not None and not in_doubt(apart):
        wrong = misread(fit.shift, apart)
        words, *advice = _temperatures_refused(fit, apart, wrong, names)
        return Verdict(False, fit.p_value, _wicket(apart)[0], words, tuple(advice), wrong)
    nearly = next((c for c in causes if c.may_serve), None)
    if nearly is not None:
        # A fit that is still on its way refuses no material.
        words = (
            f"whether one shifted law serves cannot be told: it does where {story(nearly)} at all "
            f"temperatures ({_gain(nearly.fit)}), but that fit has not come to its end; this law is not to "
            f"be used. What decides: {nearly.effect.discriminating_test}"
        )
        return Verdict(None, fit.p_value, _wicket(fit)[0], words, law_stands=False)
    if explains(fit):
        off, at = _wicket(fit if apart is None else apart)
        instead = _whose(fit, odd_ones, names) if odd_ones else _instead(fit)
        words = _refusal(fit, f"differs by up to {two_digits(off)} % at {at:g} degC")
        return Verdict(False, fit.p_value, off, words, instead)
    other = next((c for c in causes if explains(c.fit)), None)
    if other is not None:
        words = _refusal(other.fit, f"differs even where {story(other)} at all temperatures")
        return Verdict(False, other.fit.p_value, _wicket(fit)[0], words, _instead(other.fit))
    words = (
        "whether one shifted law serves cannot be told: not even a law for each temperature explains the "
        f"readings (chi-square per degree of freedom {fit.own_chi2_per_dof:.3g}), nor one effect at "
        "all of them; this law is not to be used: first 'viscorig diagnose' the data of each temperature by "
        "itself"
    )
    return Verdict(None, fit.p_value, _wicket(fit)[0], words, law_stands=False)


def _beside_a_cause(fit: ShiftedFit, able: Sequence[Cause]) -> Verdict:
    """One law serves beside a cause, or each of several."""
    said = " or ".join(story(c) for c in able)
    best, cure = able[0].fit, able[0].effect.discriminating_test
    if explains(fit):
        words = (
            f"not simple, or not the specimen as stated: one shifted law serves where {said} at all "
            f"temperatures, which is counted in ({_gain(best)}); without it no one law does "
            f"({_gain(fit)}). What decides: {cure}"
        )
    else:
        words = (
            f"the readings fit no law as they are; where {said} at all temperatures, which is counted in, "
            f"the material is thermorheologically simple as far as these data tell: {_gain(best)}. "
            f"To be rid of it: {cure}"
        )
    return Verdict(None if explains(fit) else True, best.p_value, _wicket(best)[0], words)


def story(cause: Cause) -> str:
    """What the plate or the rig does, in half a sentence with numbers."""
    u = cause.fit.one.of(cause.effect)
    names = [q.key for q in cause.effect.parameters]
    return cause.effect.story(dict(zip(names, u.tolist(), strict=True)))


def _gain(fit: ShiftedFit) -> str:
    more = fit.chi2 - fit.chi2_own
    fewer = f"{fit.degrees:.0f} parameter{'s' * (f'{fit.degrees:.0f}' != '1')}"
    said = f"chi-square {more:+.1f} for {fewer} fewer, p {tail(fit.p_value)}"
    return said if fit.noise_known else f"{said}, noise being what a law for each temperature leaves"


def _whose(fit: ShiftedFit, odd_ones: Sequence[OddOne], names: Sequence[str]) -> tuple[str, ...]:
    name, T = (names or range(1, len(fit.shift.temperature_c) + 1)), fit.shift.temperature_c
    each = [f"without {name[o.place]} ({T[o.place]:g} degC, p {tail(o.p_value)})" for o in odd_ones]
    return (
        f"{' or '.join(each)} one law explains all others: something may be off there alone (a mass, a "
        "mount, another specimen), or the material is not simple there",
        "identify it by itself, and the others",
    )


def _refusal(fit: ShiftedFit, difference: str) -> str:
    how = {"wlf": "by WLF", "arrhenius": "by Arrhenius", "free": "freely"}[fit.shift.kind]
    return (
        f"no one law shifted {how} explains all temperatures ({_gain(fit)}): at the same G' the loss factor "
        f"{difference}"
    )


def _instead(fit: ShiftedFit) -> tuple[str]:
    """What to try where the material is refused."""
    if fit.shift.kind == "free":
        return (
            "the material is not thermorheologically simple here, or not one material, or a specimen is "
            "not as stated at some temperatures: identify each alone",
        )
    return (
        "try --shift free: if it is refused too, the material is not thermorheologically simple, or not "
        "one material, or a specimen is not as stated at some temperatures",
    )


def _temperatures_refused(
    fit: ShiftedFit, apart: ShiftedFit, wrong: Misread | None, names: Sequence[str]
) -> tuple[str, ...]:
    """What is refused, then what to do about it."""
    how = {"wlf": "WLF", "arrhenius": "Arrhenius", "free": "one factor a temperature"}[fit.shift.kind]
    words = (
        f"the temperatures as stated do not go with {how} ({_gain(fit)}), the material with one law does, "
        f"each of the data shifted by a factor of its own ({_gain(apart)})"
    )
    if wrong is not None:
        said = " or ".join(_wrong(one, names) for one in (wrong, *wrong.rivals))
        which = ", of which one is wrong" if wrong.rivals else ""
        until = "until then this law, which is of all temperatures as stated, is not to be used"
        return f"{words}: {said}{which}, check it", until
    if fit.shift.kind == "free":
        return (f"{words}: data stated at one temperature were not at one, check them",)
    check = "check the temperatures, or say with --temperature-k how well they are known"
    upwards = rising(fit.shift, apart.log_shift)
    if upwards is not None:
        words += f": the factor of {upwards[1]:g} degC is above that of {upwards[0]:g} degC"
    return words, check, "--shift free takes the factors as they are"


def _wrong(wrong: Misread, names: Sequence[str]) -> str:
    """Which sweep is stated at which temperature, and what its readings are."""
    name = names[wrong.sweep] if names else f"sweep {wrong.sweep + 1}"
    if wrong.further:
        name += f", as {wrong.further} more,"
    known = np.isfinite(wrong.read_c)
    read = f"those of {wrong.read_c:.1f} degC" if known else "of no temperature"
    return f"{name} is stated at {wrong.stated_c:g} degC, its readings are {read} by the others"


def _wicket(fit: ShiftedFit) -> tuple[float, float]:
    """Percent, and the temperature it is at: each law by itself against the joint one at equal G'."""
    worst, where = 0.0, float(fit.shift.temperature_c[0])
    for k, (low, high) in enumerate(fit.bands_hz):
        omega = 2 * np.pi * np.geomspace(low, high, _POINTS)
        storage, eta = fit.own_law(k).storage_and_loss(omega)
        a, up = np.exp(fit.sweeps_log_shift[k]), np.exp(fit.log_vertical[k])
        wide = np.geomspace(omega[0] / 10, omega[-1] * 10, 400) * a
        joint_storage, joint_eta = fit.law.storage_and_loss(wide)
        off = 100 * np.abs(eta / np.interp(storage, up * joint_storage, joint_eta) - 1)
        if off.max() > worst:
            worst, where = float(off.max()), float(fit.shift.temperature_c[k])
    return worst, where
