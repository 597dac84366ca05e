"""Least squares complex frequency: common-denominator poles at rising orders, kept where stable.

H = B(z)/A(z) in z = e^{i omega dt} over a band, coefficients of A complex and common to all channels, the
last of them one. A pole is stable where it returns in the next orders within 0.5 % in frequency
and 5 % in damping; the mode is the median of its longest such row.

Source: Peeters, Van der Auweraer, Guillaume, Leuridan, Shock and Vibration 11 (2004) 395.
"""

import numpy as np

from fitting.arrays import Complex
from fitting.modal.attempt import refusing
from fitting.modal.frf import DampingEstimate, Frf, Refusal, corrected

ORDERS = tuple(range(2, 25))
"""Twice as many poles as the modes a band of a hammer test holds, and some for its edges."""
FREQUENCY_STABLE = 0.005
"""Half of what stabilisation diagrams usually take: light damping fixes a frequency far better than 1 %."""
RATIO_STABLE = 0.05
"""As stabilisation diagrams usually take."""
FEWEST_ORDERS = 5
"""Poles of noise move from order to order; so long a row of them is rare."""
_FEWEST_LINES = 8
"""Below, the lowest order has hardly more data than coefficients."""
_MOST_RATIO = 0.5
"""Of critical damping: beyond, a pole describes a trend of the band and no resonance."""


def lscf_poles(frfs: list[Frf]) -> list[Complex]:
    """Decaying poles in rad/s at every order; all channels on the same lines. Shape (poles,) each."""
    f = frfs[0].frequency_hz
    if len(f) < _FEWEST_LINES:
        return []
    orders = tuple(n for n in ORDERS if 2 * (n + 1) <= len(f))
    low, high = float(f[0]), float(f[-1])
    # The band mapped onto half a circle: well conditioned however narrow it is.
    dt = 0.49 / (high - low)
    z = np.exp(-2j * np.pi * (f - low) * dt)
    P = z[:, None] ** np.arange(max(orders, default=0) + 1)
    Q, _ = np.linalg.qr(P)
    # The numerators go out by projection: lower orders use the leading columns of the same Q.
    products = [(Y.conj().T @ Y, Q.conj().T @ Y) for Y in (frf.H[:, None] * P for frf in frfs)]
    return [_poles_of_order(products, n, low, high, dt) for n in orders]


def _poles_of_order(
    products: list[tuple[Complex, Complex]], n: int, low: float, high: float, dt: float
) -> Complex:
    M = np.zeros((n + 1, n + 1), dtype=complex)
    for YY, QY in products:
        inside = QY[: n + 1, : n + 1]
        M += YY[: n + 1, : n + 1] - inside.conj().T @ inside
    a = np.append(-np.linalg.lstsq(M[:n, :n], M[:n, n], rcond=None)[0], 1.0)
    roots = np.roots(a[::-1])
    s = -np.log(roots[np.abs(roots) > 1e-12]) / dt
    # Modulo 2 pi / dt; the band begins at `low`.
    s = s.real + 1j * (np.mod(s.imag, 2 * np.pi / dt) + 2 * np.pi * low)
    return np.asarray(s[(s.real < 0) & (s.imag > 2 * np.pi * low) & (s.imag < 2 * np.pi * high)])


@refusing
def lscf(
    poles: list[Complex], near_hz: float, added_decay_1_s: float, within_hz: float
) -> DampingEstimate | Refusal:
    """The stable mode nearest to `near_hz`, within `within_hz` of it.

    `poles` as `lscf_poles` gives them, shape (poles,) each.
    """
    row: list[complex] = []
    best: list[complex] = []
    for found in poles:
        candidates = found[np.abs(np.abs(found) / (2 * np.pi) - near_hz) <= within_hz]
        candidates = candidates[-candidates.real < _MOST_RATIO * np.abs(candidates)]
        if len(candidates) == 0:
            row = []
            continue
        pole = complex(candidates[np.argmin(np.abs(np.abs(candidates) / (2 * np.pi) - near_hz))])
        row = [*row, pole] if row and _stable(row[-1], pole) else [pole]
        best = max(best, row, key=len)
    if len(best) < FEWEST_ORDERS:
        return Refusal(f"stable over {len(best)} orders, expected {FEWEST_ORDERS} or more")
    omega_n = np.abs(best)
    ratios = np.array([-p.real / abs(p) for p in best])
    f_n = float(np.median(omega_n) / (2 * np.pi))
    own = corrected(f_n, float(np.median(ratios)), added_decay_1_s)
    return DampingEstimate(*own, float(np.std(ratios)))


def _stable(before: complex, now: complex) -> bool:
    ratio_before, ratio = -before.real / abs(before), -now.real / abs(now)
    return abs(abs(now) / abs(before) - 1) < FREQUENCY_STABLE and abs(ratio / ratio_before - 1) < RATIO_STABLE
