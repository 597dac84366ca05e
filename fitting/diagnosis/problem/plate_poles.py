"""Poles of the unchanged plate near a range of frequencies."""

import numpy as np
from scipy.linalg import eigh

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.nodes import MOST_POLES, Nodes
from fitting.diagnosis.problem.pole_following import KnownPoles, ModulusNear
from fitting.dynamics.dynamic_stiffness import stacked
from fitting.laws import CoreLaw
from fitting.sweep import segments_by_gap
from fitting.widened.enriched_plate import EnrichedReducedPlate

PLAIN, ODD = "plate", "plate/odd"
"""Groups of the unchanged plate's motions: those that its load excites; those odd across its width."""


_HELD, _A_PART = MOST_POLES - 1, 2
"""Poles of a cluster that is left whole, and of each part of one that is not: what is beside a part is taken
out too, and poles move as the law does."""
_BESIDE, _BESIDE_MIDDLE = 0.5, 0.1
"""How far beside a range its poles are looked for: shares of its width and of its middle. A choice."""
_STEP = 1e-3
"""Of a range's two ends together: the step of the law's slope at its middle. A choice."""


def cuts_between(plate: EnrichedReducedPlate, law: CoreLaw, omega: Array) -> Array:
    """Where clusters of frequencies (rad/s, shape (points,)) hold too many poles to take them all out.

    Half-way between poles, ascending, rad/s. Shape (any,).
    """
    own = np.ix_(*[np.flatnonzero(plate.group == PLAIN)] * 2)
    found = []
    numbers = segments_by_gap(omega / (2 * np.pi))
    for number in np.unique(numbers):
        low, high = omega[numbers == number].min(), omega[numbers == number].max()
        stiffness = plate.K_0[own].real + law.modulus(np.array([(low + high) / 2]))[0].real * plate.K_1[own]
        p = np.sqrt(np.maximum(eigh(stiffness, plate.M[own], eigvals_only=True), 0))
        p = p[(p > low) & (p < high)]
        if len(p) > _HELD:
            found.append((p[_A_PART - 1 : -1 : _A_PART] + p[_A_PART::_A_PART]) / 2)
    return np.concatenate(found) if found else np.empty(0)


class PlatePoles:
    """p of (K_0 + G K_1 + i p C_1 - p^2 M) y = 0 with y the motion."""

    def __init__(self, plate: EnrichedReducedPlate, law: CoreLaw, group: str = PLAIN) -> None:
        self.law = law
        self.own = np.flatnonzero(plate.group == group)
        square = np.ix_(self.own, self.own)
        U = plate.U[self.own]
        C_1 = (U * plate.d) @ U.T
        self.matrices = stacked(plate.K_0[square], plate.K_1[square], plate.M[square], C_1)
        self._known: dict[complex, Complex] = {}
        self._found: dict[tuple[float, float], Complex] = {}
        self._latest: tuple[bytes, KnownPoles, Complex] | None = None

    def near(self, low: float, high: float) -> Complex:
        """In and beside a range (rad/s), the law continued off the real axis to first order. Shape (any,)."""
        key = round(low, 6), round(high, 6)
        if key not in self._found:
            self._found[key] = self._near(low, high)
        return self._found[key]

    def _near(self, low: float, high: float) -> Complex:
        middle, h = (low + high) / 2, _STEP * (low + high)
        below, G, above = self.law.modulus(np.array([middle - h, middle, middle + h]))
        slope = (above - below) / (2 * h)
        K_0, K_1, M, C_1 = self.matrices
        values, vectors = np.linalg.eig(np.linalg.solve(M, K_0 + G * K_1 + 1j * middle * C_1))
        p = np.sqrt(values)
        margin = _BESIDE * (high - low) + _BESIDE_MIDDLE * middle
        inside = np.flatnonzero((p.real > low - margin) & (p.real < high + margin))
        inside = inside[np.argsort(np.abs(p[inside] - middle))][:MOST_POLES]
        y = np.asarray(vectors[:, inside].T, dtype=complex)
        together = np.zeros(len(inside), np.intp)
        modulus = ModulusNear(*(np.full(len(inside), value) for value in (middle, G, slope)))
        found, y = KnownPoles(p[inside], y, together, modulus).followed(self.matrices)
        self._known |= {complex(pole): shape for pole, shape in zip(found, y, strict=True)}
        return found

    def under(self, nodes: Nodes, G: Complex) -> tuple[KnownPoles | None, Complex]:
        """The poles that nodes were made for, to be followed, and where they are under a modulus.

        Shape (nodes,) of `G`, (poles,) of the places. One law is asked for with many effects: the latest
        answer is kept.
        """
        if not len(nodes.poles):
            return None, nodes.poles
        key = nodes.omega.tobytes() + G.tobytes()
        if self._latest is None or self._latest[0] != key:
            known = self.known(nodes, G)
            self._latest = key, known, known.followed(self.matrices)[0]
        return self._latest[1:]

    def known(self, nodes: Nodes, G: Complex) -> KnownPoles:
        """The poles that nodes were made for, to be followed to where a modulus has them. Shape (nodes,)."""
        at = nodes.pole_node
        modes = np.array([self._known[complex(p)] for p in nodes.poles], complex)
        return KnownPoles(
            nodes.poles, modes, nodes.cluster[at], ModulusNear(nodes.omega[at], G[at], nodes.slope(G))
        )
