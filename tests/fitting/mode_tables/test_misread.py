"""A row of a table of modes that is not what the others say."""

from dataclasses import replace

import pytest
from beam_tables import BEAM, FACE, KNOWN_NEARLY, LAW, SOFT, begun, nearly_read, read, with_row

from fitting.mode_tables.build import member_of
from fitting.mode_tables.diagnose import diagnose_modes
from fitting.mode_tables.fit import begin_modal, problem_of, start_of
from fitting.mode_tables.misread import misread
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing

FORMS = {e.name: e for e in standing([BEAM])}


@pytest.mark.parametrize("k", range(6))
@pytest.mark.parametrize(("f", "eta"), [(1.05, 1.0), (1.0, 1.9), (0.93, 0.7)])
def test_the_odd_row_is_found_and_where_the_others_have_it(k, f, eta):
    table = read(BEAM)
    odd = misread(begun(with_row(table, k, f, eta)).begun)
    assert odd is not None
    assert odd.place == k
    assert odd.frequency_hz == pytest.approx(table.frequency_hz[k], rel=0.01)
    assert odd.loss_factor == pytest.approx(table.loss_factor[k], rel=0.25)
    assert odd.others.chi2_per_dof < 3


@pytest.mark.parametrize("seed", range(12))
def test_of_noise_no_row_is_odd(seed):
    assert misread(begun(read(BEAM, seed=seed)).begun) is None


def test_what_all_rows_say_is_of_none_of_them():
    other = replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9))
    assert misread(begun(read(other)).begun) is None


def test_of_three_modes_any_could_be_left_out():
    assert misread(begun(with_row(read(BEAM, 3), 1, 1.05)).begun) is None


def test_two_odd_rows_are_none():
    table = with_row(with_row(read(BEAM), 1, 1.08), 4, 0.94)
    assert misread(begun(table).begun) is None


def test_no_effect_is_named_for_a_row_that_is_misread():
    table = with_row(read(BEAM), 2, 1.05)
    problem = ModalProblem.of([member_of(table, BEAM)])
    effects = [FORMS[name] for name in ("core_law", "added_mass", "substrate_stiffness")]
    found = diagnose_modes(problem, effects, LAW)
    assert (found.judgement.verdict, found.judgement.accepted) == ("unknown", None)
    assert found.odd.place == 2


def test_where_an_effect_explains_all_rows_none_is_called_odd():
    other = replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9))
    problem = ModalProblem.of([member_of(read(other), BEAM)])
    found = diagnose_modes(problem, [FORMS["substrate_stiffness"]], LAW)
    assert (found.judgement.verdict, found.odd) == ("effect", None)


def begun_nearly(table):
    problem = problem_of([table], [KNOWN_NEARLY])
    return begin_modal(problem, start_of([table], [KNOWN_NEARLY]))


@pytest.mark.parametrize(("k", "f", "eta"), [(0, 0.94, 1.0), (0, 1.06, 1.0), (1, 1.03, 1.0), (1, 1.0, 1.25)])
def test_the_row_that_a_law_bends_for_is_found_where_no_reading_is_off(k, f, eta):
    right = nearly_read()
    begun = begun_nearly(with_row(right, k, f, eta))
    assert begun.none.chi2_per_dof < 3
    odd = misread(begun)
    assert not odd.plain
    assert odd.place == k
    assert odd.frequency_hz == pytest.approx(right.frequency_hz[k], rel=0.015)
    assert odd.loss_factor == pytest.approx(right.loss_factor[k], rel=0.25)
    assert odd.with_it > odd.others.chi2 + 12


def test_where_errors_are_not_stated_it_has_to_stand_out_by_what_the_others_leave():
    unsaid = replace(with_row(nearly_read(), 0, 0.93), frequency_std_hz=None, loss_factor_std=None)
    odd = misread(begun_nearly(unsaid))
    assert (odd.place, odd.plain) == (0, False)


@pytest.mark.parametrize("seed", range(10))
def test_a_law_that_may_bend_has_no_odd_row_in_noise(seed):
    assert misread(begun_nearly(nearly_read(seed))) is None


def test_a_row_and_an_effect_that_do_alike_are_both_said():
    table = with_row(nearly_read(), 0, 0.95)
    problem = ModalProblem.of([member_of(table, KNOWN_NEARLY)])
    forms = {e.name: e for e in standing([KNOWN_NEARLY])}
    found = diagnose_modes(problem, [forms["treatment_not_gripped"], forms["added_mass"]], SOFT)
    assert found.odd is not None or found.rival is not None
    said = found.odd or found.rival
    assert said.place == 0
    assert found.judgement.verdict in ("ambiguous", "unknown")
