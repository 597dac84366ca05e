from dataclasses import replace

import numpy as np
import pytest

from fitting.errors import TooFewPoints
from fitting.identification.kramers_kronig import LEVEL, kramers_kronig
from fitting.identification.pointwise import PointwiseLaw

BANDS_HZ = np.concatenate([np.geomspace(15, 25, 7), np.geomspace(80, 125, 7), np.geomspace(250, 315, 6)])


def havriliak_negami(omega):
    return 6e6 + (0.3e6 - 6e6) / (1 + (1j * omega * 3e-4) ** 0.8) ** 0.7


def maxwell(omega):
    """One relaxation time, the sharpest spectrum there is, on no grid."""
    s = 1j * omega * 4.56e-4
    return 1e6 + 3e6 * s / (1 + s)


def spring(omega):
    return np.full(len(omega), 1e6 + 0j)


def pointwise(modulus, error, seed=None, frequency_hz=BANDS_HZ, common=()):
    """G* with relative errors: `error` of each band by itself, and shared ones per standard deviation."""
    G, count = modulus(2 * np.pi * frequency_hz), len(frequency_hz)
    common = np.reshape(np.array(common, complex), (-1, count))
    if seed is not None:
        rng = np.random.default_rng(seed)
        G = G * (1 + error * (rng.standard_normal((2, count)).T @ [1, 1j]))
        G = G * (1 + rng.standard_normal(len(common)) @ common)
    J = common * G
    return PointwiseLaw(
        frequency_hz,
        G,
        (error * np.abs(G))[:, None, None] ** 2 * np.eye(2),
        np.stack([J.real, J.imag], axis=-1),
        np.full(count, error),
        np.ones(count, bool),
        ("",) * count,
        np.ones(count, int),
        np.zeros(count),
    )


def shared(frequency_hz):
    """A stiffness, a loss and a tilt that all bands share."""
    f = frequency_hz
    return [np.full(len(f), 0.03), np.full(len(f), 0.01j), 0.05 * np.log(f / 100) + 0.02j * f / 300]


@pytest.mark.parametrize(
    ("modulus", "with_shared"),
    [(havriliak_negami, False), (havriliak_negami, True), (maxwell, False), (spring, True)],
)
def test_causal_cores_are_refused_as_rarely_as_stated(modulus, with_shared):
    common = shared(BANDS_HZ) if with_shared else ()
    p = np.array([kramers_kronig(pointwise(modulus, 0.01, s, common=common)).p_value for s in range(200)])
    assert np.mean(p < LEVEL) <= 0.03
    assert np.mean(p < 0.1) <= 0.17
    assert 0.4 < np.median(p) < 0.75


def test_shared_errors_taken_for_noise_are_no_core():
    # The pitfall: what moves all bands together by 5 % is not 1 % noise.
    laws = [pointwise(havriliak_negami, 0.003, s, common=shared(BANDS_HZ)) for s in range(30)]
    assert np.mean([kramers_kronig(law).consistent for law in laws]) > 0.9
    blind = [kramers_kronig(replace(law, common=law.common[:0])).consistent for law in laws]
    assert np.mean(blind) < 0.6


@pytest.mark.parametrize(
    "modulus",
    [
        lambda w: np.conj(havriliak_negami(w)),
        lambda w: 1e6 * (1 + 1j * (0.3 + 0.25 * np.sin(3 * np.log(w / 100)))),
        lambda w: havriliak_negami(w).real + 0.5j * havriliak_negami(w).imag,
    ],
    ids=["conjugated", "flat but lossy", "half the loss"],
)
@pytest.mark.parametrize("with_shared", [False, True])
def test_cores_that_are_none_are_found(modulus, with_shared):
    common = shared(BANDS_HZ) if with_shared else ()
    found = kramers_kronig(pointwise(modulus, 0.01, 0, common=common))
    assert not found.consistent
    assert found.p_value < 1e-4
    assert "do not agree" in found.words


def test_what_a_shared_error_hides_stretches_it():
    def softening(omega):
        return 1e6 * (omega / 600) ** -0.2 * (1 + 0.1j)

    assert kramers_kronig(pointwise(softening, 0.01, 0)).p_value < 1e-4
    # A tilt of 5 % a factor e that all bands share takes it up, far beyond its own size.
    hidden = kramers_kronig(pointwise(softening, 0.01, 0, common=shared(BANDS_HZ)))
    assert hidden.p_value > LEVEL
    assert not hidden.consistent
    assert "only if a stated tolerance is off" in hidden.words


def test_without_noise_the_causal_series_is_the_core():
    found = kramers_kronig(pointwise(havriliak_negami, 1e-3))
    omega = 2 * np.pi * BANDS_HZ
    np.testing.assert_allclose(found.smooth, havriliak_negami(omega), rtol=5e-4)
    np.testing.assert_allclose(found.modulus(omega), found.smooth, rtol=1e-12)
    assert found.consistent
    assert found.chi2_per_dof < 0.1
    assert np.all(found.weights_pa >= 0)


def test_only_bands_well_known_take_part():
    law = pointwise(havriliak_negami, 0.01, 0)
    G = law.modulus.copy()
    G[3], G[5] = np.nan, 9 * G[5]
    determined = np.arange(len(law)) != 3
    error = np.where(np.arange(len(law)) == 5, 0.2, 0.01)
    found = kramers_kronig(replace(law, modulus=G, determined=determined, relative_error=error))
    assert len(found.frequency_hz) == len(law) - 2
    assert found.consistent


def test_too_few_bands_are_refused():
    with pytest.raises(TooFewPoints, match="2 of 2 bands"):
        kramers_kronig(pointwise(havriliak_negami, 0.01, 0, BANDS_HZ[:2]))
    with pytest.raises(TooFewPoints, match="0 of 20 bands"):
        kramers_kronig(pointwise(havriliak_negami, 0.2, 0))


def test_bands_without_any_noise_are_refused_in_words():
    common = [np.full(len(BANDS_HZ), 0.03)]
    with pytest.raises(TooFewPoints, match="no noise of their own"):
        kramers_kronig(pointwise(havriliak_negami, 0.0, common=common))
