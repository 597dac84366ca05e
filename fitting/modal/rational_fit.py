"""Local rational fit: poles and smooth remainder in a window of lines about a mode.

    H(omega) = sum_m R_m/(i omega - lambda_m) + c_0 + c_1 (omega - omega_0) + ...

On the lines of a plain (not padded) transform of a decay cut off at T, every mode keeps exactly its
pole: the cut multiplies its residue only. So truncation does no harm under a rectangular window.
The residues are linear: variable projection leaves the poles to a small least squares.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander
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
_WIDEST = 0.6
"""Of a frequency on either side: below, a heavily damped mode's window meets the mirror pole's."""
FEWEST_TERMS, MOST_TERMS = 2, 6
"""Of the smooth remainder: about a mode of 5 % its neighbours' flanks want four or five."""
_CURVED_TERMS = 4
"""Of a remainder that neighbours outside the window bend."""
_WIDE = 0.15
"""Of a frequency on either side, from which a remainder is more than straight: a narrower one that is not has
a mode in it that nobody knows of, which a curve would take up in part."""
_SPARE = 4
"""Numbers more than unknowns, at least."""
_LIKE = 2.0
"""Half-power half bandwidths within which two fits have found one mode."""
_NOTHING = 1e-24
"""Of the lines' own sum of squares: what rounding leaves, which no term makes less."""
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
    heights: Array
    """Of the resonances at their poles. Shape (poles,)."""
    errors: Array
    """Standard errors of the poles' damping ratios, by the scatter of the lines. Shape (poles,)."""
    cost: float
    """n ln(sum of squares / n) + k ln n (Schwarz): the least of several fits to the same lines wins."""

    @property
    def ratios(self) -> Array:
        """Of critical damping, as the lines have them, windows not taken off. Shape (poles,)."""
        return np.asarray(-self.poles.real / np.abs(self.poles))

    @property
    def frequencies_hz(self) -> Array:
        """Undamped natural ones. Shape (poles,)."""
        return np.asarray(np.abs(self.poles) / (2 * np.pi))


@refusing
def rational_fit(
    frf: Frf,
    near_hz: float,
    start_ratio: float,
    neighbours_hz: tuple[float, ...] = (),
    most_terms: int = FEWEST_TERMS,
) -> RationalFit | Refusal:
    """Fit the mode near `near_hz`; other modes that fall into its window get poles of their own.

    About a heavily damped one the remainder gets as many terms as the lines ask for, up to `most_terms`; what
    one more would change is in the error. More than the fewest are for where all neighbours are known.
    """
    window, inside, is_wide = _about(frf, near_hz, start_ratio, neighbours_hz)
    starts = [near_hz, *inside]
    fits = list[_Fitted]()
    for terms in range(FEWEST_TERMS, (most_terms if is_wide else FEWEST_TERMS) + 1):
        unknowns = 2 * (2 * len(starts) + terms)
        if 2 * len(window.H) < unknowns + _SPARE:
            break
        fits.append(_fitted(window, starts, start_ratio, terms))
        if len(fits) > 2 and min(fits[-1].cost, fits[-2].cost) > fits[-3].cost:
            break
    if not fits:
        return Refusal(
            f"{len(window.H)} lines about the mode, expected more than {2 * len(starts) + FEWEST_TERMS + 2} "
            f"for {len(starts)} poles"
        )
    terms = int(np.argmin([f.cost for f in fits]))
    best = fits[terms]
    found = best.estimate(window)
    if not 0 < best.ratios[0] < _MOST_RATIO or not is_near(found.frequency_hz, near_hz):
        return Refusal("the fit found no decaying pole at the peak")
    for beyond in fits[terms + 1 : terms + 2]:
        if beyond.is_like(best):
            # What a term more would change is not in the scatter of the lines.
            found = found.off_by(beyond.estimate(window))
    known = found.standard_error / abs(found.ratio)
    if not known <= _MOST_RELATIVE_ERROR:
        return Refusal(f"its own standard error is {100 * known:.0f} % of the ratio")
    if best.heights[0] < _LEAST_HEIGHT * best.noise:
        return Refusal(
            f"it stands only {best.heights[0] / best.noise:.1f} times above the scatter of the lines"
        )
    return best.said(window, found)


@dataclass(frozen=True)
class Freer:
    """What follows the same lines more freely than one pole beside a straight line; neither is judged."""

    curved: RationalFit
    """One pole beside a curve."""
    two: RationalFit
    """Two poles near one another; the estimate is the first one's."""


@refusing
def freer_fits(
    frf: Frf, near_hz: float, start_ratio: float, neighbours_hz: tuple[float, ...] = ()
) -> Freer | Refusal:
    """Their cost beside that of `rational_fit` says what the lines ask for."""
    window, inside, _ = _about(frf, near_hz, start_ratio, neighbours_hz)
    if 2 * len(window.H) < 2 * (2 * (len(inside) + 2) + FEWEST_TERMS) + _SPARE:
        return Refusal(f"{len(window.H)} lines about the mode, too few for two")
    apart = start_ratio * near_hz
    places = ((-0.5, 0.5), (-1.5, 0.0), (0.0, 1.5))
    tried = (
        _fitted(window, [near_hz + x * apart for x in both] + inside, start_ratio, FEWEST_TERMS)
        for both in places
    )
    curved = _fitted(window, [near_hz, *inside], start_ratio, _CURVED_TERMS)
    two = min(tried, key=lambda fit: fit.cost)
    return Freer(*(fit.said(window, fit.estimate(window)) for fit in (curved, two)))


def _about(
    frf: Frf, near_hz: float, start_ratio: float, neighbours_hz: tuple[float, ...]
) -> tuple[Frf, list[float], bool]:
    """The window's lines, the neighbours that show in it, and whether it is a wide one."""
    step = float(np.median(np.diff(frf.frequency_hz)))
    reach = max(_HALF_WIDTH_LINES * step, _HALF_WIDTH_BANDWIDTHS * 2 * start_ratio * near_hz)
    reach = min(reach, _MOST_LINES / 2 * step)
    reach = max(min(reach, _WIDEST * near_hz), _HALF_WIDTH_LINES * step)
    inside = [f for f in neighbours_hz if abs(f - near_hz) < reach * 1.2 and f != near_hz]
    return frf.between(near_hz - reach, near_hz + reach), inside, reach > _WIDE * near_hz


@dataclass(frozen=True)
class _Fitted:
    """Poles beside a remainder of so many terms."""

    poles: Complex
    errors: Array
    """Of their real parts, rad/s."""
    frequency_errors: Array
    """Of their imaginary parts, rad/s."""
    heights: Array
    noise: float
    H: Complex
    cost: float

    @property
    def ratios(self) -> Array:
        return np.asarray(-self.poles.real / np.abs(self.poles))

    def estimate(self, window: Frf) -> DampingEstimate:
        """Of the first pole, what a window added taken off."""
        omega_n = float(abs(self.poles[0]))
        return DampingEstimate(
            *corrected(omega_n / (2 * np.pi), float(self.ratios[0]), window.added_decay_1_s),
            float(self.errors[0]) / omega_n,
            float(self.frequency_errors[0]) / (2 * np.pi),
        )

    def said(self, window: Frf, estimate: DampingEstimate) -> RationalFit:
        return RationalFit(
            window.frequency_hz,
            self.H,
            self.poles,
            self.noise,
            estimate,
            self.heights,
            self.errors / np.abs(self.poles),
            self.cost,
        )

    def is_like(self, other: "_Fitted") -> bool:
        """Whether it is the same mode: within a few bandwidths of the other's."""
        return abs(self.poles[0] - other.poles[0]) < _LIKE * abs(other.poles[0].real)


def _fitted(window: Frf, starts: Sequence[float], start_ratio: float, terms: int) -> _Fitted:
    omega, H = window.omega, window.H
    start = np.array([complex(-max(start_ratio, 1e-4) * 2 * np.pi * f, 2 * np.pi * f) for f in starts])
    scale = float(np.abs(start[0].real))
    # The search may end by its gradient, which has the unit of |H|^2: of 1e-6 m/N it ended where it began.
    # Of large numbers it never does.
    size = min(float(np.sqrt(np.mean(np.abs(H) ** 2))) or 1.0, 1.0)
    shape = H / size
    lines = _Lines(omega, shape, terms)
    found = least_squares(
        lambda p: _stack(lines.with_poles(_poles(p, start, scale)).left),
        np.zeros(2 * len(start)),
        jac=lambda p: scale * lines.with_poles(_poles(p, start, scale)).jacobian,
        x_scale="jac",
        xtol=1e-12,
        ftol=1e-12,
        max_nfev=200,
    )
    poles = _poles(found.x, start, scale)
    count, unknowns = 2 * len(H), 2 * (2 * len(start) + terms)
    left = float(np.sqrt(2 * found.cost / (count - unknowns)))
    # zeta = -Re/|lambda|: with Re << |lambda| its error is that of the real part.
    errors = scale * left * np.sqrt(np.diag(np.linalg.pinv(found.jac.T @ found.jac)))
    n = len(start)
    whole = _Lines(omega, H, terms).with_poles(poles)
    return _Fitted(
        poles,
        errors[:n],
        errors[n:],
        np.abs(whole.coefficients[:n]),
        left * size,
        H - whole.left,
        count * np.log(size**2 * max(2 * found.cost, _NOTHING * float(np.sum(np.abs(shape) ** 2))) / count)
        + unknowns * np.log(count),
    )


def _poles(p: Array, start: Complex, scale: float) -> Complex:
    n = len(start)
    return np.asarray(start + scale * (p[:n] + 1j * p[n:]))


class _Lines:
    """Lines to be followed by some poles and a polynomial, whose residues and coefficients are the best."""

    def __init__(self, omega: Array, H: Complex, terms: int) -> None:
        self.omega, self.H = omega, H
        t = (omega - omega.mean()) / ((omega[-1] - omega[0]) / 2)
        self.background = legvander(t, terms - 1)
        self._last: _Followed | None = None

    def with_poles(self, poles: Complex) -> "_Followed":
        """Kept until others are asked for: a fit asks what is left first, then how it changes."""
        if self._last is None or not np.array_equal(self._last.poles, poles):
            self._last = _Followed(self, poles)
        return self._last


class _Followed:
    """Lines as some poles follow them."""

    def __init__(self, lines: _Lines, poles: Complex) -> None:
        self.lines, self.poles = lines, poles
        resonances = np.abs(poles.real) / (1j * lines.omega[:, None] - poles)
        self._Q, self._R = np.linalg.qr(np.column_stack([resonances, lines.background]))
        self._along = self._Q.conj().T @ lines.H
        self.left: Complex = lines.H - self._Q @ self._along
        """What the fit leaves of the lines."""

    @property
    def coefficients(self) -> Complex:
        """Heights of the resonances at their poles, then the background."""
        return np.asarray(np.linalg.solve(self._R, self._along))

    @property
    def jacobian(self) -> Array:
        """Kaufman's: the columns' change, projected. To the poles' real, then imaginary parts."""
        poles, omega = self.poles, self.lines.omega
        c = self.coefficients[: len(poles)]
        change = -(c * np.abs(poles.real) / (1j * omega[:, None] - poles) ** 2)
        change = change - self._Q @ (self._Q.conj().T @ change)
        both = np.hstack([change, 1j * change])
        return np.concatenate([both.real, both.imag])


def _stack(z: Complex) -> Array:
    return np.concatenate([z.real, z.imag])
