"""Poles of the unchanged plate near a range of frequencies."""

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Complex
from fitting.diagnosis.nodes import MOST_POLES
from fitting.diagnosis.pole_following import KnownPoles, ModulusNear
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.laws import CoreLaw

PLAIN, ODD = "plate", "plate/odd"
"""Groups of the unchanged plate's motions: those that its load excites; those odd across its width."""


class PlatePoles:
    """p of (K_0 + G K_1 + i p C_1 - p^2 M) y = 0 with y the motion."""

    def __init__(self, plate: EnrichedReducedPlate, law: CoreLaw, group: str = PLAIN) -> None:
        self.law = law
        self.own = np.flatnonzero(plate.group == group)
        square = np.ix_(self.own, self.own)
        U = plate.U[self.own]
        C_1 = (U * plate.d) @ U.T
        self.matrices = plate.K_0[square], plate.K_1[square], plate.M[square], C_1
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
        K_0, K_1, M, C_1 = self.matrices
        values, vectors = np.linalg.eig(np.linalg.solve(M, K_0 + G * K_1 + 1j * middle * C_1))
        p = np.sqrt(values)
        margin = 0.5 * (high - low) + 0.1 * middle
        inside = np.flatnonzero((p.real > low - margin) & (p.real < high + margin))
        inside = inside[np.argsort(np.abs(p[inside] - middle))][:MOST_POLES]
        y = np.asarray(vectors[:, inside].T, dtype=complex)
        together = np.zeros(len(inside), np.intp)
        modulus = ModulusNear(*(np.full(len(inside), value) for value in (middle, G, slope)))
        found, y = KnownPoles(p[inside], y, together, modulus).followed(self.matrices)
        self._known |= {complex(pole): shape for pole, shape in zip(found, y, strict=True)}
        return found

    def known(self, poles: Complex, cluster: NDArray[np.intp], modulus: ModulusNear) -> KnownPoles:
        """Poles that were found, to be followed. Shape (poles,) of `poles` and `cluster`."""
        modes = np.array([self._known[complex(p)] for p in poles], complex).reshape(-1, len(self.own))
        return KnownPoles(poles, modes, cluster, modulus)
