"""Effects that a reading, a reference or the time shows: what they make of a sweep."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fitting.data.noise import noise_of
from fitting.effects.absolute_velocity import AbsoluteVelocityEffect
from fitting.effects.amplitude_softening import AmplitudeSofteningEffect
from fitting.effects.given import ModulusAt, Points
from fitting.effects.level_error import LevelErrorEffect
from fitting.effects.mains_hum import MainsHumEffect
from fitting.effects.temperature_drift import C_1, C_2_K, TemperatureDriftEffect
from fitting.laws.fractional_zener import FractionalZener
from fitting.sweep import Sweep

LAW = FractionalZener(g0_pa=0.27e6, ginf_pa=4.1e6, tau_s=1.21e-4, alpha=0.83)
OMEGA = 2 * np.pi * np.array([20.0, 90.0, 300.0])


def points(time_s, *, reads="relative", timed=True):
    n = len(time_s)
    return Points(np.resize(OMEGA, n), np.full(n, 9.81), np.asarray(time_s, float), timed, True, reads)


def sweep(level=1.0, hum_m_s=0.0):
    """Sixty points about 50 and 100 Hz, the reference `level` times the command."""
    f = np.concatenate([np.linspace(46, 56, 30), np.linspace(95, 106, 30)])
    rng = np.random.default_rng(5)
    scatter = 1 + 1e-3 * (rng.standard_normal(60) + 1j * rng.standard_normal(60))
    v = (0.02 + 0.01j) * (f / 50) * scatter
    for mains in (50.0, 100.0):
        v = v + hum_m_s * np.sinc(f - mains)
    one = np.ones(60, dtype=np.intp)
    return Sweep(f, v, np.full(60, 9.81), np.repeat([1, 2], 30), one, base_m_s2=9.81 * level * scatter)


def test_a_plate_that_moves_with_its_base_reads_the_base_s_velocity():
    read = AbsoluteVelocityEffect().reading(np.zeros(3, complex), points([0, 1, 2]), np.empty(0))
    assert 1j * OMEGA * read == pytest.approx(np.full(3, 9.81))


def test_data_that_are_absolute_cannot_be_so_by_mistake():
    effect = AbsoluteVelocityEffect()
    assert effect.objection(points([0, 1, 2], reads="absolute"), None)
    assert effect.objection(points([0, 1, 2]), None) is None


def test_one_level_shows_softening_of_a_beam_and_none_of_a_pad():
    softening, one_level = AmplitudeSofteningEffect(), points([0, 1, 2])
    sheared, free_layer = SimpleNamespace(names={"strain.mean_square"}), SimpleNamespace(names=set())
    assert softening.on("beam").objection(one_level, sheared) is None
    assert "free layer" in softening.on("beam").objection(one_level, free_layer)
    assert "one level" in softening.on("shear-pair").objection(one_level, sheared)
    two_levels = replace(one_level, drive_amplitude=np.array([9.81, 9.81, 2.45]))
    assert softening.on("shear-pair").objection(two_levels, sheared) is None


def test_softening_that_saturates_takes_k_at_the_reference_and_less_beyond():
    p = points([0.0, 1.0, 2.0])
    first, saturating = AmplitudeSofteningEffect(), AmplitudeSofteningEffect(saturates=True)
    for s, most in ((1.0, 0.2), (3.0, 0.2 * 1.5 * 3 / 2.5)):
        G = ModulusAt(LAW, p, lambda softened, s=s: s + 0 * softened)
        found = saturating.modulus(G, p, np.array([0.2, 0.5])) / LAW.modulus(OMEGA)
        assert found == pytest.approx(1 - most)
        assert saturating.modulus(G, p, np.array([0.2, 0.0])) == pytest.approx(
            first.modulus(G, p, np.array([0.2]))
        )
    untimed = replace(p, timed=False)
    assert [(f.saturates, f.rubs) for f in first.forms(untimed, None)] == [(False, False), (False, True)]
    levels = replace(p, drive_amplitude=np.array([9.81, 4.9, 2.45]))
    each = [(False, False), (True, False), (False, True), (True, True)]
    assert [(f.saturates, f.rubs) for f in first.forms(replace(levels, timed=False), None)] == each
    assert [(f.saturates, f.rubs) for f in first.forms(levels, None)] == 2 * each
    assert [f.keeps for f in first.forms(levels, None)] == [False] * 4 + [True] * 4


def test_what_the_largest_strain_so_far_has_taken_stays_as_far_as_it_is_kept():
    p = points([20.0, 0.0, 30.0])
    form = AmplitudeSofteningEffect(keeps=True)
    strain = np.array([0.5, 1.0, 0.2])
    G = ModulusAt(LAW, p, lambda softened: strain + 0 * softened)

    def lost(kept):
        return 1 - (form.modulus(G, p, np.array([0.2, kept])) / LAW.modulus(OMEGA)).real

    # The second point was measured first, at the largest strain of all.
    assert lost(1.0) == pytest.approx([0.2, 0.2, 0.2])
    assert lost(0.0) == pytest.approx(0.2 * strain)
    assert lost(0.25) == pytest.approx(0.2 * (0.75 * strain + 0.25))


def test_kept_softening_is_of_the_strain_that_the_core_then_has():
    """Softer by a tenth it strains a tenth more: a fixed point, the first two points still strained less."""
    p = points([0.0, 10.0, 20.0])
    form = AmplitudeSofteningEffect(keeps=True)
    driven = np.array([0.2, 1.0, 0.5])
    G = ModulusAt(LAW, p, lambda softened: driven * (1 + softened))
    lost = 1 - (form.modulus(G, p, np.array([0.3, 1.0])) / LAW.modulus(OMEGA)).real
    largest = np.maximum.accumulate(driven * (1 + lost))
    assert lost == pytest.approx(0.3 * largest, rel=1e-6)


def test_a_core_gains_loss_beside_the_modulus_that_it_loses_less_and_less():
    p = points([0.0, 1.0, 2.0])
    plain, rubbing = (AmplitudeSofteningEffect(saturates=True, rubs=rubs) for rubs in (False, True))
    law = LAW.modulus(OMEGA)
    for s in (0.3, 1.0, 3.0):
        G = ModulusAt(LAW, p, lambda softened, gained=None, s=s: s + 0 * softened)
        lost = 1 - plain.modulus(G, p, np.array([0.2, 0.5])).real / law.real
        found = rubbing.modulus(G, p, np.array([0.2, 0.5, 0.1, 0.5]))
        assert found.real == pytest.approx(law.real * (1 - lost))
        gained = 0.1 * 1.5 * np.sqrt(s) / (1 + 0.5 * s) * np.sqrt(law.real * law.imag)
        assert found.imag == pytest.approx(law.imag * (1 - lost) + gained)


def test_a_core_warms_from_what_the_law_says_to_shorter_times():
    at = points([0.0, 0.0, 0.0]), points([1e6, 1e6, 1e6])
    begun, ended = (
        TemperatureDriftEffect().modulus(ModulusAt(LAW, p, None), p, np.array([10.0, 600.0])) for p in at
    )
    assert begun == pytest.approx(LAW.modulus(OMEGA))
    shorter = 10 ** (-C_1 * 10 / (C_2_K + 10))
    assert ended == pytest.approx(replace(LAW, tau_s=shorter * LAW.tau_s).modulus(OMEGA))
    assert (np.abs(ended) < np.abs(begun)).all()


@pytest.mark.parametrize(
    ("effect", "u"),
    [
        (TemperatureDriftEffect(), [10.0, 600.0]),
        (AmplitudeSofteningEffect(), [0.2]),
        (AmplitudeSofteningEffect(rubs=True), [0.2, 0.1]),
    ],
)
def test_of_many_laws_at_once_the_core_has_the_modulus_that_it_has_of_each(effect, u):
    p, logs = points([0.0, 300.0, 2000.0]), np.log(LAW.values) + np.array([[0.0], [0.01], [-0.02]])

    def strain(softened, gained=None):
        return 0.5 + softened

    found = effect.modulus(ModulusAt(LAW, p, strain, logs), p, np.array(u))
    each = [effect.modulus(ModulusAt(LAW.with_logs(row), p, strain), p, np.array(u)) for row in logs]
    np.testing.assert_allclose(found, each, rtol=1e-12)


def test_a_drift_is_not_judged_by_many_points_without_time():
    effect, many = TemperatureDriftEffect(), np.arange(31.0)
    assert effect.objection(points(many, timed=False), None)
    assert effect.objection(points(many), None) is None
    assert effect.objection(points(many[:30], timed=False), None) is None


def test_a_level_off_the_command_is_seen_in_the_reference_and_spoils_no_point():
    found = LevelErrorEffect().seen(sweep(level=0.9), None)
    factor, error, unit = found.values["factor"]
    assert factor == pytest.approx(0.9, abs=5 * error)
    # Of a median over sixty references that scatter by a thousandth.
    assert error == pytest.approx(np.sqrt(np.pi / 2) * 0.9e-3 / np.sqrt(60), rel=0.3)
    assert unit == "1"
    assert not found.aside.any()
    assert LevelErrorEffect().seen(sweep(), None) is None


def test_the_points_that_hum_are_set_aside():
    humming = sweep(hum_m_s=5e-3)
    found = MainsHumEffect().seen(humming, noise_of(humming))
    assert found.values["mains"][::2] == (50.0, "Hz")
    assert found.values["size"][0] == pytest.approx(5e-3, rel=0.3)
    off_hz = np.abs(humming.frequency_hz - 50 * np.round(humming.frequency_hz / 50))
    assert found.aside[off_hz < 0.3].all()
    assert not found.aside[off_hz > 2.5].any()
    assert MainsHumEffect().seen(sweep(), noise_of(sweep())) is None
