"""What a law cannot explain of a table of modes, traced to what it can see."""

from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases as pads
from beam_tables import BEAM, FACE, LAW, begun, read

from fitting.effects.base import Effect
from fitting.mode_tables.build import member_of
from fitting.mode_tables.diagnose import diagnose_modes, visible
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing
from fitting.mode_tables.table import ModalTable
from fitting.structures.small_modes import small_modes

FORMS = {e.name: e for e in standing([BEAM])}
STIFFER, THICKER = FORMS["substrate_stiffness"], FORMS["core_thickness"]


def diagnosed(table, *effects):
    told = []
    found = diagnose_modes(ModalProblem.of([member_of(table, BEAM)]), effects, LAW, told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    return found


def test_a_stiffer_face_is_named_and_its_factor_found():
    found = diagnosed(read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)), 4), STIFFER, THICKER)
    assert found.judgement.verdict == "effect"
    assert found.judgement.accepted.names == ("substrate_stiffness",)
    fitted = found.judgement.accepted.fitted
    error = np.sqrt(np.diag(fitted.covariance))[-1]
    assert abs(np.log(fitted.of(STIFFER)[0] / 1.35)) < 3 * error
    assert found.temper >= 1.0


def test_two_effects_are_not_certain_by_the_few_numbers_of_a_table_however_well_they_fit():
    both = replace(
        BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9), constraining=replace(FACE, thickness_m=1.5e-3)
    )
    found = diagnosed(read(both), STIFFER, FORMS["constraining_thickness"]).judgement
    assert set(found.accepted.names) == {"substrate_stiffness", "constraining_thickness"}
    assert found.verdict == "ambiguous"


def test_a_mass_at_the_free_end_is_found_there_without_its_place_being_paid_for():
    mass = FORMS["added_mass"]
    clean = read(BEAM)
    problem = ModalProblem.of([member_of(clean, BEAM)])
    known = [*np.zeros(len(problem.each)), 2e-3, BEAM.length_m]
    logs = problem.response([mass]).velocity(LAW, np.array(known))
    f, eta = np.exp(logs.real), np.exp(logs.imag / problem.members[0].kappa)
    with_mass = replace(clean, frequency_hz=f, loss_factor=eta)
    found = diagnosed(with_mass, mass).judgement
    assert found.verdict == "effect"
    m, x = found.accepted.fitted.of(found.accepted.fitted.effects[0])
    assert m == pytest.approx(2e-3, rel=0.02)
    assert x == BEAM.length_m
    assert not found.accepted.fitted.free[-1]


def test_of_a_beam_as_stated_nothing_is_named():
    found = diagnosed(read(BEAM), STIFFER)
    assert found.judgement.verdict == "none"
    assert {t.names for t in found.scored} == {(), ("substrate_stiffness",)}
    costs = [t.cost for t in found.scored]
    assert costs == sorted(costs)


@pytest.mark.parametrize("noise", [0.0, 0.5, 1.0])
def test_a_table_that_states_no_errors_is_not_known_better_for_being_met_well(noise):
    """Within half the usual errors, or exact to the last digit: those errors are still allowed for."""
    modes, noisy = small_modes(BEAM, LAW, 6), read(BEAM)
    f, eta = (np.array([getattr(m, name) for m in modes]) for name in ("frequency_hz", "loss_factor"))
    nearer = replace(
        noisy,
        frequency_hz=f * (noisy.frequency_hz / f) ** noise,
        loss_factor=eta * (noisy.loss_factor / eta) ** noise,
    )
    silent = replace(nearer, frequency_std_hz=None, loss_factor_std=None)
    stated, unsaid = (diagnosed(one, STIFFER, THICKER) for one in (nearer, silent))
    assert unsaid.judgement.verdict == "none"
    errors = [np.sqrt(np.diag(found.begun.none.covariance))[:2] for found in (stated, unsaid)]
    assert np.all(errors[1] > 0.99 * errors[0])


@pytest.mark.parametrize(
    ("name", "seen"),
    [("gain_error", False), ("channel_delay", False), ("core_law", True), ("substrate_stiffness", True)],
)
def test_modes_see_structure_and_law_and_no_channel(name, seen):
    assert visible(begun(read(BEAM, 3)).begun.problem, FORMS[name]) is seen


def test_an_effect_that_changes_nothing_here_is_not_tried():
    class Nothing(Effect):
        name = "nothing"

        def change(self, plate, u):
            return None

    assert not visible(begun(read(BEAM, 3)).begun.problem, Nothing())


def test_a_pad_s_mass_hides_in_its_law_and_is_said_to():
    law, specimens = LAW, [pads.pair(m) for m in (0.2533, 0.2533, 0.2533)]
    members, rng = [], np.random.default_rng(2)
    for specimen in specimens:
        (mode,) = small_modes(specimen, law, 1)
        f, eta = mode.frequency_hz * (1 + 1e-3 * rng.normal()), mode.loss_factor * (1 + 0.03 * rng.normal())
        table = ModalTable(*np.array([[1.0], [f], [eta], [1e-3 * f], [0.03 * eta]]), read="model")
        members.append(member_of(table, specimen))
    mass = next(e for e in standing(specimens) if e.name == "added_mass")
    judgement = diagnose_modes(ModalProblem.of(members), [mass], law).judgement
    assert judgement.verdict == "ambiguous"
    assert judgement.equivalent == {"added_mass": ("added_mass", "none")}
    assert "cannot be told from the core's modulus" in judgement.note
