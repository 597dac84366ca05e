"""What intervals are asked for: the law's parameters, G' and eta at some frequencies."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.depth.task import DepthTask


@dataclass(frozen=True)
class Quantities:
    """All of them, positive by nature: looked at in their logarithms."""

    task: DepthTask
    frequency_hz: Array

    @property
    def names(self) -> list[str]:
        """Parameters that move, then `storage_modulus_pa` and `loss_factor` in turn."""
        both = ("storage_modulus_pa", "loss_factor")
        at = [f"{name} at {f:.4g} Hz" for f in self.frequency_hz for name in both]
        return [*(self.task.law.names[k] for k in self._own), *at]

    @property
    def _own(self) -> list[int]:
        return [k for k in range(len(self.task.law.plain.names)) if self.task.kept[k]]

    def logs(self, x: Array) -> Array:
        """Logarithms at some unknowns. Shape (quantities,)."""
        return np.asarray(self.of_many(x[None])[0])

    def of_many(self, X: Array) -> Array:
        """Shapes (any, kept) to (any, quantities)."""
        whole = self.task.full(X)
        G = self.task.law.moduli(whole[:, : len(self.task.law.names)], 2 * np.pi * self.frequency_hz)
        both = np.log(np.stack([G.real, np.maximum(G.imag / G.real, 1e-12)], axis=2))
        return np.concatenate([whole[:, self._own], both.reshape(len(X), -1)], axis=1)

    def gradient(self, x: Array) -> Array:
        """Derivatives of `logs`. Shape (quantities, kept)."""
        law_count = len(self.task.law.names)
        law = self.task.law.with_logs(self.task.full(x)[:law_count])
        omega = 2 * np.pi * self.frequency_hz
        by = law.jacobian(omega) * law.values.reshape(-1, 1)
        G = law.modulus(omega)
        storage = by.real / G.real
        loss = by.imag / G.imag - storage
        whole = np.zeros((len(self._own) + 2 * len(omega), len(self.task.whole)))
        for row, k in enumerate(self._own):
            whole[row, k] = 1.0
        both = np.stack([storage.T, loss.T], axis=1).reshape(-1, law_count)
        whole[len(self._own) :, :law_count] = both
        return whole[:, self.task.kept]
