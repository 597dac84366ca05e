"""The core's true law, G* = g_inf + sum of g_k i w tau_k / (1 + i w tau_k), and what moves it."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import nnls

from drivers.arrays import Complex


@dataclass(frozen=True)
class MaxwellLaw:
    """A spring beside relaxing elements."""

    g_inf_pa: float
    """Shear modulus at rest."""
    g_pa: tuple[float, ...]
    """Of each element, not negative."""
    tau_s: tuple[float, ...]
    """Relaxation time of each element."""

    def __post_init__(self) -> None:
        if len(self.g_pa) != len(self.tau_s):
            raise ValueError(
                f"{len(self.g_pa)} moduli and {len(self.tau_s)} relaxation times: give as many of each"
            )
        if self.g_inf_pa <= 0 or min(self.g_pa, default=1.0) < 0 or min(self.tau_s, default=1.0) <= 0:
            raise ValueError(
                "a Maxwell series needs g_inf and times above zero, moduli not below: the core gains energy"
            )

    def modulus(self, omega: ArrayLike) -> Complex:
        """G* in Pa at angular frequencies in rad/s, of their shape."""
        s = 1j * np.multiply.outer(np.asarray(omega, dtype=float), np.array(self.tau_s))
        return np.asarray(self.g_inf_pa + (s / (1 + s)) @ np.array(self.g_pa))

    def shifted(self, factor: float) -> "MaxwellLaw":
        """Every relaxation time times `factor`: time-temperature superposition."""
        return replace(self, tau_s=tuple(factor * t for t in self.tau_s))

    def scaled(self, factor: float) -> "MaxwellLaw":
        """Every modulus times `factor`."""
        return MaxwellLaw(factor * self.g_inf_pa, tuple(factor * g for g in self.g_pa), self.tau_s)


def wlf_shift(kelvin: float, c1: float, c2_kelvin: float) -> float:
    """Factor on relaxation times at `kelvin` above the reference (Williams, Landel and Ferry 1955)."""
    return float(10 ** (-c1 * kelvin / (c2_kelvin + kelvin)))


def fractional_zener(
    g0_pa: float, ginf_pa: float, tau_s: float, alpha: float
) -> Callable[[ArrayLike], Complex]:
    """G* of (g0 + ginf (i w tau)^alpha) / (1 + (i w tau)^alpha), to make a series from. Shape of omega."""

    def modulus(omega: ArrayLike) -> Complex:
        s = (1j * np.asarray(omega) * tau_s) ** alpha
        return np.asarray((g0_pa + ginf_pa * s) / (1 + s))

    return modulus


_BAND_HZ = (3.0, 3000.0)
"""Where a series follows its law: a decade beyond a usual sweep at its upper end. A choice."""


def maxwell_series(modulus: Callable[[ArrayLike], Complex], terms: int = 8) -> MaxwellLaw:
    """The series nearest to a law from 3 to 3000 Hz in relative error, by non-negative least squares.

    The times are spaced evenly in the logarithm, from 2 / (lowest w) to 1 / (highest w). `modulus` keeps the
    shape of omega.
    """
    omega = 2 * np.pi * np.geomspace(*_BAND_HZ, 200)
    wanted = modulus(omega)
    tau = np.geomspace(2 / omega[0], 1 / omega[-1], terms)
    s = 1j * omega[:, None] * tau
    columns = np.column_stack([np.ones(len(omega)), s / (1 + s)]) / wanted[:, None]
    real = np.vstack([columns.real, columns.imag])
    g, _ = nnls(real, np.concatenate([np.ones(len(omega)), np.zeros(len(omega))]))
    return MaxwellLaw(float(g[0]), tuple(map(float, g[1:])), tuple(map(float, tau)))


ZN1 = MaxwellLaw(
    g_inf_pa=271152.0,
    g_pa=(3065.2, 5979.96, 15247.8, 40229.1, 111671.0, 420027.0, 1823650.0, 1258410.0),
    tau_s=(0.106103, 0.0358223, 0.0120942, 0.00408321, 0.00137856, 0.000465426, 0.000157136, 5.30516e-05),
)
"""`maxwell_series(fractional_zener(0.27e6, 4.1e6, 1.21e-4, 0.83))`, rounded; within 0.3 %, 3 to 3000 Hz."""


def even_loss(loss_factor: float) -> MaxwellLaw:
    """Unit stiffness at 60 Hz with a loss factor almost even from 5 to 600 Hz."""
    tau = np.geomspace(1 / (2 * np.pi * 1.0), 1 / (2 * np.pi * 3000), 8)
    s = 2j * np.pi * np.geomspace(5, 600, 100)[:, None] * tau
    g, _ = nnls((s / (1 + s)).imag, np.ones(len(s)))
    at_60 = 2j * np.pi * 60 * tau
    relaxed = 1 - loss_factor * float((at_60 / (1 + at_60)).real @ g)
    return MaxwellLaw(relaxed, tuple(float(loss_factor * c) for c in g), tuple(map(float, tau)))
