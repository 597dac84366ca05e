"""The result of `viscorig modes`, of the modes themselves."""

from collections.abc import Iterable, Sequence

import numpy as np

from fitting.dynamics.complex_modes import ModalValue
from fitting.laws import CoreLaw
from instrument.facts.modes import ComplexModeRow, ModesResult


def modes_from(
    found: Iterable[ModalValue], law: CoreLaw | None = None, along: Sequence[bool] = (), remark: str = ""
) -> ModesResult:
    """A row a mode; a note where some lie outside what the law was made for, or go along a beam; `remark`."""
    rows = [(float(m.frequency_hz), float(m.loss_factor)) for m in found]
    said = law.outside(np.array([f for f, _ in rows])) if law is not None else ""
    notes = [one for one in (said, remark) if one]
    notes += [
        f"mode {number} at {f:.4g} Hz goes along the beam, which does not bend in it: no sweep shows it"
        for number, ((f, _), goes) in enumerate(zip(rows, along, strict=False), start=1)
        if goes
    ]
    return ModesResult(
        modes=tuple(ComplexModeRow(frequency_hz=f, loss_factor=loss) for f, loss in rows),
        notes=tuple(notes),
    )
