"""One specimen with its table: matrices by what is stated, and how its modes move with everything.

A mode is kept as ln f + i kappa ln eta: kappa makes both parts equally well known, so that all that is built
for phasors of a sweep holds for modes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import reduce

import numpy as np

from fitting.arrays import Array, Complex
from fitting.complex_modes import ComplexMode
from fitting.effects.base import Effect
from fitting.effects.change import Change
from fitting.effects.enriched_plate import EnrichedReducedPlate
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.modes import ModalMatrices, modes_of
from fitting.mode_tables.table import ModalTable
from fitting.nuisances import Nuisances
from fitting.structures import AnySpecimen

_H = 1e-4
"""Relative step of a frequency: for the law's slope."""
_LEAST_LOSS = 1e-12
"""A mode without losses has a logarithm too."""

Acting = Sequence[tuple[Effect, Array]]
"""Effects with their unknowns."""


@dataclass(frozen=True)
class Member:
    """A specimen's modes as a fit sees them."""

    table: ModalTable
    specimen: AnySpecimen
    wide: EnrichedReducedPlate
    """With the columns of every effect it may have."""
    stated: Nuisances
    own_error: tuple[Array, Array] = (np.zeros(1), np.zeros(1))
    """Relative errors of the model itself, of f and eta. Shape (modes,) or (1,)."""
    together: Array = field(default_factory=lambda: np.zeros((0, 1)))
    """Relative errors of all f by one cause each. Shape (causes, modes)."""
    _taken: dict[tuple[str, ...], EnrichedReducedPlate] = field(default_factory=dict, compare=False)

    @property
    def std(self) -> tuple[Array, Array]:
        """Of ln f and of ln eta, the model's own error in them. Shape (modes,) each."""
        f, eta = self.table.relative_std
        return np.hypot(f, self.own_error[0]), np.hypot(eta, self.own_error[1])

    @property
    def kappa(self) -> Array:
        """Of ln eta. Shape (modes,)."""
        f, eta = self.std
        return np.asarray(f / eta)

    @property
    def measured(self) -> Complex:
        """Ln f + i kappa ln eta. Shape (modes,)."""
        return np.asarray(np.log(self.table.frequency_hz) + 1j * self.kappa * np.log(self.table.loss_factor))

    def system(self, effects: Sequence[Effect]) -> EnrichedReducedPlate:
        """Its own columns and those that effects need."""
        spans = {s.name: s for e in effects for s in e.spans}
        key = tuple(sorted(spans))
        if key not in self._taken:
            self._taken[key] = self.wide.take(spans.values()) if len(self.wide.names) else self.wide
        return self._taken[key]

    def modes(self, law: CoreLaw, z: Array, acting: Acting = ()) -> list[ComplexMode]:
        """Those of the table; `z` has shape (stated numbers,).

        Raises `OutsideModel` where the model has fewer.
        """
        return self._solved(law, z, acting)[1]

    def logs(self, modes: Sequence[ComplexMode]) -> Complex:
        """As `measured`, of modes. Shape (modes,)."""
        eta = np.maximum([m.loss_factor for m in modes], _LEAST_LOSS)
        return np.asarray(np.log([m.frequency_hz for m in modes]) + 1j * self.kappa * np.log(eta))

    def with_derivatives(
        self, law: CoreLaw, z: Array, acting: Acting, steps: Sequence[Array]
    ) -> tuple[Complex, Complex]:
        """`logs`, and their derivatives to the law's log parameters, to `z` and to effects' unknowns.

        `steps` are those of differences, of every effect's unknowns. Shapes (modes,), (numbers, modes).
        """
        A, modes = self._solved(law, z, acting)
        system = self.system([e for e, _ in acting])
        Y, value = np.array([m.shape for m in modes]), np.array([m.eigenvalue for m in modes])
        omega = np.sqrt(value.real)
        G = law.modulus(omega)
        by_G = _energy(A.K_1, Y)
        rows = [
            *(by_G * law.jacobian(omega) * law.values[:, None]),
            *self._by_stated(system, z, Y, value, G),
        ]
        for (effect, u), h in zip(acting, steps, strict=True):
            for k in range(len(u)):
                up, down = (
                    ModalMatrices.of(system, effect.change(system, _moved(u, k, s * h[k])) or Change())
                    for s in (1, -1)
                )
                rows.append(_difference(up, down, Y, value, G) / (2 * h[k]))
        moved = np.array(rows).reshape(-1, len(modes))
        # The law and the damping are taken at omega_r, which moves with lambda.
        h_omega = _H * omega
        slope = by_G * (law.modulus(omega + h_omega) - law.modulus(omega - h_omega)) / (2 * h_omega)
        slope = slope + 1j * _energy(A.C_1, Y)
        moved = moved + slope * (moved.real / (2 * omega - slope.real))
        by_real = moved.real / value.real
        by_loss = moved.imag / np.where(value.imag > 0, value.imag, np.inf) - by_real
        return self.logs(modes), by_real / 2 + 1j * self.kappa * by_loss

    def _solved(self, law: CoreLaw, z: Array, acting: Acting) -> tuple[ModalMatrices, list[ComplexMode]]:
        system = self.system([e for e, _ in acting])
        changes = [c for e, u in acting if (c := e.change(system, u)) is not None]
        changes.append(self.stated.change(system, z))
        A = ModalMatrices.of(system, reduce(Change.and_then, changes))
        count = int(self.table.mode.max())
        found = modes_of(A, law, count, float(self.table.frequency_hz[0]))
        if len(found) < count:
            of = f"{self.table.name}: " if self.table.name else ""
            raise OutsideModel(
                f"{of}mode {count}, expected one of the {len(found)} that the model has, numbered from 1 in "
                "the order of frequency, rigid ones left out"
            )
        return A, [found[int(k) - 1] for k in self.table.mode]

    def _by_stated(
        self, system: EnrichedReducedPlate, z: Array, Y: Complex, value: Complex, G: Complex
    ) -> list[Complex]:
        """D lambda at a fixed omega_r. Shape (modes,) each."""
        n_0, n_1, n_M = self.stated.counts
        energy = np.array([_energy(P, Y) for P in system.parts])
        energy[n_0 : n_0 + n_1] *= G
        energy[n_0 + n_1 :] *= -value
        found = list(self.stated.by_coefficients(z)[:, : n_0 + n_1 + n_M] @ energy)
        omega = np.sqrt(value.real)
        for k, (mode, by) in self.stated.by_damping(len(system.d), z).items():
            found[k] = found[k] + 1j * omega * by * system.d[mode] * (Y @ system.U[:, mode]) ** 2
        return found


def _energy(A: Array, Y: Complex) -> Complex:
    """y^T A y of every mode. Shape (modes,)."""
    return np.asarray(np.einsum("mi,mi->m", Y, Y @ A))


def _difference(up: ModalMatrices, down: ModalMatrices, Y: Complex, value: Complex, G: Complex) -> Complex:
    """What a change of the matrices does to lambda. Shape (modes,)."""
    omega = np.sqrt(value.real)
    K_0, K_1, M, C_1 = (_energy(getattr(up, n) - getattr(down, n), Y) for n in ("K_0", "K_1", "M", "C_1"))
    return np.asarray(K_0 + G * K_1 - value * M + 1j * omega * C_1)


def _moved(u: Array, k: int, h: float) -> Array:
    found = u.copy()
    found[k] += h
    return found
