"""Tables of modes with their specimens: a law identified, the theory checked."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.digits import two_digits, written_out
from fitting.dynamics.damping import viscous_damping
from fitting.effects import all_spans, span_modules
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.identification.doubt import ASTRAY, BIASED, Doubt
from fitting.identification.result import moved_too_far
from fitting.laws import CoreLaw
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.build import member_of, own_motions
from fitting.mode_tables.diagnose import DiagnosedModes, diagnose_modes
from fitting.mode_tables.fit import BegunModal, ModalFit, begin_modal, modal_fit_of, problem_of, start_of
from fitting.mode_tables.formulas import ByFormula, by_formula
from fitting.mode_tables.misread import Misread, misread
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing
from fitting.mode_tables.table import FREQUENCY_STD, LOSS_STD, ModalTable
from fitting.plate.plate import Plate
from fitting.progress import Report
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from fitting.structures.beam import Beam
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.enriching import enriched, reach_over
from fitting.widened.full_plate import FullPlate
from instrument.finding.effect_names import refuse_unknown_effects
from instrument.models.cache import cached
from instrument.progress import Progress, quiet
from instrument.remarks.as_given import (
    remarks_on_damping,
    remarks_on_law,
    remarks_on_patches,
    remarks_on_tolerances,
)
from instrument.remarks.clamp_remarks import remarks_on_clamps
from instrument.remarks.free_layers import remark_on_free_layers
from instrument.remarks.modal_reads import remark_on_reading
from instrument.remarks.theory import check_each_theory

_LOST = 0.1
"""Relative: stated numbers within their tolerances move frequencies by a tenth of that."""
_MISFIT = 3.0
"""Chi-square per degree from which errors of modes do not explain what is left."""
_NOTHING_BENDS = 1e-6
"""A loss factor that only motion along a beam has."""
_WARMER = 2.0
"""K between rows of a table, from which a damping polymer is another one."""


@dataclass(frozen=True)
class TablesIdentified:
    """A law from tables."""

    fit: ModalFit
    begun: BegunModal
    seconds: float
    remarks: tuple[str, ...]
    formulas: tuple[tuple[ByFormula, ...], ...] = ()
    """Moduli by formula, for each mode of every table."""
    setup_seconds: float = 0.0


def identify_tables(
    tables: Sequence[ModalTable],
    specimens: Sequence[AnySpecimen],
    progress: Progress = quiet,
    bare: ModalTable | None = None,
) -> TablesIdentified:
    """One law from all tables; `bare` is of the beam before its treatment, for the standard's formulas.

    Raises `TooFewPoints`, and `OutsideModel` also where a plate's theory does not hold for the law found.
    """
    start, began = start_of(tables, specimens), perf_counter()
    with threadpool_limits(1, "blas"), progress("fitting modes"):
        problem = problem_of(tables, specimens)
        ready = perf_counter()
        begun = begin_modal(problem, start)
        found, odd = modal_fit_of(begun), misread(begun)
    theory = check_theories(found.law, tables, specimens)
    formulas = tuple(
        by_formula(t, s, found.law, bare) if isinstance(s, Beam) else ()
        for t, s in zip(tables, specimens, strict=True)
    )
    seconds = perf_counter() - ready
    reads = remark_on_reading(problem.members, [found.law] * len(problem.members))
    left: tuple[str, ...] = (*remark_on_fit(found, tables), *remarks_on_pulls(found))
    if odd is not None:
        left = (remark_on_misread(odd, tables),)
    said = (
        *left,
        *_remark_on_free_layers(specimens, begun, begun.none),
        *theory,
        *reads,
        *remarks_on_tables(tables, specimens),
    )
    return TablesIdentified(found, begun, seconds, said, formulas, ready - began)


@dataclass(frozen=True)
class TablesDiagnosed:
    """What tables of modes show beside a law."""

    found: DiagnosedModes
    effects: tuple[Effect, ...]
    """The effects that were looked for."""
    setup_seconds: float
    seconds: float
    remarks: tuple[str, ...]
    misread: str = ""
    """Which mode does not go with the others, where that says more than any effect."""


def diagnose_tables(
    tables: Sequence[ModalTable],
    specimens: Sequence[AnySpecimen],
    without: Collection[str] = frozenset(),
    progress: Progress = quiet,
) -> TablesDiagnosed:
    """What one law cannot explain, traced to an effect of all specimens or of one.

    Raises `BadInput` for an unknown effect, `FittingError` as `identify_tables`.
    """
    refuse_unknown_effects(without)
    kinds = sorted({s.kind for s in specimens})
    if len(kinds) > 1:
        raise OutsideModel(f"{' and '.join(kinds)} together, expected specimens of one kind to diagnose")
    start, began = start_of(tables, specimens), perf_counter()
    with threadpool_limits(1, "blas"):
        with progress("spanning what effects change") as report:
            members = [
                member_of(t, s, partial(widened, report=report, reach_hz=reach_over(t.frequency_hz)))
                for t, s in zip(tables, specimens, strict=True)
            ]
        ready = perf_counter()
        effects = tuple(e for e in standing(specimens) if e.name not in without)
        with progress("tracing what is left") as report:
            found = diagnose_modes(ModalProblem.of(members), effects, start, report)
    accepted = found.judgement.accepted
    fitted = accepted.fitted if accepted else found.begun.none
    law = fitted.law
    reads = remark_on_reading(members, [law] * len(members))
    remarks = (*check_theories(law, tables, specimens), *reads, *remarks_on_tables(tables, specimens))
    remarks = (*_remark_on_free_layers(specimens, found.begun, fitted), *remarks)
    odd = remark_on_misread(found.odd, tables) if found.odd is not None else ""
    return TablesDiagnosed(found, effects, ready - began, perf_counter() - ready, remarks, odd)


def _remark_on_free_layers(
    specimens: Sequence[AnySpecimen], begun: BegunModal, fitted: Refitted
) -> tuple[str, ...]:
    f, n = begun.problem.frequency_hz, len(fitted.law.names)
    return remark_on_free_layers(
        specimens,
        fitted.law,
        fitted.covariance[:n, :n],
        (float(f.min()), float(f.max())),
        partial(begun.quantities, fitted=fitted),
    )


def widened(specimen: PlateSpecimen, V: Array, report: Report, reach_hz: float) -> EnrichedReducedPlate:
    """A plate and its own motions with all that effects need, made or loaded. Shape (n, k)."""

    def build() -> EnrichedReducedPlate:
        plate = Plate(specimen)
        full = FullPlate(plate, viscous_damping(plate))
        return enriched(full, V, all_spans(specimen), report, reach_hz)

    assert specimen.core is not None
    lawless = specimen.with_law(ConstantModulus(1e6, 0.0))
    modules = [*span_modules(), enriched.__module__, own_motions.__module__]
    return cached("modes", [lawless, V.shape[1], reach_hz], EnrichedReducedPlate, build, modules)


def check_theories(
    law: CoreLaw, tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]
) -> tuple[str, ...]:
    """As `check_each_theory`, for the law found."""
    return check_each_theory(specimens, law, [t.frequency_hz for t in tables])


def remarks_on_pulls(fit: ModalFit) -> tuple[Doubt, ...]:
    """That stated numbers had to be moved further than they may be; nothing where they were not."""
    n = len(fit.law.names)
    stated = slice(n, n + len(fit.adjusted))
    return tuple(moved_too_far(fit.adjusted, fit.posterior[stated, stated]))


def remark_on_fit(fit: ModalFit, tables: Sequence[ModalTable]) -> tuple[Doubt, ...]:
    """That a law leaves more of the modes than errors or tolerances would; nothing where it does not."""
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
    whose = "their" if all(t.states_its_noise for t in tables) else "the assumed"
    return (
        Doubt(
            f"the modes are off by {chi2:.3g} times what {whose} errors explain (chi-square per degree), by "
            f"up to {two_digits(100 * np.abs(off_f).max())} % in frequency and "
            f"{two_digits(100 * np.abs(off_eta).max())} % in loss factor: check mode numbers, "
            "and that loss factors are no damping ratios (half of them); else the model lacks something, and "
            f"{BIASED}"
        ),
    )


def remark_on_misread(odd: Misread, tables: Sequence[ModalTable]) -> str:
    """Which mode does not go with the others, and where they have it."""
    mode, f, eta = (
        np.concatenate([getattr(t, name) for t in tables])[odd.place]
        for name in ("mode", "frequency_hz", "loss_factor")
    )
    file = int(np.searchsorted(np.cumsum([len(t.mode) for t in tables]), odd.place, "right")) + 1
    of_file = f" of file {file}" if len(tables) > 1 else ""
    theirs, asked = f"with a loss factor of {odd.loss_factor:.3g}", "is it misread, or another motion?"
    if odd.loss_factor < _NOTHING_BENDS:
        theirs = "where layers stretch along the beam, nothing bends and nothing is lost"
        asked = f"bending modes are numbered past that one: is this mode {mode + 1:g}?"
    return (
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
