"""A row of a batch that is a table of modes."""

from pathlib import Path
from typing import Any

import numpy as np

from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.modal import ModalResult
from instrument.files.modal_table import read_modal_table
from instrument.files.structure_file import read_structure
from instrument.finding.modal import diagnose_tables, first_fit_of, identify_tables
from instrument.interchange.questions import question_modes
from instrument.results.modal_diagnosis_from import modal_diagnosis_from
from instrument.results.modal_from import mean_temperature, modal_from


def identified_modes(data: Path, specimen: Path, *, insist: bool) -> tuple[ModalResult, dict[str, Any]]:
    """What `identify` says of the table; points and band of it. Raises `BadInput`, `FittingError`."""
    tables = [read_modal_table(data)]
    specimens = [read_structure(specimen)]
    found = identify_tables(tables, specimens)
    if not insist:
        question_modes(tables, found.fit, [data], specimens, odd=found.odd)
    result = modal_from(found, tables, [data.name])
    return result, _measured(tables[0].frequency_hz, mean_temperature(tables))


def diagnosed_modes(data: Path, specimen: Path, *, insist: bool) -> tuple[DiagnosisResult, dict[str, Any]]:
    """What `diagnose` says of it, and the same. Raises `BadInput`, `FittingError`."""
    tables = [read_modal_table(data)]
    specimens = [read_structure(specimen)]
    if not insist:
        first, odd = first_fit_of(tables, specimens)
        question_modes(tables, first, [data], specimens, odd=odd)
    found = diagnose_tables(tables, specimens)
    result = modal_diagnosis_from(found, tables, [data.name])
    return result, _measured(tables[0].frequency_hz, mean_temperature(tables))


def _measured(frequency_hz: np.ndarray[Any, Any], temperature_c: float | None) -> dict[str, Any]:
    return {
        "points": len(frequency_hz),
        "lowest_hz": float(frequency_hz.min()),
        "highest_hz": float(frequency_hz.max()),
        "temperature_c": temperature_c,
        "borrowed_model": False,
    }
