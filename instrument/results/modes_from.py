"""The result of `viscorig modes`, of the modes themselves."""

from collections.abc import Iterable

import numpy as np

from fitting.complex_modes import ModalValue
from fitting.laws import CoreLaw
from instrument.facts.modes import ComplexModeRow, ModesResult


def modes_from(found: Iterable[ModalValue], law: CoreLaw | None = None) -> ModesResult:
    """A row a mode; where some lie outside what the law was made for, a note."""
    rows = [(float(m.frequency_hz), float(m.loss_factor)) for m in found]
    said = law.outside(np.array([f for f, _ in rows])) if law is not None else ""
    return ModesResult(
        modes=tuple(ComplexModeRow(frequency_hz=f, loss_factor=loss) for f, loss in rows),
        notes=(said,) if said else (),
    )
