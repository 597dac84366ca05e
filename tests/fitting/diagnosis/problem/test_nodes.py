import numpy as np
import pytest

from fitting.diagnosis.problem.nodes import Nodes

OMEGA = 2 * np.pi * np.concatenate([np.linspace(14, 26, 90), np.linspace(95, 110, 80)])
POLES = 2 * np.pi * np.array([20 + 1.1j, 102 + 6j])
MOVED = POLES * (1 + 0.02 + 0.004j)


def between(low, high):
    return POLES[(POLES.real > low) & (POLES.real < high)]


def response(omega, poles):
    return (1 / (omega[:, None] ** 2 - poles**2)).sum(axis=1)


def test_a_change_of_sharp_resonances_is_carried_from_few_nodes_to_all_points():
    nodes = Nodes.of(OMEGA, 16).around(between)
    assert len(nodes.omega) < 40
    change = response(nodes.omega, MOVED) - response(nodes.omega, POLES)
    expected = response(OMEGA, MOVED) - response(OMEGA, POLES)
    found = nodes.spread(change, POLES, MOVED)
    assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max()


def test_without_the_poles_the_same_nodes_do_not_suffice():
    nodes = Nodes.of(OMEGA, 16)
    change = response(nodes.omega, MOVED) - response(nodes.omega, POLES)
    expected = response(OMEGA, MOVED) - response(OMEGA, POLES)
    found = change @ nodes.plain.T
    assert np.abs(found - expected).max() > 1e-3 * np.abs(expected).max()


def test_what_rises_as_one_over_the_distance_from_poles_is_smooth_times_that_distance():
    nodes = Nodes.of(OMEGA, 16).around(between)
    size = [np.abs(response(w, MOVED)) for w in (nodes.omega, OMEGA)]
    away = [nodes.away(lambda mine, at: MOVED[mine, None] ** 2, at_nodes=there) for there in (True, False)]
    found = (nodes.plain @ np.log(size[0] * away[0])) - np.log(away[1])
    np.testing.assert_allclose(found, np.log(size[1]), atol=1e-6)


def test_poles_may_be_elsewhere_for_every_point():
    nodes = Nodes.of(OMEGA, 16).around(between)
    moved = POLES[:, None] * (1 + np.linspace(0.0, 0.02, len(OMEGA)))
    found = nodes.away(lambda mine, at: moved[mine][:, at] ** 2)
    own = np.repeat([0, 1], [90, 80])
    each = moved[own, np.arange(len(OMEGA))]
    np.testing.assert_allclose(found, np.abs(OMEGA**2 - each**2) / np.abs(POLES[own]) ** 2)


def test_few_points_are_nodes_themselves():
    omega = 2 * np.pi * np.array([18.4, 19.3, 20.2, 100.5])
    nodes = Nodes.of(omega, 16)
    assert sorted(nodes.omega) == pytest.approx(sorted(omega))
    assert nodes.omega @ nodes.plain.T == pytest.approx(omega)


def test_two_frequencies_a_radian_a_second_apart_are_their_own_nodes_without_a_warning():
    omega = np.array([100.0, 101.0])
    with np.errstate(all="raise"):
        nodes = Nodes.of(omega, 8)
    assert nodes.plain.tolist() == [[1.0, 0.0], [0.0, 1.0]]


def test_a_wide_cluster_has_nodes_as_close_as_is_asked():
    wide = 2 * np.pi * np.linspace(79.9, 120.1, 200)
    assert len(Nodes.of(wide, 6).omega) == 3 + 10
    assert len(Nodes.of(wide, 6, hz_a_node=8.0).omega) == 3 + 5
    assert len(Nodes.of(wide, 6, hz_a_node=40.0).omega) == 6
