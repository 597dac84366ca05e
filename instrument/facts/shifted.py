"""The result of `viscorig identify --shift`."""

from typing import Literal

from instrument.facts.diagnosis import EffectFound
from instrument.facts.intervals import IntervalsFound
from instrument.facts.number import Number
from instrument.facts.result import Result
from instrument.facts.rows import AdjustedNumber, LawRow


class ShiftAt(Result):
    """One sweep's place under the joint law."""

    name: str
    """Name of its file."""
    temperature_c: Number
    log10_shift: Number
    """Of a_T: the law is read at a_T times the frequency."""
    log10_shift_standard_error: Number
    vertical: Number
    """Factor on G*; 1 where none was asked for."""
    vertical_standard_error: Number
    rms_percent: Number | None = None
    """Of the differences in amplitude between a sweep and the one law; None of a table of modes."""


class ModeAt(Result):
    """A mode at one temperature beside the model's under the joint law."""

    name: str
    """Name of its file."""
    temperature_c: Number
    """Temperature as its table states it."""
    mode: int
    frequency_hz: Number
    predicted_hz: Number
    loss_factor: Number
    predicted_loss_factor: Number


class ShiftedResult(Result):
    """One law in reduced frequency over sweeps at several temperatures."""

    shift: Literal["wlf", "arrhenius", "free"]
    reference_c: Number
    shift_parameters: dict[str, Number]
    shift_standard_errors: dict[str, Number]
    temperatures: tuple[ShiftAt, ...]
    law_kind: str
    parameters: dict[str, Number]
    """At the reference temperature, in SI units, which the keys end with."""
    standard_errors: dict[str, Number]
    law: tuple[LawRow, ...]
    """Over reduced frequency, at the reference temperature."""
    simple: bool | None
    """Whether one shifted law serves; None where that cannot be told: the plate or its rig may be what sets
    temperatures apart."""
    common_cause: EffectFound | None = None
    """An effect that all sweeps seem to have in common; it is counted in."""
    converged: bool = True
    """Whether the joint fit came to its end; its values are provisional where it did not."""
    p_value: Number
    chi2: Number
    chi2_each_alone: Number
    """Of a law for each temperature."""
    wicket_percent: Number
    """Largest distance of eta from the joint law's at one G', over all temperatures."""
    modes: tuple[ModeAt, ...] = ()
    """Modes of the tables, where data are tables."""
    adjusted: tuple[AdjustedNumber, ...] = ()
    """The stated numbers as the joint fit has them, those of a specimen once for all its temperatures."""
    words: str
    uncertainty: tuple[IntervalsFound, ...] | None = None
    """By profile likelihood, where it was asked for (docs/uncertainty.md)."""
    warnings: tuple[str, ...]
    doubts: tuple[str, ...] | None = None
    """Those warnings by which the law may be wrong by more than is known of it; None in files of older
    versions."""
    seconds: Number
