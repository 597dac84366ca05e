"""Columns put together to the quantities that they are parts of."""

import numpy as np
import pytest

from instrument.errors import BadInput
from instrument.interchange.said_by_name import NotSaid
from instrument.interchange.signals import signals_of

SIZE, TURN = np.array([1e-3, 2e-3]), np.array([-90.0, 45.0])


def test_parts_of_one_quantity_are_one_signal_and_others_are_left():
    table = {
        "Velocity re [mm/s]": np.array([1.0, 2.0]),
        "Velocity im [mm/s]": np.array([-1.0, 0.5]),
        "temperature_c": np.array([20.0, 21.0]),
    }
    (velocity,) = signals_of("table", table, ["temperature_c"])
    np.testing.assert_allclose(velocity.values, [1e-3 - 1e-3j, 2e-3 + 0.5e-3j])
    assert velocity.names == ("Velocity re [mm/s]", "Velocity im [mm/s]")


def test_a_phase_of_nothing_said_is_that_of_the_only_size():
    (velocity,) = signals_of("table", {"Velocity [m/s]": SIZE, "Phase [deg]": TURN}, [])
    np.testing.assert_allclose(velocity.values, SIZE * np.exp(1j * np.radians(TURN)))


def test_one_part_alone_is_refused():
    with pytest.raises(BadInput, match="its other part is missing"):
        signals_of("table", {"Velocity re [m/s]": SIZE}, [])


def test_a_phase_that_says_less_than_the_only_size_is_that_ones():
    table = {"FRF Masse/Fuß [dB re 1 g/g]": np.array([-20.0, 0.0]), "FRF Phase [°]": TURN}
    (frf,) = signals_of("table", table, [])
    np.testing.assert_allclose(frf.values, [0.1, 1.0] * np.exp(1j * np.radians(TURN)))


def test_a_phase_of_something_else_is_nobodys():
    (velocity,) = signals_of("table", {"Velocity [m/s]": SIZE, "Force phase [deg]": TURN}, [])
    assert not np.iscomplexobj(velocity.values)


def test_several_phases_are_each_of_the_size_whose_words_they_share():
    table = {
        "Acceleration mass (g)": SIZE,
        "Phase mass (deg)": TURN,
        "Base accel (g)": 2 * SIZE,
        "Phase base (deg)": -TURN,
    }
    mass, base = signals_of("table", table, [])
    turn = np.exp(1j * np.radians(TURN))
    np.testing.assert_allclose(mass.values / mass.values[0], SIZE / SIZE[0] * turn / turn[0])
    np.testing.assert_allclose(base.values * mass.values, 2 * np.abs(mass.values) ** 2)


@pytest.mark.parametrize("name", ["Base phase [deg]", "Phase ref [deg]", "Phase Base acceleration [deg]"])
def test_a_phase_of_the_base_is_the_only_bases(name):
    table = {"Velocity [mm/s]": SIZE, "Velocity phase [deg]": TURN, "Base accel [g]": 2 * SIZE, name: -TURN}
    velocity, base = signals_of("table", table, [])
    turned = np.exp(1j * np.radians(TURN))
    np.testing.assert_allclose(velocity.values, 1e-3 * SIZE * turned)
    np.testing.assert_allclose(base.values / np.abs(base.values), turned.conj())


def test_a_phase_beside_a_force_is_the_responses():
    table = {"Velocity [mm/s]": SIZE, "Phase [deg]": TURN, "Force [N]": SIZE}
    velocity, force = signals_of("table", table, [])
    np.testing.assert_allclose(np.angle(velocity.values), np.radians(TURN))
    assert not np.iscomplexobj(force.values)


def test_where_one_of_several_phases_is_of_two_sizes_it_is_asked_about():
    table = {"Velocity tip (m/s)": SIZE, "Velocity root (m/s)": SIZE}
    table |= {"Phase velocity (deg)": TURN, "Phase tip (deg)": TURN}
    with pytest.raises(NotSaid, match=r"Phase velocity \(deg\), Phase tip \(deg\): the phase of what\?"):
        signals_of("table", table, [])
