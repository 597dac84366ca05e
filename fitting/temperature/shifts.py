"""How far a temperature shifts a law along the frequency: reduced frequency = a_T frequency.

Ferry, Viscoelastic Properties of Polymers, 3rd ed. 1980, chapter 11; ISO 10112, ASTM E756.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array

Kind = Literal["wlf", "arrhenius", "free"]
GAS_J_MOL_K = 8.314462618
"""Molar gas constant, CODATA 2018 (exact since 2019)."""
ZERO_K = 273.15
"""0 degrees Celsius."""
FARTHEST = 5.0
"""Standard deviations that a temperature is moved at most: beyond, it is a mistake and no scatter."""
_STEP_K = 1e-3
"""Of central differences along the temperature, where forms are smooth over kelvins."""
_LN10 = float(np.log(10.0))
"""WLF is written with the decimal logarithm."""


@dataclass(frozen=True)
class Shift:
    """A form of ln a_T; its parameters are fitted as they stand in `names`."""

    kind: Kind
    temperature_c: Array
    """Of each sweep, as stated."""
    reference_c: float
    error_k: float = 0.0
    """Standard deviation of each stated temperature; what a form makes of it is fitted."""

    @property
    def fewest(self) -> int:
        """How many temperatures fix it, none to spare."""
        return 3 if self.kind == "wlf" else 2

    @property
    def moves_temperatures(self) -> bool:
        """Whether the temperatures are unknowns of the fit: a free factor of one sweep takes any as it is."""
        several = len(self._temperatures) < len(self.temperature_c)
        return self.error_k > 0 and (self.kind != "free" or several)

    @property
    def names(self) -> list[str]:
        """Of the parameters; a free factor for each temperature but the one at the reference."""
        if self.kind == "wlf":
            return ["c1", "c2_k"]
        if self.kind == "arrhenius":
            return ["activation_energy_j_mol"]
        return [f"ln_shift at {t:g} degC" for t in self._moved]

    @property
    def _temperatures(self) -> Array:
        return np.unique(self.temperature_c)

    @property
    def nearest_c(self) -> float:
        """The stated temperature that is nearest to the reference."""
        return float(self._temperatures[np.argmin(np.abs(self._temperatures - self.reference_c))])

    @property
    def _moved(self) -> list[float]:
        return [float(t) for t in self._temperatures if t != self.nearest_c]

    @property
    def _coldest_c(self) -> float:
        return float(self.temperature_c.min()) - FARTHEST * self.error_k

    @property
    def scales(self) -> Array:
        """What a parameter is measured in inside the fit. Shape (parameters,)."""
        if self.kind == "wlf":
            return np.array([10.0, 100.0])
        return np.array([1e5]) if self.kind == "arrhenius" else np.ones(len(self._moved))

    @property
    def lowest(self) -> Array:
        """Limits below; of WLF C2 keeps every temperature above the pole. Shape (parameters,)."""
        if self.kind == "wlf":
            return np.array([1e-3, max(1.0, 1.0 + self.reference_c - self._coldest_c)])
        return np.array([1.0]) if self.kind == "arrhenius" else np.full(len(self._moved), -60.0)

    @property
    def highest(self) -> Array:
        """Limits above. Shape (parameters,)."""
        if self.kind == "wlf":
            return np.array([1e3, 1e5])
        return np.array([2e6]) if self.kind == "arrhenius" else np.full(len(self._moved), 60.0)

    def log_shift(self, p: Array, temperature_c: Array | None = None) -> Array:
        """Ln a_T at the sweeps' temperatures, or others for a form that has a formula.

        Shape of the temperatures.
        """
        T = self.temperature_c if temperature_c is None else np.asarray(temperature_c, float)
        if self.kind == "wlf":
            off = T - self.reference_c
            # log10 a_T = -C1 (T - T_0) / (C2 + T - T_0)
            return np.asarray(-_LN10 * p[0] * off / (p[1] + off))
        if self.kind == "arrhenius":
            # ln a_T = E_a / R (1/T - 1/T_0)
            inverse = 1 / (T + ZERO_K) - 1 / (self.reference_c + ZERO_K)
            return np.asarray(p[0] / GAS_J_MOL_K * inverse)
        known = {t: float(v) for t, v in zip(self._moved, p, strict=True)}
        if temperature_c is None:
            return np.array([known.get(float(t), 0.0) for t in T])
        at = self._temperatures
        return _along(T, at, np.array([known.get(float(t), 0.0) for t in at]))

    def by_temperature(self, p: Array, temperature_c: Array) -> Array:
        """Derivatives of `log_shift` to the temperatures, in 1/K. Shapes (sweeps,) both."""
        up, down = (self.log_shift(p, temperature_c + h) for h in (_STEP_K, -_STEP_K))
        return np.asarray((up - down) / (2 * _STEP_K))

    def slope(self, p: Array, temperature_c: Array | None = None) -> Array:
        """Derivatives of `log_shift` to the parameters, at its temperatures. Shape (sweeps, parameters)."""
        found = []
        for k, size in enumerate(self.scales):
            h = 1e-5 * size
            up, down = p.copy(), p.copy()
            up[k], down[k] = p[k] + h, p[k] - h
            found.append((self.log_shift(up, temperature_c) - self.log_shift(down, temperature_c)) / (2 * h))
        return np.array(found).T.reshape(len(self.temperature_c), len(p))

    def positive(self, p: Array) -> Array:
        """The parameters as a fit in logarithms has them: free ones as factors. Shape (parameters,)."""
        return np.exp(p) if self.kind == "free" else np.asarray(p)

    def from_positive(self, theta: Array) -> Array:
        """And back. Shape (parameters,)."""
        return np.log(theta) if self.kind == "free" else np.asarray(theta)

    def by_log(self, p: Array) -> Array:
        """Derivatives of the parameters to the logarithms of `positive`. Shape (parameters,)."""
        return np.ones(len(p)) if self.kind == "free" else np.asarray(p)

    def place_of(self, sweep: int) -> int | None:
        """Which of the temperatures that are not the reference's a sweep has."""
        moved, t = self._moved, float(self.temperature_c[sweep])
        return moved.index(t) if t in moved else None

    @property
    def moved_count(self) -> int:
        """How many temperatures are not the reference's."""
        return len(self._moved)

    def near(self, log_shift: Array) -> Array:
        """The parameters nearest to some factors, to start from. Shapes (parameters,), of (sweeps,)."""
        if self.kind == "free":
            return np.array([np.mean(log_shift[self.temperature_c == t]) for t in self._moved])
        starts = [[8.0, 100.0], [17.0, 60.0]] if self.kind == "wlf" else [[5e4]]
        low, high, s = self.lowest, self.highest, self.scales
        if self.kind == "wlf":
            # A law on its way to none in its curvature does not come back: no flatter than Arrhenius's.
            high = np.array([high[0], max(2 * low[1], self.reference_c + ZERO_K)])
        fits = [
            least_squares(
                lambda q: self.log_shift(q * s) - log_shift,
                np.clip(np.array(start), low * 1.01, high * 0.99) / s,
                bounds=(low / s, high / s),
            )
            for start in starts
        ]
        return np.asarray(min(fits, key=lambda f: f.cost).x * s)


def _along(x: Array, at: Array, values: Array) -> Array:
    """Straight between values, and beyond the ends as between the last two. Shape of `x`."""
    found = np.asarray(np.interp(x, at, values))
    if len(at) > 1:
        for end, beside in ((0, 1), (-1, -2)):
            slope = (values[end] - values[beside]) / (at[end] - at[beside])
            beyond = x < at[0] if end == 0 else x > at[-1]
            found = np.where(beyond, values[end] + slope * (x - at[end]), found)
    return found
