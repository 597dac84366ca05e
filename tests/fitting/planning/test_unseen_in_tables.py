"""What a table of modes could not have seen, beside a fit of a table that has it."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, FACE, LAW, read

from fitting.data.readings import Readings
from fitting.diagnosis.inference.refit import refit
from fitting.mode_tables.build import member_of
from fitting.mode_tables.diagnose import diagnose_modes
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.standing import standing
from fitting.planning.unseen_in_tables import unseen_in_tables

FORMS = {e.name: e for e in standing([BEAM])}
SOME = tuple(FORMS[name] for name in ("substrate_stiffness", "core_thickness", "tether", "channel_delay"))


@pytest.fixture(scope="module")
def clean():
    return diagnose_modes(ModalProblem.of([member_of(read(BEAM), BEAM)]), SOME[:1], LAW)


def test_what_is_listed_shifts_the_law_by_what_is_said_and_leaves_no_more_than_would_be_seen(clean):
    listed = {one.name: one for one in unseen_in_tables(clean, SOME)}
    begun = clean.begun
    for name in ("core_thickness", "substrate_stiffness"):
        one, problem = listed[name], begun.problem
        (form, *_) = FORMS[name].variants()
        keys = [q.key for q in form.parameters]
        absent = np.array([float(q.neutral or 0) for q in form.parameters])
        there = np.where(np.array(keys) == one.key, one.size, absent)
        without, with_form = (np.concatenate([begun.none.u, u]) for u in (absent, there))
        v = problem.response([form]).velocity
        moved = v(begun.none.law, with_form) - v(begun.none.law, without)
        with_it = replace(begun.evidence, readings=Readings(begun.none.velocity_m_s + moved))
        found = refit(problem.response(), with_it, begun.none.law, begun.none.u)
        f = 2 * np.pi * np.geomspace(problem.frequency_hz.min(), problem.frequency_hz.max(), 21)
        shift = np.abs(found.law.storage_and_loss(f)[0] / begun.none.law.storage_and_loss(f)[0] - 1).max()
        assert shift == pytest.approx(one.storage_modulus, rel=0.3)
        assert found.chi2 < 4.0**2 * 1.1


def test_channels_leave_no_trace_in_a_table_and_are_not_listed(clean):
    assert "channel_delay" not in {one.name for one in unseen_in_tables(clean, SOME)}


def test_nothing_is_listed_beside_what_nothing_explains():
    table = read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)))
    other = replace(table, frequency_hz=table.frequency_hz * (1 + 0.01 * (-1) ** table.mode))
    found = diagnose_modes(ModalProblem.of([member_of(other, BEAM)]), SOME[:1], LAW)
    assert found.judgement.verdict == "unknown"
    assert unseen_in_tables(found, SOME) == []
