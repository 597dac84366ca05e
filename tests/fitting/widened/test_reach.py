"""How far up the widened plate holds: full solves beside it above the usual range."""

from dataclasses import replace

import numpy as np
import scipy.sparse.linalg as sla

from campaign.plates.judged import models_of
from fitting.diagnosis.problem.plate_answer import answer
from fitting.dynamics.damping import viscous_damping
from fitting.effects.partial_debond import LEFT, PartialDebondEffect, strips
from fitting.plate.plate import Plate
from fitting.reduced.domain import domain_of
from fitting.reduced.reduced_plate import reduce_plate
from fitting.widened.enriching import USUAL_HZ, enriched, reach_over
from fitting.widened.full_plate import FullPlate

HZ = np.array([100.0, 380.0, 540.0, 580.0])
G = 1.5e6 * (HZ / 100) ** 0.4 * (1 + 0.5j)


def direct(full, K_1):
    loose, damping = full.loose, full.damping
    free = np.unique(full.lift.indices)
    U, d = (full.lift @ damping.U)[free], damping.d
    row, load = loose.observe(*full.pickup_m)[free], -(loose.M @ full.heave)[free]
    found = []
    for w, g in zip(2 * np.pi * HZ, G, strict=True):
        A = loose.K_0 + g * (loose.K_1 + K_1) - w**2 * loose.M
        X = sla.splu(A.tocsc().astype(complex)[free][:, free].tocsc()).solve(np.column_stack([load, U]) + 0j)
        small = np.diag(1 / (1j * w * d)) + U.T @ X[:, 1:]
        found.append(row @ (X[:, 0] - X[:, 1:] @ np.linalg.solve(small, U.T @ X[:, 0])))
    return np.array(found)


def test_a_strip_along_an_edge_holds_as_far_as_the_sweep_goes():
    specimen = replace(models_of("P6"), elements=(20, 14))
    plate = Plate(specimen)
    damping = viscous_damping(plate)
    full = FullPlate(plate, damping)
    effect = PartialDebondEffect("y")
    basis = plate.carried @ reduce_plate(plate, damping, domain_of(specimen, HZ)).V
    rows = strips(full, "y")
    expected = direct(full, -(1 - LEFT) * (rows[-1] + rows[-2]))
    width = 2 * specimen.width_m / len(rows)

    def error(reach_hz):
        spanned = enriched(full, basis, effect.spans, reach_hz=reach_hz).take(effect.spans)
        change = effect.change(spanned, np.array([specimen.width_m - width, width]))
        found = answer(spanned, 2 * np.pi * HZ, G, change, [], with_pitch=False).heave.value
        return np.max(np.abs(found / expected - 1))

    assert reach_over(HZ) == 600.0
    assert error(600.0) < 3e-3
    assert error(USUAL_HZ) > 1e-2


def test_a_sweep_within_the_usual_range_asks_for_no_more():
    assert reach_over(np.array([20.0, 419.0])) == USUAL_HZ
    assert reach_over(np.array([20.0, 421.0])) == 500.0
