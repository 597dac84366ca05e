"""Rigs and experiments whose numbers are a unit away from the right ones."""

import tomllib

import pytest

from instrument.files.new_file import TEMPLATES
from instrument.files.plausible_rig import experiment_doubts, rig_doubts
from instrument.simulated_case import case_file


def tables(path):
    return tomllib.loads(path.read_text())


@pytest.mark.parametrize("path", [TEMPLATES["rig"], TEMPLATES["real-rig"], case_file("rig.toml")], ids=str)
def test_usual_rigs_are_not_questioned(path):
    assert list(rig_doubts(tables(path))) == []


@pytest.mark.parametrize("path", [TEMPLATES["experiment"], case_file("experiment.toml")], ids=str)
def test_usual_experiments_are_not_questioned(path):
    assert list(experiment_doubts(tables(path))) == []


@pytest.mark.parametrize(("mv", "unit"), [(0.0102, "V"), (980.0, "mV per g")])
def test_a_sensitivity_names_the_unit_it_was_probably_in(mv, unit):
    (said,) = rig_doubts({"channels": {"base": {"sensitivity_mv_per_unit": mv}}})
    assert said.startswith(f"channels.base.sensitivity_mv_per_unit = {mv:g} is outside")
    assert said.endswith(f": is it in {unit}?")


def test_a_blow_on_the_very_edge_is_one():
    assert list(experiment_doubts({"hammer": {"hit_x_mm": 300.2, "hit_y_mm": 0.0}})) == []
