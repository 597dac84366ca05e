"""A small structure with a viscoelastic branch, from its matrices to its motion, against formulas."""

import numpy as np
import pytest

from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.diagonal import diagonalised
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.motion import EvenStretch, Motion, tones_of
from drivers.simulated.plant.structure import (
    Branch,
    Structure,
    condensed,
    factor,
    first_order,
    modal_damping,
)

LAW = MaxwellLaw(2e3, (3e3, 5e3), (1e-2, 1e-3))
COUPLING = np.array([[1.0, -1.0], [-1.0, 1.0]])
ONE = np.eye(2)


def chain(M=ONE):
    """Two masses to ground and to each other, by way of the law."""
    loads, readings = np.array([[1.0], [0.0]]), np.array([[0.0, 1.0]])
    return Structure(M, np.diag([4.0, 2.0]), np.diag([4e4, 9e4]), (Branch(COUPLING, LAW),), loads, readings)


def system():
    structure = chain()
    A, B, scale = first_order(structure)
    C = np.zeros((1, len(A)))
    C[0] = np.linalg.solve(scale, np.eye(len(A)))[1]
    return diagonalised(A, B[:, 0], C, np.zeros(1), scale, ("second",))


@pytest.mark.parametrize("frequency_hz", [5.0, 32.0, 48.0, 200.0])
def test_its_poles_respond_as_its_matrices_do(frequency_hz):
    omega = 2 * np.pi * frequency_hz
    exact = (chain().readings @ chain().response(omega))[:, 0]
    np.testing.assert_allclose(system().transfer(1j * omega), exact, rtol=1e-9)


def test_the_transfer_functions_rate_is_its_derivative():
    s, h = 200j, 1e-3
    central = (system().transfer(s + h) - system().transfer(s - h)) / (2 * h)
    np.testing.assert_allclose(system().transfer_rate(s), central, rtol=1e-6)


def test_every_pole_of_a_damped_structure_dies_away():
    assert (system().poles.real < 0).all()


def test_condensed_it_responds_the_same_with_masses_of_one():
    heavy = chain(np.array([[3.0, 0.5], [0.5, 2.0]]))
    small, V = condensed(heavy, (LAW, LAW.scaled(0.5)), (4.0, 100.0), 8)
    np.testing.assert_allclose(small.M, np.eye(V.shape[1]), atol=1e-12)
    omega = 2 * np.pi * 30.0
    np.testing.assert_allclose(
        small.readings @ small.response(omega), heavy.readings @ heavy.response(omega), rtol=1e-9
    )


def test_another_law_takes_the_first_branchs_place():
    stiff = chain().with_laws(LAW.scaled(2.0))
    np.testing.assert_allclose(
        stiff.dynamic_stiffness(100.0) - chain().dynamic_stiffness(100.0), LAW.modulus(100.0) * COUPLING
    )


def test_a_stiffness_has_a_factor_of_its_rank():
    F = factor(COUPLING)
    assert F.shape == (2, 1)
    np.testing.assert_allclose(F @ F.T, COUPLING, atol=1e-12)


def test_modal_damping_gives_each_mode_its_ratio():
    M, K = np.diag([2.0, 1.0]), np.array([[5e4, -1e4], [-1e4, 3e4]])
    C = modal_damping(M, K, np.array([0.01, 0.03]))
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    poles = np.linalg.eigvals(A)
    poles = sorted(poles[poles.imag > 0], key=abs)
    np.testing.assert_allclose([-p.real / abs(p) for p in poles], [0.01, 0.03], rtol=1e-9)


def test_driven_for_long_it_moves_as_the_transfer_function_says():
    one, omega, step_s = system(), 2 * np.pi * 30.0, 1e-3
    motion = Motion(one)
    motion.drive(DrivePiece(0.0, 30.0, 2.0, 0.0, 0.4))
    t = 20.0 + step_s * np.arange(600)
    expected = (2.0 * one.transfer(1j * omega)[0] * np.exp(1j * (omega * t + 0.4))).imag
    found = motion.at(20.0, step_s, 600, ("second",))[0]
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())


def test_from_one_stretch_to_the_next_the_state_goes_on():
    piece = DrivePiece(0.0, 30.0, 2.0, 1.5, 0.4)
    first = EvenStretch(0.0, system(), tones_of(piece), np.zeros(len(system().poles)))
    begun = EvenStretch(0.05, system(), (), first.state(0.05))
    np.testing.assert_allclose(begun.state(0.05), first.state(0.05), rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(
        begun.outputs(0.05, 1e-3, 1, [0]), first.outputs(0.05, 1e-3, 1, [0]), rtol=1e-9
    )


def test_a_change_that_was_read_is_not_taken_back():
    motion = Motion(system())
    motion.drive(DrivePiece(0.5, 30.0, 2.0, 0.0, 0.0))
    motion.take_back(0.4)
    assert not motion.at(0.0, 1e-2, 100, ("second",)).any()
    with pytest.raises(ValueError, match="already read: give it sooner"):
        motion.take_back(0.4)
