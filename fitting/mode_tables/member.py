"""One specimen with its table: matrices by what is stated, and how its modes move with everything.

A mode is kept as ln f + i kappa ln eta: kappa makes both parts equally well known, so that all that is built
for phasors of a sweep holds for modes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import reduce

import numpy as np

from fitting.arrays import Array, Complex
from fitting.dynamics.complex_modes import ComplexMode
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.as_read import Read, Stiffness, as_read
from fitting.mode_tables.modes import ModalMatrices, modes_of
from fitting.mode_tables.table import ModalTable
from fitting.nuisances.nuisances import Nuisances
from fitting.structures import AnySpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate

_H = 1e-4
"""Relative step of a frequency: for the law's slope."""
_OF_HALF = 1 / 3
"""Of what elements of twice the side change: these have a quarter of their error."""
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
    together: Array = field(default_factory=lambda: np.zeros((0, 2, 1)))
    """Relative errors of all f and eta by one cause each. Shape (causes, 2, modes)."""
    otherwise: Array = field(default_factory=lambda: np.zeros((2, 1)))
    """Half of what f and eta read off peaks have more than the model's, relative; zero where the table says
    how it was read. So much is added to the model's, with as much for its standard deviation, one cause of
    all. Shape (2, modes)."""
    halved: "Member | None" = None
    """The plate with half as many elements each way: its modes say what the mesh gets wrong."""
    mesh_off: Array = field(default_factory=lambda: np.zeros((2, 1)))
    """What ln f and ln eta have more on the mesh than on ever smaller elements. Shape (2, modes)."""
    _taken: dict[tuple[str, ...], EnrichedReducedPlate] = field(default_factory=dict, compare=False)

    @property
    def std(self) -> tuple[Array, Array]:
        """Of ln f and of ln eta, the model's own error in them. Shape (modes,) each."""
        f, eta = self.table.relative_std
        return np.hypot(f, self.own_error[0]), np.hypot(eta, self.own_error[1])

    @property
    def kappa(self) -> Array:
        """Factor on ln eta by which it is as uncertain as ln f. Shape (modes,)."""
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

    def logs(self, law: CoreLaw, z: Array, acting: Acting = ()) -> Complex:
        """As `measured`, of the model's modes; `z` has shape (stated numbers,). Shape (modes,).

        Raises `OutsideModel` where the model has fewer.
        """
        A, modes = self._solved(law, z, acting)
        return self._as_measured(modes, _stiffness(A, law, modes))

    def off_by_mesh(self, law: CoreLaw) -> Array:
        """As `mesh_off`, as stated: the error goes with the square of an element. Shape (2, modes)."""
        if self.halved is None:
            return np.zeros((2, len(self.table.mode)))
        fine, coarse = (np.array(m._numbers(law)) for m in (self, self.halved))
        return (coarse - fine) * _OF_HALF

    def _numbers(self, law: CoreLaw) -> tuple[Array, Array]:
        """Ln of frequencies and of loss factors as stated. Shape (modes,) each."""
        A, modes = self._solved(law, np.zeros(len(self.stated)), ())
        ln_f, ln_eta = self._read(_stiffness(A, law, modes))
        return np.log([m.frequency_hz for m in modes]) + ln_f, ln_eta

    def reads_otherwise(self, law: CoreLaw, z: Array, how: Read) -> tuple[Array, Array]:
        """By how much frequencies and loss factors would be read otherwise, relative. Shape (modes,) each."""
        A, modes = self._solved(law, z, ())
        k = _stiffness(A, law, modes)
        ln_f, eta = as_read(how, k)
        return np.expm1(ln_f), eta / k.loss_factor - 1

    def _as_measured(self, modes: Sequence[ComplexMode], k: Stiffness) -> Complex:
        ln_f, ln_eta = self._read(k)
        f, (f_off, eta_off) = np.array([m.frequency_hz for m in modes]), self.mesh_off - self.otherwise
        return np.asarray(np.log(f) + ln_f - f_off + 1j * self.kappa * (ln_eta - eta_off))

    def _read(self, k: Stiffness) -> tuple[Array, Array]:
        """Ln of the frequency over the model's, and of the loss factor, as the table has them."""
        ln_f, eta = as_read(self.table.read or "model", k)
        return ln_f, np.log(np.maximum(eta, _LEAST_LOSS))

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
        about = _stiffness(A, law, modes)
        slope = (about.sigma * about.core + about.viscous) * omega
        moved = moved + slope * (moved.real / (2 * omega - slope.real))
        by_real = moved.real / value.real
        by_loss = moved.imag / np.where(value.imag > 0, value.imag, np.inf) - by_real
        # What is read follows both; what share the core has, and how steep it is, hardly move.
        (f_up, loss_up), (f_down, loss_down) = (self._read(_lossier(about, s * _H)) for s in (1, -1))
        f_by_loss, loss_by_loss = (f_up - f_down) / (2 * _H), (loss_up - loss_down) / (2 * _H)
        by_modes = by_real / 2 + (f_by_loss + 1j * self.kappa * loss_by_loss) * by_loss
        return self._as_measured(modes, about), by_modes

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
        counts = self.stated.of_parts.counts
        energy = np.array([_energy(P, Y) for P in system.parts])
        counts.weigh(energy, G, -value)
        found = list(self.stated.of_parts.by_there(z)[:, counts.matrices] @ energy)
        omega = np.sqrt(value.real)
        for k, (mode, by) in self.stated.ratios.by(len(system.d), z).items():
            found[k] = found[k] + 1j * omega * by * system.d[mode] * (Y @ system.U[:, mode]) ** 2
        return found


def _stiffness(A: ModalMatrices, law: CoreLaw, modes: Sequence[ComplexMode]) -> Stiffness:
    """Of every mode about its own frequency."""
    Y, value = np.array([m.shape for m in modes]), np.array([m.eigenvalue for m in modes])
    omega = np.sqrt(value.real)
    G, h = law.modulus(omega), _H * omega
    sigma = (law.modulus(omega + h) - law.modulus(omega - h)) / (2 * _H * G)
    core, viscous = G * _energy(A.K_1, Y) / value.real, 1j * omega * _energy(A.C_1, Y) / value.real
    return Stiffness(value / value.real - core - viscous, core, sigma, viscous)


def _lossier(k: Stiffness, by: float) -> Stiffness:
    """Every loss larger by a relative step."""

    def more(part: Complex) -> Complex:
        return np.asarray(part.real + 1j * part.imag * np.exp(by), complex)

    return Stiffness(more(k.rest), more(k.core), k.sigma, more(k.viscous))


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
