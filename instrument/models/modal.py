"""Tables of modes with their specimens: a law identified, the theory checked."""

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

from threadpoolctl import threadpool_limits

from fitting.mode_tables.fit import ModalFit, fit_modes
from fitting.mode_tables.table import ModalTable
from fitting.specimen import Specimen
from fitting.structures import AnySpecimen
from instrument.models.remarks import remarks_on_law, remarks_on_tolerances
from instrument.models.theory import theory_over
from instrument.progress import Progress, quiet

_WARMER = 2.0
"""K between rows of a table, from which a damping polymer is another one."""


@dataclass(frozen=True)
class TablesIdentified:
    """A law from tables."""

    fit: ModalFit
    seconds: float
    remarks: tuple[str, ...]


def identify_tables(
    tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen], progress: Progress = quiet
) -> TablesIdentified:
    """One law from all tables.

    Raises `TooFewPoints`, and `OutsideModel` also where a plate's theory does not hold for the law found.
    """
    began = perf_counter()
    with threadpool_limits(1, "blas"), progress("fitting modes"):
        found = fit_modes(tables, specimens)
    check_theories(found, tables, specimens)
    return TablesIdentified(found, perf_counter() - began, remarks_on_tables(tables, specimens))


def check_theories(found: ModalFit, tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]) -> None:
    """Raise `OutsideModel` where a plate's theory does not hold for the law found."""
    for table, specimen in zip(tables, specimens, strict=True):
        if isinstance(specimen, Specimen):
            theory_over(specimen, found.law, table.frequency_hz)


def remarks_on_tables(tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen]) -> tuple[str, ...]:
    """What is to be said of tables and specimens as they were given."""
    said: list[str] = []
    for table, specimen in zip(tables, specimens, strict=True):
        if specimen.core is not None:
            said += remarks_on_law(specimen.core.law, table.frequency_hz)
        if isinstance(specimen, Specimen):
            said += remarks_on_tolerances(specimen)
        if not table.states_its_noise:
            f, eta = table.relative_std
            said.append(
                f"errors of the modes are not stated: {100 * f.max():.2g} % of frequencies and "
                f"{100 * eta.max():.2g} % of loss factors at most are taken for granted"
            )
        warm = table.temperature_c
        if warm is not None and float(warm.max() - warm.min()) > _WARMER:
            said.append(
                f"rows of one table were measured at {warm.min():.1f} to {warm.max():.1f} C: one "
                "law is fitted to all of them"
            )
    return tuple(dict.fromkeys(said))
