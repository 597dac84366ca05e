"""Data beside a structure whatever its core: how near the nearest core comes, up to a factor or not.

A core is a modulus at the middle frequency, a loss factor there, and the slopes of their logarithms:
enough to come within some percent of any law over a sweep. Distances are those of logarithms, so that a
wrong unit is a constant, and what is further off than a factor e counts no more: a part that is wrong does
not hide the rest.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from fitting.arrays import Array, Complex
from fitting.errors import OutsideModel
from fitting.identification.model import velocity
from fitting.reduced.rational import RationalSweep, rational_sweep
from fitting.specimen import PlateSpecimen, Reading
from fitting.structures import AnySpecimen, ShearPair
from fitting.structures.small import check_driven, system_of
from fitting.structures.small_sum import rational_of
from instrument.models.specimen_models import Models
from instrument.progress import Progress

_DECADES, _MODULI = 2.0, 25
"""About the middle of what the model spans, either way, and how many: three resonances' widths apart."""
_SLOPES, _LOSSES = (0.0, 0.35), (0.05, 0.3, 1.0)
"""Of a core at rest in its plateau and in its transition; of a metal-like, a usual and a lossy one."""
FURTHEST = 1.0
"""Of ln(measured/predicted)."""
_STEPS = 180
"""Of the search by simplex: four unknowns, to a percent."""
_FIRST = (0.15, 0.1, 0.4, 0.3)
"""Size of the simplex: half the grid's spacing in log10 of the modulus, its slope, ln of the loss factor, its
slope."""
_MOST_LOSS, _STEEPEST_LOSS = 5.0, 1.0
"""More than a core has, and as steep as its loss factor gets."""


class Nearest(NamedTuple):
    """The core that comes nearest."""

    distance: float
    """Mean over the points of |ln(measured/predicted)|, at most `FURTHEST` each."""
    factor: complex
    """Measured over predicted at all points alike; one where none was asked for."""
    core: Array
    """As `AnyCore.log_velocity` takes it. Shape (4,)."""


@dataclass(frozen=True)
class AnyCore:
    """What one spot of a structure reads for a unit drive, as a function of its core."""

    omega: Array
    sums: RationalSweep
    reads: Reading
    stated: Array
    """The core stated in the file, as `log_velocity` takes it. Shape (4,)."""
    unknowns: int = 4
    """How many of a core's numbers are sought at most: one resonance tells no rising loss from a factor."""

    @property
    def middle(self) -> float:
        """Geometric mean of the frequencies' ends, rad/s."""
        return float(np.sqrt(self.omega.min() * self.omega.max()))

    def log_velocity(self, cores: Array) -> Complex:
        """Ln of the phasors, of log10 G', its slope, ln eta and its slope. Shapes (n, 4), (n, points)."""
        log_G, slope, log_eta, eta_slope = cores.T[:, :, None]
        x = self.omega / self.middle
        G = 10**log_G * x**slope * (1 + 1j * np.exp(log_eta) * x**eta_slope)
        return np.log(velocity(self.omega, self.sums.displacement(G), self.reads))

    @cached_property
    def cores(self) -> Array:
        """Those that are tried first. Shape (n, 4)."""
        log_G = np.log10(np.abs(self.sums.G_ref)) + np.linspace(-_DECADES, _DECADES, _MODULI)
        grid = np.array([(g, s, np.log(e), 0.0) for g in log_G for s in _SLOPES for e in _LOSSES])
        return np.concatenate([grid, self.stated[None]])

    @cached_property
    def _tried(self) -> Complex:
        return self.log_velocity(self.cores)

    def nearest(self, response: Complex, *, has_phase: bool, free: bool, refine: bool = True) -> Nearest:
        """The nearest core; `free`: up to one factor at all points. `response` for a unit drive (points,)."""
        read = np.log(response.astype(complex))

        def of(log_v: Complex) -> tuple[Array, Complex]:
            return _distances(read - log_v, has_phase=has_phase, free=free)

        distances, factors = of(self._tried)
        best = int(np.argmin(distances))
        found = Nearest(float(distances[best]), complex(factors[best]), self.cores[best])
        return self._refined(found, of) if refine else found

    def _refined(self, start: Nearest, of: Callable[[Complex], tuple[Array, Complex]]) -> Nearest:
        n = self.unknowns

        def core_of(x: Array) -> Array:
            return np.concatenate([x, start.core[n:]])

        def distance(x: Array) -> float:
            core = core_of(x)
            _, slope, log_eta, eta_slope = core
            if not 0 <= slope <= 1 or log_eta > np.log(_MOST_LOSS) or abs(eta_slope) > _STEEPEST_LOSS:
                return 2 * FURTHEST
            return float(of(self.log_velocity(core[None]))[0][0])

        first = start.core[:n] + np.vstack([np.zeros(n), np.diag(_FIRST[:n])])
        found = minimize(
            distance,
            start.core[:n],
            method="Nelder-Mead",
            options={"initial_simplex": first, "maxfev": _STEPS, "xatol": 1e-3, "fatol": 1e-4},
        )
        if not found.fun < start.distance:
            return start
        core = core_of(found.x)
        return Nearest(float(found.fun), complex(of(self.log_velocity(core[None]))[1][0]), core)


def _distances(off: Complex, *, has_phase: bool, free: bool) -> tuple[Array, Complex]:
    """Of logarithms (n, points): distances and factors. Shape (n,) each."""
    log_factor = np.zeros(len(off), complex)
    if free:
        log_factor += np.median(off.real, axis=1)
    if free and has_phase:
        log_factor += 1j * np.angle(np.mean(np.exp(1j * off.imag), axis=1))
    off = off - log_factor[:, None]
    turned = np.angle(np.exp(1j * off.imag)) if has_phase else 0.0
    size = np.minimum(np.abs(off.real + 1j * turned), FURTHEST)
    return np.mean(size, axis=1), np.exp(log_factor)


def any_core(specimen: AnySpecimen, frequency_hz: Array, progress: Progress) -> AnyCore:
    """Of a specimen with a core, seen at its first spot. Shape (points,).

    Raises `OutsideModel` where it cannot be modelled over these frequencies.
    """
    if specimen.core is None:
        raise OutsideModel("a bare specimen has no core")
    omega = 2 * np.pi * frequency_hz
    middle = np.sqrt(omega.min() * omega.max())
    at = specimen.core.law.modulus(middle * np.array([1.0, 1.1]))
    slope = float(np.clip(np.log(at[1].real / at[0].real) / np.log(1.1), 0, 1))
    losses = np.log(np.clip(at.imag / at.real, 1e-3, _MOST_LOSS))
    eta_slope = np.clip((losses[1] - losses[0]) / np.log(1.1), -1, 1)
    stated = np.array([np.log10(at[0].real), slope, losses[0], eta_slope])
    if isinstance(specimen, PlateSpecimen):
        sums = rational_sweep(Models.of(specimen, frequency_hz, progress).reduced, omega)
    else:
        parts = specimen.parts()
        check_driven(parts, specimen)
        sums = rational_of(system_of(specimen, parts), omega, float(np.abs(at[0])))
    return AnyCore(omega, sums, specimen.reads, stated, 3 if isinstance(specimen, ShearPair) else 4)
