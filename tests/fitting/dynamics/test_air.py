from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.linalg as la
from hypothesis import given
from hypothesis import strategies as st

from drivers.simulated.plant import air as lattice
from fitting.dynamics.air import air_factor, air_lowering, still_air
from fitting.dynamics.real_modes import real_modes
from fitting.effects.air_added_mass import AirAddedMassEffect
from fitting.plate.element import DOFS, THETA_X, THETA_Y, U_B, U_C, V_B, V_C, W
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face

ALUMINIUM = Face(1.9e-3, 68.9e9, 0.3, 2700.0)
MODES = 10


def rectangle(length_m, width_m, elements=None, boundary="free"):
    return Plate(PlateSpecimen(length_m, width_m, boundary, ALUMINIUM, elements=elements))


def heave_mass(length_m, width_m, counts=None):
    plate = rectangle(length_m, width_m, (max(8, round(8 * length_m / width_m)), 10))
    return float(np.sum(still_air(plate, counts).heave ** 2))


@pytest.fixture(scope="module")
def bare(zn1):
    return Plate(zn1.bare)


@pytest.fixture(scope="module")
def modes(bare):
    return real_modes(bare, 0.0, 40)


@pytest.fixture(scope="module")
def still(bare):
    return still_air(bare)


@pytest.fixture(scope="module")
def few(bare):
    return still_air(bare, (5, 4))


# DNVGL-RP-N103, Table A-2: mass / (rho pi a^2 b / 4) of a rectangle a x b that moves broadside.
@pytest.mark.parametrize(
    ("aspect", "coefficient"),
    [
        (1.0, 0.579),
        (1.25, 0.642),
        (1.5, 0.690),
        (1.59, 0.704),
        (2.0, 0.757),
        (2.5, 0.801),
        (3.0, 0.830),
        (4.0, 0.872),
        (5.0, 0.897),
        (8.0, 0.934),
        (10.0, 0.947),
    ],
)
def test_heaving_rectangle_carries_the_published_mass(aspect, coefficient):
    assert heave_mass(aspect, 1.0) / (np.pi / 4 * aspect) == pytest.approx(coefficient, abs=0.002)


def test_a_longer_strip_gains_what_plane_flow_says():
    """Conformal mapping: pi b^2/4 a length in heave, pi b^4/128 in roll. Ends are alike and drop out."""
    mass = []
    for length in (10.0, 20.0):
        plate = rectangle(length, 1.0, (80, 8))
        roll = np.zeros((plate.mesh.nodes, DOFS))
        roll[:, W] = plate.mesh.node_positions()[:, 1] - 0.5
        roll[:, THETA_X] = 1.0
        found = still_air(plate, (14, 6))
        mass.append([np.sum(found.heave**2), np.sum((roll.ravel()[plate.free] @ found.L) ** 2)])
    gained = np.subtract(mass[1], mass[0]) / 10.0
    np.testing.assert_allclose(gained, [np.pi / 4, np.pi / 128], rtol=2e-3)


def test_a_plate_and_the_same_plate_turned_carry_the_same():
    assert heave_mass(0.2, 0.3) == pytest.approx(heave_mass(0.3, 0.2), rel=1e-10)


@pytest.mark.parametrize("scale", [0.05, 20.0])
def test_mass_goes_with_the_cube_of_the_size(scale):
    assert heave_mass(0.3 * scale, 0.2 * scale) == pytest.approx(heave_mass(0.3, 0.2) * scale**3, rel=1e-10)


def test_modes_have_converged_in_the_number_of_functions(bare, modes, still):
    shapes = modes.shapes[:, :MODES]
    mass = ((still.L.T @ shapes) ** 2).sum(axis=0)
    finest = ((still_air(bare, (14, 12)).L.T @ shapes) ** 2).sum(axis=0)
    np.testing.assert_allclose(mass, finest, rtol=2e-3)
    np.testing.assert_allclose(mass[:6], finest[:6], rtol=1e-4)


@given(mixture=st.lists(st.integers(-9, 9), min_size=MODES, max_size=MODES).filter(np.any))
def test_more_functions_never_take_mass_away(few, modes, still, mixture):
    """Galerkin approaches the energy from below; quadrature moves it by 1e-5."""
    w = modes.shapes[:, :MODES] @ np.array(mixture)
    less, more = (np.sum((found.L.T @ w) ** 2) for found in (few, still))
    assert 0 < less <= more * (1 + 1e-5)


def test_every_mode_carries_air_and_no_two_are_alike(modes, still):
    carried = still.L.T @ modes.shapes[:, :MODES]
    energy = la.eigvalsh(carried.T @ carried)
    assert energy[0] > 0.1 * energy[-1]


def test_even_motion_gives_no_odd_force(bare, still):
    forces = (bare.odd.T @ still.L) @ (still.L.T @ bare.even)
    assert np.abs(forces).max() < 1e-12 * np.abs((bare.even.T @ still.L) @ (still.L.T @ bare.even)).max()


def test_motion_in_the_plane_moves_no_air(zn1):
    L = air_factor(Plate(replace(zn1, boundary="free", elements=(10, 8)))).reshape(-1, DOFS, 48)
    assert not L[:, [U_C, V_C, U_B, V_B]].any()
    assert np.abs(L[:, W]).max() > 0


@pytest.mark.parametrize("elements", [(8, 8), (17, 9)])
def test_rigid_motion_does_not_feel_the_mesh(still, zn1, elements):
    coarse = still_air(Plate(replace(zn1.bare, elements=elements)))
    np.testing.assert_allclose(coarse.heave, still.heave, atol=1e-9 * np.abs(still.heave).max())
    np.testing.assert_allclose(coarse.pitch, still.pitch, atol=1e-9 * np.abs(still.pitch).max())


def test_the_base_moves_the_held_root_too(still, zn1):
    """Of a free plate every node is in L: its rigid motions are the base's."""
    loose = Plate(replace(zn1.bare, boundary="free"))
    L = air_factor(loose)
    node = np.repeat(np.arange(loose.mesh.nodes), DOFS)[loose.free]
    dof = loose.free % DOFS
    heave = (dof == W).astype(float)
    pitch = np.where(dof == W, loose.mesh.node_positions()[node, 0], -1.0 * (dof == THETA_Y))
    np.testing.assert_allclose(heave @ L, still.heave, atol=1e-12)
    np.testing.assert_allclose(pitch @ L, still.pitch, atol=1e-12)


def test_another_method_finds_the_same_mass_and_load(bare, modes, still):
    """A lattice of vortex rings; its error goes with the square of the panel, and is taken off."""
    w = modes.shapes[:, :6]
    carried = np.column_stack([still.heave, still.pitch, still.L.T @ w])
    found = carried.T @ carried
    coarse, fine = (_by_lattice(bare, w, panels) for panels in ((24, 16), (36, 24)))
    size = np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert np.abs((fine - found) / size).max() < 0.01
    extrapolated = fine + (fine - coarse) / ((36.5 / 24.5) ** 2 - 1)
    assert np.abs((extrapolated - found) / size).max() < 0.001


def _by_lattice(plate, shapes, panels):
    """Masses and their coupling between heave, pitch and shapes."""
    length, width = plate.mesh.length_m, plate.mesh.width_m
    xs, ys = lattice.centres(length, width, panels)
    at = [(x, y) for x in xs for y in ys]
    w = np.array([[1.0, x, *(plate.observe(x, y) @ shapes)] for x, y in at])
    return w.T @ lattice.mass_per_density(length, width, panels) @ w


def test_bare_frequencies_fall_as_the_plate_in_air_says(bare, modes, still):
    """The plate in air on 40 modes in vacuum; first order leaves 3/2 of the fall's square."""
    density = 1.2
    carried = still.L.T @ modes.shapes
    squared = la.eigh(np.diag(modes.omega**2), np.eye(40) + density * carried.T @ carried, eigvals_only=True)
    exact = (1 - np.sqrt(squared) / modes.omega)[:MODES]
    fall = air_lowering(bare, modes, density)[:MODES]
    assert 0.003 < fall.min() < fall.max() < 0.012
    np.testing.assert_allclose(fall - 1.5 * fall**2, exact, atol=3e-5)
    np.testing.assert_allclose(air_lowering(bare, modes, 2 * density)[:MODES], 2 * fall)
    assert not air_lowering(bare, modes, 0.0).any()


def test_air_that_the_bare_plate_felt_too_lowers_its_modes_and_air_it_did_not_feel_none():
    effect, by_density = AirAddedMassEffect(), np.array([0.02, 0.01, 0.004])
    bare = SimpleNamespace(lowering_per_density=by_density)
    assert not effect.bare_shift(bare, np.array([1.2, 0.0])).any()
    # Twice the fall of ln f is the share of mass added: f goes with the root of 1 / (1 + that).
    found = np.exp(effect.bare_shift(bare, np.array([1.2, 1.0])))
    assert found == pytest.approx(1 / np.sqrt(1 + 2 * 1.2 * by_density))


def test_the_air_s_mass_goes_with_its_density():
    carried = SimpleNamespace(matrix={"air.M": np.eye(2)}.get, vector={"air.load": np.ones(2)}.get)
    change = AirAddedMassEffect().change(carried, np.array([0.6, 0.0]))
    assert np.array_equal(change.M, 0.6 * np.eye(2))
    assert np.array_equal(change.load, 0.6 * np.ones(2))
