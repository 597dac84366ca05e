"""What a table of modes says of one specimen."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.mode_tables.as_read import Read

FREQUENCY_STD, LOSS_STD = 1e-3, 0.03
"""Relative, where a table states none: a careful resonance test."""


@dataclass(frozen=True)
class ModalTable:
    """Modes of one specimen. Shape (modes,) each."""

    mode: Array
    """From 1, in the order of frequency; rigid ones are not counted."""
    frequency_hz: Array
    loss_factor: Array
    frequency_std_hz: Array | None = None
    loss_factor_std: Array | None = None
    temperature_c: Array | None = None
    name: str = ""
    """Name of its file."""
    read: Read | None = None
    """How its numbers were read; None where nobody says: as the model's own."""

    @property
    def relative_std(self) -> tuple[Array, Array]:
        """Of frequencies and of loss factors, stated or usual."""
        f, eta = self.frequency_std_hz, self.loss_factor_std
        return (
            np.full(len(self.mode), FREQUENCY_STD) if f is None else f / self.frequency_hz,
            np.full(len(self.mode), LOSS_STD) if eta is None else eta / self.loss_factor,
        )

    @property
    def states_its_noise(self) -> bool:
        """Whether the scale of its readings is known."""
        return self.frequency_std_hz is not None and self.loss_factor_std is not None
