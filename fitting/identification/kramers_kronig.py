"""Whether G' and eta, found apart from each other, belong to one causal core.

Kramers and Kronig's integrals need all frequencies; a few bands have none beyond their ends. What every
relaxing core has instead is a spectrum of relaxation times without negative weights (Ferry, Viscoelastic
Properties of Polymers, ch. 3),

    G*(w) = G_0 + sum_k G_k i w tau_k / (1 + i w tau_k),   G_0, G_k >= 0

causal and passive whatever the weights. The best such series, fitted to G' and G'' jointly, leaves the noise
of a core that is one; times far outside the band stand for what is not measured there.

The test is as good as its covariance. Errors common to the bands (the substrate's stiffness, the gain) move
G' and G'' of all of them together and look like no core at all if taken for noise: the residual is whitened
with noise and nuisances as one matrix.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import nnls

from fitting.arrays import Array, Complex
from fitting.errors import TooFewPoints
from fitting.identification.pointwise import PointwiseLaw
from fitting.numerics.chances import chi2_above

LEVEL = 0.01
"""Probability by chance below which the core is said not to be causal."""
FIRST_ORDER = 0.1
"""Standard error over |G*| above which errors are no longer Gaussian enough for a tail probability."""
MOST_PULL = 3.5
"""Standard deviations of a common nuisance: one beyond them in two thousand is chance."""
FEWEST_BANDS = 3
"""Six numbers for a static modulus and relaxation times: fewer can hardly contradict."""
_BEYOND = 1e3
"""Relaxation times reach this far beyond the band."""
_NEAR = 10.0
"""A decade to either side of the band is where relaxation shapes what is seen inside it."""
_DENSE, _SPARSE = 20, 4
"""Times a decade near the band and far from it."""
_PASSES = 4
"""Times the weights are made anew from the smooth curve. A choice."""
_FAR_OFF = 0.5
"""Of a modulus: a smooth curve further from what was found lends no weight to it. A choice."""
_STEPS_A_WEIGHT = 50
"""Iterations of the non-negative least squares, at most: the library gives up after three a weight."""
_TINY = 1e-12
"""Below it a tail probability is only said to be below."""


@dataclass(frozen=True)
class KramersKronig:
    """How well one relaxing core explains G' and eta together."""

    consistent: bool
    """Not refuted: neither chance below `LEVEL` nor a nuisance beyond `MOST_PULL`."""
    p_value: float
    """Probability of a chi-square as large by chance; NaN without a degree of freedom."""
    chi2: float
    dof: int
    """Two a band less the relaxation times that took part."""
    frequency_hz: Array
    """Bands that took part. Shape (bands,)."""
    smooth: Complex
    """The causal series there, Pa. Shape (bands,)."""
    long_time_pa: float
    weights_pa: Array
    """Shape (times,), as the next."""
    tau_s: Array
    pulls: Array
    """Common nuisances the series asks for, in their standard deviations. Shape (nuisances,).

    One chi-square over all bands may hide one that is stretched: beyond `MOST_PULL` is a refusal of its own.
    """
    words: str

    @property
    def chi2_per_dof(self) -> float:
        """NaN without a degree of freedom."""
        return self.chi2 / self.dof if self.dof > 0 else float("nan")

    def modulus(self, omega: Array) -> Complex:
        """The causal series at `omega` in rad/s, Pa. Shape of `omega`."""
        return np.asarray(_series(omega, self.tau_s) @ np.r_[self.long_time_pa, self.weights_pa])


def kramers_kronig(law: PointwiseLaw) -> KramersKronig:
    """Test the determined bands of `law` whose errors are small enough for first order.

    Raises `TooFewPoints` where fewer than three are.
    """
    used = law.known(FIRST_ORDER)
    if len(used) < FEWEST_BANDS:
        raise TooFewPoints(
            f"{len(used)} of {len(law)} bands know G* to {FIRST_ORDER:.0%}, a test of causality needs "
            f"{FEWEST_BANDS}: measure more resonances, or with less noise"
        )
    omega = 2 * np.pi * used.frequency_hz
    tau_s = _times(omega)
    A = _series(omega, tau_s)
    smooth, size = used.modulus, np.abs(used.modulus)
    for _ in range(_PASSES):
        # Errors in per cent of a noisy value would favour what noise made small: per cent of the smooth one.
        C, J = _errors(used, smooth)
        weights, left_over = _whitened_nnls(A / size[:, None], used.modulus / size, C)
        smooth = A @ weights
    dof = 2 * len(used) - int(np.count_nonzero(weights))
    chi2 = left_over**2
    p = float(chi2_above(chi2, dof)) if dof > 0 else float("nan")
    pulls = J @ np.linalg.solve(C, _stacked((used.modulus - smooth) / size))
    stretched = bool(np.any(np.abs(pulls) > MOST_PULL))
    return KramersKronig(
        consistent=not (p < LEVEL or stretched),
        p_value=p,
        chi2=chi2,
        dof=dof,
        frequency_hz=used.frequency_hz,
        smooth=smooth,
        long_time_pa=float(weights[0]),
        weights_pa=weights[1:],
        tau_s=tau_s,
        pulls=pulls,
        words=_words(used, smooth, chi2, dof, p, pulls),
    )


def _times(omega: Array) -> Array:
    """Relaxation times from well below to well above the band, dense near it. Shape (times,)."""
    low, high = 1 / omega.max(), 1 / omega.min()
    ends = [low / _BEYOND, low / _NEAR, high * _NEAR, high * _BEYOND]
    parts = [
        np.geomspace(a, b, int(np.ceil(n * np.log10(b / a))), endpoint=False)
        for a, b, n in zip(ends, ends[1:], (_SPARSE, _DENSE, _SPARSE), strict=False)
    ]
    return np.concatenate([*parts, ends[-1:]])


def _series(omega: Array, tau_s: Array) -> Complex:
    """Contribution of a unit of each weight, the spring first. Shape (..., 1 + times)."""
    s = 1j * np.multiply.outer(omega, tau_s)
    return np.concatenate([np.ones((*np.shape(omega), 1)), s / (1 + s)], axis=-1)


def _stacked(z: Complex) -> Array:
    """All G', then all G''. Shape (..., bands) to (..., 2 bands)."""
    return np.concatenate([z.real, z.imag], axis=-1)


def _errors(law: PointwiseLaw, smooth: Complex) -> tuple[Array, Array]:
    """Covariance of G' and G'' over |G*| and the nuisances' share in it.

    Shapes (2 bands, 2 bands), (nuisances, 2 bands).
    """
    ratio = smooth / law.modulus
    # Far from what was found, no core explains it, and there is nothing to be taken from it.
    q = np.where(np.abs(ratio - 1) < _FAR_OFF, ratio, 1) / np.abs(law.modulus)
    turn = np.moveaxis(np.array([[q.real, -q.imag], [q.imag, q.real]]), -1, 0)
    noise = turn @ law.noise_covariance @ turn.transpose(0, 2, 1)
    J = _stacked((law.common @ np.array([1, 1j])) * q)
    rows = [[np.diag(noise[:, i, k]) for k in range(2)] for i in range(2)]
    return np.block(rows) + J.T @ J, J


def _whitened_nnls(A: Complex, b: Complex, C: Array) -> tuple[Array, float]:
    """Non-negative weights and the norm of what they leave, whitened by the covariance."""
    both = _stacked(np.concatenate([A.T, b[None]])).T
    try:
        root = np.linalg.cholesky(C)
    except np.linalg.LinAlgError:
        why = "the bands carry no noise of their own: nothing to test causality against"
        raise TooFewPoints(why) from None
    whitened = solve_triangular(root, both, lower=True)
    scale = np.linalg.norm(whitened[:, :-1], axis=0)
    x, left_over = nnls(whitened[:, :-1] / scale, whitened[:, -1], maxiter=_STEPS_A_WEIGHT * len(scale))
    return np.asarray(x / scale), float(left_over)


def _words(law: PointwiseLaw, smooth: Complex, chi2: float, dof: int, p: float, pulls: Array) -> str:
    if dof <= 0:
        return f"{len(law)} bands are too few to say whether G' and eta belong to one causal core."
    shown = f"p = {p:.2g}" if p > _TINY else f"p < {_TINY:g}"
    numbers = f"chi-square {chi2 / dof:.3g} a degree of freedom over {len(law)} bands, {shown}"
    if p < LEVEL:
        error = np.sqrt(np.trace(law.covariance, axis1=1, axis2=2) / 2)
        k = int(np.argmax(np.abs(law.modulus - smooth) / error))
        found, core = (
            f"eta {G.imag / G.real:.3g} and G' {G.real / 1e6:.3g} MPa" for G in (law.modulus[k], smooth[k])
        )
        return (
            f"G' and eta do not agree with one causal, relaxing core ({numbers}): {found} at "
            f"{law.frequency_hz[k]:.4g} Hz, where such a core has {core}; the plate's model lacks something "
            "there, or the core changed in between."
        )
    furthest = float(np.max(np.abs(pulls), initial=0))
    if furthest > MOST_PULL:
        return (
            "G' and eta agree with one causal, relaxing core only if a stated tolerance is off by "
            f"{furthest:.2g} standard deviations ({numbers}): look at the tolerances, or at what the "
            "plate's model lacks."
        )
    return f"G' and eta agree with one causal, relaxing core ({numbers})."
