"""The result of `viscorig identify` on tables of modes."""

from collections.abc import Mapping

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result
from instrument.facts.rows import AdjustedNumber, LawRow


class ModeFitted(Result):
    """A mode of a table beside the model's."""

    file: int
    """From 1."""
    mode: int
    frequency_hz: Number
    predicted_hz: Number
    loss_factor: Number
    predicted_loss_factor: Number


class ModalResult(Result):
    """The core's law from natural frequencies and loss factors of any structure."""

    method: str = "modes"
    law_kind: str
    parameters: Mapping[str, Number]
    """Of the law, in SI units, which the keys end with."""
    standard_errors: Mapping[str, Number]
    chi2_per_dof: MaybeNumber = None
    modes: tuple[ModeFitted, ...]
    files: tuple[str, ...]
    evaluations: int = 0
    converged: bool = True
    law: tuple[LawRow, ...]
    """Over the range of the modes."""
    adjusted: tuple[AdjustedNumber, ...] = ()
    warnings: tuple[str, ...] = ()
    temperature_c: MaybeNumber = None
    """Mean of the rows that state one."""
    seconds: MaybeNumber = None
