"""The campaign on beams: its solids, what they hide, its cases, its score and the command."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from click.testing import CliRunner

from campaign.__main__ import campaign
from campaign.beams import simulate
from campaign.beams.cases import KINDS, NONE, draw_case
from campaign.beams.geometry import BEAMS, beam_named
from campaign.beams.hidden import HIDDEN, ON_REQUEST, Setting
from campaign.beams.hidden.attached import (
    HiddenAddedMass,
    HiddenLoosePart,
    HiddenSpotOffset,
    HiddenTether,
)
from campaign.beams.hidden.base import HiddenInBeam, driven_by_base
from campaign.beams.hidden.base_motion import HiddenBaseRocking, HiddenFixtureResonance
from campaign.beams.hidden.clamp import (
    HiddenClampFriction,
    HiddenClampLine,
    HiddenTreatmentNotGripped,
)
from campaign.beams.hidden.core import (
    HiddenAmplitudeSoftening,
    HiddenPartialDebond,
    HiddenTemperatureDrift,
)
from campaign.beams.hidden.layers import HiddenCoreThickness, HiddenSubstrateStiffness
from campaign.beams.judged import diagnosed, identified
from campaign.beams.run import ROTATION, run_beams, write_beam_summary
from campaign.beams.simulate import BuiltBeam, built, level_unit, reading, resonances
from campaign.beams.stated import beam_from, draw_stated, toml
from campaign.beams.visible import visible_chi2
from campaign.law import TrueLaw
from campaign.plates.answers import Answer, Band, outcome_of
from campaign.plates.asked import Asked
from campaign.plates.score import named
from campaign.plates.stated import CAREFUL
from campaign.run import in_rotation
from campaign.schedule import Schedule
from fitting.laws.constant import ConstantModulus
from fitting.structures.small import system_of
from fitting.structures.small_modes import elastic_modes, small_velocity

LAW = TrueLaw("fractional-zener", (0.4e6, 8e6, 1e-4, 0.7))
STRIP, STRUCK, FREE = beam_named("strip"), beam_named("struck"), beam_named("free")


@pytest.fixture(autouse=True)
def _coarse(monkeypatch):
    monkeypatch.setattr(simulate, "PIECES", 5)


def at(*frequency_hz, level=1.0):
    f = np.array(frequency_hz, float)
    one = np.ones(len(f), np.intp)
    return Schedule(f, one, one, level * np.ones(len(f)), np.linspace(0, 600, len(f)))


def lowest(beam: BuiltBeam):
    return np.array([r.frequency_hz for r in resonances(beam, LAW)[:3]])


def setting(beam):
    return Setting(beam, (30.0, 180.0, 480.0), 600.0)


def test_every_effect_is_drawn_where_it_can_be_and_says_so():
    for name, effect in HIDDEN.items():
        able = [b for b in BEAMS if effect.able(b)]
        assert able
        for beam in able:
            drawn = effect.draw(np.random.default_rng(3), setting(beam))
            assert drawn.name == name
            assert all(0 < x <= beam.span_m for x in drawn.places_m())
            assert 0 < drawn.beam(beam).spot_m <= drawn.beam(beam).span_m
            assert set(drawn.facts) == set(vars(drawn))
    assert not HIDDEN["clamp_line"].able(FREE)
    assert not HIDDEN["base_rocking"].able(STRUCK)
    assert driven_by_base(STRIP)
    with pytest.raises(NotImplementedError):
        HiddenInBeam.draw(np.random.default_rng(3), setting(STRIP))


def test_the_solid_weighs_what_the_beam_does():
    for beam in (STRIP, beam_named("padded"), beam_named("balance")):
        found = built(beam)
        heave = np.linalg.solve(found.basis.M, found.load[:, 0])
        # What its clamp holds does not move.
        assert 0.94 < heave @ found.basis.M @ heave / beam.mass_kg < 1.0


def test_without_poissons_ratio_the_solid_is_the_beam_of_the_fit():
    """With it a clamp holds the beam flat across, as if it were shorter by some 3 % of its width."""
    flat = replace(
        STRIP,
        substrate=replace(STRIP.substrate, poisson=0.0),
        constraining=replace(STRIP.constraining, poisson=0.0),
    )
    specimen = beam_from(toml(flat, None, 100.0))
    law = TrueLaw("fractional-zener", tuple(specimen.core.law.values))
    f = np.array([15.0, 29.0, 100.0, 172.0, 300.0, 470.0])
    found = level_unit(flat) * reading(built(flat, pieces=16), law, at(*f))
    np.testing.assert_allclose(found, small_velocity(specimen, f), rtol=0.02)
    assert (lowest(built(STRIP)) / lowest(built(flat))).min() > 1.003


def test_an_absolute_laser_reads_the_base_too_and_a_slow_force_meets_a_spring():
    f = at(2.0, 40.0)
    riding = reading(built(STRIP), LAW, f)
    floor = reading(built(replace(STRIP, reads="absolute")), LAW, f)
    np.testing.assert_allclose(floor - riding, 1 / (2j * np.pi * f.frequency_hz))
    slow, twice = reading(built(STRUCK), LAW, at(0.5, 1.0))
    assert abs(twice / slow) == pytest.approx(2.0, rel=0.02)


def test_a_mass_that_hangs_there_is_one_that_the_beam_has():
    mass = HiddenAddedMass(0.003, 0.17)
    hung = built(STRIP, (mass,))
    row, M = hung.basis.w[2], hung.basis.M
    heavy = replace(hung.basis, w=hung.basis.w[:2], M=M + 0.003 * np.outer(row, row))
    heavy = replace(heavy, load=heavy.load + 0.003 * np.outer(row, [1.0, 0.17]))
    f = at(20.0, 150.0)
    np.testing.assert_allclose(reading(hung, LAW, f), reading(BuiltBeam(STRIP, heavy), LAW, f), rtol=1e-9)


def test_something_loose_rides_along_far_below_its_own_frequency_and_rests_far_above():
    loose = HiddenLoosePart(0.003, 900.0, 0.05, 0.17, 0.5)
    slow = at(15.0, 30.0)
    stuck = reading(built(STRIP, (HiddenAddedMass(0.003, 0.17),)), LAW, slow)
    np.testing.assert_allclose(reading(built(STRIP, (loose,)), LAW, slow), stuck, rtol=1e-3)
    fast, soft = at(300.0, 470.0), replace(loose, frequency_hz=3.0)
    alone = reading(built(STRIP), LAW, fast)
    np.testing.assert_allclose(reading(built(STRIP, (soft,)), LAW, fast), alone, rtol=1e-2)


def test_a_cable_to_the_floor_pulls_at_what_the_base_carries():
    """Below resonance w = -k w_base / k_beam more: of the floor's hold the base's own motion is a part."""
    f = at(0.2)
    tied, ridden = (
        reading(built(STRIP, (HiddenTether(5.0, 0.0, 0.2, floor),)), LAW, f)[0] for floor in (True, False)
    )
    assert abs(tied) > 100 * abs(ridden)


def test_what_a_clamp_does_lowers_every_resonance():
    clean = lowest(built(STRIP))
    soft = HiddenClampFriction(1e14, 1e14, 1e14, 0.2, 0.3)
    loose = built(STRIP, (soft,))
    assert (lowest(loose) < clean).all()
    assert np.any(np.imag(loose.elastic))
    assert (lowest(built(STRIP, (HiddenTreatmentNotGripped(),)))[1:] < clean[1:]).all()
    longer = built(STRIP, (HiddenClampLine(2.2e-3),))
    assert longer.true.spot_m == pytest.approx(STRIP.spot_m + 2.2e-3)
    np.testing.assert_allclose(lowest(longer) / clean, 1.01**-2, rtol=5e-3)


def test_a_debond_lowers_modes_and_a_warm_core_changes_the_reading():
    clean = built(STRIP)
    debond = HiddenPartialDebond(0.0, 0.03, 0.004, 0.02)
    assert (lowest(built(STRIP, (debond,))) < lowest(clean)).all()
    warm = HiddenTemperatureDrift(6.0, 200.0, 1e5)
    shift = warm.frequency_factor(np.array([0.0, 1e4]))
    assert shift[0] == pytest.approx(1.0)
    assert 0.3 < shift[1] < 0.6
    late = replace(at(30.0), time_s=np.array([1e4]))
    assert reading(built(STRIP, (warm,)), LAW, late) != pytest.approx(reading(clean, LAW, late), rel=0.01)


def test_strips_soften_by_their_own_strain_and_not_at_rest():
    soft = HiddenAmplitudeSoftening(0.2, 0.5)
    assert soft.factor(np.array([0.0, 1.0]), 1.0) == pytest.approx([1.0, 0.8])
    beam, peak = built(STRIP, (soft,)), lowest(built(STRIP))[0]
    found, still = (reading(beam, LAW, at(0.98 * peak, peak, level=level)) for level in (1.0, 1e-9))
    assert np.abs(found / still - 1).max() > 0.02
    np.testing.assert_allclose(still, reading(built(STRIP), LAW, at(0.98 * peak, peak)), rtol=2e-3)


def test_a_base_that_pitches_and_a_fixture_that_yields():
    rocking = HiddenBaseRocking(0.3)
    omega = 2 * np.pi * np.array([10.0, 5000.0])
    np.testing.assert_allclose(rocking.pitch(omega), 0.3)
    assert rocking.reference(omega) == pytest.approx(1.0)
    yields = HiddenFixtureResonance(100.0, 0.02, 0.03, 0.1)
    assert abs(yields.pitch(omega)[0]) < 0.002
    assert yields.reference(omega)[1] == pytest.approx(1 / 0.97, rel=1e-3)
    plain, rocked = (reading(built(STRIP, h), LAW, at(25.0))[0] for h in ((), (rocking,)))
    assert abs(rocked / plain - 1) > 0.02


def test_numbers_that_are_off_are_those_of_the_beam():
    assert HiddenSubstrateStiffness(1.1).beam(STRIP).substrate.young_pa == pytest.approx(1.1 * 206e9)
    assert HiddenCoreThickness(0.9).beam(STRIP).core.thickness_m == pytest.approx(0.225e-3)
    assert HiddenSpotOffset(0.003).beam(STRIP).spot_m == pytest.approx(0.153)


def test_what_is_stated_is_about_the_truth_with_tolerances_of_numbers_that_there_are():
    rng = np.random.default_rng(0)
    off = [draw_stated(rng, STRIP).length_m / STRIP.length_m - 1 for _ in range(200)]
    assert np.std(off) == pytest.approx(CAREFUL.length_m / STRIP.length_m, rel=0.2)
    found = beam_from(toml(STRIP, CAREFUL, 100.0))
    assert found.length_m == pytest.approx(STRIP.length_m)
    assert found.tolerances["pickup"] == pytest.approx(CAREFUL.pickup_m)
    assert "width" not in found.tolerances
    coated = toml(beam_named("coated"), CAREFUL, 100.0)
    assert "constraining" not in coated
    assert "force_mm = 1" in toml(STRUCK, CAREFUL, 100.0)
    assert beam_from(toml(STRIP, None, 100.0)).exact


def test_a_case_is_the_same_for_the_same_seed_and_measures_what_rings():
    first, again = (draw_case("clamp_line", 4, beam="strip") for _ in range(2))
    np.testing.assert_array_equal(first.sweep.velocity_m_s, again.sweep.velocity_m_s)
    assert first.truth.facts == again.truth.facts
    assert first.truth.names == ("clamp_line",)
    assert first.hammer is None
    peaks = [r.frequency_hz for r in resonances(built(STRIP, first.truth.effects), first.truth.law)]
    for middle in first.truth.resonances_hz:
        assert np.abs(np.log(np.array(peaks) / middle)).min() < 0.04
    noise = np.abs(first.sweep.response_m_s - first.clean_m_s) / np.abs(first.clean_m_s).max()
    assert 1e-4 < np.median(noise) < 0.02
    with pytest.raises(ValueError, match="expected one of none, added_mass"):
        draw_case("ghost", 4)


def right(case):
    f = case.truth.resonances_hz
    G = case.truth.modulus_pa
    storage, loss = G.real, G.imag / G.real
    return Band(*(tuple(v.tolist()) for v in (np.array(f), storage, loss, 0.02 * storage, 0.02 * loss)))


def honest(case):
    band = right(case)
    verdict = "effect" if case.truth.names else "none"
    return Answer(verdict, case.truth.names, {}, {}, band, band, 1.0, 1.05)


def test_a_campaign_is_scored_and_told(tmp_path):
    jobs = in_rotation(("none", "spot_offset"), 2, 11)
    lines = run_beams(jobs, tmp_path, Asked(identify=right, diagnose=honest), workers=1)
    text = write_beam_summary(lines, tmp_path)
    assert "# 2 sweeps of" in text
    assert "solid beams" in text
    assert "| spot_offset | 1 | 1 | 1 | 1 | 0 |" in text
    assert "| 1.05 | 1 |" in text
    assert (tmp_path / "summary.md").read_text(encoding="utf-8") == text
    case = draw_case("spot_offset", 12)
    assert named(outcome_of(case, None, honest(case))) == ("spot_offset",)


def test_the_command_runs_it(tmp_path, monkeypatch):
    monkeypatch.setattr("campaign.__main__.beam_identified", right)
    options = ["--count", "1", "--kind", NONE, "--workers", "1", "--law-alone"]
    said = CliRunner().invoke(campaign, ["beams", str(tmp_path), *options])
    assert said.exit_code == 0, said.output
    assert "| none | identify |" in said.output


def test_what_shows_is_what_no_law_takes_up():
    moved = draw_case("spot_offset", 4, beam="strip")
    assert visible_chi2(moved) > 5
    assert visible_chi2(draw_case(NONE, 4, beam="strip")) is None
    np.testing.assert_array_equal(draw_case(NONE, 4).clean_m_s, draw_case(NONE, 4).without_m_s)


def test_every_kind_is_in_rotation():
    assert set(ROTATION) == set(KINDS) - set(ON_REQUEST)


@pytest.mark.long
def test_a_moved_spot_is_not_called_nothing():
    case = draw_case("spot_offset", 3, beam="strip")
    assert diagnosed(case).verdict != NONE
    assert len(identified(case).frequency_hz) > 1


@pytest.mark.long
def test_a_core_that_softens_is_named_from_one_level():
    case = draw_case("amplitude_softening", 8214)
    assert len(set(case.sweep.commanded_m_s2)) == 1
    said = diagnosed(case)
    assert (said.verdict, said.effects) == ("effect", ("amplitude_softening",))


@pytest.mark.parametrize(
    ("name", "axial_pa"),
    [
        ("free", 0.0),
        ("strip", 0.0),
        ("bridge", 12e6),
        *(
            pytest.param(*one, marks=pytest.mark.long)
            for one in (("long", 0.0), ("laminate", 0.0), ("bridge", -3e6))
        ),
    ],
)
def test_modes_of_the_theory_are_those_of_the_solid(name, axial_pa, monkeypatch):
    monkeypatch.setattr(simulate, "PIECES", 20)
    true = replace(beam_named(name), axial_pa=axial_pa)
    solid = built(true).basis
    G = 1.5e6 * (1 + 0.4j)
    values = la.eigvals(solid.K_faces.sum(axis=0) + G * solid.K_core.sum(axis=0), solid.M)
    values = values[np.argsort(values.real)][0 if true.clamped else 3 :]
    beam = beam_from(toml(true, None, 100.0, held_width=True))
    pulled = system_of(beam, beam.parts(), {"axial": axial_pa})
    modes = elastic_modes(pulled, ConstantModulus(1.5e6, 0.4), 3)
    for value, mode in zip(values, modes, strict=False):
        assert mode.frequency_hz == pytest.approx(np.sqrt(value.real) / (2 * np.pi), rel=1e-3)
        if value.imag / value.real > 0.04:
            assert mode.loss_factor == pytest.approx(value.imag / value.real, rel=5e-3)
