"""How stated numbers shift the modes of a hammer test, against plates built anew."""

from dataclasses import replace

import numpy as np
import pytest
from bare_plates import frequencies_hz
from bare_plates import zn1 as zn1
from scipy.sparse.linalg import eigsh

from fitting.dynamics.bare_modes import (
    CarriedSensor,
)
from fitting.effects import CATALOGUE
from fitting.effects.orthotropic_substrate import sheet
from fitting.identification.bare_plate import (
    FREQUENCY_SCATTER,
    match_modes,
)
from fitting.nuisances.nuisance import Nuisance
from fitting.nuisances.nuisances import Nuisances
from fitting.plate.element import U_B, V_B, Shape, face_stiffness
from fitting.plate.plate import Plate
from fitting.plate.plate_numbers import moved, plate_numbers
from fitting.stated.tolerances import STATED
from instrument.models.set_up import bare_of


@pytest.fixture(scope="module")
def bare_test(zn1):
    """A hammer test with a sensor on the plate, and the stated numbers, each with its typical tolerance."""
    sensor = CarriedSensor(2e-3, 0.25, 0.03)
    modes = match_modes(zn1, frequencies_hz(zn1, sensor), np.array(zn1.modal_ratios), sensor)
    names = [n for n, _ in plate_numbers(zn1)]
    return (
        bare_of(modes, replace(zn1, exact=False)),
        Nuisances(zn1, tuple(Nuisance(n, n, STATED[n].typical) for n in names)),
        sensor,
    )


def test_as_stated_nothing_is_shifted(bare_test):
    bare, nuisances, _ = bare_test
    z = np.zeros(len(nuisances))
    np.testing.assert_allclose(bare.shift, 0, atol=1e-9)
    np.testing.assert_allclose(bare.stated_shift(nuisances, z), 0, atol=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_stated_numbers_shift_the_modes_as_a_plate_built_anew(bare_test, zn1, seed):
    """By Rayleigh's quotient, to less than half of what the test scatters.

    The test has a clamp line of its own: its length is not the sweep's.
    """
    bare, nuisances, sensor = bare_test
    z = 1.5 * np.random.default_rng(seed).normal(size=len(nuisances))
    names = [n.name for n in nuisances.each]
    by = [0.0 if n == "length" else STATED[n].typical * step for n, step in zip(names, z, strict=True)]
    expected = np.log(frequencies_hz(moved(zn1, names, by), sensor) / frequencies_hz(zn1, sensor))
    found = bare.stated_shift(nuisances, z)
    assert np.abs(expected).max() > 2e-3
    np.testing.assert_allclose(found, expected, atol=0.4 * FREQUENCY_SCATTER)


def test_derivatives_of_the_shift_agree_with_differences(bare_test):
    bare, nuisances, _ = bare_test
    z = np.round(np.random.default_rng(9).normal(size=len(nuisances)))
    by = bare.by_stated(nuisances, z)
    for k, n in enumerate(nuisances.each):
        step = 1e-2 * np.eye(len(z))[k]
        difference = (bare.stated_shift(nuisances, z + step) - bare.stated_shift(nuisances, z - step)) / 2e-2
        np.testing.assert_allclose(by[k], difference, atol=1e-7, err_msg=n.name)
        felt = n.name.startswith("substrate") or n.name == "width"
        assert by[k].any() == felt
    assert [nuisances.each[k].name for k in nuisances.of_bare_plate] == [
        n.name for k, n in enumerate(nuisances.each) if by[k].any()
    ]


def test_a_rolled_sheet_shifts_the_modes_as_one_solved_anew(bare_test, zn1):
    bare, _, _ = bare_test
    plate, ratio = Plate(zn1.bare), 1.02
    shape, plain = Shape(*plate.mesh.sides_m), zn1.substrate
    rolled, isotropic = (face_stiffness(shape, face, U_B, V_B) for face in (sheet(plain, ratio), plain))
    K = plate.K_0.real + plate.scatter(rolled - isotropic)
    solved, stated = (
        np.sqrt(np.sort(eigsh(A.tocsc(), 8, plate.M.tocsc(), sigma=0.0)[0])) for A in (K, plate.K_0.real)
    )
    found = CATALOGUE["orthotropic_substrate"].bare_shift(bare, np.array([ratio, 0.0]))
    expected = np.log(solved / stated)
    assert np.ptp(expected) > 4e-3
    np.testing.assert_allclose(found[: len(expected)], expected, atol=0.4 * FREQUENCY_SCATTER)


def test_a_clamp_line_further_out_lowers_the_modes(bare_test, zn1):
    bare, _, _ = bare_test
    longer = frequencies_hz(moved(zn1, ["length"], [3e-4]))
    fall = -np.log(longer / frequencies_hz(zn1))
    np.testing.assert_allclose(3e-4 * bare.by_line, fall, rtol=0.03, atol=2e-6)
