"""Explanations of tables of modes, weighed one by one."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, FACE, LAW, begun, read

from fitting.diagnosis.inference.refitted import by_chi2
from fitting.diagnosis.several.of_files import ALIKE, EACH, Place
from fitting.mode_tables.standing import standing

STIFF = replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9))
STIFFER = next(e for e in standing([BEAM]) if e.name == "substrate_stiffness")


@pytest.fixture(scope="module")
def two():
    return begun(read(BEAM, 5), read(BEAM, 5, seed=1))


def test_modes_left_out_are_predicted_within_their_errors_and_not_from_a_wrong_beam():
    work = begun(read(BEAM))
    assert 0.4 < work.held_out(work.scored(work.begun.none)) < 2.5
    stiff = begun(read(STIFF))
    none = stiff.scored(stiff.begun.none)
    (fitted,) = stiff.fits(STIFFER, stiff.begun.none)
    assert stiff.held_out(stiff.scored(fitted)) < 0.7 * stiff.held_out(none)
    assert stiff.scored(fitted).cost < none.cost


def test_another_law_is_not_held_to_what_was_left_out():
    work = begun(read(BEAM))
    other = next(e for e in standing([BEAM]) if e.replaces_law)
    fitted = work.fits(other, work.begun.none)
    assert fitted
    assert np.isnan(work.held_out(work.scored(fitted[0])))


def test_in_several_tables_an_effect_is_tried_in_all_and_in_each_and_fits_where_it_is():
    work = begun(read(BEAM, 5), read(STIFF, 5, seed=1))
    forms = work.forms(STIFFER)
    assert [[form.holds(Place(file)) for file in (1, 2)] for form in forms] == [
        [True, True],
        [True, False],
        [False, True],
    ]
    fits = [work.fits(form, work.begun.none)[0] for form in forms]
    costs = [work.scored(fit).cost for fit in fits]
    assert costs[2] < min(costs[:2])
    assert fits[2].u[-2] == pytest.approx(1.35, rel=0.03)


@pytest.mark.parametrize(
    "name", ["clamp_compliance", "clamp_friction", "clamp_line", "treatment_not_gripped"]
)
def test_every_form_of_what_comes_of_a_mounting_moves_the_modes_of_its_tables(two, name):
    problem, plain = two.begun.problem, two.begun.none
    forms = two.forms(next(e for e in standing([BEAM]) if e.name == name))
    assert EACH in {form.file for form in forms}
    for form in forms:
        u = form.starts(problem.members[0].wide, problem.points)[0]
        moved = problem.response([form]).velocity(plain.law, np.append(plain.u, u)) - plain.velocity_m_s
        of = [bool(np.any(np.abs(moved[part]) > 1e-9)) for part in problem.parts]
        assert of == [form.file in (ALIKE, EACH, k) for k in (1, 2)]


def test_tables_of_two_mountings_are_found_each_with_a_clamp_of_its_own(two):
    clamp = next(e for e in standing([BEAM]) if e.name == "clamp_compliance")
    each = next(form for form in two.forms(clamp) if form.file == EACH)
    problem, stiffness = two.begun.problem, [3e13, 1e14]
    known = np.array([*np.zeros(len(problem.each)), *stiffness, EACH])
    logs = problem.response([each]).velocity(LAW, known)
    tables = []
    for member, part in zip(problem.members, problem.parts, strict=True):
        f, eta = np.exp(logs.real[part]), np.exp(logs.imag[part] / member.kappa)
        tables.append(replace(member.table, frequency_hz=f, loss_factor=eta))
    work = begun(*tables)
    best = min((f for form in work.forms(clamp) for f in work.fits(form, work.begun.none)), key=by_chi2)
    assert best.effects[0].file == EACH
    np.testing.assert_allclose(best.of(best.effects[0])[:2], stiffness, rtol=0.15)
