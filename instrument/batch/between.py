"""Between rows of one material and temperature: how far laws lie apart beyond what is not known of each."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from instrument.batch.columns import Cell
from instrument.batch.run import BatchRow
from instrument.batch.taking_part import Group, groups_of, repeats_among, taking_part
from instrument.facts.batch import BatchSpread
from instrument.material.comparing import RESOLUTION
from instrument.material.spread import FEWEST, FREQUENCIES, Curves, Spread, spread_of_curves
from instrument.material.spread_facts import apart_rows, spread_rows


@dataclass(frozen=True)
class Between:
    """Rows of one material and temperature."""

    material: str | None
    temperature_c: float | None
    """Mean of theirs; None where none was measured."""
    spread: Spread
    places: tuple[int, ...]
    """Of its rows among all."""

    @property
    def lines(self) -> list[str]:
        """What is said of it: the spread, each row that is apart, and the spread without those."""
        called = "rows"
        if self.material is not None:
            called += f" of {self.material}"
        if self.temperature_c is not None:
            called += f" at {self.temperature_c:g} degC"
        return self.spread.lines_of(called)

    @property
    def result(self) -> BatchSpread:
        """The spread between specimens as the JSON of a result has it."""
        without = self.spread.without
        return BatchSpread(
            material=self.material,
            temperature_c=self.temperature_c,
            rows=len(self.spread.names),
            frequencies=spread_rows(self.spread),
            apart=apart_rows(self.spread),
            without_apart=spread_rows(without) if without is not None else (),
        )


@dataclass(frozen=True)
class _Curve:
    """Of one row. Arrays have shape (2 frequencies,): of ln G', then of ln eta."""

    place: int
    name: str
    values: Array
    errors: Array
    stated: Array
    """The part of the errors that stated numbers make."""
    same: str | None
    """Which numbers those are."""


def between_rows(rows: Iterable[BatchRow], repeats: Mapping[int, str] | None = None) -> list[Between]:
    """The spread of every material and temperature that has rows enough with a band in common.

    By material, then the lowest temperature first; rows without come last. `rows` is gone through several
    times; of each a few numbers are kept. `repeats` are those that count no more, by place; found where not
    given.
    """
    repeats = repeats_among(rows) if repeats is None else repeats
    groups = groups_of(rows)
    bands: dict[Group, list[tuple[float, float]]] = defaultdict(list)
    for place, _, law in taking_part(rows, repeats):
        bands[groups[place]].append((float(law["frequency_hz"][0]), float(law["frequency_hz"][-1])))
    at = {
        group: np.geomspace(low, high, FREQUENCIES)
        for group, some in bands.items()
        if len(some) >= FEWEST and (low := max(b[0] for b in some)) < (high := min(b[1] for b in some))
    }
    found: dict[Group, list[_Curve]] = defaultdict(list)
    for place, row, law in taking_part(rows, repeats):
        if (group := groups[place]) in at:
            found[group].append(_curve(place, row, law, at[group]))
    return [_between(group, at[group], some) for group, some in sorted(found.items(), key=_order)]


def marks_of(between: Sequence[Between], repeats: Mapping[int, str]) -> dict[int, dict[str, Cell]]:
    """What every row is among the others, as cells of the table."""
    marks: dict[int, dict[str, Cell]] = {place: {"repeat_of": data} for place, data in repeats.items()}
    for one in between:
        for place, p in zip(one.places, one.spread.p_values.tolist(), strict=True):
            if np.isfinite(p):
                marks[place] = {"apart_p_value": p}
    return marks


def _order(item: tuple[Group, list[_Curve]]) -> tuple[bool, str, bool, float]:
    (material, warm), _ = item
    return material is None, material or "", warm is None, warm or 0.0


def _between(group: Group, frequency_hz: Array, some: Sequence[_Curve]) -> Between:
    curves = Curves(
        tuple(one.name for one in some),
        frequency_hz,
        np.array([one.values for one in some]),
        np.array([one.errors for one in some]),
        np.array([one.stated for one in some]),
        tuple(one.same for one in some),
        np.zeros((len(some), 2 * len(frequency_hz))),
    )
    return Between(*group, spread_of_curves(curves), tuple(one.place for one in some))


def _curve(place: int, row: BatchRow, law: dict[str, Array], frequency_hz: Array) -> _Curve:
    x, at = np.log(law["frequency_hz"]), np.log(frequency_hz)
    stated = row.outcome.get("stated") or {}
    values, errors, parts = [], [], []
    for value, error, which in (
        ("storage_modulus_pa", "storage_modulus_standard_error_pa", "storage"),
        ("loss_factor", "loss_factor_standard_error", "loss"),
    ):
        values.append(np.interp(at, x, np.log(law[value])))
        errors.append(np.hypot(np.interp(at, x, law[error] / law[value]), RESOLUTION))
        share = stated.get(which)
        parts.append(errors[-1] if share is None else np.interp(at, x, share))
    y, known, part = (np.concatenate(columns) for columns in (values, errors, parts))
    return _Curve(place, row.task.data, y, known, part, stated.get("same"))
