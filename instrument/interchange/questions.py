"""Questions about data beside their specimen, asked wherever a law is to come of them: unit, sign, plate.

Whoever knows better insists, and then nobody asks.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from fitting.mode_tables.fit import ModalFit
from fitting.mode_tables.misread import Misread
from fitting.mode_tables.table import ModalTable
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, ShearPair
from instrument.errors import BadInput
from instrument.files.plausible import INSIST
from instrument.files.sweep_file import words_of_other_reading
from instrument.files.table import count_rows, read_header
from instrument.interchange.given import Given
from instrument.mistakes.modal_look import modal_doubt
from instrument.mistakes.modal_mistakes import table_doubt
from instrument.mistakes.mode_numbers import numbers_doubt
from instrument.mistakes.quick_look import data_doubt
from instrument.progress import Progress, quiet
from instrument.temperatures.shifted import Shifted

_WARM_C = 200.0
"""Few damping materials are measured warmer, and no laboratory is colder in kelvin."""
_APART_K = 2.0
"""Between files of one law: by more a polymer in its transition is another one by tenths."""
_DRIFTED_K = 5.0
"""Within one sweep or table, from its coldest row to its warmest: no mean is that of all of it."""
_MANY, _ENOUGH = 20_000, 2_000
"""Lines of a sweep: more take more than a minute, and say hardly more of a law than as many as are enough."""
_SHORTEST = 10
"""Letters of a line of a sweep: a frequency and two parts have more."""
_TIMED_ROWS = 10
"""Readings that share one time from which on it is no clock's: fewer may be told by hand, all at once."""
_LONGEST_S = 3 * 7 * 86_400.0
"""Of one sweep: rigs take hours, and half an hour in ms is as long."""
_SECONDS_A_LINE = 3e-3
"""Of a plate's fit on one processor."""
_BEST_FREQUENCY, _BEST_LOSS = 1e-6, 1e-4
"""Standard deviations of a mode, relative: a thousandth and a hundredth of what a careful laboratory has."""
_LOSSY = 2.0
"""More than a mode of any structure has."""


def question_length(path: Path, specimen: AnySpecimen) -> None:
    """Ask about a sweep of far too many lines before any of them is read. Raises `BadInput`."""
    is_table = path.suffix.lower() in (".csv", ".txt") and path.is_file()
    if is_table and path.stat().st_size > _MANY * _SHORTEST and "frequency_hz" in read_header(path):
        _ask(_many(count_rows(path), isinstance(specimen, PlateSpecimen)), [path])


def question_data(
    given: Given, path: Path, progress: Progress = quiet, like: PlateSpecimen | None = None
) -> None:
    """Ask about the sweep of a specimen, or of one like it, as its first spot sees it.

    Raises `BadInput`, and `FittingError` where it cannot be modelled over these frequencies.
    """
    plate = given.specimen
    if not given.session:
        doubt = _otherwise_read(given) or kelvin_doubt(given.temperature_c)
        doubt = doubt or _drifted(given.temperature_range_c) or _times(given.sweep.time_s)
        _ask(doubt or _many(len(given.sweep), isinstance(plate, PlateSpecimen)), [path])
    if (
        given.session
        or plate.core is None
        or not (isinstance(plate, ShearPair) or plate.pickup_m is not None)
    ):
        return
    if isinstance(plate, PlateSpecimen) and plate.masses:
        return
    _ask(data_doubt(given.sweep, like or plate, progress), [path])


def _otherwise_read(given: Given) -> str:
    return words_of_other_reading(given.reads, given.specimen.reads) if given.reads else ""


def question_modes(
    tables: Sequence[ModalTable],
    fit: ModalFit,
    paths: Sequence[Path],
    specimens: Sequence[AnySpecimen] = (),
    progress: Progress = quiet,
    odd: Misread | None = None,
) -> None:
    """Ask about tables beside their fit without any effect; with `specimens` also how they may be meant.

    `odd` as `table_doubt` takes it. Raises `BadInput`.
    """
    question_tables(tables, paths)
    for table, path in zip(tables, paths, strict=False):
        _ask(_of_several_temperatures(table), [path])
    question_temperatures(
        [None if t.temperature_c is None else float(t.temperature_c.mean()) for t in tables], paths
    )
    question_modes_at(tables, np.concatenate(fit.as_stated_hz), paths)
    if specimens:
        _ask(table_doubt(tables, specimens, fit.uncertainty.chi2_per_dof, progress, odd), paths)


def question_tables(tables: Sequence[ModalTable], paths: Sequence[Path]) -> None:
    """Ask about tables by themselves: kelvin, percent, errors too small. Raises `BadInput`."""
    warmest = [float(t.temperature_c.max()) for t in tables if t.temperature_c is not None]
    _ask(kelvin_doubt(max(warmest, default=None)) or _percent(tables) or _too_well_known(tables), paths)


def question_numbers(
    tables: Sequence[ModalTable], specimens: Sequence[AnySpecimen], paths: Sequence[Path]
) -> None:
    """Ask about mode numbers that are all one off, before any fit; each table with its specimen.

    Raises `BadInput`.
    """
    _ask(numbers_doubt(tables, specimens), paths)


def question_modes_at(tables: Sequence[ModalTable], predicted_hz: Array, paths: Sequence[Path]) -> None:
    """Ask about modes that no core comes near. Raises `BadInput`. `predicted_hz` of shape (all modes,)."""
    _ask(modal_doubt(np.concatenate([t.frequency_hz for t in tables]), predicted_hz), paths)


def question_temperatures(temperatures_c: Sequence[float | None], paths: Sequence[Path]) -> None:
    """Ask about files of one law that are not of one temperature. Raises `BadInput`."""
    known = sorted((t, path) for t, path in zip(temperatures_c, paths, strict=False) if t is not None)
    if known and known[-1][0] - known[0][0] > _APART_K:
        (cold, first), (warm, last) = known[0], known[-1]
        raise BadInput(
            f"{first}: at {cold:g} degC, {last.name} at {warm:g} degC: one law is that of one temperature, "
            f"expected 'identify --shift', or files of one temperature; {INSIST}"
        )


def question_reference(
    reference_c: float | None, temperatures_c: Sequence[float], paths: Sequence[Path]
) -> None:
    """Ask about a reference temperature far from all that was measured. Raises `BadInput`."""
    if reference_c is None or not temperatures_c:
        return
    cold, warm = min(temperatures_c), max(temperatures_c)
    if not cold - (warm - cold) <= reference_c <= warm + (warm - cold):
        hint = ": is it in K?" if kelvin_doubt(reference_c) else ", expected one of these, or one between"
        _ask(f"--reference-c {reference_c:g}, measured at {cold:g} to {warm:g} degC{hint}", paths)


def question_shift(found: Shifted, paths: Sequence[Path]) -> None:
    """Ask about columns in another unit, and temperatures that would have the core stiffen as it warms.

    Raises `BadInput`.
    """
    _ask(found.otherwise, paths)
    if found.plainly_stiffens:
        _ask(f"{found.stiffens}: are temperatures exchanged?", paths)


def _many(lines: int, of_plate: bool) -> str:
    if lines <= _MANY:
        return ""
    every = -(-lines // _ENOUGH)
    minutes = round(_SECONDS_A_LINE * lines / 60)
    takes = f" (some {minutes} minutes)" if of_plate and minutes > 1 else ""
    return (
        f"{lines} lines make a fit long{takes}: a resonance needs some 50, expected every {every}th line or "
        "so, closer where a resonance is narrow"
    )


def _drifted(range_c: tuple[float, float] | None) -> str:
    if range_c is None or range_c[1] - range_c[0] <= _DRIFTED_K:
        return ""
    return (
        f"temperature_c from {range_c[0]:g} to {range_c[1]:g} in one sweep: its law is that of no one "
        "temperature, expected a file for each"
    )


def _times(time_s: Array | None) -> str:
    """Of one sweep's readings, shape (points,)."""
    if time_s is None:
        return ""
    first, duration = float(time_s.min()), float(np.ptp(time_s))
    if first < 0:
        return f"time_s down to {first:g}: expected seconds since the first point"
    if duration > _LONGEST_S:
        return f"time_s over {duration:.3g} s, {duration / 86_400:.0f} days, in one sweep: is it in ms or us?"
    if duration == 0 and len(time_s) >= _TIMED_ROWS:
        return (
            f"time_s = {first:g} in all {len(time_s)} lines: expected seconds since the first point, or no "
            "such column"
        )
    return ""


def _of_several_temperatures(table: ModalTable) -> str:
    T = table.temperature_c
    if T is None or not float(np.ptp(T)) > _DRIFTED_K:
        return ""
    return (
        f"temperature_c from {T.min():g} to {T.max():g} in one table: one law is that of one temperature, "
        "expected 'identify --shift', or a table for each"
    )


def kelvin_doubt(temperature_c: float | None) -> str:
    """Empty for a temperature that a damping material may have been measured at."""
    if temperature_c is None or temperature_c <= _WARM_C:
        return ""
    return f"temperature_c = {temperature_c:g}: is it in K?"


def _percent(tables: Sequence[ModalTable]) -> str:
    most = max(float(t.loss_factor.max()) for t in tables)
    if most > _LOSSY:
        return f"loss_factor up to {most:g}: is it in percent?"
    for t in tables:
        std = t.loss_factor_std
        if std is not None and np.median(std / t.loss_factor) > 1:
            most = float(t.loss_factor.max())
            return f"loss_factor_std up to {std.max():g} for loss factors up to {most:g}: is it in percent?"
    return ""


def _too_well_known(tables: Sequence[ModalTable]) -> str:
    for t in tables:
        for what, value, std, least in (
            ("frequency_std_hz", t.frequency_hz, t.frequency_std_hz, _BEST_FREQUENCY),
            ("loss_factor_std", t.loss_factor, t.loss_factor_std, _BEST_LOSS),
        ):
            if std is not None and float(np.median(std / value)) < least:
                k = int(np.argmin(std / value))
                return (
                    f"{what} of {std[k]:.2g} for {value[k]:.5g}: no measurement knows a mode so well, "
                    "expected standard deviations, in the same unit"
                )
    return ""


def _ask(doubt: str, paths: Sequence[Path]) -> None:
    if doubt:
        raise BadInput(f"{', '.join(map(str, paths))}: {doubt}; {INSIST}")
