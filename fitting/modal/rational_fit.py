"""Local rational fit: poles and smooth remainder in a window of lines about a mode.

    H(omega) = sum_m R_m/(i omega - lambda_m) + c_0 + c_1 (omega - omega_0)

On the lines of a plain (not padded) transform of a decay cut off at T, every mode keeps exactly its
pole: the cut multiplies its residue only. So truncation does no harm under a rectangular window.
The residues are linear: variable projection leaves the poles to a small least squares.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from fitting.arrays import Array, Complex
from fitting.modal.attempt import refusing
from fitting.modal.frf import DampingEstimate, Frf, Refusal, corrected, is_near

_HALF_WIDTH_LINES = 8
"""At least, on either side: 34 numbers for the 12 that two poles ask for."""
_HALF_WIDTH_BANDWIDTHS = 6.0
"""Half-power bandwidths on either side: there a mode is down to a twelfth of its height."""
_LEAST_HEIGHT = 6.0
"""Of a resonance over the scatter of a line: noise alone reaches 4."""
_MOST_LINES = 400
"""Of a window: more hold other modes rather than more of this one, and cost time."""
_MOST_RATIO = 0.3
"""Of critical damping: a wider pole is no longer told from the smooth remainder."""
_MOST_RELATIVE_ERROR = 0.15
"""Of a ratio: known worse than that it is refused, not reported."""


@dataclass(frozen=True)
class RationalFit:
    """The fit about one mode, for drawing and judging."""

    frequency_hz: Array
    H: Complex
    """Fitted response on the window's lines."""
    poles: Complex
    """rad/s, the mode's own first."""
    noise: float
    """Standard deviation of a line about the fit, each part."""
    estimate: DampingEstimate


@refusing
def rational_fit(
    frf: Frf, near_hz: float, start_ratio: float, neighbours_hz: tuple[float, ...] = ()
) -> RationalFit | Refusal:
    """Fit the mode near `near_hz`; other modes that fall into its window get poles of their own."""
    step = float(np.median(np.diff(frf.frequency_hz)))
    reach = max(_HALF_WIDTH_LINES * step, _HALF_WIDTH_BANDWIDTHS * 2 * start_ratio * near_hz)
    reach = min(reach, _MOST_LINES / 2 * step)
    window = frf.between(near_hz - reach, near_hz + reach)
    inside = [f for f in neighbours_hz if abs(f - near_hz) < reach * 1.2 and f != near_hz]
    starts = [near_hz, *inside]
    unknowns = 2 * (2 * len(starts) + 2)
    if 2 * len(window.H) < unknowns + 4:
        return Refusal(
            f"{len(window.H)} lines about the mode, expected more than {unknowns // 2 + 2} "
            f"for {len(starts)} poles"
        )
    omega = window.omega
    start = np.array([complex(-max(start_ratio, 1e-4) * 2 * np.pi * f, 2 * np.pi * f) for f in starts])
    scale = float(np.abs(start[0].real))
    found = least_squares(
        lambda p: _stack(_remainder(omega, window.H, _poles(p, start, scale))),
        np.zeros(2 * len(start)),
        jac=lambda p: scale * _jacobian(omega, window.H, _poles(p, start, scale)),
        x_scale="jac",
        xtol=1e-12,
        ftol=1e-12,
        max_nfev=200,
    )
    poles = _poles(found.x, start, scale)
    own = complex(poles[0])
    omega_n = abs(own)
    ratio = -own.real / omega_n
    dof = 2 * len(window.H) - unknowns
    noise = float(np.sqrt(2 * found.cost / dof))
    if not 0 < ratio < _MOST_RATIO or not is_near(omega_n / (2 * np.pi), near_hz):
        return Refusal("the fit found no decaying pole at the peak")
    covariance = noise**2 * np.linalg.pinv(found.jac.T @ found.jac)
    # zeta = -Re/|lambda|: with Re << |lambda| its error is that of the real part
    error = float(scale * np.sqrt(covariance[0, 0]) / omega_n)
    f_n = omega_n / (2 * np.pi)
    adopted = corrected(f_n, ratio, frf.added_decay_1_s)
    if not error <= _MOST_RELATIVE_ERROR * abs(adopted):
        return Refusal(f"its own standard error is {100 * error / abs(adopted):.0f} % of the ratio")
    height = float(np.abs(_coefficients(omega, window.H, poles)[0]))
    if height < _LEAST_HEIGHT * noise:
        return Refusal(f"it stands only {height / noise:.1f} times above the scatter of the lines")
    fitted = window.H - _remainder(omega, window.H, poles)
    return RationalFit(window.frequency_hz, fitted, poles, noise, DampingEstimate(f_n, adopted, error))


def _poles(p: Array, start: Complex, scale: float) -> Complex:
    n = len(start)
    return np.asarray(start + scale * (p[:n] + 1j * p[n:]))


def _remainder(omega: Array, H: Complex, poles: Complex) -> Complex:
    """What residues and background, chosen best, leave of H."""
    Q, _ = np.linalg.qr(_columns(omega, poles))
    return np.asarray(H - Q @ (Q.conj().T @ H))


def _coefficients(omega: Array, H: Complex, poles: Complex) -> Complex:
    """Heights of the resonances at their poles, then the background."""
    Q, R = np.linalg.qr(_columns(omega, poles))
    return np.asarray(np.linalg.solve(R, Q.conj().T @ H))


def _jacobian(omega: Array, H: Complex, poles: Complex) -> Array:
    """Kaufman's: the columns' change, residues kept, projected. To the poles' real, then imaginary parts."""
    Q, _ = np.linalg.qr(_columns(omega, poles))
    c = _coefficients(omega, H, poles)[: len(poles)]
    change = -(c * np.abs(poles.real) / (1j * omega[:, None] - poles) ** 2)
    change = change - Q @ (Q.conj().T @ change)
    both = np.hstack([change, 1j * change])
    return np.concatenate([both.real, both.imag])


def _columns(omega: Array, poles: Complex) -> Complex:
    t = (omega - omega.mean()) / ((omega[-1] - omega[0]) / 2)
    resonances = np.abs(poles.real) / (1j * omega[:, None] - poles)
    return np.column_stack([resonances, np.ones_like(t), t])


def _stack(z: Complex) -> Array:
    return np.concatenate([z.real, z.imag])
