"""The joint fit as an identification: the posterior of the law, and the stated numbers as it has them."""

from fitting.diagnosis.inference.begin import Begun
from fitting.diagnosis.inference.posterior import posterior
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.verdict.stage import adjusted_of
from fitting.identification.fit import Fit


def fit_of(begun: Begun) -> Fit:
    """The fit without effects as `fitting.identification.result.summarise` takes it."""
    none, first = begun.none, begun.first
    C = posterior(response_of(begun.problem, ()), begun.evidence, none)
    n = len(none.law.names)
    return Fit(
        law=none.law,
        residuals=none.residuals,
        jacobian=none.jacobian,
        velocity_m_s=none.velocity_m_s,
        iterations=first.iterations + none.iterations,
        evaluations=first.evaluations + none.evaluations,
        # Where the law alone ended is where this fit began, no more.
        converged=none.converged,
        readings=none.data,
        covariance=C[:n, :n],
        posterior=C,
        adjusted=adjusted_of(begun.problem, none, C),
    )
