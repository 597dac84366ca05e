"""The result of `viscorig modes`, of the modes themselves."""

from collections.abc import Iterable, Sequence

import numpy as np

from fitting.dynamics.complex_modes import ModalValue
from fitting.laws import CoreLaw
from instrument.facts.modes import ComplexModeRow, ModesResult


def modes_from(
    found: Iterable[ModalValue],
    law: CoreLaw | None = None,
    along: Sequence[bool] = (),
    remarks: Sequence[str] = (),
) -> ModesResult:
    """A row a mode; `remarks`, and a note where some lie outside the law's range or go along a beam."""
    rows = [(float(m.frequency_hz), float(m.loss_factor)) for m in found]
    said = law.outside(np.array([f for f, _ in rows])) if law is not None else ""
    notes = [one for one in (said, *remarks) if one]
    notes += [
        f"mode {number} at {f:.4g} Hz goes along the beam, which does not bend in it: no sweep shows it"
        for number, ((f, _), goes) in enumerate(zip(rows, along, strict=False), start=1)
        if goes
    ]
    return ModesResult(
        modes=tuple(ComplexModeRow(frequency_hz=f, loss_factor=loss) for f, loss in rows),
        notes=tuple(notes),
    )
