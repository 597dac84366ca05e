"""A law from tables of modes: natural frequency and loss factor of each mode of each specimen.

One posterior as for sweeps: ln f and ln eta over their standard deviations, stated numbers over their
tolerances, the law's bend. Stated numbers of the same thing in several specimens are one number.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array
from fitting.bent_law import BentLaw
from fitting.complex_modes import ComplexMode
from fitting.errors import OutsideModel, TooFewPoints
from fitting.identification.adjusted import Adjusted, adjusted
from fitting.identification.uncertainty import Uncertainty, limits_reached
from fitting.laws import CoreLaw
from fitting.nuisances import Nuisance
from fitting.structures.small import Parts, SmallNuisances, SmallSpecimen, nuisances_of, system_of
from fitting.structures.small_modes import elastic_modes

FREQUENCY_STD, LOSS_STD = 1e-3, 0.03
"""Relative, where a table states none: a careful resonance test."""
OF_EACH_TABLE = ("mass", "length", "width")
_STEP = 1e-4
"""Relative, of a frequency: for the law's slope."""
_MOST_EVALUATIONS = 40


@dataclass(frozen=True)
class ModalTable:
    """Modes of one specimen. Shape (modes,) each."""

    mode: Array
    """From 1."""
    frequency_hz: Array
    loss_factor: Array
    frequency_std_hz: Array | None = None
    loss_factor_std: Array | None = None

    @property
    def relative_std(self) -> tuple[Array, Array]:
        """Of frequencies and of loss factors, stated or usual."""
        f, eta = self.frequency_std_hz, self.loss_factor_std
        return (
            np.full(len(self.mode), FREQUENCY_STD) if f is None else f / self.frequency_hz,
            np.full(len(self.mode), LOSS_STD) if eta is None else eta / self.loss_factor,
        )


@dataclass(frozen=True)
class ModalFit:
    """What was found, mode by mode."""

    law: CoreLaw
    """With its bend."""
    uncertainty: Uncertainty
    predicted_hz: tuple[Array, ...]
    predicted_loss: tuple[Array, ...]
    adjusted: tuple[Adjusted, ...]
    evaluations: int
    converged: bool


@dataclass(frozen=True)
class _Member:
    table: ModalTable
    specimen: SmallSpecimen
    parts: Parts
    stated: SmallNuisances
    at: list[int]

    def modes(self, law: CoreLaw, z: Array) -> tuple[Array, Array]:
        """Frequencies in Hz and loss factors of the table's modes."""
        chosen = self._modes(law, z)
        return np.array([m.frequency_hz for m in chosen]), np.array([m.loss_factor for m in chosen])

    def by_everything(self, law: CoreLaw, z: Array) -> tuple[Array, Array]:
        """Derivatives of ln f and ln eta to the law's log parameters and to `z`. Shape (modes, numbers) each.

        With y a mode, lambda = y^T K y / y^T M y; the law is taken at omega_r = sqrt(Re lambda).
        """
        n_0, n_1, n_M = len(self.parts.K_0), len(self.parts.K_1), len(self.parts.M)
        every = np.concatenate([self.parts.K_0, self.parts.K_1, self.parts.M])
        c = self.stated.coefficients(z[self.at]) + self.specimen.coefficients({})
        by_z = self.stated.by_coefficients(z[self.at])[:, : n_0 + n_1 + n_M]
        found = []
        for mode in self._modes(law, z):
            y, value = mode.shape, mode.eigenvalue
            energy = np.einsum("i,pij,j->p", y, every, y)
            mass = c[n_0 + n_1 : n_0 + n_1 + n_M] @ energy[n_0 + n_1 :]
            s = c[n_0 : n_0 + n_1] @ energy[n_0 : n_0 + n_1] / mass
            omega = float(np.sqrt(value.real))
            at = np.array([omega])
            G = law.modulus(at)[0]
            up, down = law.modulus(at * (1 + _STEP))[0], law.modulus(at * (1 - _STEP))[0]
            slope = s * (up - down) / (2 * _STEP * omega)
            factors = np.concatenate([np.ones(n_0), np.full(n_1, G), np.full(n_M, -value)])
            moved = np.zeros(len(law.names) + len(z), complex)
            moved[: len(law.names)] = s * law.jacobian(at)[:, 0] * law.values
            moved[len(law.names) + np.array(self.at, dtype=int)] = by_z @ (factors * energy) / mass
            by_omega = moved.real / (2 * omega - slope.real)
            found.append((moved + slope * by_omega, value))
        d = np.array([one for one, _ in found])
        values = np.array([v for _, v in found])[:, None]
        by_real = d.real / values.real
        return by_real / 2, d.imag / values.imag - by_real

    def _modes(self, law: CoreLaw, z: Array) -> list[ComplexMode]:
        system = system_of(self.specimen, self.parts)
        change = self.stated.change(system, z[self.at])
        moved = replace(system, K_0=system.K_0 + change.K, K_1=system.K_1 + change.K_1, M=system.M + change.M)
        count = int(self.table.mode.max())
        found = elastic_modes(moved, law, count, self.table.frequency_hz[0])
        if len(found) < count:
            raise OutsideModel(f"mode {count}, expected one of the {len(found)} that the model has")
        return [found[int(k) - 1] for k in self.table.mode]


def fit_modes(tables: Sequence[ModalTable], specimens: Sequence[SmallSpecimen]) -> ModalFit:
    """The law of all tables. Raises `TooFewPoints`, `OutsideModel`."""
    members, each = _members(tables, specimens)
    start = _start(specimens, tables)
    count, n = sum(2 * len(t.mode) for t in tables), len(start.names)
    if count <= len(start.plain.names):
        raise TooFewPoints(
            f"{count} numbers cannot carry the {len(start.plain.names)} parameters of {start.kind}"
        )

    def residuals(p: Array) -> Array:
        law, z = start.with_logs(p[:n]), p[n:]
        rows = []
        for m in members:
            f, eta = m.modes(law, z)
            sigma_f, sigma_eta = m.table.relative_std
            rows += [np.log(f / m.table.frequency_hz) / sigma_f]
            rows += [np.log(np.maximum(eta, 1e-12) / m.table.loss_factor) / sigma_eta]
        return np.concatenate([*rows, z, p[n - start.bend_count : n]])

    def jacobian(p: Array) -> Array:
        law, z = start.with_logs(p[:n]), p[n:]
        rows = []
        for m in members:
            by_f, by_eta = m.by_everything(law, z)
            sigma_f, sigma_eta = m.table.relative_std
            rows += [by_f / sigma_f[:, None], by_eta / sigma_eta[:, None]]
        same = np.eye(len(p))
        return np.concatenate([*rows, same[n:], same[n - start.bend_count : n]])

    lower, upper = start.log_limits
    reach = np.full(len(each), 12.0)
    found = least_squares(
        residuals,
        np.concatenate([np.clip(np.log(start.values), lower, upper), np.zeros(len(each))]),
        bounds=(np.concatenate([lower, -reach]), np.concatenate([upper, reach])),
        jac=jacobian,
        x_scale="jac",
        max_nfev=_MOST_EVALUATIONS,
    )
    law, z = start.with_logs(found.x[:n]), found.x[n:]
    C, uncertainty = _uncertainty(law, found.jac, found.fun[:count], n)
    errors = np.sqrt(np.maximum(np.diag(C)[n:], 0))
    modes = [m.modes(law, z) for m in members]
    stated = []
    for k, one in enumerate(each):
        owner = next(m for m in members if k in m.at)
        plain = replace(one, name=one.name.split(" [")[0])
        (as_found,) = adjusted(owner.specimen, [plain], z[k : k + 1], errors[k : k + 1])
        stated.append(replace(as_found, name=one.name))
    return ModalFit(
        law,
        uncertainty,
        tuple(f for f, _ in modes),
        tuple(eta for _, eta in modes),
        tuple(stated),
        int(found.nfev),
        bool(found.status > 0),
    )


def _members(
    tables: Sequence[ModalTable], specimens: Sequence[SmallSpecimen]
) -> tuple[list[_Member], list[Nuisance]]:
    members: list[_Member] = []
    each: list[Nuisance] = []
    keys: dict[tuple[object, ...], int] = {}
    for k, (table, specimen) in enumerate(zip(tables, specimens, strict=True)):
        parts = specimen.parts()
        whole = nuisances_of(specimen, parts, has_phase=False)
        own = replace(whole, each=tuple(n for n in whole.each if n.kind in specimen.numbers))
        at = []
        for n in own.each:
            key: tuple[object, ...] = (n.name, n.sigma, specimen.stated_number(n.kind)[0])
            apart = n.kind in OF_EACH_TABLE and len(tables) > 1
            key = (n.name, k) if apart else key
            if key not in keys:
                keys[key] = len(each)
                each.append(replace(n, name=f"{n.name} [{k + 1}]") if apart else n)
            at.append(keys[key])
        members.append(_Member(table, specimen, parts, own, at))
    return members, each


def _start(specimens: Sequence[SmallSpecimen], tables: Sequence[ModalTable]) -> CoreLaw:
    cores = [s.core for s in specimens if s.core is not None]
    if len(cores) < len(specimens):
        raise OutsideModel("a bare specimen has no core to identify, expected a core in every one")
    frequency_hz = np.concatenate([t.frequency_hz for t in tables])
    law = cores[0].law.to_fit(frequency_hz).lifted()
    if all(s.exact for s in specimens):
        return law
    return BentLaw.over(law, frequency_hz)


def _uncertainty(law: CoreLaw, J: Array, readings: Array, n: int) -> tuple[Array, Uncertainty]:
    """The posterior of everything, and the law's part. Scaled upwards by a misfit, never downwards."""
    dof = len(readings) - len(law.plain.names)
    chi2 = float(readings @ readings / dof) if dof > 0 else float("nan")
    widths = law.search_widths
    loose = np.zeros((len(widths), J.shape[1]))
    loose[:, : len(widths)] = np.diag(1 / widths)
    J = np.vstack([J, loose])
    C: Array = np.asarray(np.linalg.pinv(J.T @ J), dtype=np.float64) * max(
        1.0, chi2 if np.isfinite(chi2) else 1.0
    )
    return C, Uncertainty(C[:n, :n], limits_reached(law), chi2)
