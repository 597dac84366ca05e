"""Resonances hardly wider than the model's own error in their frequency: a fit has that as an unknown.

What a shifted resonance changes of a response is proportional to its shift only while that is a small part of
its width. Beyond, the shift is no error to be marginalised beside a fit but an unknown in it, of the model
error's size; and so is its loss factor. A stiffness (1 + kappa) times as large, of mode r alone, is
K_0 + kappa s s^T with s = omega_r M phi_r.
"""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Complex
from fitting.nuisances.nuisance import Nuisance

THEORY = "theory"
"""Name of the theory-error nuisance shared by all narrow resonances.

Each is off in the sense that exact elasticity says.
"""
NARROW = 0.03
"""Shift by one standard deviation over half the width, from which its square matters (0.1 % of a peak)."""


@dataclass(frozen=True)
class NarrowResonance:
    """One of them, as the model has it."""

    number: int
    """Of the plate's modes that its base or its force moves, from 1 on."""
    frequency_hz: float
    by_itself: float
    """Standard deviation of the logarithm of its frequency."""
    by_theory: float
    """The same by what all have in common, signed."""
    loss: float
    """Its loss factor, the core's and the faces'."""
    loss_by_itself: float
    """Standard deviation, absolute."""
    loss_by_theory: float

    @property
    def numbers(self) -> tuple[Nuisance, Nuisance]:
        """Of the fit, under the names of results."""
        return (
            Nuisance(f"resonance_{self.number}", "resonance", self.by_itself, self.frequency_hz),
            Nuisance(f"loss_{self.number}", "loss", self.loss_by_itself, self.loss),
        )


@dataclass(frozen=True)
class NarrowResonances:
    """Those of a plate, whose U has a column s for each, undamped, behind those of its modal ratios."""

    each: tuple[NarrowResonance, ...] = ()

    def __len__(self) -> int:
        return len(self.each)

    @property
    def numbers(self) -> tuple[Nuisance, ...]:
        """The unknowns that they add to a fit."""
        if not self.each:
            return ()
        return (*(number for one in self.each for number in one.numbers), Nuisance(THEORY, THEORY, 1.0, 0.0))

    @property
    def steps(self) -> Complex:
        """Of ln (1 + kappa) of each, one standard deviation of every number. Shape (numbers, resonances)."""
        found = np.zeros((2 * len(self) + 1, len(self)), complex)
        for k, one in enumerate(self.each):
            # d ln f = 1/2 d ln K, and a loss is the imaginary part of ln K.
            found[2 * k : 2 * k + 2, k] = 2 * one.by_itself, 1j * one.loss_by_itself
            found[-1, k] = 2 * one.by_theory + 1j * one.loss_by_theory
        return found

    def stiffer(self, z: Array) -> Complex:
        """By what share kappa each resonance is stiffer than the model has it.

        Shape (resonances,), of its `numbers` (numbers,).
        """
        return np.asarray(np.exp(z @ self.steps) - 1)

    def by(self, z: Array) -> Complex:
        """Its derivatives. Shape (numbers, resonances)."""
        return np.asarray(self.steps * (1 + self.stiffer(z)))


NONE = NarrowResonances()
