"""The result of a law from tables of modes, read off its fit."""

from collections.abc import Sequence
from dataclasses import asdict, replace

import numpy as np

from fitting.arrays import Array
from fitting.identification.doubt import doubts_among
from fitting.identification.known_curve import known_curve
from fitting.identification.quoted import REFERENCE_FREQUENCIES_HZ
from fitting.identification.result import LawBand
from fitting.identification.uncertainty import Uncertainty, correlations_by_name
from fitting.identification.validation import rms
from fitting.laws import CoreLaw
from fitting.mode_tables.fit import ModalFit
from fitting.mode_tables.table import ModalTable
from instrument.facts.modal import FormulaRow, ModalResult, ModeFitted
from instrument.finding.modal import TablesIdentified
from instrument.results.rows_from import adjusted_from, law_known_from, law_rows_from

_BAND_POINTS = 41


def modal_from(
    identified: TablesIdentified, tables: Sequence[ModalTable], names: Sequence[str]
) -> ModalResult:
    """The result of `identify` on modal tables."""
    found = identified.fit
    plain = found.law.plain
    own = found.uncertainty.of_first(len(plain.names))
    errors, off = own.standard_errors * plain.values, percent_off(found, tables)
    band = modal_band(found, tables)
    return ModalResult(
        method="modes",
        law_kind=plain.kind,
        parameters=dict(zip(plain.names, plain.values.tolist(), strict=True)),
        standard_errors=dict(zip(plain.names, errors.tolist(), strict=True)),
        correlations=correlations_by_name(plain.names, own),
        rms_percent=rms(off),
        max_percent=float(np.abs(off).max()),
        chi2_per_dof=found.uncertainty.chi2_per_dof,
        leave_one_out_rms_percent=None,
        # A result of sweeps has them: said to be none, not left out.
        points=(),
        held_out=(),
        held_out_rms_percent=None,
        criterion_met=None,
        modes=modes_fitted(found, tables),
        files=tuple(names),
        iterations=int(found.iterations),
        evaluations=int(found.evaluations),
        converged=bool(found.converged),
        law=law_rows_from(band),
        law_known=law_known_from(band),
        adjusted=adjusted_from(found.adjusted),
        formulas=_formulas(identified),
        warnings=identified.remarks,
        doubts=doubts_among(identified.remarks),
        temperature_c=mean_temperature(tables),
        seconds=identified.seconds,
        setup_seconds=identified.setup_seconds,
    )


def percent_off(found: ModalFit, tables: Sequence[ModalTable]) -> Array:
    """100 (predicted / measured - 1) of frequencies. Shape (modes,)."""
    measured = np.concatenate([t.frequency_hz for t in tables])
    return np.asarray(100 * (np.concatenate(found.predicted_hz) / measured - 1))


def _formulas(identified: TablesIdentified) -> tuple[FormulaRow, ...]:
    return tuple(
        FormulaRow(file=k + 1, **asdict(one)) for k, rows in enumerate(identified.formulas) for one in rows
    )


def modes_fitted(found: ModalFit, tables: Sequence[ModalTable]) -> tuple[ModeFitted, ...]:
    """Every mode beside the fit's."""
    return tuple(
        ModeFitted(
            file=k + 1,
            mode=int(t.mode[m]),
            frequency_hz=float(t.frequency_hz[m]),
            predicted_hz=float(found.predicted_hz[k][m]),
            loss_factor=float(t.loss_factor[m]),
            predicted_loss_factor=float(found.predicted_loss[k][m]),
        )
        for k, t in enumerate(tables)
        for m in range(len(t.mode))
    )


def mean_temperature(tables: Sequence[ModalTable]) -> float | None:
    """Of all rows that state one."""
    stated = [t.temperature_c for t in tables if t.temperature_c is not None]
    return float(np.mean(np.concatenate(stated))) if stated else None


def modal_band(found: ModalFit, tables: Sequence[ModalTable]) -> LawBand:
    """The law over the tables' range with its standard errors."""
    f = listed_hz(tables, _BAND_POINTS)
    known = known_curve(found.law, found.posterior, [one.name for one in found.adjusted], f[0], f[-1])
    return replace(band_of(found.law, found.uncertainty, f), known=known)


def band_of(law: CoreLaw, known: Uncertainty, frequency_hz: Array) -> LawBand:
    """A law with its standard errors at some frequencies. Shape (any,)."""
    omega = 2 * np.pi * frequency_hz
    return LawBand(frequency_hz, *law.storage_and_loss(omega), *known.law_band(law, omega))


def listed_hz(tables: Sequence[ModalTable], count: int) -> Array:
    """So many frequencies over the tables' range, and the reference ones in it. Shape (frequencies,)."""
    every = np.concatenate([t.frequency_hz for t in tables])
    low, high = float(every.min()), float(every.max())
    inside = [f for f in REFERENCE_FREQUENCIES_HZ if low <= f <= high]
    return np.unique(np.concatenate([np.geomspace(low, high, count), inside]))
