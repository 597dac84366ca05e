"""Somebody's DMA beside a law: how far off it is, and whether by more than both are known to."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Mask
from fitting.numerics.chances import chi2_above
from instrument.facts.beside import BesideTable, BesideTemperature
from instrument.files.dma_file import DmaTable
from instrument.material.comparing import LEVEL, RESOLUTION, covariance_of
from instrument.material.found_law import MaterialLaw

_LEAST_FOR_SCATTER = 6
"""Rows from which their own scatter is read."""
_CURVE = 2
"""Degree in ln f of what scatter is taken about."""


@dataclass(frozen=True)
class TableAtTemperature:
    """One temperature of a table, inside the law's band. Arrays have shape (rows,)."""

    temperature_c: float
    frequency_hz: Array
    storage_difference: Array
    """The table over the law, less one."""
    loss_factor_difference: Array
    chi2: float
    p_value: float
    """NaN where the law's error or the table's is not known."""
    noise: str
    """Of the table: `stated`, `scatter`, or `unknown`."""

    @property
    def differs(self) -> bool | None:
        """Beyond what both are known to; None where it cannot be told."""
        return None if np.isnan(self.p_value) else bool(self.p_value < LEVEL)


def beside(law: MaterialLaw, table: DmaTable) -> list[TableAtTemperature]:
    """Each temperature by itself; nothing is shifted. Empty where no row lies inside the band."""
    low, high = law.band_hz
    inside = (table.frequency_hz >= low) & (table.frequency_hz <= high)
    found = []
    for t in table.temperatures():
        same = np.isnan(table.temperature_c) if np.isnan(t) else table.temperature_c == t
        rows = inside & same
        if rows.any():
            found.append(_one(law, table, rows, t))
    return found


def _one(law: MaterialLaw, table: DmaTable, rows: Mask, temperature_c: float) -> TableAtTemperature:
    order = np.argsort(table.frequency_hz[rows], kind="stable")
    f = table.frequency_hz[rows][order]
    G = law.modulus(2 * np.pi * f)
    eta = G.imag / G.real
    by_storage = np.log(table.storage_modulus_pa[rows][order] / G.real)
    by_loss = table.loss_factor[rows][order] - eta
    stated = table.storage_std[rows][order], table.loss_factor_std[rows][order]
    noise, source = _noise(f, (by_storage, by_loss), stated)
    S = covariance_of(law, f) + np.diag(noise**2)
    S += np.diag(np.repeat([RESOLUTION, RESOLUTION * float(np.mean(np.abs(eta)))], len(f)) ** 2)
    d = np.concatenate([by_storage, by_loss])
    statistic = float(d @ np.linalg.solve(S, d)) if np.isfinite(S).all() else float("nan")
    p = float(chi2_above(statistic, len(d)))
    return TableAtTemperature(temperature_c, f, np.expm1(by_storage), by_loss, statistic, p, source)


def _noise(f: Array, differences: tuple[Array, ...], stated: tuple[Array, ...]) -> tuple[Array, str]:
    """Standard deviations of the rows, one quantity after the other."""
    if all(np.isfinite(s).all() for s in stated):
        return np.concatenate(stated), "stated"
    if len(np.unique(f)) < _LEAST_FOR_SCATTER:
        return np.full(2 * len(f), np.nan), "unknown"
    x = np.log(f / f[0])
    found = []
    for d in differences:
        rest = d - np.polyval(np.polyfit(x, d, _CURVE), x)
        found.append(np.full(len(f), np.sqrt(rest @ rest / (len(f) - _CURVE - 1))))
    return np.concatenate(found), "scatter"


def beside_table(table: DmaTable, found: list[TableAtTemperature]) -> BesideTable:
    """As JSON has it, under `with`."""
    return BesideTable(
        source=table.path.name,
        kind=table.kind,
        poisson=table.poisson,
        rows=len(table.frequency_hz),
        rows_in_band=sum(len(one.frequency_hz) for one in found),
        temperatures=tuple(
            BesideTemperature(
                temperature_c=one.temperature_c,
                rows=len(one.frequency_hz),
                storage_modulus_mean_difference_percent=100 * float(np.mean(one.storage_difference)),
                storage_modulus_rms_difference_percent=100 * _rms(one.storage_difference),
                loss_factor_mean_difference=float(np.mean(one.loss_factor_difference)),
                loss_factor_rms_difference=_rms(one.loss_factor_difference),
                chi2=one.chi2,
                degrees_of_freedom=2 * len(one.frequency_hz),
                p_value=one.p_value,
                differs=one.differs,
                noise=one.noise,
            )
            for one in found
        ),
    )


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
