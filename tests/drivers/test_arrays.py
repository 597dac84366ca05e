"""What a plant computes is of the types the room names: in single precision a pole drifts within a minute."""

from typing import get_args, get_type_hints

import numpy as np
import pytest

from drivers.arrays import Array, Complex
from drivers.simulated.plant.diagonal import Diagonal, diagonalised
from drivers.simulated.plant.law import MaxwellLaw


def number(kind):
    """What an array of this type holds."""
    return np.dtype(get_args(get_args(kind)[1])[0])


@pytest.fixture(scope="module")
def oscillator():
    """x'' + 0.02 x' + x = u."""
    A = np.array([[0.0, 1.0], [-1.0, -0.02]])
    return diagonalised(A, np.array([0.0, 1.0]), np.eye(2)[:1], np.zeros(1), np.eye(2), ("x",))


def test_every_array_of_a_plant_holds_what_it_says(oscillator):
    said = {name: kind for name, kind in get_type_hints(Diagonal).items() if kind in (Array, Complex)}
    assert len(said) == 6
    assert {name: getattr(oscillator, name).dtype for name in said} == {n: number(k) for n, k in said.items()}


def test_responses_and_moduli_hold_complex_numbers_in_double_precision(oscillator):
    law = MaxwellLaw(1e6, (2e6,), (1e-3,))
    for made in (oscillator.transfer(2j), oscillator.transfer_rate(2j), law.modulus([1.0, 2.0])):
        assert made.dtype == number(Complex) == np.complex128
    assert number(Array) == np.float64
