"""A plate read at another spot, with what an effect moves of the reading."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.effects import CATALOGUE
from fitting.planning.elsewhere import read_elsewhere, struck
from fitting.plate.plate import Plate
from instrument.models.set_up import set_up

OMEGA, G = 2 * np.pi * np.array([30.0, 90.0]), np.array([1e6 + 3e5j, 2e6 + 5e5j])


@pytest.fixture(scope="module")
def ready(coarse, table5):
    """The paper's plate on a coarse mesh; models of one that is 1 % longer."""
    specimen = replace(coarse, exact=False)
    return set_up(table5, specimen, like=replace(specimen, length_m=1.01 * specimen.length_m))


@pytest.fixture(scope="module")
def elsewhere(ready):
    problem = ready.problem
    spot = (0.4 * problem.specimen.length_m, 0.3 * problem.specimen.width_m)
    return (spot, *read_elsewhere(problem.plate, ready.reduced, problem.nuisances, spot))


def test_a_clamp_line_moves_what_is_read_there(elsewhere):
    spot, plate, _, _ = elsewhere
    there = 1.01 * spot[0]
    longer, length = 2e-3, plate.length_m
    change = CATALOGUE["clamp_line"].change(plate, np.array([longer, 1.0]))
    # The spot was measured from the visible edge: on the plate that is longer it lies further out.
    expected = plate.row((there + longer) * length / (length + longer), spot[1])
    assert plate.observe + change.observe == pytest.approx(expected, rel=1e-9, abs=1e-12)
    assert np.abs(change.observe).max() > 0


def test_the_plate_without_effects_is_read_there(ready, elsewhere):
    _, plate, reduced, moved = elsewhere
    assert moved.spots.row(plate, ready.problem.as_stated) == pytest.approx(plate.observe)
    first, there = (r.displacement(OMEGA, G) for r in (ready.reduced, reduced))
    A = reduced.matrices(OMEGA, G)
    load = np.broadcast_to(reduced.load.astype(complex)[:, None], (2, len(reduced.load), 1))
    assert there == pytest.approx(np.linalg.solve(A, load)[:, :, 0] @ reduced.observe)
    assert np.abs(there / first - 1).min() > 0.3


def test_what_is_struck_on_its_axis_reads_there_what_a_full_solve_has(ready):
    stated = ready.problem.nuisances.specimen
    point = (0.95 * stated.length_m, 0.5 * stated.width_m)
    plate, reduced, moved = struck(ready.problem.plate, ready.reduced, ready.problem.nuisances, point, 0.01)
    like = moved.reference
    full = Plate(replace(like, force_m=like.force_m, elements=stated.elements))
    x = displacement_direct(full, viscous_damping(full), OMEGA, G)
    # Free edges carry less twist where a force drives (decision 13).
    assert reduced.displacement(OMEGA, G) == pytest.approx(x, rel=1e-2)
    assert moved.specimen.drive == "force"
    names = {n.name: n.sigma for n in moved.each}
    assert names["gain"] == 0.01
    assert {"force_x", "force_y"} < set(names)
    assert not plate.load_part.any()
    assert not plate.pitch.any()
