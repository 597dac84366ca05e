"""A fit before or after, with everything that is said of it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import block_diag

from fitting.arrays import Array
from fitting.diagnosis.checks.structure import structure
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.inference.posterior import posterior
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.search.catalogue_search import ScoredFit, Search
from fitting.diagnosis.several.responses import response_of
from fitting.diagnosis.verdict.kin import Kin, Unlisted
from fitting.diagnosis.verdict.result import FoundEffect, ParameterEstimate, Stage
from fitting.identification.adjusted import Adjusted
from fitting.identification.known_curve import KnownCurve, known_curve, known_of_mixture
from fitting.identification.result import LawBand, differences_percent, law_band, sweep_range
from fitting.identification.uncertainty import Uncertainty, correlations_by_name, limits_reached
from fitting.identification.validation import Validation
from fitting.widened.enriched_plate import EnrichedReducedPlate

_AT_LIMIT = 1e-6
"""Of the range between an unknown's limits: nearer to one it sits on it, and its error says nothing. Of the
range, unlike in `verdict.kin` and `search.stand_in`: it is what the error is compared with, too."""
_NEXT_TO = float(np.log(2.0))
"""In ln f, to either side: how far wrong laws are from one another there says how far they may be here. An
octave: moduli change little over it. A choice."""
FEW = 9
"""Frequencies at which a candidate's law is listed, and the reference ones."""


def stage_of(
    problem: DiagnosisProblem, evidence: Evidence, fitted: Refitted, validation: Validation, temper: float
) -> Stage:
    """`validation` is what the fit says of data it has not seen; `temper` is that of `posterior`."""
    law = fitted.law
    C = posterior(response_of(problem, fitted.effects), evidence, fitted, temper)
    uncertainty = _of_law(fitted, C)
    reached = uncertainty.at_bound
    plain = law.plain
    own = uncertainty.of_first(len(plain.names))
    errors = own.standard_errors * plain.values
    whitened = fitted.residuals[: fitted.data]
    chi2 = fitted.chi2_per_dof if evidence.scale_known else float("nan")
    return Stage(
        law=plain,
        standard_errors={
            name: float("nan") if name in reached else float(e)
            for name, e in zip(plain.names, errors, strict=True)
        },
        band=replace(law_band(problem.sweep, law, uncertainty), known=_known(problem, fitted, C)),
        predicted_m_s=fitted.velocity_m_s,
        difference_percent=differences_percent(problem.sweep, fitted.velocity_m_s),
        whitened=whitened,
        chi2_per_dof=chi2,
        validation=validation,
        structure=structure(
            problem.sweep, evidence, whitened, chi2, problem.specimen.kind, problem.points.struck
        ),
        adjusted=adjusted_of(problem, fitted, C),
        correlations=correlations_by_name(plain.names, own),
    )


def _of_law(fitted: Refitted, covariance: Array) -> Uncertainty:
    law = fitted.law
    reached = limits_reached(law)
    n = len(law.names)
    # What sits at an upper limit has no first-order error of its own; near zero it has (`open_widths`).
    at_limit = np.array([reached.get(name) == "upper" for name in law.names])
    by_law = covariance[:n, :n] * ~np.logical_or.outer(at_limit, at_limit)
    return Uncertainty(by_law, reached, fitted.chi2_per_dof)


def _known(problem: DiagnosisProblem, fitted: Refitted, covariance: Array) -> KnownCurve | None:
    names = [one.name for one in adjusted_of(problem, fitted, covariance)]
    return known_curve(fitted.law, covariance, names, *sweep_range(problem.sweep))


def adjusted_of(problem: DiagnosisProblem, fitted: Refitted, covariance: Array) -> tuple[Adjusted, ...]:
    """The stated numbers as a fit has them. `covariance` of shape (columns, columns)."""
    n = len(fitted.law.names)
    errors = np.sqrt(np.maximum(np.diag(covariance)[n : n + fitted.stated], 0))
    return problem.adjusted(fitted.z, errors)


def few_of_law(problem: DiagnosisProblem, fitted: Refitted, temper: float) -> LawBand:
    """The law of a fit at a few frequencies; `temper` is that of `Refitted.tempered_covariance`."""
    uncertainty = _of_law(fitted, fitted.tempered_covariance(temper))
    return law_band(problem.sweep, fitted.law, uncertainty, points=FEW)


def mixed_band(
    problem: DiagnosisProblem,
    search: Search,
    group: Sequence[tuple[ScoredFit, float]],
    *,
    few: bool = False,
    all_wrong: bool = False,
) -> LawBand:
    """The law over all explanations of a group: mean and standard deviation of their mixture.

    At a `few` frequencies only, where a candidate's law is listed; `all_wrong` as `mixture_of` takes it.

    Each brings its own posterior; where they disagree, so does the band.
    """
    bands, shares = [], []
    posteriors: dict[ScoredFit, Array] = {}
    for scored, kin, share in each_of(group):
        fitted = scored.fitted
        if scored not in posteriors:
            response = response_of(problem, fitted.effects)
            posteriors[scored] = posterior(response, search.evidence, fitted, search.temper(scored))
        C, law = posteriors[scored], fitted.law
        if kin is not None:
            C, law = C + kin.wider, kin.law(fitted)
        at = replace(fitted, law=law)
        points = {"points": FEW} if few else {}
        band = law_band(problem.sweep, law, _of_law(at, C), **points)
        bands.append(replace(band, known=_known(problem, at, C)))
        shares.append(share)
    return mixture_of(bands, np.array(shares), all_wrong=all_wrong)


def each_of(group: Sequence[tuple[ScoredFit, float]]) -> Iterator[tuple[ScoredFit, Kin | None, float]]:
    """Its explanations and their kin, each with its share."""
    for scored, share in group:
        if isinstance(scored, Unlisted):
            yield from ((one, kin, share * part) for one, kin, part in scored.of)
        else:
            yield scored, None, share


def mixture_of(bands: Sequence[LawBand], shares: Array, *, all_wrong: bool = False) -> LawBand:
    """Mean and standard deviation of laws over the same frequencies; `shares` of shape (laws,).

    Laws that are `all_wrong` are known no better where they happen to cross.
    """
    f = bands[0].frequency_hz

    def mixture(value: str, error: str) -> tuple[Array, Array]:
        means = np.array([getattr(b, value) for b in bands])
        errors = np.array([getattr(b, error) for b in bands])
        mean = shares @ means
        variance = shares @ (errors**2 + (means - mean) ** 2)
        if all_wrong:
            variance += _lacking(f, shares @ (means / mean - 1) ** 2) * mean**2
        return mean, np.sqrt(variance)

    G, G_error = mixture("storage_modulus_pa", "storage_modulus_standard_error_pa")
    eta, eta_error = mixture("loss_factor", "loss_factor_standard_error")
    known = [b.known for b in bands if b.known is not None]
    whole = None
    if len(known) == len(bands):
        at = known[0].frequency_hz
        curves = [b.values_at(at) for b in bands]
        whole = known_of_mixture(curves, known, shares)
        if all_wrong:
            apart = shares @ (np.array(curves) - shares @ np.array(curves)) ** 2
            halves = [np.sqrt(_lacking(at, half)) for half in np.split(apart, 2)]
            whole = whole.wider_by(block_diag(*(_nearby(at) * np.outer(e, e) for e in halves)))
    return LawBand(f, G, eta, G_error, eta_error, whole)


def _lacking(frequency_hz: Array, variance: Array) -> Array:
    """What a variance has less than on average round about. Shape (frequencies,) each."""
    weights = _nearby(frequency_hz)
    return np.maximum(weights @ variance / weights.sum(axis=1) - variance, 0.0)


def _nearby(frequency_hz: Array) -> Array:
    """How far frequencies have to do with one another. Shape (frequencies, frequencies)."""
    x = np.log(frequency_hz)
    return np.exp(-((x[:, None] - x) ** 2) / (2 * _NEXT_TO**2))


def found_effects(
    fitted: Refitted, plate: EnrichedReducedPlate, temper: float = 1.0
) -> tuple[FoundEffect, ...]:
    """The effects of a fit with sizes and standard errors; `temper` is that of `tempered_covariance`."""
    errors, found = fitted.unknown_errors(temper), []
    for effect, part in fitted.each():
        lower, upper = effect.limits(plate)
        parameters = {}
        for k, q in enumerate(effect.parameters):
            value, error = float(fitted.u[part][k]), float(errors[part][k])
            if q.logarithmic:
                error *= value
            reach = _AT_LIMIT * (upper[k] - lower[k]) if np.isfinite(upper[k]) else 0.0
            at_limit = not q.fixed and (value - lower[k] <= reach or upper[k] - value <= reach)
            if at_limit or error > upper[k] - lower[k]:
                error = float("nan")
            parameters[q.key] = ParameterEstimate(value, error, q.unit)
        if effect.replaces_law:
            law = fitted.law.plain
            of_law = np.sqrt(np.diag(fitted.tempered_covariance(temper))[: len(law.names)]) * law.values
            for name, value, error in zip(law.names, law.values, of_law, strict=True):
                parameters[name] = ParameterEstimate(float(value), float(error), _unit(name))
        found.append(FoundEffect(effect.name, parameters))
    return tuple(found)


def _unit(name: str) -> str:
    if name.endswith("_pa"):
        return "Pa"
    return "rad/s" if name.endswith("_rad_s") else "s" if name.endswith("_s") else "1"
