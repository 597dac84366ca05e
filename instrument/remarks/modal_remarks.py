"""What is said of tables of modes and their specimens, and of the law that was fitted to them."""

from collections.abc import Sequence

import numpy as np

from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.thresholds import VERDICT
from fitting.digits import two_digits, written_out
from fitting.identification.doubt import ASTRAY, BIASED, Doubt
from fitting.identification.result import moved_too_far
from fitting.mode_tables.fit import ModalFit
from fitting.mode_tables.misread import Misread
from fitting.mode_tables.table import FREQUENCY_STD, LOSS_STD, ModalTable
from fitting.numerics.chances import chi2_above
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.remarks.as_given import (
    remarks_on_damping,
    remarks_on_law,
    remarks_on_patches,
    remarks_on_tolerances,
)
from instrument.remarks.clamp_remarks import remarks_on_clamps

_LOST = 0.1
"""Relative: stated numbers within their tolerances move frequencies by a tenth of that."""
_MISFIT = 3.0
"""Chi-square per degree from which errors of modes do not explain what is left."""
_NOTHING_BENDS = 1e-6
"""A loss factor that only motion along a beam has."""
_WARMER = 2.0
"""K between rows of a table, from which a damping polymer is another one."""


def remarks_on_pulls(fit: ModalFit) -> tuple[Doubt, ...]:
    """Doubts of a law for which stated numbers had to be moved further than they may be."""
    n = len(fit.law.names)
    stated = slice(n, n + len(fit.adjusted))
    return tuple(moved_too_far(fit.adjusted, fit.posterior[stated, stated]))


def remark_on_fit(fit: ModalFit, tables: Sequence[ModalTable]) -> tuple[Doubt, ...]:
    """Doubts of a law that leaves more of the modes than errors or tolerances would."""
    off_f = np.concatenate(fit.predicted_hz) / np.concatenate([t.frequency_hz for t in tables]) - 1
    off_eta = np.concatenate(fit.predicted_loss) / np.concatenate([t.loss_factor for t in tables]) - 1
    if (rms_f := float(np.sqrt(np.mean(off_f**2)))) > _LOST:
        return (
            Doubt(
                f"{ASTRAY} modes (rms {written_out(100 * rms_f, 3)} % in frequency): check "
                "mode numbers, specimen and unit"
            ),
        )
    chi2 = fit.uncertainty.chi2_per_dof
    if not chi2 > _MISFIT:
        return ()
    whose = "the modes'" if all(t.states_its_noise for t in tables) else "the assumed"
    return (
        Doubt(
            f"chi-square per degree of freedom is {chi2:.3g} where {whose} errors leave 1: modes are off by "
            f"up to {two_digits(100 * np.abs(off_f).max())} % in frequency and "
            f"{two_digits(100 * np.abs(off_eta).max())} % in loss factor: check mode numbers, "
            "and that loss factors are no damping ratios (half of them); else the model lacks something, and "
            f"{BIASED}"
        ),
    )


def remark_on_all(none: Refitted, tables: Sequence[ModalTable]) -> tuple[Doubt, ...]:
    """Doubts of a law that bends, and moves stated numbers, each within what it may, too far together."""
    dof = none.data - none.parameter_count
    if not all(t.states_its_noise for t in tables) or not chi2_above(none.chi2, dof) < VERDICT.check_level:
        return ()
    return (
        Doubt(
            "the modes are met only by a law that bends, and stated numbers that move, further together "
            f"than chance has them (chi-square {none.chi2:.3g} where {dof} is expected): some modes are "
            f"misread, or the model lacks something, and {BIASED}; see 'viscorig diagnose'"
        ),
    )


def remark_on_unlike(odd: Misread, tables: Sequence[ModalTable]) -> Doubt:
    """Which mode the law has to bend for, where the others have it, and which other one may be it instead."""
    mode, of_file, f, eta = _row(odd, tables)
    instead = "".join(
        f"; or mode {number:g}{of} in its place: they have that at {one.frequency_hz:.5g} Hz with "
        f"{one.loss_factor:.3g}, the table at {its_f:.5g} Hz with {its_eta:.3g}"
        for one in odd.rivals
        for number, of, its_f, its_eta in [_row(one, tables)]
    )
    return Doubt(
        f"mode {mode:g}{of_file} does not go with the others (chi-square {odd.with_it:.3g} with it, "
        f"{odd.others.chi2:.2g} without; a right one takes along as much in fewer than one table of "
        f"two hundred): one law of the others has it at {odd.frequency_hz:.5g} Hz with a loss factor of "
        f"{odd.loss_factor:.3g}, the table at {f:.5g} Hz with {eta:.3g}{instead}: is it misread, or another "
        "motion? If it is right something acts on it ('viscorig diagnose'), or the core departs from its "
        f"formula there. As it is, {BIASED}"
    )


def _row(odd: Misread, tables: Sequence[ModalTable]) -> tuple[float, str, float, float]:
    """Its mode, the words for its file, its frequency and loss factor in the table."""
    mode, f, eta = (
        float(np.concatenate([getattr(t, name) for t in tables])[odd.place])
        for name in ("mode", "frequency_hz", "loss_factor")
    )
    file = int(np.searchsorted(np.cumsum([len(t.mode) for t in tables]), odd.place, "right")) + 1
    return mode, f" of file {file}" if len(tables) > 1 else "", f, eta


def remark_on_misread(odd: Misread, tables: Sequence[ModalTable]) -> Doubt:
    """Which mode plainly does not go with the others, and where they have it."""
    mode, of_file, f, eta = _row(odd, tables)
    theirs, asked = f"with a loss factor of {odd.loss_factor:.3g}", "is it misread, or another motion?"
    if odd.loss_factor < _NOTHING_BENDS:
        theirs = "where layers stretch along the beam, nothing bends and nothing is lost"
        asked = f"bending modes are numbered past that one: is this mode {mode + 1:g}?"
    return Doubt(
        f"mode {mode:g}{of_file} does not go with the others, which one law explains without any effect: "
        f"they have it at {odd.frequency_hz:.5g} Hz {theirs}, the table "
        f"at {f:.5g} Hz with {eta:.3g}: {asked} "
        "With this row left out there is a law; with it there is none to be trusted"
    )


def remarks_on_errors(tables: Sequence[ModalTable]) -> tuple[str, ...]:
    """Where standard deviations are not stated, which are assumed."""
    assumed = [
        f"{two_digits(100 * usual)} % of {what} ({column})"
        for what, column, usual, unsaid in (
            (
                "frequencies",
                "frequency_std_hz",
                FREQUENCY_STD,
                any(t.frequency_std_hz is None for t in tables),
            ),
            ("loss factors", "loss_factor_std", LOSS_STD, any(t.loss_factor_std is None for t in tables)),
        )
        if unsaid
    ]
    if not assumed:
        return ()
    return (f"errors of the modes are not stated, assumed are {' and '.join(assumed)}",)


def remarks_on_tables(tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]) -> tuple[str, ...]:
    """What is to be said of tables and specimens as they were given."""
    said: list[str] = []
    for table, specimen in zip(tables, specimens, strict=True):
        if specimen.core is not None:
            said += remarks_on_law(specimen.core.law, table.frequency_hz)
        if isinstance(specimen, PlateSpecimen):
            said += [*remarks_on_tolerances(specimen), *remarks_on_damping(specimen, tested=False)]
        said += (*remarks_on_patches(specimen), *remarks_on_clamps(specimen))
        said += remarks_on_errors([table])
        warm = table.temperature_c
        if warm is not None and float(warm.max() - warm.min()) > _WARMER:
            said.append(
                f"rows of one table were measured at {warm.min():.1f} to {warm.max():.1f} C: one "
                "law is fitted to all of them"
            )
    return tuple(dict.fromkeys(said))
