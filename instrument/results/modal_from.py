"""The result of a law from tables of modes, read off its fit."""

from collections.abc import Sequence

import numpy as np

from fitting.identification.result import REFERENCE_FREQUENCIES_HZ, LawBand
from fitting.structures.modal_fit import ModalFit, ModalTable
from instrument.facts.modal import ModalResult, ModeFitted
from instrument.results.rows_from import adjusted_from, law_rows_from

_BAND_POINTS = 41


def modal_from(
    found: ModalFit, tables: Sequence[ModalTable], names: Sequence[str], warnings: Sequence[str] = ()
) -> ModalResult:
    """The result of `identify` on modal tables."""
    plain = found.law.plain
    errors = found.uncertainty.of_first(len(plain.names)).standard_errors * plain.values
    return ModalResult(
        method="modes",
        law_kind=plain.kind,
        parameters=dict(zip(plain.names, plain.values.tolist(), strict=True)),
        standard_errors=dict(zip(plain.names, errors.tolist(), strict=True)),
        chi2_per_dof=found.uncertainty.chi2_per_dof,
        modes=tuple(
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
        ),
        files=tuple(names),
        evaluations=int(found.evaluations),
        converged=bool(found.converged),
        law=law_rows_from(modal_band(found, tables)),
        adjusted=adjusted_from(found.adjusted),
        warnings=tuple(warnings),
    )


def modal_band(found: ModalFit, tables: Sequence[ModalTable]) -> LawBand:
    """The law over the tables' range with its standard errors."""
    every = np.concatenate([t.frequency_hz for t in tables])
    low, high = float(every.min()), float(every.max())
    inside = [f for f in REFERENCE_FREQUENCIES_HZ if low <= f <= high]
    f = np.unique(np.concatenate([np.geomspace(low, high, _BAND_POINTS), inside]))
    G, eta = found.law.storage_and_loss(2 * np.pi * f)
    return LawBand(f, G, eta, *found.uncertainty.law_band(found.law, 2 * np.pi * f))
