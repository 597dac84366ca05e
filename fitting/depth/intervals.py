"""Intervals by one method beside the linear ones, and what to make of it where they differ."""

from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array
from fitting.depth.quantities import Quantities
from fitting.numerics.chances import Z_95

LEVELS = {68: 1.0, 95: Z_95}
"""Percent, and how many standard deviations a normal distribution has there."""
_TAILS = {68: (15.8655, 84.1345), 95: (2.5, 97.5)}
"""Percentiles with as much on either side: 68.27 %, a normal distribution's standard deviation, and 95 %."""
TELLING = 0.2
"""Relative difference of an interval's half from the linear one, from which it is said."""


@dataclass(frozen=True)
class Intervals:
    """Of every quantity, in its own unit. Bounds by level in percent, NaN where open."""

    method: str
    names: tuple[str, ...]
    found: Array
    """Where the fit ended."""
    linear: dict[int, Array]
    bounds: dict[int, Array]

    @classmethod
    def of_logs(cls, method: str, quantities: Quantities, bounds: dict[int, Array]) -> "Intervals":
        """From bounds of the logarithms; linear ones from the fit's own covariance. Shape (quantities, 2)."""
        task = quantities.task
        at, slope = quantities.logs(task.mode), quantities.gradient(task.mode)
        error = np.linalg.norm(slope @ task.root, axis=1)
        linear = {
            level: np.exp(at)[:, None] * (1 + z * error[:, None] * np.array([-1, 1]))
            for level, z in LEVELS.items()
        }
        own = {level: np.exp(b) for level, b in bounds.items()}
        return cls(method, tuple(quantities.names), np.exp(at), linear, own)

    def off(self, level: int = 68) -> Array:
        """How far each half is from the linear one, relative. Shape (quantities, 2); infinite where open."""
        half = np.abs(self.bounds[level] - self.found[:, None])
        plain = np.abs(self.linear[level] - self.found[:, None])
        with np.errstate(invalid="ignore"):
            return np.where(np.isnan(half), np.inf, half / np.maximum(plain, 1e-300) - 1)

    @property
    def advice(self) -> str:
        """One line."""
        off = self.off()
        worst = np.max(np.abs(off), axis=1)
        telling = [k for k in np.argsort(-worst) if worst[k] > TELLING]
        if not telling:
            return f"linear errors and {self.method} agree within {100 * TELLING:g} %: the linear ones serve"
        said = []
        for k in telling[:3]:
            side = int(np.argmax(np.abs(off[k])))
            where = ("lower", "upper")[side]
            size = "is open" if np.isinf(off[k, side]) else f"{100 * off[k, side]:+.0f} %"
            said.append(f"{self.names[k]} ({where} {size})")
        more = f" and {len(telling) - 3} more" if len(telling) > 3 else ""
        return f"take the interval by {self.method}, not the linear error, for {', '.join(said)}{more}"


def of_draws(draws: Array) -> dict[int, Array]:
    """Equal-tailed bounds of draws. Shape (draws, quantities)."""
    return {level: np.percentile(draws, tails, axis=0).T for level, tails in _TAILS.items()}
