"""Modes of several temperatures as members of one fit."""

from dataclasses import replace

import numpy as np
import pytest
from beam_temperatures import REFERENCE, beam, measured, wlf, zener

from fitting.mode_tables.build import member_of, with_own_error
from fitting.mode_tables.fit import start_of
from fitting.mode_tables.member import Member
from fitting.temperature.members import Joined
from fitting.temperature.tables import Tables, alone

T = (0.0, 20.0, 40.0)


def member(one, number=0):
    return member_of(one.data, beam(number).at_temperature(one.temperature_c))


@pytest.fixture(scope="module")
def made():
    return measured(zener, T, lambda t: wlf(t, 8.0, 110.0), beams=2, count=3, off_k=0.0)


@pytest.fixture(scope="module")
def begun(made):
    start = start_of([one.data for one in made], [beam(one.specimen - 1) for one in made])
    return [alone(member(one, one.specimen - 1), start).begun for one in made[:3]]


def test_each_temperature_s_law_is_found_from_a_start_that_is_decades_away(begun):
    for t, one in zip(T, begun, strict=True):
        omega = 2 * np.pi * one.problem.frequency_hz
        truth = zener(np.exp(wlf(t, 8.0, 110.0)) * omega)
        np.testing.assert_allclose(one.none.law.modulus(omega).real, truth.real, rtol=0.25)


def test_modes_of_one_beam_share_its_numbers_and_those_of_another_have_their_own(made):
    class Held:
        def __init__(self, one):
            self.problem = type("P", (), {"members": [member(one, one.specimen - 1)]})
            self.evidence = type("E", (), {"scale_known": True})

    numbers = [one.specimen for one in made]
    joined: Joined = Tables.of([Held(one) for one in made], numbers)
    names = [n.name for n in joined.each]
    assert [n for n in names if n.startswith("length")] == ["length [1]", "length [2]"]
    assert names.count("substrate_young") == names.count("substrate_young_per_k") == 1
    assert names.count("core_thickness") == 2
    assert joined.lengths == (3,) * 6
    length = names.index("length [1]")
    assert [length in at for at in joined.places] == [True] * 3 + [False] * 3


def test_what_the_theory_gets_wrong_of_a_mode_it_gets_wrong_at_every_temperature_alike(begun):
    joined = Tables.of(begun)
    B, n = joined.evidence.B, sum(joined.lengths)
    # Mode 2 of the three temperatures, in frequency.
    of_second = [c for c in B.T if c[1] and not c[0] and not c[2]]
    (column,) = of_second
    assert np.flatnonzero(column).tolist() == [1, 4, 7]
    assert len(column) == 2 * n
    again = joined.erring_at(begun[1].none.law)
    own = with_own_error(begun[0].problem.members[0], begun[1].none.law)
    assert isinstance(own, Member)
    np.testing.assert_allclose(again.problem.members[0].own_error[0], own.own_error[0])


def test_a_warmer_beam_is_softer_by_what_its_metal_says():
    cold = beam(young_per_k=-5e-4)
    warm = cold.at_temperature(REFERENCE + 40.0)
    assert warm.coefficients({})[0] == pytest.approx((1 - 0.02) * cold.coefficients({})[0])
    assert warm.section == cold.section
    assert "substrate_young_per_k" in warm.numbers
    assert "substrate_young_per_k" not in cold.numbers
    assert warm.tolerance("substrate_young_per_k") == pytest.approx(1e-4)
    moved = warm.coefficients({"constraining_young_per_k": 1e-4})[1]
    assert moved == pytest.approx((1 - 0.016) * cold.coefficients({})[1])
    assert replace(cold, exact=True).at_temperature(60.0).temperature_c == 60.0
