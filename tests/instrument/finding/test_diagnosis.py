"""Sweeps of a 3D solid plate with an effect that the plate model is not told of: is it found and named?"""

from dataclasses import replace

import numpy as np
import pytest
from beam_temperatures import beam
from data_folder import DATA
from rig_plate import MESH, plate_of_the_rig
from rivals import all_but, among

from campaign.plant.cases import draw
from campaign.plates.cases import draw_case
from fitting.diagnosis.diagnose import seen_in_channels
from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.effects import CATALOGUE
from fitting.effects.treatment_not_gripped import TreatmentEndsShortEffect
from fitting.errors import OutsideModel
from fitting.laws.fractional_zener import FractionalZener
from fitting.stated.patches import Patch
from instrument.errors import BadInput
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.finding.diagnosis import diagnose
from instrument.finding.effect_names import effects_among
from instrument.models.files import File
from instrument.paper_case import case_file
from instrument.processes.other_processes import VARIABLE

OMEGA = 2 * np.pi * np.array([20.0, 100.0, 280.0])
PRACTICE = {
    "005": ({"spot_offset"}, (301911.854, 2462406.867, 1.05021e-4, 0.835801188)),
}
"""What is in the files, and the core's law: never seen by what is tested."""


def as_a_laboratory_states_it():
    """The same plate, each number within its typical tolerance."""
    return replace(plate_of_the_rig(), exact=False)


def practice(name):
    return read_sweep(DATA / f"practice-{name}.csv").sweep(9.81)


def every(nth, sweep):
    """Of its points; for what does not depend on how many there are."""
    return sweep.take(np.arange(0, len(sweep), nth))


def on(*specimens):
    return [effect for effect, _ in effects_among(specimens)]


def test_a_sweep_of_a_patch_is_asked_about_each_of_its_edges():
    plate = plate_of_the_rig()
    patched, unlike = (replace(plate, patches=(Patch(0.0, x, 0.05, 0.12),)) for x in (0.25, 0.2))

    def edges(effects):
        (debond,) = (e for e in effects if e.name == "partial_debond")
        return [(e.along, e.edge_m) for e in debond.variants() if e.at_edge]

    assert edges(on(patched)) == [("x", 0.0), ("x", 0.25), ("y", 0.05), ("y", 0.12)]
    assert edges(on(patched, unlike)) == [("x", None), ("y", None)]


def test_a_treatment_that_ends_short_does_so_at_every_clamp_of_its_beam():
    one = beam()
    two = replace(one, boundary="clamped-clamped")

    def clamps(effects):
        (free,) = (e for e in effects if e.name == "treatment_not_gripped")
        return [e.clamps for e in free.variants() if isinstance(e, TreatmentEndsShortEffect)]

    assert clamps(on(one)) == [1]
    assert clamps(on(two)) == [2]
    assert clamps(on(two, two)) == [2]
    assert clamps(on(one, two)) == []


RIVALS = "spot_offset", "gain_error", "added_mass", "base_rocking", "channel_delay"


@pytest.fixture(scope="module")
def shifted_spot():
    """What is said of the file with a shifted spot, the specimen exact."""
    return diagnose([File(every(3, practice("005")), plate_of_the_rig())]).result


def test_a_hidden_effect_is_named_and_the_law_put_right(shifted_spot):
    effects, law = PRACTICE["005"]
    found = shifted_spot
    assert {e.name for e in found.effects} == effects
    assert all(e.probability > 0.95 for e in found.effects)
    true, before, after = (
        one.modulus(OMEGA) for one in (FractionalZener(*law), found.before.law, found.after.law)
    )
    assert np.abs(after.real / true.real - 1).max() < 0.025
    assert np.abs(after.real / true.real - 1).max() < 0.5 * np.abs(before.real / true.real - 1).max()
    assert found.after.chi2_per_dof < 1.2 < found.before.chi2_per_dof
    assert "instead of" in " ".join(found.explanation)


@among(*RIVALS)
def test_numbers_that_may_be_otherwise_do_not_hide_it(without):
    effects, law = PRACTICE["005"]
    found = diagnose([File(every(4, practice("005")), as_a_laboratory_states_it())], without=without).result
    assert {e.name for e in found.effects} == effects
    band, true = found.after.band, FractionalZener(*law)
    off = np.abs(band.storage_modulus_pa - true.modulus(2 * np.pi * band.frequency_hz).real)
    assert np.mean(off < 1.96 * band.storage_modulus_standard_error_pa) > 0.9
    assert {a.name for a in found.after.adjusted} > {"substrate_young", "core_thickness", "pickup_x"}
    assert max(abs(a.pull) for a in found.after.adjusted) < 2
    # Without the effect the stated numbers are pulled far to make up for it.
    assert max(abs(a.pull) for a in found.before.adjusted) > 3


def test_what_only_fits_is_refused_and_said_to_be_nearest():
    """A shifted spot is well imitated by a gain beside a mass: their chi-square per degree is 1.2."""
    without = all_but("gain_error", "added_mass")
    found = diagnose([File(every(2, practice("005")), plate_of_the_rig())], without=without).result
    assert found.verdict == "unknown"
    assert min(c.chi2_per_dof for c in found.candidates if c.name != UNLISTED) < 1.25
    assert "gain_error with added_mass, would leave such data once in" in " ".join(found.explanation)


def test_where_all_that_lead_fail_every_place_is_tried():
    """The mass's own place promises least of seven by a linear step."""
    case = draw("added_mass", 96002)
    plate = replace(case.specimen, elements=MESH)
    found = diagnose([File(case.sweep, plate)], without=all_but("added_mass")).result
    (mass,) = found.effects
    place = mass.parameters["x"].value, mass.parameters["y"].value
    truth = case.truth.effects["added_mass"]
    assert np.hypot(place[0] - truth["x_m"], place[1] - truth["y_m"]) < 5e-3


def test_one_mass_is_not_taken_for_two():
    """From the law without it a single mass ends elsewhere; a search for two comes upon its place."""
    found = diagnose(
        [File(every(2, practice("007")), plate_of_the_rig())], without=all_but("added_mass", "added_masses")
    ).result
    (mass,) = found.effects
    assert (found.verdict, mass.name) == ("effect", "added_mass")
    assert np.hypot(mass.parameters["x"].value - 0.27, mass.parameters["y"].value - 0.06) < 4e-3


@pytest.mark.long
def test_a_rival_that_promises_little_by_a_linear_step_is_followed_all_the_same():
    """Beside a tether that explains everything a drift promises nothing, and then explains more."""
    case = draw_case("temperature_drift", 700038)
    found = diagnose([File(case.sweep, case.specimen)], without=all_but("tether", "temperature_drift")).result
    assert [e.name for e in found.effects] == ["temperature_drift"]


@pytest.mark.parametrize("processes", [3, pytest.param(2, marks=pytest.mark.long)])
def test_other_processes_change_nothing(monkeypatch, processes):
    some = all_but("gain_error", "channel_delay")
    sweep = every(4, practice("005"))
    alone = diagnose([File(sweep, plate_of_the_rig())], without=some).result
    assert len(alone.candidates) > len(CATALOGUE) - len(some)
    monkeypatch.setenv(VARIABLE, str(processes))
    shared = diagnose([File(sweep, plate_of_the_rig())], without=some).result
    assert repr(shared.candidates) == repr(alone.candidates)
    assert shared.explanation == alone.explanation
    assert np.array_equal(shared.after.law.values, alone.after.law.values)


@pytest.mark.parametrize(
    ("stated", "sure", "without"),
    [
        pytest.param(plate_of_the_rig, 0.75, set(), id="exact"),
        pytest.param(as_a_laboratory_states_it, 0.5, all_but(*RIVALS), id="tolerances, rivals"),
        pytest.param(as_a_laboratory_states_it, 0.5, set(), id="tolerances", marks=pytest.mark.long),
    ],
)
def test_a_clean_sweep_is_said_to_be_clean(stated, sure, without):
    found = diagnose([File(practice("002"), stated())], without=without).result
    assert found.verdict == "none"
    assert found.effects == ()
    assert found.after.law == found.before.law
    none = next(c for c in found.candidates if c.name == "none")
    assert none.probability > sure
    assert sum(c.probability for c in found.candidates) == pytest.approx(1.0)


@pytest.mark.parametrize("kind", ["mains_hum", "level_error"])
def test_hum_and_a_wrong_level_are_seen_in_the_channels(kind):
    case = draw(kind, 1)
    why, channels, _ = seen_in_channels(case.sweep, list(CATALOGUE.values()))
    assert [e.name for e in channels] == [kind]
    assert np.all(why == "") == (kind == "level_error")


@pytest.mark.long
def test_nine_amplitudes_cannot_name_one_effect():
    plate = read_specimen(case_file("zn1.toml"))
    sweep = read_sweep(case_file("table5.csv")).sweep(plate.base_acceleration_m_s2)
    found = diagnose([File(sweep, plate)]).result
    assert found.verdict == "none"
    assert found.before.rms_percent == pytest.approx(5.19, abs=0.02)
    assert found.before.validation.leave_one_out_rms_percent == pytest.approx(8.82, abs=0.05)
    probable = {c.name: c.probability for c in found.candidates}
    assert probable["none"] < 0.7
    assert probable["substrate_stiffness"] > 0.03
    # Without any effect a search finds as much; with the selection repeated it predicts no better.
    assert found.p_value > 0.05
    assert found.nested_held_out_rms_percent > 8.0
    # What nine amplitudes leave open is in the band.
    wider = (
        found.after.band.storage_modulus_standard_error_pa
        / found.before.band.storage_modulus_standard_error_pa
    )
    assert wider.max() > 1.2


def test_nine_amplitudes_do_not_make_a_misfit_likely_where_much_is_uncertain():
    """More stated numbers than amplitudes, and noise of unknown size: what fits three times worse is none."""
    plate = replace(read_specimen(case_file("zn1.toml")), exact=False, elements=(10, 10))
    sweep = read_sweep(case_file("table5.csv")).sweep(plate.base_acceleration_m_s2)
    without = all_but("absolute_velocity", "gain_error")
    found = diagnose([File(sweep, plate)], without=without, resamples=0).result
    assert found.verdict == "none"
    assert next(c.probability for c in found.candidates if c.name == "absolute_velocity") < 0.01


def test_of_few_points_it_is_said_what_a_search_finds_by_chance():
    plate = replace(read_specimen(case_file("zn1.toml")), elements=(10, 10))
    sweep = read_sweep(case_file("table5.csv")).sweep(plate.base_acceleration_m_s2)
    sweep = sweep.take(np.arange(len(sweep)) % 3 > 0)
    without = all_but("gain_error")
    found = diagnose([File(sweep, plate)], without=without, resamples=2).result
    assert found.verdict == "none"
    # Of two sweeps without any effect, and the one that was measured.
    assert found.p_value in (2 / 3, 1.0)
    assert found.resamples == 2
    # The selection repeated without each point: no better than one law alone.
    assert found.nested_held_out_rms_percent > 0.95 * found.before.validation.leave_one_out_rms_percent


def test_effects_are_accepted_and_declined_by_hand():
    given = [File(practice("005"), plate_of_the_rig())]
    told = diagnose(given, accept=("gain_error", "channel_delay")).result
    assert told.verdict == "effect"
    assert [e.name for e in told.effects] == ["gain_error", "channel_delay"]
    assert "By your word" in " ".join(told.explanation)
    assert told.after.chi2_per_dof < told.before.chi2_per_dof
    declined = diagnose(given, accept=()).result
    assert (declined.verdict, declined.effects) == ("none", ())
    assert declined.before.chi2_per_dof == pytest.approx(told.before.chi2_per_dof)


def test_another_law_and_an_effect_beside_it_are_accepted_by_hand():
    given = [File(practice("005"), plate_of_the_rig())]
    told = diagnose(given, accept=("spot_offset", "core_law")).result
    assert {e.name for e in told.effects} == {"core_law", "spot_offset"}
    assert told.after.chi2_per_dof < 1.1


def test_unknown_names_and_bare_plates_are_refused():
    sweep = practice("002").take(np.arange(20))
    with pytest.raises(BadInput, match="effect 'gremlins', expected one of"):
        diagnose([File(sweep, plate_of_the_rig())], without={"gremlins"})
    with pytest.raises(BadInput, match="effect 'gremlins', expected one of"):
        diagnose([File(sweep, plate_of_the_rig())], accept=["gremlins"])
    for given in ([File(sweep, plate_of_the_rig())], 2 * [File(sweep, plate_of_the_rig())]):
        with pytest.raises(BadInput, match="both accepted and left out"):
            diagnose(given, accept=["core_law"], without=["core_law"])
    with pytest.raises(BadInput, match="resamples with accepted effects: no search to repeat"):
        diagnose([File(sweep, plate_of_the_rig())], accept=["core_law"], resamples=2)
    with pytest.raises(BadInput, match="resamples: expected one sweep of a plate at one spot"):
        diagnose(given, resamples=2)
    with pytest.raises(OutsideModel, match="no core to diagnose"):
        diagnose([File(sweep, plate_of_the_rig().bare)])


@pytest.mark.long
def test_a_segment_in_another_range_is_named_with_its_frequencies():
    sweep = every(3, practice("002"))
    off = np.where(sweep.segment == 2, 1.12, 1.0)
    off_there = replace(sweep, velocity_m_s=sweep.velocity_m_s * off)
    rivals = all_but("segment_gain", "gain_error", "added_mass", "partial_debond", "fixture_resonance")
    result = diagnose([File(off_there, as_a_laboratory_states_it())], without=rivals).result
    (effect,) = result.effects
    assert (result.verdict, effect.name) == ("effect", "segment_gain")
    factor = effect.parameters["factor"]
    assert abs(factor.value - 1.12) < 3 * factor.standard_error < 0.03
    assert effect.parameters["from"].value == pytest.approx(85, abs=2)
    told = " ".join(result.explanation)
    assert "from 85 to 115 Hz alone" in told
    assert "the others cannot foretell" in told


def test_readings_that_were_lost_leave_law_and_verdict_as_they_are():
    sweep, plate = every(2, practice("002")), as_a_laboratory_states_it()
    v = sweep.velocity_m_s.copy()
    v[[10, 11, 12, 13, 90, 150]] *= 0.02
    among_few = all_but("signal_dropout", "gain_error", "fixture_resonance")
    clean = diagnose([File(sweep, plate)], without=among_few).result
    spoilt = diagnose([File(replace(sweep, velocity_m_s=v), plate)], without=among_few).result
    assert (clean.verdict, spoilt.verdict) == ("none", "none")
    (lost,) = spoilt.effects or spoilt.channels
    assert lost.name == "signal_dropout"
    assert lost.parameters["readings"].value == 6
    one, other = (r.after.law.modulus(OMEGA) for r in (clean, spoilt))
    assert np.abs(other / one - 1).max() < 0.01
