"""The core's modulus at every point of a sweep: a law's, as effects soften or warm it."""

from collections.abc import Callable, Sequence

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.plate_changes import PlateChanges
from fitting.diagnosis.response.strains import Moved, Reference, Strains
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
        G = self._shifted(law, u, law.moduli(others, omega), others)
        found = np.asarray((G[1:] - G[0]) / h[:, None])
        if self.strained:
            # A core of another law is strained otherwise too.
            at_nodes = law.moduli(others[1:], self._problem.dense.omega)
            found = found + self._along(law, u, self._strains.of_laws(list(at_nodes))) / h[:, None]
        return found

    def along(self, law: CoreLaw, u: Array, nearby: tuple[Change, Change, float]) -> Complex:
        """Derivative to an unknown, as a changed plate strains its core otherwise. Shape (points,).

        `nearby` as `StrainedCore.by` takes it.
        """
        return np.asarray(self._along(law, u, lambda core: core.by(nearby)[None])[0])

    def by_own(self, k: int, law: CoreLaw, u: Array, step: Array) -> Complex:
        """What it differs by from a `step` below to one above in numbers of effect k. Shape (points,).

        `step` of shape (unknowns,).
        """
        at, effect = ModulusAt(law, self._points, self._strain(law, u)), self._unknowns.effects[k]
        own = self._unknowns.of(k, u)
        by, shifted = (
            effect.modulus_by(at, self._points, own, self._unknowns.of(k, step)),
            effect.modulus(at, self._points, own),
        )
        assert by is not None
        assert shifted is not None
        return np.asarray(self.at(law, u) * (by / shifted))

    def by_stated(self, law: CoreLaw, u: Array) -> Complex:
        """Derivatives to the stated numbers, in standard deviations, as they strain the core otherwise.

        Shape (numbers, points).
        """
        z, nuisances = u[self._unknowns.stated], self._problem.nuisances
        return self._along(law, u, lambda core: core.by_stated(nuisances, z))

    def _along(self, law: CoreLaw, u: Array, moved: Moved) -> Complex:
        """Derivatives as the core is strained otherwise. Shape (ways, points)."""
        ways, G = self._strains.along(law, *self._plate(u), moved), self.at(law, u)
        found: Complex = np.zeros((1, len(G)), complex)
        for k in self.effects:
            effect, own = self._unknowns.effects[k], self._unknowns.of(k, u)
            at = ModulusAt(law, self._points, self._strain(law, u))
            by = effect.modulus_along(at, self._points, own, ways)
            if by is not None:
                shifted = effect.modulus(at, self._points, own)
                assert shifted is not None
                found = found + G * (by / shifted)
        return found

    def _shifted(self, law: CoreLaw, u: Array, G_law: Complex, logs: Array | None = None) -> Complex:
        """Of many laws where their `logs` are given: shape (laws, points), as `G_law` then."""
        G = G_law
        for k in self.effects:
            at = ModulusAt(law, self._points, self._strain(law, u), logs)
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
