"""One law over several temperatures as JSON holds it."""

from collections.abc import Sequence

import numpy as np

from fitting.temperature.causes import Cause
from instrument.facts.diagnosis import EffectFound
from instrument.facts.shifted import ShiftAt, ShiftedResult
from instrument.models.temperatures import AtTemperature, Shifted
from instrument.results.diagnosis_from import parameters_from
from instrument.results.rows_from import law_rows_from


def shifted_from(found: Shifted, sweeps: Sequence[AtTemperature]) -> ShiftedResult:
    """Shifts, law and checks."""
    fit, verdict = found.fit, found.verdict
    law = fit.law.plain
    errors = np.sqrt(np.diag(fit.law_covariance))[: len(law.names)] * law.values
    return ShiftedResult(
        shift=fit.shift.kind,
        reference_c=fit.shift.reference_c,
        shift_parameters=dict(zip(fit.shift.names, fit.parameters.tolist(), strict=True)),
        shift_standard_errors=dict(zip(fit.shift.names, fit.parameter_errors.tolist(), strict=True)),
        temperatures=tuple(
            ShiftAt(
                name=one.name,
                temperature_c=one.temperature_c,
                log10_shift=fit.log_shift[k] / np.log(10),
                log10_shift_standard_error=fit.log_shift_errors[k] / np.log(10),
                vertical=np.exp(fit.log_vertical[k]),
                vertical_standard_error=np.exp(fit.log_vertical[k]) * fit.log_vertical_errors[k],
            )
            for k, one in enumerate(sweeps)
        ),
        law_kind=law.kind,
        parameters=dict(zip(law.names, law.values.tolist(), strict=True)),
        standard_errors=dict(zip(law.names, errors.tolist(), strict=True)),
        law=law_rows_from(found.band),
        simple=verdict.simple,
        common_cause=_cause_from(found.cause) if found.cause is not None else None,
        p_value=verdict.p_value,
        chi2=fit.chi2,
        chi2_each_alone=fit.chi2_own,
        wicket_percent=verdict.wicket_percent,
        words=verdict.words,
        warnings=found.warnings,
        seconds=found.seconds,
    )


def _cause_from(cause: Cause) -> EffectFound:
    return EffectFound(name=cause.effect.name, parameters=parameters_from(cause.found))
