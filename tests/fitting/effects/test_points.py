"""What touches the plate at points, and a base that rolls: reduced plate beside full solves."""

import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg as sla

from fitting.effects import CATALOGUE
from fitting.effects.added_masses import AddedMassesEffect
from fitting.effects.base_roll import rolling
from fitting.effects.tether import TetherEffect
from fitting.plate.element import THETA_X, V_B, V_C, W

MASSES, TETHER, ROLL = AddedMassesEffect(), TetherEffect(), CATALOGUE["base_roll"]
TWO = (3e-3, 0.27, 0.06, 5e-3, 0.16, 0.17)


def at(full, x, y):
    return full.loose.observe(x, y)


def test_two_masses_answer_as_the_full_model_with_both(full):
    rows = [at(full, *TWO[k + 1 : k + 3]) for k in (0, 3)]
    M = sum(TWO[k] * sp.csc_array(np.outer(w, w)) for k, w in zip((0, 3), rows, strict=True))
    load = -TWO[0] * rows[0] - TWO[3] * rows[1]
    assert full.error(MASSES, TWO, M=M, load=load) < 1e-3
    assert full.error(MASSES, (0.0, *TWO[1:3], 0.0, *TWO[4:])) < 1e-5


def test_two_masses_start_from_few_pairs(full):
    starts = MASSES.starts(full.spanned, None)
    lower, upper = MASSES.limits(full.spanned)
    assert len(starts) < 20
    assert all((lower <= u).all() and (u <= upper).all() for u in starts)
    assert MASSES.extends == "added_mass"


@pytest.mark.parametrize(("k", "loss", "x", "y"), [(60.0, 0.2, 0.29, 0.02), (800.0, 0.5, 0.2, 0.15)])
def test_a_cable_answers_as_a_spring_between_floor_and_plate(full, k, loss, x, y):
    w = at(full, x, y)
    k_loss = k * (1 + 1j * loss)
    K = k_loss * sp.csc_array(np.outer(w, w))
    # The floor end moves against the base: the plate is pulled by the base's own travel too.
    error = full.error(TETHER, [k, loss, x, y], K=K, load=lambda omega: k_loss / omega**2 * w)
    assert error < 1e-3
    assert full.error(TETHER, [0.0, loss, x, y]) < 1e-5


def test_a_rolling_base_strains_nothing_and_answers_as_the_full_model(full):
    """Its rigid part strains nothing; the response is to heave and roll together."""
    r = rolling(full.full)
    assert np.abs(full.loose.K_0 @ r).max() < 1e-6 * np.abs(full.loose.K_0 @ np.abs(r)).max()
    assert np.abs(full.loose.K_1 @ r).max() < 1e-6 * np.abs(full.loose.K_1 @ np.abs(r)).max()
    on_nodes = full.loose.on_nodes(r[:, None])[:, :, 0]
    assert on_nodes[:, W] == pytest.approx(full.loose.mesh.node_positions()[:, 1] - full.specimen.width_m / 2)
    assert on_nodes[0, V_C] < on_nodes[0, V_B] < on_nodes[0, THETA_X]
    lever = full.full.pickup_m[1] - full.specimen.width_m / 2
    for roll in (0.3, -1.5):
        assert full.error(ROLL, [roll], r=full.full.heave + roll * r, travel=roll * lever) < 2e-4


def test_a_cable_that_pulls_is_the_plate_in_absolute_motion(full):
    """The same in absolute displacements: root driven, spring to the floor, no inertia load."""
    k, loss, x, y = 300.0, 0.3, 0.25, 0.05
    loose, moving = full.loose, full.clamped
    held = np.setdiff1d(np.arange(loose.size), moving)
    w_p, read = at(full, x, y), at(full, *full.full.pickup_m)[moving]
    cable = k * (1 + 1j * loss) * sp.csc_array(np.outer(w_p, w_p))
    U, d = (full.full.lift @ full.damping.U)[moving], full.damping.d
    found = []
    for w, g in zip(full.omega, full.modulus, strict=True):
        A = sp.csc_array(loose.K_0 + g * loose.K_1 - w**2 * loose.M + cable)
        base = -full.full.heave / w**2
        # Damping acts on the relative motion: s = i w d U^T (q - base).
        bordered = sp.block_array(
            [[A[moving][:, moving], U], [U.T, -np.diag(1 / (1j * w * d))]], format="csc"
        )
        rhs = np.concatenate([-(A[moving][:, held] @ base[held]), U.T @ base[moving]])
        absolute = sla.splu(bordered).solve(rhs.astype(complex))[: len(moving)]
        found.append(read @ (absolute - base[moving]))
    assert np.abs(full.reduced(TETHER, (k, loss, x, y)) / np.array(found) - 1).max() < 1e-3


def test_a_roll_of_zero_changes_nothing(full):
    assert full.error(ROLL, [0.0]) < 1e-5


@pytest.mark.parametrize(
    ("effect", "u", "n"),
    [(MASSES, TWO, 3), (MASSES, TWO, 1), (TETHER, (60.0, 0.2, 0.29, 0.02), 1), (ROLL, (0.2,), 0)],
)
def test_derivatives_of_effects_at_points_are_those_of_differences(full, effect, u, n):
    by, difference = full.slope(effect, u, n)
    assert np.abs(by / difference - 1).max() < 1e-3
