"""Between the rows of one temperature: how far their laws lie apart beyond what is not known of each."""

import os
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from instrument.batch.columns import cells, is_doubted
from instrument.batch.run import BatchRow
from instrument.facts.batch import BatchSpread
from instrument.material.comparing import RESOLUTION
from instrument.material.spread import FEWEST, FREQUENCIES, Spread, spread_of_curves, spread_rows

UNKNOWN = "unknown"
Group = float | None
"""A temperature in whole degrees Celsius; None where none was measured."""


@dataclass(frozen=True)
class Between:
    """Rows of one temperature."""

    temperature_c: Group
    spread: Spread

    @property
    def words(self) -> str:
        """One line."""
        where = "" if self.temperature_c is None else f" at {self.temperature_c:g} degC"
        return self.spread.words.replace(" specimens at", f" rows{where} at", 1)

    @property
    def result(self) -> BatchSpread:
        """As JSON has it."""
        return BatchSpread(
            temperature_c=self.temperature_c,
            rows=len(self.spread.names),
            frequencies=spread_rows(self.spread),
        )


def between_rows(rows: Iterable[BatchRow]) -> list[Between]:
    """The spread of every temperature that has rows enough with a band in common, the lowest first.

    `rows` is gone through twice; of each a few numbers are kept. Rows that failed, whose verdict is unknown,
    whose law says that it may be biased or has no standard errors take no part.
    """
    bands: dict[Group, list[tuple[float, float]]] = defaultdict(list)
    for row in _once(rows):
        law = _law(row)
        if law is not None:
            bands[_group(row)].append((float(law["frequency_hz"][0]), float(law["frequency_hz"][-1])))
    at = {
        group: np.geomspace(low, high, FREQUENCIES)
        for group, some in bands.items()
        if len(some) >= FEWEST and (low := max(b[0] for b in some)) < (high := min(b[1] for b in some))
    }
    found: dict[Group, list[tuple[str, Array, Array]]] = defaultdict(list)
    for row in _once(rows):
        law = _law(row)
        if law is not None and (group := _group(row)) in at:
            found[group].append((row.task.data, *_curve(law, at[group])))
    return [
        Between(group, spread_of_curves(tuple(n for n, _, _ in some), at[group], curves, errors))
        for group, some in sorted(found.items(), key=lambda item: (item[0] is None, item[0]))
        for curves, errors in [(np.array([c for _, c, _ in some]), np.array([e for _, _, e in some]))]
    ]


def _once(rows: Iterable[BatchRow]) -> Iterator[BatchRow]:
    """A file that is named twice, by whatever path, is one specimen."""
    seen = set()
    for row in rows:
        task = row.task
        files = (os.path.realpath(path) if path else None for path in (task.data, task.specimen, task.hammer))
        named = *files, _group(row)
        if named not in seen:
            seen.add(named)
            yield row


def _group(row: BatchRow) -> Group:
    temperature = cells(row)["temperature_c"]
    return round(temperature) + 0.0 if isinstance(temperature, int | float) else None


def _law(row: BatchRow) -> dict[str, Array] | None:
    """Its columns, where all of them are known."""
    o = row.outcome
    if o["failed"] or o["verdict"] == UNKNOWN or is_doubted(row):
        return None
    law = {key: np.array(values, dtype=float) for key, values in (o.get("law") or {}).items()}
    if not law or not all(np.isfinite(v).all() for v in law.values()) or np.any(law["loss_factor"] <= 0):
        return None
    return law


def _curve(law: dict[str, Array], frequency_hz: Array) -> tuple[Array, Array]:
    """Ln G', then ln eta, and their standard errors. Shape (2 frequencies,) each."""
    x, at = np.log(law["frequency_hz"]), np.log(frequency_hz)
    curves, errors = [], []
    for value, error in (
        ("storage_modulus_pa", "storage_modulus_standard_error_pa"),
        ("loss_factor", "loss_factor_standard_error"),
    ):
        curves.append(np.interp(at, x, np.log(law[value])))
        errors.append(np.hypot(np.interp(at, x, law[error] / law[value]), RESOLUTION))
    return np.concatenate(curves), np.concatenate(errors)
