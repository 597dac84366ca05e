"""What intervals are asked for: the law's parameters, G' and eta at some frequencies."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array
from fitting.depth.task import DepthTask
from fitting.laws import CoreLaw


@dataclass(frozen=True)
class Quantities:
    """All of them, positive by nature: looked at in their logarithms."""

    task: DepthTask
    frequency_hz: Array
    law: CoreLaw
    """Whose parameters they are of, where the fit ended."""
    columns: NDArray[np.intp]
    """Where these stand among the fit's unknowns. Shape (names of the law,)."""

    @classmethod
    def of(cls, task: DepthTask, frequency_hz: Array) -> "Quantities":
        """What is asked of a fit whose law is the core's, at `frequency_hz` of shape (frequencies,)."""
        return cls(task, frequency_hz, task.law, np.arange(len(task.law.names)))

    @property
    def names(self) -> list[str]:
        """Parameters that move, then `storage_modulus_pa` and `loss_factor` in turn."""
        both = ("storage_modulus_pa", "loss_factor")
        at = [f"{name} at {f:.4g} Hz" for f in self.frequency_hz for name in both]
        return [*(self.law.names[k] for k in self._own), *at]

    @property
    def _own(self) -> list[int]:
        return [k for k in range(len(self.law.plain.names)) if self.task.kept[self.columns[k]]]

    def logs(self, x: Array) -> Array:
        """Logarithms at some unknowns. Shape (quantities,)."""
        return np.asarray(self.of_many(x[None])[0])

    def of_many(self, X: Array) -> Array:
        """Shapes (any, kept) to (any, quantities)."""
        own = self.task.full(X)[:, self.columns]
        G = self.law.moduli(own, 2 * np.pi * self.frequency_hz)
        both = np.log(np.stack([G.real, np.maximum(G.imag / G.real, 1e-12)], axis=2))
        return np.concatenate([own[:, self._own], both.reshape(len(X), -1)], axis=1)

    def gradient(self, x: Array) -> Array:
        """Derivatives of `logs`. Shape (quantities, kept)."""
        law = self.law.with_logs(self.task.full(x)[self.columns])
        omega = 2 * np.pi * self.frequency_hz
        by = law.jacobian(omega) * law.values.reshape(-1, 1)
        G = law.modulus(omega)
        storage = by.real / G.real
        loss = by.imag / G.imag - storage
        found = np.zeros((len(self._own) + 2 * len(omega), len(self.columns)))
        for row, k in enumerate(self._own):
            found[row, k] = 1.0
        found[len(self._own) :] = np.stack([storage.T, loss.T], axis=1).reshape(-1, len(self.columns))
        whole = np.zeros((len(found), len(self.task.whole)))
        whole[:, self.columns] = found
        return whole[:, self.task.kept] * self.task.slope(x)
