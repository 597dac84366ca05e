"""What effects and stated numbers make of a velocity on its way into the file, and of its derivatives."""

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.unknowns import Unknowns, stepped
from fitting.effects.base import Effect

_SMALL = 1e-6
"""Of the velocity: the step along which a derivative of it is read."""


class Channels:
    """What the channels make of a problem's velocities.

    `u` has shape (unknowns,), velocities (points,) where nothing else is said.
    """

    def __init__(self, problem: DiagnosisProblem, unknowns: Unknowns) -> None:
        self._problem, self._unknowns = problem, unknowns
        self._touching = [k for k, e in enumerate(unknowns.effects) if type(e).reading is not Effect.reading]

    def read(self, v: Complex, u: Array) -> Complex:
        """What the file keeps of velocities in m/s. Shape (..., points)."""
        for k in self._touching:
            read = self._unknowns.effects[k].reading(v, self._problem.points, self._unknowns.of(k, u))
            v = v if read is None else read
        return self._as_stated(v, u)

    def _as_stated(self, v: Complex, u: Array) -> Complex:
        """What the stated gain and delay make of it."""
        nuisances = self._problem.nuisances
        return nuisances.reading(v, self._problem.points.omega, u[self._unknowns.stated]) if nuisances else v

    def along(self, raw: Complex, read: Complex, by: Complex, u: Array) -> Complex:
        """What is read of derivatives of the velocity `raw`, itself read as `read`. Shape (any, points)."""
        if not self._touching:
            return self._as_stated(by, u)
        # Each reading goes by its own velocity alone: two directions of that tell all others.
        h = _SMALL * np.abs(raw)
        along, across = (self.read(np.stack([raw + h, raw + 1j * h]), u) - read) / h
        return np.asarray(by.real * along + by.imag * across)

    def by(self, n: int, raw: Complex, u: Array) -> Complex:
        """How what is read of a velocity goes with unknown n of an effect. Shape (points,)."""
        if self._unknowns.owner(n) not in self._touching:
            return np.zeros(len(raw), complex)
        h = self._unknowns.step(n, u)
        return (self.read(raw, stepped(u, n, h)) - self.read(raw, stepped(u, n, -h))) / (2 * h)
