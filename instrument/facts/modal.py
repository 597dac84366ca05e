"""The result of `viscorig identify` on tables of modes."""

from collections.abc import Mapping
from math import nan

from instrument.facts.identification import PointFitted
from instrument.facts.intervals import IntervalsFound
from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result
from instrument.facts.rows import AdjustedNumber, HeldOut, LawKnown, LawRow


class ModeFitted(Result):
    """A mode of a table beside the model's."""

    file: int
    """From 1."""
    mode: int
    frequency_hz: Number
    predicted_hz: Number
    loss_factor: Number
    predicted_loss_factor: Number


class FormulaRow(Result):
    """What a standard's formula makes of one mode, beside the full model's law there."""

    file: int
    """From 1."""
    mode: int
    frequency_hz: Number
    method: str
    """`oberst`, `van-oort`, `ross-kerwin-ungar` (ASTM E756) or `central-impedance`."""
    loss_factor: Number
    """Of the layer; by `central-impedance` of the whole beam."""
    storage_modulus_pa: MaybeNumber = None
    """Of the layer, in shear."""
    bending_stiffness_n_m2: MaybeNumber = None
    """Of the whole beam, by `central-impedance`."""
    full_storage_modulus_pa: MaybeNumber = None
    full_loss_factor: MaybeNumber = None
    objections: tuple[str, ...] = ()
    """Why the formula is not to be trusted there."""


class ModalResult(Result):
    """The core's law from natural frequencies and loss factors of any structure."""

    method: str = "modes"
    law_kind: str
    parameters: Mapping[str, Number]
    """Of the law, in SI units, which the keys end with."""
    standard_errors: Mapping[str, Number]
    correlations: Mapping[str, Mapping[str, Number]] = {}
    """Of the logarithms of the parameters."""
    rms_percent: Number = nan
    """Of the differences in frequency."""
    max_percent: Number = nan
    chi2_per_dof: MaybeNumber = None
    leave_one_out_rms_percent: MaybeNumber = None
    """None: modes are not left out one by one."""
    points: tuple[PointFitted, ...] = ()
    """None: `modes` are what was measured; so are the three below of sweeps alone."""
    held_out: tuple[HeldOut, ...] = ()
    held_out_rms_percent: MaybeNumber = None
    criterion_met: bool | None = None
    modes: tuple[ModeFitted, ...]
    files: tuple[str, ...]
    iterations: int = 0
    evaluations: int = 0
    converged: bool = True
    law: tuple[LawRow, ...]
    """Over the range of the modes."""
    law_known: LawKnown | None = None
    adjusted: tuple[AdjustedNumber, ...] = ()
    formulas: tuple[FormulaRow, ...] = ()
    """Of beams, where a formula can be asked."""
    uncertainty: tuple[IntervalsFound, ...] | None = None
    """By profile likelihood, where it was asked for (docs/uncertainty.md)."""
    warnings: tuple[str, ...] = ()
    doubts: tuple[str, ...] | None = None
    """Those warnings by which the law may be wrong by more than is known of it; None in files of older
    versions."""
    temperature_c: MaybeNumber = None
    """Mean of the rows that state one."""
    seconds: MaybeNumber = None
    """Of the fit, set-up not counted."""
    setup_seconds: MaybeNumber = None
