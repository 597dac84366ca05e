"""The frequencies at which everything is timed, and a sweep of the reduced model there."""

import numpy as np

from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep
from instrument.models.specimen_models import Models
from instrument.paper_case import TABLE_4

GRID_HZ = np.concatenate([np.linspace(14, 26, 121), np.linspace(80, 125, 116), np.linspace(245, 315, 116)])
"""353 frequencies in three resonance regions."""


def synthetic_sweep(specimen: PlateSpecimen, seed: int = 0, noise: float = 0.005) -> Sweep:
    """353 phasors of Table 4's law on the reduced model, with relative noise of the given size."""
    models = Models.of(specimen, GRID_HZ)
    v = models.predict(TABLE_4, GRID_HZ)
    rng = np.random.default_rng(seed)
    scatter = rng.normal(size=(2, len(v))) * noise * np.abs(v)
    return Sweep(
        frequency_hz=GRID_HZ,
        velocity_m_s=v + scatter[0] + 1j * scatter[1],
        commanded_m_s2=np.full(len(v), specimen.base_acceleration_m_s2),
        segment=np.digitize(GRID_HZ, [50, 200]).astype(np.intp) + 1,
        sweep=np.ones(len(v), dtype=np.intp),
        std_m_s=noise * np.abs(v),
    )
