"""The result of `viscorig modes`, of the modes themselves."""

from collections.abc import Iterable

from fitting.complex_modes import ComplexMode
from instrument.facts.modes import ComplexModeRow, ModesResult


def modes_from(found: Iterable[ComplexMode]) -> ModesResult:
    """A row a mode."""
    rows = [(float(m.frequency_hz), float(m.loss_factor)) for m in found]
    return ModesResult(modes=tuple(ComplexModeRow(frequency_hz=f, loss_factor=loss) for f, loss in rows))
