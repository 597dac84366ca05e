"""What a hammer test of a bare plate is expected to find."""

from types import SimpleNamespace

import numpy as np
import pytest
from fitted_by_hand import FittedByHand

from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.several.of_files import OfFiles, Place
from fitting.effects import CATALOGUE
from fitting.nuisances.nuisances import Nuisances
from fitting.planning.learnt import LearntRival
from fitting.planning.struck_forecast import struck_forecast
from fitting.stated.layers import Face

AIR, MODES = CATALOGUE["air_added_mass"], 3
NOTHING = np.zeros(MODES)
BARE = BareModes(
    shift=NOTHING,
    softness=np.ones(MODES),
    scatter=np.full(MODES, 1e-3),
    lowering_per_density=np.array([0.02, 0.01, 0.005]),
    clamp=0.0,
    stiffness=np.ones((MODES, 1)),
    inertia=np.ones((MODES, 1)),
    sensor=NOTHING,
    by_line=NOTHING,
    line_m=0.0,
    substrate=Face(2e-3, 70e9, 0.3, 2700.0),
)


def forecast(effect, *u):
    free = np.array([not q.fixed for q in effect.parameters])
    fitted = FittedByHand(
        effects=(effect,), u=np.array(u), stated=0, free=free, law=SimpleNamespace(names=("g_pa",))
    )
    rival = LearntRival(fitted, 0.1 * np.eye(1 + free.sum()), np.zeros(0))
    return struck_forecast(rival, BARE, Nuisances(None, ()), np.zeros(0, np.intp), Place(1))


@pytest.mark.parametrize("felt", [0.0, 1.0])
def test_nobody_knows_whether_the_bare_plate_was_struck_in_the_air_that_its_modulus_was_found_in(felt):
    found = forecast(AIR, 1.2, felt)
    all_of_it = BARE.whitened_change(AIR.bare_shift(BARE, np.array([1.2, 1.0])))
    np.testing.assert_allclose(found.mean, all_of_it / 2)
    # It may be all of it, or nothing; and its density is open besides.
    fresh = found.root[:, found.known :]
    np.testing.assert_allclose(np.abs(fresh[:, 0]), np.abs(all_of_it) / 2)
    assert np.all(np.linalg.norm(found.root[:, : found.known], axis=1) > 0)


def test_air_of_another_file_is_not_about_this_plate():
    found = forecast(OfFiles(AIR, 2, 2), 1.2, 1.0, 2.0)
    np.testing.assert_array_equal(found.mean, 0)
    np.testing.assert_array_equal(found.root, 0)
