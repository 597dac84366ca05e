"""One law over several temperatures as people read it."""

from collections.abc import Sequence

from instrument.cli.output import Output
from instrument.facts.shifted import ModeAt, ShiftAt, ShiftedResult
from instrument.results.law_words import LAW_COLUMNS, law_cells
from instrument.results.numbers import format_number, signed, to_error, with_error

_ROWS = 9


def print_shifted(out: Output, result: ShiftedResult, *, law_stands: bool) -> None:
    """The law and its shifts, how near each file lies, and what is to be said of them."""
    unusable = "" if law_stands else " (not to be used, see below)"
    title = f"{result.law_kind} at {result.reference_c:g} degC{unusable}"
    _parameters(out, title, result.parameters, result.standard_errors)
    if result.shift != "free":
        # Free factors are those of the table below, with the errors of temperatures in theirs.
        _parameters(out, f"shift: {result.shift}", result.shift_parameters, result.shift_standard_errors)
    _factors(out, result)
    if result.modes:
        _modes(out, result.modes)
    _law(out, result, unusable)
    out.say(result.words)
    for warning in result.warnings:
        out.say(f"note: {warning}")


def _parameters(out: Output, title: str, values: dict[str, float], errors: dict[str, float]) -> None:
    rows = [[n, to_error(v, errors[n]), f"{errors[n]:.2g}"] for n, v in values.items()]
    out.table(title, ["parameter", "value", "standard error"], rows)
    out.say()


def _factors(out: Output, result: ShiftedResult) -> None:
    """One row for each stated temperature; of sweeps with what the one law leaves of each."""
    columns = ["file", "temperature/degC", "log10 a_T", "standard error", "b_T"]
    of_sweeps = any(one.rms_percent is not None for one in result.temperatures)
    alike = [[one] for one in result.temperatures] if of_sweeps else _alike(result.temperatures)
    rows = []
    for its in alike:
        one = its[0]
        row = [
            _names([each.name for each in its]),
            f"{one.temperature_c:g}",
            signed(one.log10_shift, 4),
            f"{one.log10_shift_standard_error:.4f}",
            with_error(one.vertical, one.vertical_standard_error, sign="+-"),
        ]
        rows.append([*row, format_number(one.rms_percent, 3)] if of_sweeps else row)
    if of_sweeps:
        columns.append("difference rms/%")
    out.table("shift factors: the law is read at a_T f, and times b_T", columns, rows)
    out.say()


def _alike(temperatures: Sequence[ShiftAt]) -> list[list[ShiftAt]]:
    """Tables by their temperature, from cold to warm."""
    found: dict[float, list[ShiftAt]] = {}
    for one in sorted(temperatures, key=lambda each: each.temperature_c):
        found.setdefault(one.temperature_c, []).append(one)
    return list(found.values())


def _names(names: Sequence[str]) -> str:
    own = list(dict.fromkeys(names))
    return own[0] if len(own) == 1 else f"{own[0]} and {len(own) - 1} more"


def _modes(out: Output, modes: Sequence[ModeAt]) -> None:
    rows = [
        [
            m.name,
            f"{m.temperature_c:g}",
            f"{m.mode}",
            *(f"{f:.5g}" for f in (m.frequency_hz, m.predicted_hz)),
            *(f"{eta:.4g}" for eta in (m.loss_factor, m.predicted_loss_factor)),
        ]
        for m in modes
    ]
    columns = ["file", "temperature/degC", "mode", "f/Hz", "predicted", "loss factor", "predicted"]
    out.table("mode by mode, under the one law", columns, rows)
    out.say()


def _law(out: Output, result: ShiftedResult, unusable: str) -> None:
    every = max(1, len(result.law) // _ROWS)
    title = f"the law at {result.reference_c:g} degC, +- one standard error{unusable}"
    columns = [f"reduced {LAW_COLUMNS[0]}", *LAW_COLUMNS[1:]]
    out.table(title, columns, law_cells(result.law[::every], ".4g"))
