"""The domain of frequency and modulus a reduced model is built to hold in."""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.specimen import PlateSpecimen

FREQUENCIES_HZ = (5.0, 600.0)
"""Of a laboratory plate's first resonances; what is measured outside stretches it."""
MODULI_PA = (1e4, 2e7)
"""|G*| of soft damping materials; a law beyond stretches it."""
LOSS_FACTOR = 2.0
"""More than most damping materials have; a law beyond stretches it."""
_MODES = 40
"""As many resonances a basis of usual size can hold over all moduli; of 100 it is off by as much as it is.
A large or a limp plate has more below the highest of `FREQUENCIES_HZ`: what is measured counts there."""
_MARGIN = 3.0
"""A law's modulus is expected to move by this factor in a fit."""
_ELEMENTS_A_WAVE = 5
"""Fewer, and the bending of one wave is no longer a few cubics; a rule of thumb."""


@dataclass(frozen=True)
class Domain:
    """Where the basis is meant to hold."""

    omega: tuple[float, float]
    """rad/s."""
    modulus: tuple[float, float]
    """|G*| in Pa."""
    loss: float = 2.0
    """Largest loss factor."""

    def point(self, s: float, t: float, u: float) -> tuple[float, complex]:
        """Frequency and G* at fractions of the domain, |G*| on a logarithmic scale."""
        omega = self.omega[0] + s * (self.omega[1] - self.omega[0])
        size = self.modulus[0] * (self.modulus[1] / self.modulus[0]) ** t
        return omega, size * np.exp(1j * np.arctan(u * self.loss))

    def grid(self, n_omega: int, n_modulus: int, losses: tuple[float, ...]) -> tuple[Array, Complex]:
        """Frequency (rad/s) and G* over the domain, flattened. Shape (n,) each."""
        points = [
            self.point(s, t, u)
            for s in np.linspace(0, 1, n_omega)
            for t in np.linspace(0, 1, n_modulus)
            for u in losses
        ]
        return np.array([p[0] for p in points]), np.array([p[1] for p in points])

    def widened(self, law: CoreLaw, frequency_hz: Array) -> "Domain":
        """The domain with a law's moduli at `frequency_hz` well inside, whole decades at a time.

        Shape (n,).
        """
        G = law.modulus(2 * np.pi * frequency_hz)
        low, high = np.abs(G).min() / _MARGIN, np.abs(G).max() * _MARGIN
        loss = float(np.max(G.imag / G.real))
        if low < self.modulus[0]:
            low = 10 ** np.floor(np.log10(low))
        if high > self.modulus[1]:
            high = 10 ** np.ceil(np.log10(high))
        return replace(
            self,
            modulus=(float(min(low, self.modulus[0])), float(max(high, self.modulus[1]))),
            loss=max(self.loss, float(np.ceil(loss))),
        )


def domain_of(specimen: PlateSpecimen, frequency_hz: Array) -> Domain:
    """The default domain, stretched over `frequency_hz` and the specimen's law where they lie outside.

    `frequency_hz` of shape (n,). Raises `OutsideModel` where the mesh is too coarse for the highest.
    """
    highest, limit = float(np.max(frequency_hz)), highest_frequency_hz(specimen)
    if highest > limit:
        raise OutsideModel(
            f"{highest:g} Hz is beyond what the mesh resolves, expected at most {limit:.3g} Hz "
            "(or a finer [mesh])"
        )
    low, high = FREQUENCIES_HZ
    if np.min(frequency_hz) < low:
        low = 10 ** float(np.floor(np.log10(np.min(frequency_hz))))
    high = min(high, _MODES * hz_a_mode(specimen))
    if highest > high:
        high = 100 * float(np.ceil(highest / 100))
    omega = (2 * np.pi * low, 2 * np.pi * high)
    if specimen.core is None:
        return Domain(omega, (1.0, 1.0))
    return Domain(omega, MODULI_PA, LOSS_FACTOR).widened(specimen.core.law, frequency_hz)


def hz_a_mode(specimen: PlateSpecimen) -> float:
    """Between two resonances in the mean, were the substrate alone to carry all: plates have fewer.

    A wave of bending takes 4 pi / area of the square of its number (Cremer, Heckl, Petersson,
    Structure-Borne Sound, 2005).
    """
    s = specimen
    face = s.substrate
    layers = [face.thickness_m * face.density_kg_m3]
    layers += [x.thickness_m * x.density_kg_m3 for x in (s.core, s.constraining) if x is not None]
    stiffness = face.young_pa * face.thickness_m**3 / (12 * (1 - face.poisson**2))
    return float(2 / (s.length_m * s.width_m) * np.sqrt(stiffness / sum(layers)))


def highest_frequency_hz(specimen: PlateSpecimen) -> float:
    """Where a bending wave of the bare substrate is only a few elements long."""
    n_x, n_y = specimen.mesh
    side = max(specimen.length_m / n_x, specimen.width_m / n_y)
    face = specimen.substrate
    stiffness = face.young_pa * face.thickness_m**2 / (12 * (1 - face.poisson**2))
    k = 2 * np.pi / (_ELEMENTS_A_WAVE * side)
    return float(k**2 * np.sqrt(stiffness / face.density_kg_m3) / (2 * np.pi))
