"""The result of `viscorig modes`."""

from instrument.facts.number import Number
from instrument.facts.result import Result


class ComplexModeRow(Result):
    """One mode."""

    frequency_hz: Number
    loss_factor: Number


class ModesResult(Result):
    """Natural frequencies and modal loss factors, ascending; rigid modes are left out."""

    modes: tuple[ComplexModeRow, ...]
    notes: tuple[str, ...] = ()
