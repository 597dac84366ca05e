"""Tables of modes with their specimens: a law identified, the theory checked."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from time import perf_counter

from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.dynamics.damping import viscous_damping
from fitting.effects import all_spans, span_modules
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.identification.doubt import Doubt
from fitting.laws import CoreLaw
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.build import member_of, own_motions
from fitting.mode_tables.diagnose import DiagnosedModes, diagnose_modes
from fitting.mode_tables.fit import BegunModal, ModalFit, begin_modal, modal_fit_of, problem_of, start_of
from fitting.mode_tables.formulas import ByFormula, by_formula
from fitting.mode_tables.misread import Misread, misread
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing
from fitting.mode_tables.table import ModalTable
from fitting.plate.plate import Plate
from fitting.progress import Report
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from fitting.structures.beam import Beam
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.enriching import enriched, reach_over
from fitting.widened.full_plate import FullPlate
from instrument.finding.effect_names import left_out, refuse_unknown_effects
from instrument.models.cache import cached
from instrument.progress import Progress, quiet
from instrument.remarks.free_layers import remark_on_free_layers
from instrument.remarks.modal_reads import remark_on_reading
from instrument.remarks.modal_remarks import (
    remark_on_all,
    remark_on_fit,
    remark_on_misread,
    remark_on_unlike,
    remarks_on_pulls,
    remarks_on_tables,
)
from instrument.remarks.theory import check_each_theory


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
    odd: Misread | None = None
    """The mode that does not go with the others."""


def first_fit_of(
    tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen], progress: Progress = quiet
) -> tuple[ModalFit, Misread | None]:
    """The law without any effect, and the mode that does not go with the others: to ask about, first of all.

    Raises as `identify_tables`, but for the theory.
    """
    with threadpool_limits(1, "blas"), progress("fitting modes"):
        begun = begin_modal(problem_of(tables, specimens), start_of(tables, specimens))
        return modal_fit_of(begun), misread(begun)


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
    left = (*remark_on_fit(found, tables), *remarks_on_pulls(found))
    if odd is not None:
        left = (*_of_a_row(odd, tables), *(() if odd.plain else left))
    left = left or remark_on_all(begun.none, tables)
    said = (
        *left,
        *_remark_on_free_layers(specimens, begun, begun.none),
        *theory,
        *reads,
        *remarks_on_tables(tables, specimens),
    )
    return TablesIdentified(found, begun, seconds, said, formulas, ready - began, odd)


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
    rival: str = ""
    """The same where it says about as much as what is named."""


def refuse_to_diagnose(specimens: Sequence[AnySpecimen], without: Collection[str]) -> None:
    """Raises `BadInput` for an unknown effect, `OutsideModel` for specimens of several kinds."""
    refuse_unknown_effects(without)
    kinds = sorted({s.kind for s in specimens})
    if len(kinds) > 1:
        raise OutsideModel(f"{' and '.join(kinds)} together, expected specimens of one kind to diagnose")


def diagnose_tables(
    tables: Sequence[ModalTable],
    specimens: Sequence[AnySpecimen],
    without: Collection[str] = frozenset(),
    progress: Progress = quiet,
) -> TablesDiagnosed:
    """What one law cannot explain, traced to an effect of all specimens or of one.

    Raises `BadInput` for an unknown effect, `FittingError` as `identify_tables`.
    """
    refuse_to_diagnose(specimens, without)
    start, began = start_of(tables, specimens), perf_counter()
    with threadpool_limits(1, "blas"):
        with progress("spanning what effects change") as report:
            members = [
                member_of(t, s, partial(widened, report=report, reach_hz=reach_over(t.frequency_hz)))
                for t, s in zip(tables, specimens, strict=True)
            ]
        ready = perf_counter()
        every = standing(specimens)
        left = left_out(every, without)
        effects = tuple(e for e in every if e.name not in left)
        with progress("tracing what is left") as report:
            found = diagnose_modes(ModalProblem.of(members), effects, start, report)
    accepted = found.judgement.accepted
    fitted = accepted.fitted if accepted else found.begun.none
    law = fitted.law
    reads = remark_on_reading(members, [law] * len(members))
    remarks = (*check_theories(law, tables, specimens), *reads, *remarks_on_tables(tables, specimens))
    remarks = (*_remark_on_free_layers(specimens, found.begun, fitted), *remarks)
    odd = _of_a_row(found.odd, tables)
    rival = _of_a_row(found.rival, tables)
    # In the explanation one that is likelier than all effects is said already.
    said = (*rival, *(remark_on_all(fitted, tables) if not (odd or rival) else ()), *remarks)
    seconds = perf_counter() - ready
    return TablesDiagnosed(found, effects, ready - began, seconds, said, "".join(odd), "".join(rival))


def _of_a_row(odd: Misread | None, tables: Sequence[ModalTable]) -> tuple[Doubt, ...]:
    """What is said of a mode that does not go with the others; nothing of none."""
    if odd is None:
        return ()
    return ((remark_on_misread if odd.plain else remark_on_unlike)(odd, tables),)


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
