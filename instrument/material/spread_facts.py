"""A spread between specimens as JSON has it."""

from instrument.facts.comparison import SpecimenApart, SpreadAt, SpreadResult, SpreadSize
from instrument.material.spread import Size, Spread


def spread_result(found: Spread) -> SpreadResult:
    """The spread as the JSON of a result has it."""
    return SpreadResult(
        specimens=found.names,
        frequencies=spread_rows(found),
        apart=apart_rows(found),
        without_apart=spread_rows(found.without) if found.without is not None else (),
    )


def apart_rows(found: Spread) -> tuple[SpecimenApart, ...]:
    """One a specimen that is not like the others."""
    return tuple(
        SpecimenApart(
            name=one.name,
            p_value=one.p_value,
            storage_modulus_difference_percent=100 * one.storage,
            loss_factor_difference_percent=100 * one.loss,
        )
        for one in found.apart
    )


def spread_rows(found: Spread) -> tuple[SpreadAt, ...]:
    """One a frequency."""
    return tuple(
        SpreadAt(
            frequency_hz=f,
            storage_modulus_pa=found.storage_modulus_pa[k],
            storage_modulus_standard_error_pa=found.storage_modulus_pa[k] * found.storage_error[k],
            storage_modulus_spread=_said(found.storage[k]),
            loss_factor=found.loss_factor[k],
            loss_factor_standard_error=found.loss_factor[k] * found.loss_factor_error[k],
            loss_factor_spread=_said(found.loss[k]),
        )
        for k, f in enumerate(found.frequency_hz)
    )


def _said(s: Size) -> SpreadSize:
    return SpreadSize(percent=100 * s.value, interval_95_percent=(100 * s.lower, 100 * s.upper))
