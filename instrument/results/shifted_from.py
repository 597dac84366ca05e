"""One law over several temperatures as JSON holds it."""

from collections.abc import Sequence

import numpy as np

from fitting.identification.doubt import doubts_among
from fitting.identification.result import differences_percent
from fitting.identification.validation import rms
from fitting.mode_tables.table import ModalTable
from fitting.sweep import Sweep
from fitting.temperature.causes import Cause
from instrument.facts.diagnosis import EffectFound
from instrument.facts.shifted import ModeAt, ShiftAt, ShiftedResult
from instrument.results.diagnosis_from import parameters_from
from instrument.results.rows_from import adjusted_from, law_rows_from
from instrument.temperatures.members import AtTemperature
from instrument.temperatures.shifted import Shifted


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
                rms_percent=_rms_percent(found, k) if isinstance(one.data, Sweep) else None,
            )
            for k, one in enumerate(sweeps)
        ),
        law_kind=law.kind,
        parameters=dict(zip(law.names, law.values.tolist(), strict=True)),
        standard_errors=dict(zip(law.names, errors.tolist(), strict=True)),
        law=law_rows_from(found.band),
        simple=verdict.simple,
        common_cause=_cause_from(found.cause) if found.cause is not None else None,
        converged=bool(fit.converged),
        p_value=verdict.p_value,
        chi2=fit.chi2,
        chi2_each_alone=fit.chi2_own,
        wicket_percent=verdict.wicket_percent,
        modes=_modes(found, sweeps),
        adjusted=adjusted_from(found.adjusted),
        words=verdict.words,
        warnings=found.warnings,
        doubts=doubts_among(found.warnings),
        seconds=found.seconds,
    )


def _rms_percent(found: Shifted, k: int) -> float:
    """What the one law leaves of the k-th sweep's amplitudes."""
    stops = np.cumsum(found.fit.joined.lengths)
    read = np.split(found.fit.one.velocity_m_s, stops[:-1])[k]
    return rms(differences_percent(found.alone[k].begun.problem.sweep, read))


def _modes(found: Shifted, every: Sequence[AtTemperature]) -> tuple[ModeAt, ...]:
    """Measured and predicted, member after member; none of sweeps."""
    rows = [(one, one.data, k) for one in every if isinstance(one.data, ModalTable) for k in _rows(one.data)]
    return tuple(
        ModeAt(
            name=one.name,
            temperature_c=one.temperature_c,
            mode=int(table.mode[k]),
            frequency_hz=table.frequency_hz[k],
            predicted_hz=f,
            loss_factor=table.loss_factor[k],
            predicted_loss_factor=eta,
        )
        for (one, table, k), f, eta in zip(rows, *found.predicted_modes, strict=True)
    )


def _rows(table: ModalTable) -> range:
    return range(len(table.mode))


def _cause_from(cause: Cause) -> EffectFound:
    return EffectFound(name=cause.effect.name, parameters=parameters_from(cause.found))
