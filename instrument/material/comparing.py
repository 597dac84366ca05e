"""Two laws over their common band: where they differ beyond what is known of both, and whether they do."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Array, Mask
from fitting.laws.bent_law import REACH
from fitting.numerics.chances import Z_95, chi2_above
from instrument.facts.comparison import ComparedAt, ComparedPair
from instrument.material.alike import alike_in
from instrument.material.found_law import MaterialLaw

LEVEL = 0.05
"""Of the p-value below which two laws differ as a whole."""
RESOLUTION = 1e-3
"""Relative difference that the models themselves allow: what is known better than this counts no more."""
_POINTS = 41
"""Of the common band: laws are smoother than that, and the statistic counts directions, not points."""


@dataclass(frozen=True)
class Comparison:
    """Of A and B; differences are B less A. Arrays have shape (frequencies,); NaN where nothing is known."""

    a: MaterialLaw
    b: MaterialLaw
    frequency_hz: Array
    """Empty without a common band."""
    storage_difference: Array
    """Relative to A."""
    storage_z: Array
    """In joint standard errors."""
    loss_factor_difference: Array
    loss_factor_z: Array
    joint_error: Array
    """Of ln G' at the frequencies, then of eta: standard errors of both. Shape (2 frequencies,)."""
    chi2: float
    dof: float
    p_value: float
    covariance: str
    """Whence the curves' covariance is: `posterior` of both fits, or `standard errors` of one of them."""
    repeatability: float = 0.0
    """Standard deviation from mount to mount of either law, relative, counted in beside their own errors."""
    alike: tuple[str, ...] = ()
    """Stated numbers that both are off by together, which makes no difference."""

    @property
    def differs(self) -> bool | None:
        """Whether the laws differ as a whole; None where it cannot be told."""
        return None if np.isnan(self.p_value) else bool(self.p_value < LEVEL)

    @property
    def would_be_seen(self) -> tuple[float, float, float] | None:
        """In the band's middle, Hz: how far G', relative, and eta would have to differ to be listed there."""
        count, k = len(self.frequency_hz), len(self.frequency_hz) // 2
        if not count or not np.isfinite(self.joint_error).all():
            return None
        storage, eta = self.joint_error[k], self.joint_error[count + k]
        return float(self.frequency_hz[k]), Z_95 * float(storage), Z_95 * float(eta)

    def where(self, z: Array) -> list[tuple[float, float]]:
        """Ranges of frequency in Hz over which a difference is beyond its joint uncertainty."""
        return _ranges(self.frequency_hz, np.abs(np.nan_to_num(z)) > Z_95)


def compare(
    a: MaterialLaw, b: MaterialLaw, repeatability: float = 0.0, *, one_specimen: bool = False
) -> Comparison:
    """On the band that both have.

    `repeatability` is the relative standard deviation of G' and of eta from one mount to the next. Taken as
    independent where it is not `one_specimen`: what both are off by together then makes this cautious.
    """
    low, high = (max(a.band_hz[0], b.band_hz[0]), min(a.band_hz[1], b.band_hz[1]))
    if not low < high:
        nothing = np.zeros(0)
        return Comparison(a, b, *(nothing,) * 6, *(float("nan"),) * 3, "")
    f = np.geomspace(low, high, _POINTS)
    (storage_a, eta_a), (storage_b, eta_b) = _curves(a, f), _curves(b, f)
    difference = np.concatenate([np.log(storage_b / storage_a), eta_b - eta_a])
    errors = [_errors(law, f) for law in (a, b)]
    mounts = [repeatability * np.concatenate([np.ones(len(f)), eta]) for eta in (eta_a, eta_b)]
    found = [_scatter(law, f, error) for law, error in zip((a, b), errors, strict=True)]
    found += [_together(f, size) for size in mounts]
    alike = alike_in((a, b)) if one_specimen else ()
    covariance = np.asarray(np.sum(found, axis=0)) - _together_off(a, b, alike, f)
    joint = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        z = np.where(joint > 0, difference / joint, np.nan)
    floor = np.repeat([RESOLUTION, RESOLUTION * float(np.mean(np.abs(eta_a)))], len(f))
    statistic, dof = _chi2(difference, covariance, floor)
    own = a.known is not None and b.known is not None
    return Comparison(
        a,
        b,
        f,
        storage_b / storage_a - 1,
        z[: len(f)],
        eta_b - eta_a,
        z[len(f) :],
        joint,
        statistic,
        dof,
        float(chi2_above(statistic, dof)) if dof > 0 else float("nan"),
        "posterior" if own else "standard errors",
        repeatability,
        alike,
    )


def compared_pair(c: Comparison, a: str, b: str) -> ComparedPair:
    """A comparison as JSON has it, under these names."""
    f = c.frequency_hz
    rows = zip(f, c.storage_difference, c.storage_z, c.loss_factor_difference, c.loss_factor_z, strict=True)
    return ComparedPair(
        a=a,
        b=b,
        verdicts=(c.a.verdict, c.b.verdict),
        temperatures_c=(c.a.temperature_c, c.b.temperature_c),
        band_hz=(f[0], f[-1]) if len(f) else None,
        chi2=c.chi2,
        degrees_of_freedom=c.dof,
        p_value=c.p_value,
        differs=c.differs,
        covariance=c.covariance or None,
        repeatability_percent=100 * c.repeatability,
        alike=c.alike,
        storage_modulus_differs_hz=tuple(c.where(c.storage_z)),
        loss_factor_differs_hz=tuple(c.where(c.loss_factor_z)),
        frequencies=tuple(
            ComparedAt(
                frequency_hz=at,
                storage_modulus_difference_percent=100 * dG,
                storage_modulus_z=zG,
                loss_factor_difference=de,
                loss_factor_z=ze,
            )
            for at, dG, zG, de, ze in rows
        ),
    )


def covariance_of(law: MaterialLaw, frequency_hz: Array) -> Array:
    """Of ln G' at the frequencies inside the band, then of eta. Shape (2 frequencies, 2 frequencies)."""
    return _covariance(law, frequency_hz, _errors(law, frequency_hz))


def _curves(law: MaterialLaw, f: Array) -> tuple[Array, Array]:
    G = law.modulus(2 * np.pi * f)
    return G.real, G.imag / G.real


def _errors(law: MaterialLaw, f: Array) -> Array:
    """Standard errors of ln G', then of eta. Shape (2 frequencies,)."""
    x, at = np.log(law.frequency_hz), np.log(f)
    relative = law.storage_modulus_standard_error_pa / law.storage_modulus_pa
    return np.concatenate([np.interp(at, x, relative), np.interp(at, x, law.loss_factor_standard_error)])


def _scatter(law: MaterialLaw, f: Array, errors: Array) -> Array:
    """By how much the curve would be another one, were the same law measured again."""
    if law.known is not None:
        return law.known.at(f).of_another_measurement
    return _together(f, errors)


def _covariance(law: MaterialLaw, f: Array, errors: Array) -> Array:
    """Of the curve: the fit's own, else errors that go together over as far as a law's bend does."""
    if law.known is not None:
        return law.known.at(f).covariance
    return _together(f, errors)


def _together_off(a: MaterialLaw, b: MaterialLaw, alike: Sequence[str], f: Array) -> Array:
    """Twice the covariance of both curves that these stated numbers make. Shape of either's."""
    if not alike or a.known is None or b.known is None:
        return np.zeros((2 * len(f), 2 * len(f)))
    both = a.known.at(f).passed_on(alike) @ b.known.at(f).passed_on(alike).T
    return np.asarray(both + both.T)


def _together(f: Array, errors: Array) -> Array:
    """Of errors of G' and of eta that go together over as far as a law's bend does, each for itself."""
    x = np.log(f)
    near = np.exp(-0.5 * ((x[:, None] - x) / REACH) ** 2)
    nothing = np.zeros_like(near)
    return np.asarray(np.block([[near, nothing], [nothing, near]]) * np.outer(errors, errors))


def _chi2(difference: Array, covariance: Array, floor: Array) -> tuple[float, float]:
    """Over the directions in which the curves are not known exactly, each as far as it is one.

    NaN and 0 where nothing is known.
    """
    if not np.isfinite(covariance).all() or not np.isfinite(difference).all():
        return float("nan"), 0.0
    size, turned = np.linalg.eigh(covariance / np.outer(floor, floor))
    size = np.maximum(size, 0.0)
    along = turned.T @ (difference / floor)
    return float(np.sum(along**2 / (size + 1))), float(np.sum(size / (size + 1)))


def _ranges(f: Array, there: Mask) -> list[tuple[float, float]]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], there.astype(int), [0]])))
    return [(float(f[i]), float(f[j - 1])) for i, j in zip(edges[::2], edges[1::2], strict=True)]
