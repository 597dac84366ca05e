"""Which of a fit's unknowns readings have that were not made yet."""

from types import SimpleNamespace

import numpy as np
from fitted_by_hand import FittedByHand

from fitting.diagnosis.several.of_files import EACH, OfFiles, Place
from fitting.effects import CATALOGUE
from fitting.planning.further_readings import FurtherReadings, effects_at, unknowns_of

GAIN, CLAMP = CATALOGUE["gain_error"], CATALOGUE["clamp_compliance"]
FITTED = FittedByHand(
    effects=(OfFiles(CLAMP, 2, EACH), OfFiles(GAIN, 2, 2)),
    law=SimpleNamespace(names=("g_pa", "loss")),
    u=np.array([0.3, -0.2, 3e13, 5e13, EACH, 1.02, 2.0]),
    stated=2,
)


def test_effects_of_a_place_are_those_it_has_with_its_own_unknowns():
    effects, places = effects_at(FITTED, Place(1))
    assert ([e.name for e in effects], [p.tolist() for p in places]) == (["clamp_compliance"], [[2]])
    effects, places = effects_at(FITTED, Place(2))
    assert [p.tolist() for p in places] == [[3], [5]]
    assert effects_at(FITTED, Place(2), frozenset({"clamp_compliance", "gain_error"})) == ([], [])


def test_a_number_that_is_another_one_stands_where_it_is_stated():
    numbers = [SimpleNamespace(name=n, kind=n) for n in ("gain", "length", "delay")]
    member = SimpleNamespace(nuisances=SimpleNamespace(each=numbers))
    further = FurtherReadings(member, np.arange(3), np.ones(3), new=frozenset({"length"}))
    found = unknowns_of(FITTED, further, Place(2), {"gain": 0, "length": 1})
    assert found.stated == [0, None, None]
    assert found.u.tolist() == [0.3, 0.0, 0.0, 5e13, 1.02]
    assert [(g, row) for _, g, row in found.of_effects()] == [(3, 5), (5, 6)]
    assert found.at_mass == 7
