"""One law from several files, and from a single shear pair."""

from dataclasses import replace

import numpy as np
import pytest
from rivals import all_but, among
from shear_pair_cases import HEAVIER_KG, LAW, MASSES_KG, pair, sweep

from fitting.planning.unseen import unseen
from instrument.cli.output import Output
from instrument.cli.print_identification import print_identification
from instrument.finding.diagnosis import diagnose
from instrument.finding.identification import identify
from instrument.models.files import File
from instrument.processes.other_processes import VARIABLE


def files(masses=MASSES_KG, *, points=80, **more):
    return [File(sweep(pair(m), seed=k, points=points, **more), pair(m)) for k, m in enumerate(masses)]


def law_error(found, f=(60.0, 150.0, 400.0)):
    omega = 2 * np.pi * np.array(f)
    return np.abs(found.modulus(omega) / LAW.modulus(omega) - 1)


def test_one_pair_gives_its_law():
    found = identify(files([0.573])).result
    assert law_error(found.law, (60, 150)).max() < 0.01
    # Area and thickness are known to 2 % each, and what free edges give way is left open by 7 %.
    error = found.band.storage_modulus_standard_error_pa / found.band.storage_modulus_pa
    assert np.median(error) == pytest.approx(np.sqrt(0.068**2 + 2 * 0.02**2), rel=0.1)
    assert {one.name: one for one in found.fit.adjusted}["free_edges"].tolerance == pytest.approx(
        0.068, abs=2e-3
    )


def test_edges_that_are_counted_leave_the_modulus_as_well_known_as_area_and_thickness():
    given = [File(sweep(pair(0.573)), pair(0.573, edges=True))]
    band = identify(given).result.band
    error = band.storage_modulus_standard_error_pa / band.storage_modulus_pa
    assert 0.025 < np.median(error) < 0.05


def test_four_masses_give_one_law_and_each_its_own_gain():
    given = files()
    given[1] = File(sweep(pair(MASSES_KG[1]), seed=1, factor=1.006), pair(MASSES_KG[1]))
    found = identify(given).result
    assert law_error(found.law).max() < 0.015
    adjusted = {one.name: one for one in found.fit.adjusted}
    # How much is common to all of them, the core hides.
    others = np.mean([adjusted[f"gain [{k}]"].found for k in (1, 3, 4)])
    assert adjusted["gain [2]"].found / others == pytest.approx(1.006, abs=2e-3)
    assert "area" in adjusted
    assert "mass [3]" in adjusted
    assert len(found.validation.held_out) == 4


def test_one_mass_stated_wrongly_and_the_modulus_are_one():
    found = diagnose(files([0.573], more_kg=0.05 * 0.573)).result
    assert found.verdict == "ambiguous"
    assert found.effects[0].name == "added_mass"
    assert found.equivalent["added_mass"] == ("added_mass", "none")
    assert found.explanation[0].startswith("The stated shear pair with its best law")
    row = next(c for c in found.candidates if c.name == "added_mass")
    assert row.effects[0].parameters == found.effects[0].parameters


@among("added_mass", "gain_error", "channel_delay")
def test_four_masses_name_what_all_of_them_lack(without):
    more = 0.05 * MASSES_KG[0]
    found = diagnose(files(more_kg=more), without=without).result
    assert found.verdict == "effect"
    (effect,) = found.effects
    assert effect.name == "added_mass"
    assert effect.parameters["mass"].value == pytest.approx(more, rel=0.05)
    assert effect.parameters["file"].value == 0
    assert law_error(found.after.law).max() < law_error(found.before.law).max()


@pytest.mark.long
def test_a_common_mass_is_named_where_channels_wander_too():
    more = 0.05 * 0.573
    found = diagnose(files(more_kg=more, wander=1e-3, points=160)).result
    assert found.verdict == "effect"
    (effect,) = found.effects
    assert effect.name == "added_mass"
    assert effect.parameters["mass"].value == pytest.approx(more, rel=0.05)
    assert found.after.rms_percent < 0.5 * found.before.rms_percent


def test_one_mass_with_wandering_channels_names_nothing():
    given = files([0.573], more_kg=0.05 * 0.573, wander=1e-3, points=160)
    found = diagnose(given).result
    assert found.verdict == "ambiguous"


@among("added_mass", "temperature_difference", "gain_error", "channel_delay")
def test_a_mass_of_one_file_is_that_file_s_or_its_core_was_warmer(without):
    # 5 per cent in mass is 0.8 K: readings cannot tell them, chi-squares differ by one.
    given = files()
    given[2] = File(sweep(pair(0.573), seed=2, points=80, more_kg=0.05 * 0.573), pair(0.573))
    found = diagnose(given, without=without).result
    assert found.verdict == "ambiguous"
    assert set(found.equivalent["added_mass"]) == {"added_mass", "temperature_difference"}
    mass = found.effects[0].parameters["mass"]
    assert abs(mass.value - 0.05 * 0.573) < 2 * mass.standard_error < 0.008
    assert found.effects[0].parameters["file"].value == 3


def at(warmer_k, *, law=LAW):
    """Another formula than the program's: e^{-0.2 K} in time, 0.3 per cent stiffer a kelvin."""
    return replace(
        law,
        g0_pa=law.g0_pa * (1 + 0.003 * warmer_k),
        ginf_pa=law.ginf_pa * (1 + 0.003 * warmer_k),
        tau_s=law.tau_s * np.exp(-0.2 * warmer_k),
    )


@pytest.mark.long
@among("temperature_difference", "added_mass", "gain_error")
@pytest.mark.parametrize("warmer", [(0.0, 1.5, 0.0), (0.0, 0.9, 2.2)])
def test_files_whose_cores_were_apart_are_no_mass(warmer, without):
    given = []
    for k, (mass, kelvin) in enumerate(zip(HEAVIER_KG, warmer, strict=True)):
        own = pair(mass)
        warm = replace(own, core=replace(own.core, law=at(kelvin)))
        given.append(File(sweep(warm, seed=k, points=80), own))
    found = diagnose(given, without=without).result
    assert found.effects[0].name == "temperature_difference"
    assert "none" not in found.equivalent["temperature_difference"]
    (band,) = [found.after.band]
    omega = 2 * np.pi * band.frequency_hz
    off = (band.storage_modulus_pa - LAW.modulus(omega).real) / band.storage_modulus_standard_error_pa
    assert np.abs(off).max() < 2


@pytest.mark.long
def test_a_tenth_of_a_kelvin_between_files_is_no_effect():
    given = []
    for k, (mass, kelvin) in enumerate(zip(HEAVIER_KG, (0.05, -0.1, 0.1), strict=True)):
        own = pair(mass)
        warm = replace(own, core=replace(own.core, law=at(kelvin)))
        given.append(File(sweep(warm, seed=k, points=80), own))
    assert diagnose(given).result.verdict == "none"


def turned(degrees, masses=HEAVIER_KG):
    turn = np.exp(1j * np.radians(degrees))
    return [
        File(replace(f.sweep, velocity_m_s=f.sweep.velocity_m_s * turn), f.specimen) for f in files(masses)
    ]


@among("phase_offset", "phase_scale", "gain_error", "channel_delay")
def test_an_angle_between_two_accelerometers_is_not_taken_for_the_core(without):
    # With time stamps a gain and a drift did as well: certain, and the modulus off by a quarter.
    found = diagnose(turned(-3.0), without=without).result
    (effect,) = found.effects
    # The prior of the angle alone speaks for it: the law takes up what it does to the readings.
    assert found.equivalent == {"phase_offset": ("phase_offset", "unlisted")}
    assert effect.probability > 0.9
    assert effect.parameters["phase"].value == pytest.approx(np.radians(-3.0), abs=2e-3)
    assert law_error(found.after.law).max() < 0.02


@among("phase_offset", "phase_scale", "gain_error", "channel_delay")
def test_an_angle_of_four_deviations_is_an_effect_or_the_tolerance_of_one(without):
    found = diagnose(turned(-2.0), without=without).result
    assert found.equivalent == {"phase_offset": ("phase_offset", "none", "unlisted")}
    assert law_error(found.after.law).max() < 0.02


def test_a_degree_between_two_accelerometers_is_found_beside_the_law():
    found = identify(turned(1.0)).result
    (phase,) = [one for one in found.fit.adjusted if one.name == "phase"]
    assert phase.found == pytest.approx(1.0, abs=3 * phase.standard_error)
    assert phase.standard_error < 0.2 < phase.tolerance == pytest.approx(0.5)
    assert law_error(found.law).max() < 0.015


def test_one_mass_leaves_an_angle_to_the_band_of_the_loss_factor():
    """Half a degree, as two accelerometers may be apart: the loss factor is no better known than that."""
    at_resonance, below = (
        identify([File(f.sweep.take(kept(f.sweep.frequency_hz)), f.specimen)]).result.band
        for f, kept in ((turned(0.5, [0.573])[0], k) for k in (lambda f: f > 200.0, lambda f: f < 170.0))
    )
    for band in (at_resonance, below):
        G = LAW.modulus(2 * np.pi * band.frequency_hz)
        off = (band.loss_factor - G.imag / G.real) / band.loss_factor_standard_error
        assert np.abs(off).max() < 3
    assert below.loss_factor_standard_error.min() > 2 * at_resonance.loss_factor_standard_error.min()


@pytest.mark.parametrize("masses", [[0.573], HEAVIER_KG])
def test_what_may_hide_in_a_pair_s_law_is_said(masses):
    among_these = all_but("channel_delay", "gain_error")
    found = diagnose(files(masses, points=40), without=among_these)
    hidden = {one.name: one for one in unseen(found.result.rivals, found.effects)}
    # One mass over another is all that is read: a law follows a delay, and three masses part them.
    assert ("channel_delay" in hidden) == (len(masses) == 1)
    assert "channel_delay" in {e.name for e in found.effects}


def test_four_masses_as_stated_leave_nothing():
    assert diagnose(files(points=40)).result.verdict == "none"


def softened(*levels):
    p = pair(0.573)
    return [File(sweep(p, points=80, softening=60.0, level=a, seed=k), p) for k, a in enumerate(levels)]


def test_softening_is_not_told_from_one_level():
    rivals = all_but("amplitude_softening", "added_mass", "gain_error")
    one = diagnose(softened(9.81), without=rivals).result
    assert "amplitude_softening" not in {e.name for e in one.effects}


@pytest.mark.long
@among("amplitude_softening", "added_mass", "gain_error")
def test_softening_is_told_by_two_levels(without):
    two = diagnose(softened(9.81, 2.5), without=without).result
    assert two.verdict == "effect"
    assert two.effects[0].name == "amplitude_softening"


@pytest.mark.long
def test_what_softens_at_a_strain_does_so_under_every_mass():
    """One rubber: the same share at the same strain, though a heavy mass strains it six times as far."""
    given = [
        File(sweep(pair(m), points=60, softening=60.0, level=a, seed=k), pair(m))
        for k, (m, a) in enumerate((m, a) for m in (0.2, 0.5, 1.2) for a in (9.81, 2.5))
    ]
    rivals = all_but("amplitude_softening", "added_mass", "temperature_difference", "gain_error")
    found = diagnose(given, without=rivals).result
    (effect,) = found.effects
    assert effect.name == "amplitude_softening"
    assert effect.parameters["file"].value == 0
    assert found.after.chi2_per_dof < 1.2
    assert law_error(found.after.law).max() < 0.02


def test_a_resonance_of_the_fixture_is_set_aside():
    given = files(points=200)
    disturbed = given[0].sweep
    r = disturbed.frequency_hz / 330.0
    wobble = 1 + 0.01 / (1 - r**2 + 2j * 0.03 * r)
    near = np.abs(np.log(r)) < 0.3
    v = disturbed.velocity_m_s * np.where(near, wobble, 1)
    given[0] = File(type(disturbed)(**{**vars(disturbed), "velocity_m_s": v}), given[0].specimen)
    found = identify(given)
    assert {one.file for one in found.aside} == {1}
    assert any(one.glitch.low_hz < 330 < one.glitch.high_hz for one in found.aside)
    # Its tails stay.
    assert law_error(found.result.law).max() < 0.03


@pytest.mark.parametrize(("mass_kg", "at_hz"), [(0.2533, 410.0), (0.1178, 690.0)])
def test_where_a_fixture_resonates_the_rest_is_worth_less_too(mass_kg, at_hz):
    """Tails, and channels 0.5 % and 0.8 degrees off, are taken for the core else: 4 to 5 standard errors."""
    s = sweep(pair(mass_kg), seed=int(at_hz) // 100, points=400)
    r, side = s.frequency_hz / at_hz, np.sign(mass_kg - 0.2)
    v = s.velocity_m_s * 0.995 * np.exp(-0.014j * side) * (1 + 0.005 / (1 - r**2 + 0.04j * r))
    found = identify([File(replace(s, velocity_m_s=v), pair(mass_kg))])
    result = found.result
    assert found.aside
    assert result.noise.source == "misfit"
    assert any("where a fixture resonates" in said for said in result.warnings)
    band = result.band
    G = LAW.modulus(2 * np.pi * band.frequency_hz)
    pull = (band.loss_factor - G.imag / G.real) / band.loss_factor_standard_error
    assert np.abs(pull).max() < 3


@pytest.mark.long
@among(
    "added_mass", "gain_error", "channel_delay", "sensor_lowpass", "sensor_mounting", "temperature_difference"
)
@pytest.mark.parametrize("on_base", [True, False])
def test_a_sensor_on_wax_is_not_taken_for_the_core(without, on_base):
    """Its resonance lies at twice what is measured, and shows by its square."""
    f_0, given = 2600.0, []
    for file in files(HEAVIER_KG, points=120):
        rises = 1 / (1 - (file.sweep.frequency_hz / f_0) ** 2)
        factor = 1 / rises if on_base else rises
        given.append(replace(file, sweep=replace(file.sweep, velocity_m_s=factor * file.sweep.velocity_m_s)))
    found = diagnose(given, without=without).result
    # It shows by too little for its formula to be tested.
    assert found.equivalent == {"sensor_mounting": ("sensor_mounting", "unlisted")}
    (effect,) = found.effects
    assert effect.probability > 0.85
    assert effect.parameters["on_base"].value == on_base
    frequency = effect.parameters["frequency"]
    assert abs(frequency.value - f_0) < 3 * frequency.standard_error < 0.3 * f_0
    assert law_error(found.after.law).max() < 0.03


@pytest.mark.long
def test_one_file_is_not_spoken_of_as_several():
    (said,) = [one for one in _misfit([0.2533]) if "taken for the error" in one]
    assert "files" not in said
    assert "each file" not in said
    (said,) = [one for one in _misfit([0.2533, 0.573]) if "taken for the error" in one]
    assert said.startswith("the files follow no one law")


def _misfit(masses):
    return identify(files(masses, wander=0.02)).result.warnings


def test_where_no_law_fits_there_is_no_chi_square(capsys):
    found = identify(files([0.2533, 0.573], wander=0.02))
    result = found.result
    assert result.noise.source == "misfit"
    assert not result.chi2_means_something
    assert np.isnan([h.noise_percent for h in result.validation.held_out]).all()
    print_identification(Output(None), found)
    said = capsys.readouterr().out
    assert "no chi-square: readings count for as much as the fit leaves of them" in said
    assert "% (noise" not in said
    assert "chi-square per degree" not in said


@pytest.mark.long
def test_another_process_changes_no_law(monkeypatch):
    given = files([0.2533, 0.573], wander=0.02)
    alone = identify(given).result
    monkeypatch.setenv(VARIABLE, "2")
    assert np.array_equal(identify(given).result.law.values, alone.law.values)


@pytest.mark.long
def test_a_gain_and_a_phase_of_all_files_do_not_become_the_core_s():
    """Two accelerometers that are 2 % and a degree apart, the same ones for every mass."""
    apart = 0.98 * np.exp(0.02j)
    given = [
        File(sweep(pair(m), seed=k, points=120, wander=0.01, factor=apart), pair(m))
        for k, m in enumerate(HEAVIER_KG)
    ]
    found = identify(given).result
    assert found.noise.source == "misfit"
    # Each file's own wandering is what is left: without what they have in common 8 and 10 %.
    assert law_error(found.law, (60.0, 100.0)).max() < 0.045
