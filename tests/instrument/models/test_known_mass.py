"""A mass of known size that somebody put on the plate: stated, not looked for."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig

from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.several.responses import response_of
from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import solve_direct
from fitting.effects import CATALOGUE
from fitting.errors import OutsideModel
from fitting.plate.plate import Plate
from fitting.specimen import PlacedMass
from instrument.errors import BadInput
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.models.set_up import set_up
from instrument.models.specimen_models import Models
from instrument.simulated_case import case_file

MASS = PlacedMass(8e-3, 0.21, 0.05)


@pytest.fixture(scope="module")
def problems():
    """Of the same sweep, without a mass and with one."""
    sweep = read_sweep(DATA / "practice-005.csv").sweep(9.81).take(np.arange(0, 240, 8))
    plain = replace(plate_of_the_rig(), exact=False)
    heavy = replace(plain, masses=(MASS,))
    without, with_one = (set_up(sweep, s).problem for s in (plain, heavy))
    # Stated, its own motions are among the plate's; one that is looked for may be anywhere.
    return [replace(without, plate=with_one.plate), with_one]


def test_it_does_what_a_mass_found_there_does(problems):
    plain, heavy = problems
    law = plain.stated_law
    found = SweepResponse(plain, [CATALOGUE["added_mass"]])
    u = np.concatenate([plain.as_stated, [MASS.mass_kg, MASS.x_m, MASS.y_m]])
    stated = SweepResponse(heavy, ())
    v = stated.velocity(law, heavy.as_stated)
    assert np.abs(v / found.velocity(law, u) - 1).max() < 1e-9
    bare = SweepResponse(plain, ()).velocity(law, plain.as_stated)
    assert np.abs(v / bare - 1).max() > 0.05


def of_the_whole_plate(specimen, mass, omega, law):
    """Relative velocity with a mass, by receptances of all degrees of freedom."""
    plate, acceleration = Plate(specimen), specimen.base_acceleration_m_s2
    damping, row = viscous_damping(plate), plate.observe(mass.x_m, mass.y_m)
    loads, found = np.column_stack([plate.load, row]), []
    for w, G in zip(omega, law.modulus(omega), strict=True):
        base, unit = solve_direct(plate.dynamic_stiffness(w, G), w, damping, loads).T
        # It pulls by m (w^2 u - a), a of the base.
        pull = mass.mass_kg * (w**2 * (row @ base) - 1) / (1 - mass.mass_kg * w**2 * (row @ unit))
        found.append(1j * w * acceleration * (plate.pickup @ (base + pull * unit)))
    return np.array(found)


@pytest.mark.parametrize("exact", [True, False])
def test_a_heavy_one_is_as_on_the_whole_plate(exact):
    heavy = PlacedMass(60e-3, 0.25, 0.06)
    plate = replace(plate_of_the_rig(), exact=exact)
    sweep = read_sweep(DATA / "practice-005.csv").sweep(9.81).take(np.arange(0, 240, 8))
    problem = set_up(sweep, replace(plate, masses=(heavy,))).problem
    law = problem.stated_law
    near = problem.condensed(law).around(law)
    v = response_of(near, (), near.fine).velocity(law, near.as_stated)
    whole = of_the_whole_plate(problem.specimen, heavy, sweep.omega, law)
    assert np.abs(v / whole - 1).max() < 5e-4


TOLERANCES = {
    "mass_1": (8.0, 0.16, "g"),
    "place_1_x": (210.0, 0.5, "mm"),
    "place_1_y": (50.0, 0.5, "mm"),
    "length": (300.2, 0.3, "mm"),
}


@pytest.mark.parametrize("name", TOLERANCES)
def test_its_tolerances_are_unknowns_with_derivatives(problems, name):
    heavy = problems[1]
    names = [n.name for n in heavy.nuisances.each]
    k, law = names.index(name), heavy.stated_law
    response = SweepResponse(heavy, ())
    z = heavy.as_stated
    _, by = response.with_derivatives(law, z)
    h = 0.05 * np.eye(len(z))[k]
    slope = (response.velocity(law, z + h) - response.velocity(law, z - h)) / 0.1
    mine = by[len(law.names) + k]
    assert np.abs(mine - slope).max() < 0.01 * np.abs(slope).max()
    stated = heavy.adjusted(z, np.ones(len(z)))[k]
    assert (stated.stated, stated.tolerance, stated.unit) == pytest.approx(TOLERANCES[name])


def of_a_longer_plate(plain, u):
    """What is found with the clamp's line 2 mm further back, and a mass."""
    effects = [CATALOGUE["clamp_line"], CATALOGUE["added_mass"]]
    start = np.concatenate([plain.as_stated, [2e-3, 1.0], u])
    return SweepResponse(plain, effects).velocity(plain.stated_law, start)


def test_where_the_clamp_line_is_elsewhere_it_stays_so_far_from_the_free_end(problems):
    plain, heavy = problems
    z = np.concatenate([heavy.as_stated, [2e-3, 1.0]])
    v = SweepResponse(heavy, [CATALOGUE["clamp_line"]]).velocity(heavy.stated_law, z)
    length = heavy.specimen.length_m
    # The mesh is that of the stated plate, stretched.
    by_tip = (MASS.x_m + 2e-3) * length / (length + 2e-3)
    assert np.abs(v / of_a_longer_plate(plain, [MASS.mass_kg, by_tip, MASS.y_m]) - 1).max() < 1e-9
    stretched = of_a_longer_plate(plain, [MASS.mass_kg, MASS.x_m, MASS.y_m])
    assert np.abs(v / stretched - 1).max() > 1e-3


def test_a_length_that_is_another_one_leaves_it_by_the_free_end_too(problems):
    plain, heavy = problems
    k = [n.name for n in heavy.nuisances.each].index("length")
    z = heavy.as_stated + 3 * np.eye(len(heavy.as_stated))[k]
    v = SweepResponse(heavy, ()).velocity(heavy.stated_law, z)
    length, longer = heavy.specimen.length_m, 3 * heavy.nuisances.each[k].sigma
    u = [MASS.mass_kg, (MASS.x_m + longer) * length / (length + longer), MASS.y_m]
    m = [n.name for n in plain.nuisances.each].index("length")
    start = np.concatenate([plain.as_stated + 3 * np.eye(len(plain.as_stated))[m], u])
    found = SweepResponse(plain, [CATALOGUE["added_mass"]]).velocity(plain.stated_law, start)
    assert np.abs(v / found - 1).max() < 1e-9


def test_other_commands_say_that_they_do_not_know_it(problems):
    with pytest.raises(OutsideModel, match=r"\[\[mass\]\]"):
        Models.of(problems[1].specimen, np.array([20.0, 100.0]))


@pytest.mark.parametrize(
    ("more", "found"),
    [
        ("\n[[mass]]\nmass_kg = 0.005\nx_mm = 900\ny_mm = 20\n", "mass.x_mm = 900 is off the plate"),
        ("\n[[mass]]\nmass_kg = -1\nx_mm = 10\ny_mm = 20\n", "mass"),
    ],
)
def test_a_mass_that_cannot_be_is_refused_in_one_line(tmp_path, more, found):
    path = tmp_path / "specimen.toml"
    path.write_text(case_file("specimen.toml").read_text() + more)
    with pytest.raises(BadInput, match=found.replace(".", r"\.")):
        read_specimen(path)


def test_a_file_states_it_in_its_units(tmp_path):
    path = tmp_path / "specimen.toml"
    path.write_text(
        case_file("specimen.toml").read_text() + "\n[[mass]]\nmass_kg = 0.005\nx_mm = 210\ny_mm = 50\n"
    )
    assert read_specimen(path).masses == (PlacedMass(0.005, 0.21, 0.05),)
