"""Sweeps of other files, to be drawn beside the session's. No Qt."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fitting.arrays import Array, Complex, Mask
from instrument.files.sweep_file import SweepFile
from instrument.interchange.found import REFERENCE_M_S2, Found


@dataclass(frozen=True)
class OverlaidSweep:
    """One sweep. Shape (points,) each."""

    name: str
    frequency_hz: Array
    over_base_s: Complex
    level_m_s2: Array
    has_phase: bool
    """Whether more than amplitudes was kept."""

    def inside(self, band_hz: tuple[float, float] | None) -> Mask:
        """Points of a band; all of them where there is none."""
        low, high = band_hz or (0.0, np.inf)
        return (self.frequency_hz >= low) & (self.frequency_hz <= high)


def besides(files: Mapping[Path, Found]) -> tuple[OverlaidSweep, ...]:
    """Every sweep of some files over a base's motion, in order: over a force it is another quantity."""
    found = []
    for path, file in files.items():
        for number, columns in enumerate(file.sweeps, start=1):
            if "force_re_n" in columns:
                continue
            sweep = SweepFile(path, columns, {}).sweep(REFERENCE_M_S2)
            order = np.argsort(sweep.frequency_hz, kind="stable")
            over_base = np.asarray(sweep.response_m_s / sweep.commanded_m_s2, dtype=complex)
            name = path.name if len(file.sweeps) == 1 else f"{path.name}, {number}"
            found.append(
                OverlaidSweep(
                    name,
                    sweep.frequency_hz[order],
                    over_base[order],
                    sweep.commanded_m_s2[order],
                    sweep.has_phase,
                )
            )
    return tuple(found)
