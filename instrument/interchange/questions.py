"""Questions about data beside their specimen, asked wherever a law is to come of them: unit, sign, plate.

Whoever knows better insists, and then nobody asks.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fitting.mode_tables.fit import ModalFit
from fitting.mode_tables.table import ModalTable
from fitting.specimen import Specimen
from instrument.errors import BadInput
from instrument.files.plausible import INSIST
from instrument.interchange.given import Given
from instrument.models.modal_look import modal_doubt
from instrument.models.quick_look import data_doubt
from instrument.progress import Progress, quiet

_WARM_C = 200.0
"""Few damping materials are measured warmer, and no laboratory is colder in kelvin."""
_LOSSY = 3.0
"""More than a mode of any structure has."""


def question_data(given: Given, path: Path, progress: Progress = quiet, like: Specimen | None = None) -> None:
    """Ask about the sweep of a plate shaken at its base and seen at one spot, or of one like it.

    Raises `BadInput`, and `FittingError` where the plate cannot be modelled over these frequencies.
    """
    plate = given.specimen
    if not given.session:
        _ask(_kelvin(given.temperature_c), [path])
    if given.session or not isinstance(plate, Specimen) or plate.core is None or plate.pickup_m is None:
        return
    if plate.force_m is not None or plate.further_pickups_m or plate.masses:
        return
    _ask(data_doubt(given.sweep, like or plate, progress), [path])


def question_modes(tables: Sequence[ModalTable], fit: ModalFit, paths: Sequence[Path]) -> None:
    """Ask about tables beside their fit without any effect. Raises `BadInput`."""
    warmest = [float(t.temperature_c.max()) for t in tables if t.temperature_c is not None]
    _ask(_kelvin(max(warmest, default=None)) or _percent(tables), paths)
    measured, predicted = (np.concatenate(f) for f in ([t.frequency_hz for t in tables], fit.predicted_hz))
    _ask(modal_doubt(measured, predicted), paths)


def _kelvin(temperature_c: float | None) -> str:
    if temperature_c is None or temperature_c <= _WARM_C:
        return ""
    return f"temperature_c = {temperature_c:g}: is it in K?"


def _percent(tables: Sequence[ModalTable]) -> str:
    most = max(float(t.loss_factor.max()) for t in tables)
    if most > _LOSSY:
        return f"loss_factor up to {most:g}: is it in percent?"
    for t in tables:
        std = t.loss_factor_std
        if std is not None and np.median(std / t.loss_factor) > 1:
            most = float(t.loss_factor.max())
            return f"loss_factor_std up to {std.max():g} for loss factors up to {most:g}: is it in percent?"
    return ""


def _ask(doubt: str, paths: Sequence[Path]) -> None:
    if doubt:
        raise BadInput(f"{', '.join(map(str, paths))}: {doubt}; {INSIST}")
