"""The core's modulus at every point of a sweep: a law's, as effects soften or warm it."""

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_answer import StrainedCore
from fitting.diagnosis.response.plate_changes import PlateChanges
from fitting.diagnosis.response.strains import Reference, Strains, Way
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.effects.base import Effect
from fitting.effects.given import ModulusAt, Strain
from fitting.laws import CoreLaw
from fitting.widened.change import Change
from fitting.widened.span import Span

_H = 1e-4
"""Step of differences, of the logarithm of a law's parameter."""


class PointModulus:
    """G* in Pa, shape (points,), under a law and unknowns `u` of shape (unknowns,)."""

    def __init__(
        self,
        problem: DiagnosisProblem,
        unknowns: Unknowns,
        changes: PlateChanges,
        spans: Sequence[Span],
        reference: Reference,
    ) -> None:
        self._problem, self._points = problem, problem.points
        self._unknowns, self._changes = unknowns, changes
        self.effects = [k for k, e in enumerate(unknowns.effects) if type(e).modulus is not Effect.modulus]
        """Numbers of those that shift a modulus."""
        self.strained = bool(self.effects) and any(s.strains for s in spans)
        """Whether one of them goes by the core's strain."""
        self._strains = Strains(problem, changes.plate, reference)
        self._latest: tuple[CoreLaw, Complex] | None = None

    def of_law(self, law: CoreLaw) -> Complex:
        """Before any effect; the latest is kept."""
        if self._latest is None or self._latest[0] is not law:
            self._latest = law, law.modulus(self._points.omega)
        return self._latest[1]

    def at(self, law: CoreLaw, u: Array) -> Complex:
        """With all effects."""
        return self._shifted(law, u, self.of_law(law))

    def by_law(self, law: CoreLaw, u: Array) -> Complex:
        """Its derivatives to the logarithms of the law's parameters. Shape (parameters, points)."""
        omega = self._points.omega
        if not self.effects:
            return np.asarray(law.jacobian(omega) * law.values[:, None])
        logs = np.log(law.values)
        h = np.where(logs + _H < law.log_limits[1], _H, -_H)
        others = np.vstack([logs, logs + np.diag(h)])
        G = self._shifted(law, u, law.moduli(others, omega), self._strain(law, u), others)
        if self.strained:
            # A core of another law is strained otherwise too.
            for n, moved in enumerate(others[1:]):
                strain = self._strains.along_law(law, *self._plate(u), law.with_values(np.exp(moved)))
                G[1 + n] += self._shifted(law, u, self.of_law(law), strain) - G[0]
        return (G[1:] - G[0]) / h[:, None]

    def along(self, law: CoreLaw, u: Array, nearby: tuple[Change, Change, float]) -> Complex:
        """Derivative to an unknown, as a changed plate strains its core otherwise. Shape (points,).

        `nearby` as `StrainedCore.by` takes it.
        """
        return self._along(law, u, lambda core: core.by(nearby))

    def by_stated(self, law: CoreLaw, u: Array) -> Complex:
        """Derivatives to the stated numbers, in standard deviations, as they strain the core otherwise.

        Shape (numbers, points).
        """
        z, nuisances = u[self._unknowns.stated], self._problem.nuisances

        @cache
        def rows(core: StrainedCore) -> Array:
            return core.by_stated(nuisances, z)

        def row(n: int) -> Way:
            return lambda core: rows(core)[n]

        return np.array([self._along(law, u, row(n)) for n in range(len(nuisances))])

    def _along(self, law: CoreLaw, u: Array, way: Way) -> Complex:
        strain = self._strains.along(law, *self._plate(u), way, _H)
        return (self._shifted(law, u, self.of_law(law), strain) - self.at(law, u)) / _H

    def _shifted(
        self, law: CoreLaw, u: Array, G_law: Complex, strain: Strain | None = None, logs: Array | None = None
    ) -> Complex:
        """`strain` where something is a step away from what strains are known of.

        Of many laws where their `logs` are given: shape (laws, points), as `G_law` then.
        """
        G = G_law
        for k in self.effects:
            at = ModulusAt(law, self._points, strain or self._strain(law, u), logs)
            shifted = self._unknowns.effects[k].modulus(at, self._points, self._unknowns.of(k, u))
            if shifted is not None:
                G = G * (shifted / G_law)
        return G

    def _strain(self, law: CoreLaw, u: Array) -> Strain:
        """Of the core at every point, softened by a share, over the reference."""
        return self._strains.under(law, *self._plate(u))

    def _plate(self, u: Array) -> tuple[bytes, Callable[[], Change]]:
        """What strains the core goes by, as `Strains` takes it."""
        return self._changes.key(u), lambda: self._changes.every(u)
