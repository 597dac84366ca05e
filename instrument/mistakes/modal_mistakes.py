"""Tables of modes that fit far better if they are read otherwise: damping ratios, a mode that is missing.

The law of a mode's loss and the slope of its stiffness belong together: losses half as large leave a misfit
that another law, or an effect, takes up for certain. So it is asked before either is believed.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from threadpoolctl import threadpool_limits

from fitting.arrays import Array
from fitting.errors import FittingError
from fitting.mode_tables.fit import begin_modal, problem_of, start_of
from fitting.mode_tables.misread import Misread
from fitting.mode_tables.table import ModalTable
from fitting.structures import AnySpecimen
from instrument.progress import Progress, quiet

BETTER = 12.0
"""In chi-square: e^6 times likelier, four hundred to one."""
_PART, _PART_OF_HALF = 0.2, 0.4
"""Of chi-square per degree may be left, whatever the errors of the table are; the second of damping ratios,
the commonest mistake."""
FITS = 3.0
"""Chi-square per degree up to which a table follows its law."""
GROSS = 3.0
"""Chi-square per degree from which numbers of modes, too, are asked about."""

Reading = tuple[str, list[ModalTable], float]
"""In words, the tables, and the part of chi-square per degree that they may leave."""


def table_doubt(
    tables: Sequence[ModalTable],
    specimens: Sequence[AnySpecimen],
    chi2_per_dof: float,
    progress: Progress = quiet,
    odd: Misread | None = None,
) -> str:
    """What to ask of tables whose fit leaves so much; empty where no mistake explains it.

    `odd` is a mode without which one law explains all the others as they are; it counts where it is plain.
    """
    numbers = 2 * sum(len(t.mode) for t in tables)
    if not numbers * chi2_per_dof > BETTER:
        return ""
    gross = chi2_per_dof > GROSS
    place = odd.place if odd is not None and odd.plain else None
    with progress("reading the modes otherwise"), threadpool_limits(1, "blas"), np.errstate(all="ignore"):
        for some in _readings(tables, gross=gross) if place is None else _readings_of_one(tables, place):
            most = [min(part * chi2_per_dof, FITS) for *_, part in some]
            each = [
                (_left(one[1], specimens, limit), limit, one[0])
                for one, limit in zip(some, most, strict=True)
            ]
            left, limit, words = min(each)
            if numbers * (chi2_per_dof - left) > BETTER and left < limit:
                return (
                    f"the modes follow a law far better (chi-square per degree {left:.2g}, not "
                    f"{chi2_per_dof:.2g}) if {words}: is it so?"
                )
    return ""


def _left(tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen], most: float) -> float:
    """Chi-square per degree, followed as long as it may come down to `most`."""
    try:
        problem, start = problem_of(tables, specimens), start_of(tables, specimens)
        return float(begin_modal(problem, start, per_dof=most).none.chi2_per_dof)
    except FittingError:
        return float("inf")


def _readings(tables: Sequence[ModalTable], *, gross: bool) -> Iterator[list[Reading]]:
    """How they may be meant, the likeliest first: of each list the best counts."""
    yield in_other_units(tables, gross=gross)
    if not gross:
        return
    for k, table in enumerate(tables):
        for words, other in (*_with_one_missing(table, table.mode), *_with_one_too_many(table, table.mode)):
            yield [_with(tables, k, words, other)]


def _readings_of_one(tables: Sequence[ModalTable], place: int) -> Iterator[list[Reading]]:
    """How the mode that does not go with the others may be meant."""
    ends = np.cumsum([len(t.mode) for t in tables])
    k = int(np.searchsorted(ends, place, side="right"))
    table = tables[k]
    mode = table.mode[[place - int(ends[k]) + len(table.mode)]]
    for words, other in (*_with_one_missing(table, mode), *_with_one_too_many(table, mode)):
        yield [_with(tables, k, words, other)]


def _with(tables: Sequence[ModalTable], k: int, words: str, other: ModalTable) -> Reading:
    """All tables, one of them read otherwise."""
    whose = f"{tables[k].name}: " if len(tables) > 1 and tables[k].name else ""
    return whose + words, [*tables[:k], other, *tables[k + 1 :]], _PART


def in_other_units(tables: Sequence[ModalTable], *, gross: bool) -> list[Reading]:
    """Columns of all tables that are meant otherwise."""
    losses: list[Reading] = [
        ("loss_factor holds damping ratios, half of it", [_times(t, 2.0) for t in tables], _PART_OF_HALF),
        ("loss_factor is twice what it should be", [_times(t, 0.5) for t in tables], _PART),
    ]
    if not gross:
        return losses
    return [
        *losses,
        (
            "loss_factor holds logarithmic decrements, pi times it",
            [_times(t, 1 / np.pi) for t in tables],
            _PART,
        ),
        ("frequency_hz is in rad/s", [_slower(t) for t in tables], _PART),
    ]


def _times(table: ModalTable, factor: float) -> ModalTable:
    std = table.loss_factor_std
    return replace(
        table,
        loss_factor=factor * table.loss_factor,
        loss_factor_std=None if std is None else factor * std,
    )


def _slower(table: ModalTable) -> ModalTable:
    std, once = table.frequency_std_hz, 2 * np.pi
    return replace(
        table,
        frequency_hz=table.frequency_hz / once,
        frequency_std_hz=None if std is None else std / once,
    )


def _with_one_missing(table: ModalTable, before: Array) -> Iterator[tuple[str, ModalTable]]:
    """A mode more before each of some modes. Shape (any,)."""
    for first in before:
        later = table.mode + (table.mode >= first)
        yield f"a mode is missing before mode {first:g}", replace(table, mode=later)


def _with_one_too_many(table: ModalTable, modes: Array) -> Iterator[tuple[str, ModalTable]]:
    """Each of some modes left out, the later ones renumbered. Shape (any,)."""
    for one in modes:
        rest = table.mode != one
        columns = {
            name: value[rest]
            for name, value in vars(table).items()
            if isinstance(value, np.ndarray) and name != "mode"
        }
        earlier = table.mode[rest] - (table.mode[rest] > one)
        yield f"mode {one:g} is none of the specimen", replace(table, mode=earlier, **columns)
