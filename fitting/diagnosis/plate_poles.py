"""Poles of the unchanged plate near a range of frequencies."""

import numpy as np

from fitting.arrays import Complex
from fitting.diagnosis.nodes import MOST_POLES
from fitting.diagnosis.plate_answer import ModulusNear, poles_near
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.laws import CoreLaw

_STEPS = 3
"""Of Rayleigh's quotient, from poles whose law was taken in the middle of the range."""
PLAIN, ODD = "plate", "plate/odd"
"""Groups of the unchanged plate's motions: those that its load excites; those odd across its width."""


class PlatePoles:
    """p of (K_0 + G K_1 + i p C_1 - p^2 M) y = 0 with y the motion."""

    def __init__(self, plate: EnrichedReducedPlate, law: CoreLaw, group: str = PLAIN) -> None:
        self.law = law
        own = np.flatnonzero(plate.group == group)
        square = np.ix_(own, own)
        self.K_0, self.K_1, self.M = plate.K_0[square], plate.K_1[square], plate.M[square]
        U = plate.U[own]
        self.C_1 = (U * plate.d) @ U.T
        self._known: dict[complex, Complex] = {}
        self._found: dict[tuple[float, float], Complex] = {}

    def near(self, low: float, high: float) -> Complex:
        """In and beside a range (rad/s), the law continued off the real axis to first order. Shape (any,)."""
        key = round(low, 6), round(high, 6)
        if key not in self._found:
            self._found[key] = self._near(low, high)
        return self._found[key]

    def _near(self, low: float, high: float) -> Complex:
        middle, h = (low + high) / 2, 1e-3 * (low + high)
        below, G, above = self.law.modulus(np.array([middle - h, middle, middle + h]))
        slope = (above - below) / (2 * h)
        values, vectors = np.linalg.eig(
            np.linalg.solve(self.M, self.K_0 + G * self.K_1 + 1j * middle * self.C_1)
        )
        p = np.sqrt(values)
        margin = 0.5 * (high - low) + 0.1 * middle
        inside = np.flatnonzero((p.real > low - margin) & (p.real < high + margin))
        inside = inside[np.argsort(np.abs(p[inside] - middle))][:MOST_POLES]
        modulus = ModulusNear(*(np.array([value]) for value in (middle, G, slope)))
        y = np.asarray(vectors[:, inside].T, dtype=complex)
        found, y = poles_near(self.K_0, self.K_1, self.M, self.C_1, y, p[inside], modulus, _STEPS)
        self._known |= {complex(pole): shape for pole, shape in zip(found, y, strict=True)}
        return found

    def moved(self, poles: Complex, modulus: ModulusNear) -> Complex:
        """Where poles that were found have gone under another modulus. Shape (poles,)."""
        if not len(poles):
            return poles
        y = np.array([self._known[complex(p)] for p in poles])
        return poles_near(self.K_0, self.K_1, self.M, self.C_1, y, poles, modulus, steps=1)[0]
