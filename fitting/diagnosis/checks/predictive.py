"""Posterior predictive checks: whether data such as these are what an explanation would leave.

Each check is a tail probability; an explanation fails where one of them is below the stated level.
"""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from fitting.arrays import Mask
from fitting.diagnosis.checks.structure import along_frequency
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.thresholds import VERDICT
from fitting.effects.base import Effect
from fitting.numerics.chances import chi2_above, chi2_exceeded, normal_above, normal_exceeded
from fitting.sweep import Sweep

TOLERANCES = "tolerances"
"""Name of the check of the stated numbers."""
NONE_ALONE: Mapping[str, float] = MappingProxyType({})


def form_error(none: Refitted, fitted: Refitted, alone: Mapping[str, float] = NONE_ALONE) -> float:
    """Chi-square that the formulas of a fit's effects may leave.

    `alone`: that of fits of single effects, by name. Of two that are among them the one that explains more by
    itself answers for that, the other for what is left; else the looser formula answers for everything.
    """
    shares = {e.name: max(VERDICT.formula_share, e.unexplained_share) for e in fitted.effects}
    explained = max(0.0, none.chi2 - fitted.chi2)
    if len(shares) < 2 or not shares.keys() <= alone.keys():
        return max(shares.values(), default=0.0) * explained
    first, second = sorted(shares, key=lambda name: alone[name])
    by_first = min(max(0.0, none.chi2 - alone[first]), explained)
    return shares[first] * by_first + shares[second] * (explained - by_first)


def _allowed(none: Refitted, fitted: Refitted) -> float:
    """The same for a check: of two effects as if the better known formula had explained all.

    What two loose formulas together come near to is no evidence for either.
    """
    share = min((max(VERDICT.formula_share, e.unexplained_share) for e in fitted.effects), default=0.0)
    return share * max(0.0, none.chi2 - fitted.chi2)


def temper(none: Refitted, best: Refitted, alone: Mapping[str, float] = NONE_ALONE) -> float:
    """How much less a difference in chi-square says where what was explained is far above the noise.

    `alone` as in `form_error`.
    """
    return 1.0 + form_error(none, best, alone) / VERDICT.formula_shapes


def checks(
    sweep: Sweep, evidence: Evidence, none: Refitted, fitted: Refitted, struck: Mask | None = None
) -> Mapping[str, float]:
    """Tail probabilities by what was looked at. Empty where the noise is unknown.

    `struck` as `fitting.diagnosis.checks.structure.along_frequency` takes it. Shape (points,).
    """
    if not evidence.scale_known:
        return {}
    dof = max(1, fitted.data - fitted.parameter_count)
    may_leave = _allowed(none, fitted)
    allowed = 1 + may_leave / dof
    left = fitted.chi2_per_dof / allowed
    spread = _scatter(dof)
    whitened = fitted.residuals[: fitted.data]
    found = {"size": float(normal_above(np.log(max(left, 1e-12)) / spread))}
    along = evidence.whitening.along(whitened)
    t = 1 + may_leave / VERDICT.formula_shapes
    if len(along):
        found["the model's own error"] = float(chi2_above(along @ along / t, len(along)))
    if fitted.stated:
        found[TOLERANCES] = of_stated_numbers(fitted, t)
    breaches = fitted.law.breaches()
    if len(breaches):
        found["causality"] = float(chi2_above(breaches @ breaches / t, len(breaches)))
    parts = 2 if evidence.has_phase else 1
    runs, memory = along_frequency(sweep, whitened, parts, VERDICT.longest_trace, struck)
    wider = VERDICT.wider_along * (1 + VERDICT.formula_along * (may_leave / dof))
    found["signs"], found["memory"] = (float(normal_above(z / wider)) for z in (runs, memory))
    return found


def _scatter(dof: int) -> float:
    """Standard deviation of ln of a mean square: its own scatter, and the noise's."""
    return float(np.hypot(2 * VERDICT.noise_known_to, np.sqrt(2 / dof)))


def of_stated_numbers(fitted: Refitted, temper: float = 1.0) -> float:
    """Tail probability of where the data moved the stated numbers, over what they say anything of.

    In their standard deviations the fit's z scatters about zero as I - C, C its covariance: what the data
    narrow by nothing stays where it is. All of them counted alike would hide the few that are asked.
    """
    stated = len(fitted.law.names) + np.arange(fitted.stated)
    took, V = np.linalg.eigh(np.eye(fitted.stated) - fitted.covariance[np.ix_(stated, stated)])
    asked = took > VERDICT.narrowed
    if not asked.any():
        return 1.0
    moved = (V.T @ fitted.z)[asked] ** 2 / took[asked]
    return float(chi2_above(moved.sum() / temper, int(asked.sum())))


def most_unrefused(none: Refitted, effects: Sequence[Effect]) -> float:
    """Chi-square above which these effects together fail the check of size, or that of tolerances.

    Priors counted in, the law bent no further than chance has it. Formulas may leave their share of all that
    there is.
    """
    share = min((max(VERDICT.formula_share, e.unexplained_share) for e in effects), default=0.0)
    may_leave, dof = share * none.chi2, max(1, none.data - none.parameter_count)
    size = float(np.exp(normal_exceeded(VERDICT.check_level) * _scatter(dof))) * (dof + may_leave)
    t = 1 + may_leave / VERDICT.formula_shapes
    known = [n for n in (none.stated, none.law.bend_count) if n]
    return size + t * sum(float(chi2_exceeded(VERDICT.check_level, n)) for n in known)


def passes(found: Mapping[str, float]) -> bool:
    """Whether nothing speaks against an explanation."""
    return all(p >= VERDICT.check_level for p in found.values())


def weakest(found: Mapping[str, float]) -> tuple[str, float] | None:
    """What speaks against it most."""
    return min(found.items(), key=lambda one: one[1]) if found else None
