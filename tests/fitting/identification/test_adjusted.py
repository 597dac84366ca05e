"""Stated numbers as a fit has moved them, in the units of results."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.identification.adjusted import adjusted, is_relative
from fitting.nuisances.nuisance import Nuisance
from fitting.stated.layers import Glue

YOUNG = Nuisance("substrate_young", "substrate_young", 0.01)
PICKUP = Nuisance("pickup_y", "pickup", 5e-4)
GAIN = Nuisance("gain", "gain", 0.02)
DELAY = Nuisance("delay", "delay", 2e-6)
DAMPING = Nuisance("damping_2", "damping", 0.3)


def found(specimen, nuisance, z, error=0.5):
    return adjusted(specimen, [nuisance], np.array([z]), np.array([error]))[0]


def test_a_relative_number_is_moved_in_its_logarithm(zn1):
    one, young = found(zn1, YOUNG, 2.0), zn1.substrate.young_pa / 1e9
    assert (one.unit, one.stated, one.pull) == ("GPa", pytest.approx(young), 2.0)
    assert one.tolerance == pytest.approx(0.01 * young)
    assert one.found == pytest.approx(young * np.exp(0.02))
    assert one.standard_error == pytest.approx(one.found * 0.01 * 0.5)


def test_a_place_is_moved_by_so_many_millimetres(zn1):
    one = found(zn1, PICKUP, -1.5)
    assert (one.unit, one.found - one.stated) == ("mm", pytest.approx(-0.75))
    assert one.stated == pytest.approx(1e3 * zn1.pickup_m[1])
    assert one.standard_error == pytest.approx(0.25)


def test_a_channel_s_gain_is_one_and_its_delay_none_as_stated(zn1):
    assert found(zn1, GAIN, 1.0).found == pytest.approx(1.02)
    assert found(zn1, DELAY, 1.0).found == pytest.approx(2.0)
    assert found(zn1, DELAY, 1.0).unit == "us"
    assert [is_relative(n) for n in (YOUNG, GAIN, DELAY, PICKUP)] == [True, False, False, False]


def test_a_mode_has_its_own_ratio(zn1):
    assert found(zn1, DAMPING, 0.0).found == pytest.approx(100 * zn1.modal_ratios[1])


def test_glue_is_that_of_the_first_layer(zn1):
    core = replace(zn1.core, glue=(Glue(3e-5, 2e7, 1100.0), Glue(5e-5, 4e7, 1200.0)))
    glued = replace(zn1, core=core)
    assert found(glued, Nuisance("glue_thickness", "glue_thickness", 0.1), 0.0).found == pytest.approx(0.03)
