"""Nodes at every point, and poles near a range."""

import numpy as np
import pytest
import scipy.linalg as la
from shear_pair_cases import pair

from fitting.diagnosis.problem.every_point import EveryPoint
from fitting.diagnosis.problem.nodes import Nodes
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.laws.constant import ConstantModulus
from fitting.structures.small import system_of
from fitting.structures.small_modes import small_modes

SOFT = ConstantModulus(1e6, 0.5)
OMEGA = 2 * np.pi * np.array([10.0, 20.0, 40.0])


def test_where_nothing_is_interpolated_what_is_solved_comes_back():
    nodes, values = EveryPoint.at(OMEGA), np.array([[1.0, 2j, 3.0], [0.0, 1.0, 1j]])
    assert nodes.spread(values, values, values) is values
    assert nodes.around(lambda low, high: np.array([30.0 + 1j])) is nodes
    assert np.array_equal(nodes.omega, OMEGA)


def test_poles_under_a_law_are_followed_once_for_all_who_ask():
    specimen = pair(0.2)
    poles = PlatePoles(system_of(specimen, specimen.parts()), SOFT)
    (at,) = poles.near(200.0, 4000.0)
    # A step of Rayleigh's quotient from where they were: a modulus not far off, as a fit's.
    omega = np.linspace(0.8, 1.2, 60) * at.real
    nodes = Nodes.of(omega, 5).around(poles.near)
    softer = ConstantModulus(0.8e6, 0.5)
    found = poles.under(nodes, softer.modulus(nodes.omega))
    (expected,) = small_modes(specimen, softer, 1)
    assert found[1] == pytest.approx([np.sqrt(expected.eigenvalue)], rel=1e-6)
    again = poles.under(nodes, softer.modulus(nodes.omega))
    assert again[1] is found[1]
    stiffer = poles.under(nodes, SOFT.modulus(nodes.omega))
    assert stiffer[1] == pytest.approx([at], rel=1e-6)


def test_poles_of_a_pad_are_its_modes():
    specimen = pair(0.2)
    system = system_of(specimen, specimen.parts())
    (mode,) = small_modes(specimen, SOFT, 1)
    expected = np.sqrt(mode.eigenvalue)
    poles = PlatePoles(system, SOFT)
    found = poles.near(0.8 * expected.real, 1.2 * expected.real)
    assert np.abs(found / expected - 1).min() < 1e-9
    assert poles.near(0.8 * expected.real, 1.2 * expected.real) is found
    K_0, K_1, M, _ = poles.matrices
    every = np.sqrt(la.eigvals(K_0 + SOFT.modulus(np.ones(1))[0] * K_1, M))
    far = poles.near(1e-3 * every.real.min(), 2e-3 * every.real.min())
    assert not len(far)
