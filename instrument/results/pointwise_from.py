"""A core band by band and its causality, read off a second look at a fit."""

from fitting.identification.kramers_kronig import KramersKronig
from fitting.identification.pointwise import PointwiseLaw
from instrument.facts.identification import IdentificationResult
from instrument.facts.pointwise import BandFound, CausalityTest
from instrument.finding.pointwise import Pointwise


def with_second_look(result: IdentificationResult, found: Pointwise) -> IdentificationResult:
    """An identification with what is found without its law."""
    causal = causality_from(found.causal) if found.causal is not None else None
    return result.but(pointwise=bands_from(found.law), kramers_kronig=causal)


def bands_from(found: PointwiseLaw) -> tuple[BandFound, ...]:
    """A row a band: G' and eta with their standard errors, NaN where nothing was found, and why."""
    columns = (
        found.frequency_hz,
        found.storage_modulus_pa,
        found.loss_factor,
        found.storage_modulus_standard_error_pa,
        found.loss_factor_standard_error,
        found.points,
        found.determined,
    )
    rows = zip(*(column.tolist() for column in columns), found.reasons, strict=True)
    return tuple(
        BandFound(
            frequency_hz=f,
            storage_modulus_pa=storage,
            loss_factor=loss,
            storage_modulus_standard_error_pa=storage_error,
            loss_factor_standard_error=loss_error,
            points=points,
            determined=determined,
            reason=reason or None,
        )
        for f, storage, loss, storage_error, loss_error, points, determined, reason in rows
    )


def causality_from(causal: KramersKronig) -> CausalityTest:
    """The test and its sentence."""
    return CausalityTest(
        consistent=bool(causal.consistent),
        p_value=causal.p_value,
        chi2_per_dof=causal.chi2_per_dof,
        bands=len(causal.frequency_hz),
        words=causal.words,
    )
