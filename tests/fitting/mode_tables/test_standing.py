from dataclasses import replace

from beam_temperatures import beam

from fitting.effects import CATALOGUE
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.standing import standing
from fitting.stated.layers import Core
from fitting.structures import ShearPair


def test_what_stands_on_a_specimen_are_forms_for_it():
    pair = ShearPair(0.5, 2, 7e-4, Core(6e-3, 0.4999, 1100.0, ConstantModulus(1e6, 0.5)))
    found = {e.name: e for e in standing([pair])}
    assert found.keys() <= set(CATALOGUE)
    assert len(found["added_mass"].parameters) == 1
    assert "clamp_compliance" not in found


def test_what_one_of_them_cannot_have_is_not_asked_of_all():
    clamped = beam()
    free = replace(clamped, boundary="free-free")
    assert "clamp_compliance" in names(standing([clamped, clamped]))
    for some in ([clamped, free], [free, clamped]):
        assert "clamp_compliance" not in names(standing(some))
        assert "added_mass" in names(standing(some))


def names(effects):
    return {e.name for e in effects}
