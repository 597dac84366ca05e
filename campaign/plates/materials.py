"""Cores of solids: fractional Zener as a fit starts with, and others.

Maxwell series, Havriliak-Negami, and a table made from a broad spectrum of relaxation times.
"""

import numpy as np

from campaign.draws import log_uniform
from campaign.law import TrueLaw
from fitting.arrays import Array

KINDS = ("fractional-zener", "maxwell", "havriliak-negami", "table")
STORAGE_PA = (0.2e6, 5e6)
LOSS = (0.15, 1.2)
"""What damping layers have where they are of use."""
_MOST_DRAWS = 200_000
"""Few keep within the limits of a wide band."""
_CHECKED = 25
"""Frequencies of a band at which the limits are looked at: laws are smooth."""
_SOFT_PA, _RISE = (0.1e6, 0.8e6), (6, 80)
"""g0, and ginf over it: wider than what the limits let through, so that these decide."""
_AT_REST_PA = (0.15e6, 0.8e6)
"""The same of a series or a spectrum."""
_ZENER_ABOVE, _ZENER_ALPHA = (1.5, 40), (0.45, 0.97)
"""1/tau over the middle of the band, and the exponent: broad transitions to almost single relaxations."""
_HN_ABOVE, _HN_ALPHA, _HN_BETA = (0.3, 20), (0.45, 0.95), (0.25, 0.75)
"""The same of Havriliak and Negami; beta well off one, where it would be a fractional Zener."""
_ELEMENTS, _SLOWEST, _FASTEST = (3, 6), (0.05, 0.2), (15, 60)
"""Of a Maxwell series: how many, and 1/tau of the outer ones over the middle of the band."""
_FIRST_PA, _LAST_PA = (0.05e6, 0.3e6), (0.8e6, 8e6)
"""Moduli of these two."""


def draw_law(rng: np.random.Generator, band_hz: tuple[float, float], kind: str | None = None) -> TrueLaw:
    """A law whose G' and eta keep within `STORAGE_PA` and `LOSS` over a band.

    Half are fractional Zener where no kind is asked for. Raises `ArithmeticError` where it finds none.
    """
    if kind is None:
        kind = KINDS[0] if rng.random() < 0.5 else str(rng.choice(KINDS[1:]))
    f = np.geomspace(*band_hz, _CHECKED)
    for _ in range(_MOST_DRAWS):
        law = _DRAWS[kind](rng, float(np.sqrt(band_hz[0] * band_hz[1])))
        if fits(law, f):
            return law
    raise ArithmeticError(f"no {kind} keeps within the limits over {band_hz[0]:.4g} to {band_hz[1]:.4g} Hz")


def fits(law: TrueLaw, frequency_hz: Array) -> bool:
    """Whether G' and eta keep within the limits of the campaign. Shape (n,)."""
    G = law.modulus(2 * np.pi * frequency_hz)
    eta = G.imag / G.real
    storage = STORAGE_PA[0] < G.real.min() and G.real.max() < STORAGE_PA[1]
    return bool(storage and LOSS[0] < eta.min() and eta.max() < LOSS[1])


def _zener(rng: np.random.Generator, middle_hz: float) -> TrueLaw:
    g0 = log_uniform(rng, *_SOFT_PA)
    tau = 1 / (2 * np.pi * middle_hz * log_uniform(rng, *_ZENER_ABOVE))
    return TrueLaw(
        "fractional-zener", (g0, g0 * log_uniform(rng, *_RISE), tau, float(rng.uniform(*_ZENER_ALPHA)))
    )


def _maxwell(rng: np.random.Generator, middle_hz: float) -> TrueLaw:
    count = int(rng.integers(*_ELEMENTS))
    slow, fast = log_uniform(rng, *_SLOWEST), log_uniform(rng, *_FASTEST)
    tau = 1 / (2 * np.pi * middle_hz * np.geomspace(slow, fast, count))
    tau = tau * np.exp(rng.uniform(-0.3, 0.3, count))
    # Faster elements are stiffer, as in any transition towards glass.
    g_inf = log_uniform(rng, *_AT_REST_PA)
    first, last = log_uniform(rng, *_FIRST_PA), log_uniform(rng, *_LAST_PA)
    g = np.geomspace(first, last, count) * np.exp(rng.uniform(-0.4, 0.4, count))
    pairs = np.column_stack([g, tau]).ravel()
    return TrueLaw("maxwell", (g_inf, *(float(v) for v in pairs)))


def _havriliak_negami(rng: np.random.Generator, middle_hz: float) -> TrueLaw:
    g0 = log_uniform(rng, *_SOFT_PA)
    tau = 1 / (2 * np.pi * middle_hz * log_uniform(rng, *_HN_ABOVE))
    alpha, beta = float(rng.uniform(*_HN_ALPHA)), float(rng.uniform(*_HN_BETA))
    return TrueLaw("havriliak-negami", (g0, g0 * log_uniform(rng, *_RISE), tau, alpha, beta))


def _table(rng: np.random.Generator, middle_hz: float) -> TrueLaw:
    """From a spectrum of two broad humps of relaxation times, read at 25 frequencies."""
    rate = np.geomspace(1e-3, 1e4, 120) * 2 * np.pi * middle_hz
    x = np.log10(rate / (2 * np.pi * middle_hz))
    humps = [(rng.uniform(-1.5, 0.2), rng.uniform(0.3, 0.9), log_uniform(rng, 0.01e6, 0.2e6))]
    humps += [(rng.uniform(0.6, 2.0), rng.uniform(0.4, 1.0), log_uniform(rng, 0.2e6, 4e6))]
    spectrum = sum((size * np.exp(-(((x - at) / wide) ** 2) / 2) for at, wide, size in humps), np.zeros(120))
    f = np.geomspace(0.02, 50, 25) * middle_hz
    s = 2j * np.pi * f[:, None] / rate
    G = log_uniform(rng, *_AT_REST_PA) + (s / (1 + s)) @ (spectrum * np.log(rate[1] / rate[0]))
    return TrueLaw("table", (*f.tolist(), *G.real.tolist(), *(G.imag / G.real).tolist()))


_DRAWS = {
    "fractional-zener": _zener,
    "maxwell": _maxwell,
    "havriliak-negami": _havriliak_negami,
    "table": _table,
}
