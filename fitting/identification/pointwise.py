"""G* without a law: at each frequency the modulus that explains the phasors there.

A phasor is two numbers and so is G*, and the response is analytic in G*. Within a narrow band the modulus is
a law's, times one complex factor,

    G(w) = G_law(w) exp(u),    sum_k |v(w_k, G(w_k)) - v_k|^2 / sigma_k^2  least

so that points of several levels and passes count by what each of them knows, and the law gives no more than
the slope inside the band. A band of one frequency is an exact inversion. Noise that is the same in both parts
of v is so in both parts of G*, and leaves no bias of second order: the mean of an analytic function over such
noise is its value.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.data.noise import Noise
from fitting.errors import TooFewPoints
from fitting.identification.model import velocity
from fitting.identification.pointwise_roots import APART, BandMinima, BandProblem, VelocityOf, nearest_root
from fitting.laws import CoreLaw
from fitting.numerics.chances import chi2_above, chi2_median
from fitting.reduced.rational import RationalSweep
from fitting.specimen import Reading
from fitting.sweep import Sweep

BANDS_AN_OCTAVE = 24.0
"""Narrow enough for a modulus that is constant over a band: laws turn over an octave or more. A choice."""
LARGEST_ERROR = 0.25
"""Standard error over |G*| beyond which a band says nothing; first order is then no longer true either."""
_CHANCE = 1e-3
"""Probability below which the points of a band disagree by more than their noise."""
_SOME_NOISE = 0.02
"""Of the reading, where it is not known: only to begin with."""
_BY_BAND = ("frequency_hz", "modulus", "noise_covariance", "relative_error", "determined", "points", "chi2")
NOT_CONVERGED = "Newton's method found no root near the law"
OTHER_ROOT = "another root is as near to the law"
NOISE_UNKNOWN = "the noise is not known and no band holds two points to show it"


@dataclass(frozen=True)
class PointwiseLaw:
    """G* band by band, ascending in frequency. Shapes (bands,) unless said."""

    frequency_hz: Array
    """Centre of the band's points, weighted by what they know."""
    modulus: Complex
    """Pa; NaN where nothing was found."""
    noise_covariance: Array
    """Of G' and G'' by noise, independent from band to band, Pa^2. Shape (bands, 2, 2)."""
    common: Array
    """Change of G' and G'' per standard deviation of a common nuisance, Pa. Shape (nuisances, bands, 2)."""
    relative_error: Array
    """Standard error over |G*|, here or at the law, whichever is larger: how far first order has to hold."""
    determined: NDArray[np.bool_]
    reasons: tuple[str, ...]
    """Why a band is not determined; empty where it is."""
    points: NDArray[np.intp]
    chi2: Array
    """What a band's points leave over, by the noise as known, on 2 (points - 1) degrees of freedom."""

    def __len__(self) -> int:
        return len(self.frequency_hz)

    @property
    def storage_modulus_pa(self) -> Array:
        """G'."""
        return self.modulus.real

    @property
    def loss_factor(self) -> Array:
        """G''/G'."""
        return self.modulus.imag / self.modulus.real

    @property
    def covariance(self) -> Array:
        """Of G' and G'' in each band, noise and nuisances, Pa^2. Shape (bands, 2, 2)."""
        return self.noise_covariance + np.einsum("nbi,nbj->bij", self.common, self.common)

    @property
    def storage_modulus_standard_error_pa(self) -> Array:
        """Noise and nuisances."""
        return np.sqrt(self.covariance[:, 0, 0])

    @property
    def loss_factor_standard_error(self) -> Array:
        """Noise and nuisances, first order."""
        # d eta = (dG'' - eta dG') / G'
        gradient = (
            np.stack([-self.loss_factor, np.ones(len(self))], axis=-1) / self.storage_modulus_pa[:, None]
        )
        return np.sqrt(np.einsum("bi,bij,bj->b", gradient, self.covariance, gradient))

    def take(self, bands: NDArray[np.bool_]) -> "PointwiseLaw":
        """Some of the bands."""
        return replace(
            self,
            common=self.common[:, bands],
            reasons=tuple(r for r, is_in in zip(self.reasons, bands, strict=True) if is_in),
            **{name: getattr(self, name)[bands] for name in _BY_BAND},
        )

    def known(self, error: float = LARGEST_ERROR) -> "PointwiseLaw":
        """The bands that are determined, |G*| to `error` or better."""
        return self.take(self.determined & (self.relative_error <= error))


def velocity_of_sweep(sweep: Sweep, rational: RationalSweep, reads: Reading) -> VelocityOf:
    """The plate's velocity at a sweep's points; `rational` holds every frequency of it, ascending."""
    at = rational.at(np.searchsorted(rational.omega, sweep.omega * (1 - 1e-12)))

    def velocity_of(G: Complex) -> tuple[Complex, Complex]:
        x, dx = at.with_derivative(G)
        scale = sweep.commanded_m_s2
        return velocity(at.omega, x, reads) * scale, 1j * at.omega * dx * scale

    return velocity_of


def phase_is_kept(sweep: Sweep) -> None:
    """Raises `TooFewPoints` for amplitudes."""
    if not sweep.has_phase:
        raise TooFewPoints(
            f"{len(sweep)} amplitudes without phase, expected phasors: "
            "G* at a frequency is two numbers and an amplitude is one"
        )


def pointwise_law(
    sweep: Sweep,
    noise: Noise,
    velocity_of: VelocityOf,
    law: CoreLaw,
    nuisances: Complex | None = None,
    bands_an_octave: float | None = BANDS_AN_OCTAVE,
) -> PointwiseLaw:
    """Invert a sweep of phasors band by band, from `law` on.

    `nuisances`: change of the predicted velocity per standard deviation of what all points share, m/s, shape
    (nuisances, points). `bands_an_octave` None takes only points of the same frequency together. Raises
    `TooFewPoints` for amplitudes.
    """
    phase_is_kept(sweep)
    which = _bands_of(sweep.frequency_hz, bands_an_octave)
    dv = np.zeros((0, len(sweep)), complex) if nuisances is None else np.asarray(nuisances)

    def problem_with(std: Array) -> BandProblem:
        G_law, count = law.modulus(sweep.omega), int(which.max()) + 1
        return BandProblem(velocity_of, G_law, sweep.response_m_s, std, which, count)

    std = noise.std_m_s
    if not noise.is_known:
        std = std * _noise_seen(problem_with(_SOME_NOISE * std)) * _SOME_NOISE
    shown = bool(np.isfinite(std).all())
    problem = problem_with(std if shown else noise.std_m_s * _SOME_NOISE)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        return _found(problem, nearest_root(problem), law, sweep.omega, dv, noise_is_known=shown)


def _found(
    problem: BandProblem, root: BandMinima, law: CoreLaw, omega: Array, dv: Complex, *, noise_is_known: bool
) -> PointwiseLaw:
    """The modulus and its errors at the roots, and which of them to believe."""
    J = problem.sensitivity(root.u)
    # Neither the centre nor the law's slope around it may follow the noise of what was found.
    weight = np.abs(problem.sensitivity(np.zeros(problem.count, complex))) ** 2
    here, at_law = problem.summed(np.abs(J) ** 2), problem.summed(weight)
    centre = np.exp(problem.summed(weight * np.log(omega)) / at_law)
    # No modulus where no root was found: a number there would be taken for one.
    modulus = np.where(root.converged, law.modulus(centre) * np.exp(root.u), np.nan)
    # The prediction moves by dv, so what is found moves by -J^+ dv.
    shifts = [-problem.step(J, d / problem.std) for d in dv]
    moved = np.array(shifts).reshape(len(dv), problem.count)
    scale = _scatter_beyond_noise(root.chi2, 2 * (problem.points - 1)) if noise_is_known else np.nan
    # Where noise alone might lead from the law to here, the law's sensitivity is the one without noise.
    by_law = np.abs(root.u) < APART * np.sqrt(scale / at_law)
    variance = scale * np.abs(modulus) ** 2 / np.where(by_law, at_law, here)
    # Noise may carry a band that knows nothing to where the response is steep.
    error = np.sqrt(scale / np.minimum(here, at_law) + np.sum(np.abs(moved) ** 2, axis=0) / 2)
    reasons = tuple(_reason(*each) for each in zip(root.converged, root.is_alone, error, strict=True))
    return PointwiseLaw(
        frequency_hz=centre / (2 * np.pi),
        modulus=modulus,
        noise_covariance=variance[:, None, None] * np.eye(2),
        common=np.stack([(moved * modulus).real, (moved * modulus).imag], axis=-1),
        relative_error=error,
        determined=np.array([not r for r in reasons]),
        reasons=reasons,
        points=problem.points,
        chi2=root.chi2,
    )


def _reason(converged: bool, alone: bool, error: float) -> str:
    """Why a band says nothing, or empty."""
    if not converged:
        return NOT_CONVERGED
    if np.isnan(error):
        return NOISE_UNKNOWN
    if not error <= LARGEST_ERROR:
        return f"sensitivity too low: standard error {error:.0%} of |G*| (limit {LARGEST_ERROR:.0%})"
    return "" if alone else OTHER_ROOT


def _noise_seen(problem: BandProblem) -> float:
    """Factor on the standard deviation by which points of a usual band disagree; NaN where none holds two."""
    root, dof = nearest_root(problem), 2 * (problem.points - 1)
    shown = (dof > 0) & root.converged
    if not shown.any():
        return float("nan")
    # The median: a band at a wrong minimum must not make all the others noisy.
    return float(np.sqrt(np.median(root.chi2[shown] / chi2_median(dof[shown]))))


def _scatter_beyond_noise(chi2: Array, dof: NDArray[np.intp]) -> Array:
    """Factor on the variance of each band: one, but where its points disagree beyond chance."""
    too_much = (dof > 0) & (chi2_above(chi2, np.maximum(dof, 1)) < _CHANCE)
    return np.where(too_much, chi2 / np.maximum(dof, 1), 1.0)


def _bands_of(frequency_hz: Array, bands_an_octave: float | None) -> NDArray[np.intp]:
    """Number of each point's band, ascending and without gaps. Shape (points,)."""
    # To twelve digits: the same frequency read twice from a file.
    octaves = np.round(np.log2(frequency_hz), 12)
    place = octaves if bands_an_octave is None else np.floor(octaves * bands_an_octave)
    return np.asarray(np.unique(place, return_inverse=True)[1].ravel(), dtype=np.intp)
