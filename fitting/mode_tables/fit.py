"""A law from tables of modes: natural frequency and loss factor of each mode of each specimen.

One posterior as for sweeps: ln f and ln eta over their standard deviations, stated numbers over their
tolerances, the law's bend. Stated numbers of the same thing in several specimens are one number.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.depth.quantities import Quantities
from fitting.depth.task import DepthTask
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.posterior import posterior
from fitting.diagnosis.inference.refit import ROUGH, refit
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.inference.usual_law import within_search
from fitting.diagnosis.verdict.kin import Kin
from fitting.errors import OutsideModel, TooFewPoints
from fitting.identification.adjusted import Adjusted
from fitting.identification.uncertainty import Uncertainty, limits_reached
from fitting.laws import CoreLaw
from fitting.laws.bent_law import BentLaw
from fitting.mode_tables.build import member_of
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.table import ModalTable
from fitting.structures import AnySpecimen

_SOFTER_AND_STIFFER = (1.0, 0.2, 5.0)
"""Times the modulus of the law that is begun with: modes count, so a start far off may count them wrongly."""
_ROUNDS = 4
"""Matrices made anew about the law found: a bound."""


@dataclass(frozen=True)
class ModalFit:
    """What was found, mode by mode."""

    law: CoreLaw
    """With its bend."""
    uncertainty: Uncertainty
    posterior: Array
    """Covariance of the law's log parameters, of the stated numbers in their tolerances, then of the rest."""
    predicted_hz: tuple[Array, ...]
    predicted_loss: tuple[Array, ...]
    as_stated_hz: tuple[Array, ...]
    """What the law found makes of the specimens as they are stated."""
    adjusted: tuple[Adjusted, ...]
    iterations: int
    evaluations: int
    converged: bool


@dataclass(frozen=True)
class BegunModal:
    """The fit without any effect."""

    problem: ModalProblem
    evidence: Evidence
    none: Refitted
    start: CoreLaw
    """What the fit began with: where the law found is lost, other explanations begin there too."""

    def quantities(self, frequency_hz: Array, fitted: Refitted | None = None) -> Quantities:
        """What intervals may be asked for, of a fit or the one without effects. Shape (frequencies,)."""
        fitted = fitted or self.none
        task = DepthTask.of(self.problem.response(fitted.effects), self.evidence, fitted)
        return Quantities.of(task, frequency_hz)


def problem_of(tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]) -> ModalProblem:
    """Tables with the models of their specimens."""
    return ModalProblem.of([member_of(t, s) for t, s in zip(tables, specimens, strict=True)])


def begin_modal(
    problem: ModalProblem,
    start: CoreLaw,
    *,
    scale_known: bool = True,
    however_few: bool = False,
    per_dof: float = np.inf,
) -> BegunModal:
    """The best law without any effect. Raises `TooFewPoints`, `OutsideModel`.

    `however_few`: modes that do not carry a law by themselves too, what they leave open as in `start`, which
    is near. Ends early where a chi-square per degree of `per_dof` is out of reach.
    """
    count = 2 * len(problem.frequency_hz)
    if count <= len(start.plain.names) and not however_few:
        raise TooFewPoints(_too_few(problem, start))
    u = np.zeros(len(problem.each))
    none, problem = _roughly(problem, start, u, (1.0,) if however_few else _SOFTER_AND_STIFFER)
    # Numbers and bend of what is right ask for about one each.
    goal = per_dof * max(none.data - none.parameter_count, 1) + len(u) + none.law.bend_count
    for _ in range(_ROUNDS):
        evidence = problem.evidence(scale_known=scale_known)
        before = none.law.modulus(2 * np.pi * problem.frequency_hz)
        none = refit(problem.response(), evidence, none.law, none.u, goal=goal)
        after = none.law.modulus(2 * np.pi * problem.frequency_hz)
        if (none.converged and np.max(np.abs(after / before - 1)) < ROUGH) or not none.may_reach(goal):
            break
        problem = problem.around(none.law)
    return BegunModal(problem, evidence, none, start)


def _too_few(problem: ModalProblem, start: CoreLaw) -> str:
    """How many modes there are, in which files, and how many it takes."""
    modes, parameters = len(problem.frequency_hz), len(start.plain.names)
    names = ", ".join(m.table.name for m in problem.members if m.table.name)
    said = f"{names}{': ' if names else ''}{modes} mode{'s' * (modes > 1)} with {2 * modes} numbers"
    return (
        f"{said} cannot carry the {parameters} parameters of {start.kind}, expected {parameters // 2 + 1} "
        "modes or more, or a [core.law] of fewer parameters"
    )


def _roughly(
    problem: ModalProblem, start: CoreLaw, u: Array, factors: Sequence[float]
) -> tuple[Refitted, ModalProblem]:
    omega = 2 * np.pi * problem.frequency_hz
    found, refused = [], OutsideModel("no law was tried")
    for factor in factors:
        law = scaled(start, factor)
        here = problem.around(law)
        evidence = here.evidence().blunt()
        try:
            rough = refit(here.response(), evidence, law, u, tolerance=ROUGH)
        except OutsideModel as error:
            refused = error
            continue
        found.append((rough.chi2, rough))
    if not found:
        raise refused
    best = min(found, key=lambda one: one[0])[1]
    law = best.law
    plain = within_search(law.plain, omega)
    if plain is not law.plain and isinstance(law, BentLaw):
        law = BentLaw.over(plain, problem.frequency_hz)
    problem = problem.around(law)
    return refit(problem.response(), problem.evidence(), law, best.u, tolerance=ROUGH), problem


def scaled(law: CoreLaw, factor: float) -> CoreLaw:
    """The law with so many times its modulus, within its limits."""
    by = np.array([factor if name.endswith("_pa") else 1.0 for name in law.names])
    return law.with_logs(np.log(law.values * by))


def start_of(tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]) -> CoreLaw:
    """What the fit begins with. Raises `OutsideModel`."""
    cores = [s.core for s in specimens if s.core is not None]
    if len(cores) < len(specimens):
        raise OutsideModel("a bare specimen has no core to identify, expected a core in every one")
    frequency_hz = np.concatenate([t.frequency_hz for t in tables])
    law = cores[0].law.to_fit(frequency_hz).lifted()
    if all(s.exact for s in specimens):
        return law
    return BentLaw.over(law, frequency_hz)


def modal_fit_of(
    begun: BegunModal, fitted: Refitted | None = None, temper: float = 1.0, kin: Kin | None = None
) -> ModalFit:
    """What is said of a fit; the one without effects by default. Of its `kin`, where that is given, the law.

    `temper` is that of `posterior`.
    """
    problem = begun.problem
    fitted = fitted or begun.none
    response = problem.response(fitted.effects)
    C = posterior(response, begun.evidence, fitted, temper)
    law, uncertainty = law_with(fitted, C, kin)
    C = C if kin is None else C + kin.wider
    n = len(law.names)
    errors = np.sqrt(np.maximum(np.diag(C)[n : n + fitted.stated], 0))
    logs = fitted.velocity_m_s
    kappa = np.concatenate([m.kappa for m in problem.members])
    f, eta = np.exp(logs.real), np.exp(logs.imag / kappa)
    as_stated = problem.response().velocity(fitted.law, np.zeros(fitted.stated))
    return ModalFit(
        law,
        uncertainty,
        C,
        tuple(f[part] for part in problem.parts),
        tuple(eta[part] for part in problem.parts),
        tuple(np.exp(as_stated.real[part]) for part in problem.parts),
        problem.adjusted(fitted.z, errors),
        fitted.iterations,
        fitted.evaluations,
        fitted.converged,
    )


def law_with(fitted: Refitted, covariance: Array, kin: Kin | None) -> tuple[CoreLaw, Uncertainty]:
    """The law of a fit or of its kin, and how well it is known. `covariance` of shape (columns, columns)."""
    law = fitted.law if kin is None else kin.law(fitted)
    C, n = covariance if kin is None else covariance + kin.wider, len(law.names)
    return law, Uncertainty(C[:n, :n], limits_reached(law), fitted.chi2_per_dof)
