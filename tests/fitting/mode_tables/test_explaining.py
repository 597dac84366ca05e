"""Explanations of tables of modes, weighed one by one."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, FACE, begun, read

from fitting.diagnosis.several.of_files import Place
from fitting.mode_tables.standing import standing

STIFF = replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9))
STIFFER = next(e for e in standing([BEAM]) if e.name == "substrate_stiffness")


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
