"""A treated plate hung free, on a mesh to compare explanations by."""

import numpy as np
import pytest

from fitting.dynamics.damping import viscous_damping
from fitting.dynamics.direct import displacement_direct
from fitting.planning.free_plate import free_plate, free_specimen
from fitting.plate.plate import Plate

F_HZ = np.array([60.0, 140.0, 250.0])


def test_it_hangs_without_clamp_masses_and_stated_damping(zn1):
    free = free_specimen(zn1)
    assert (free.boundary, free.drive, free.modal_ratios, free.masses) == ("free", "force", (), ())
    assert free.elements[0] * free.elements[1] == pytest.approx(96, rel=0.15)
    assert free.force_m != free.pickup_m


def test_it_answers_a_blow_as_a_full_solve_does_with_effects_or_without(zn1):
    free, law = free_specimen(zn1), zn1.core.law
    plate, reduced = free_plate(free, law, F_HZ, [])
    omega = 2 * np.pi * F_HZ
    G = law.modulus(omega)
    full = displacement_direct(Plate(free), viscous_damping(Plate(free)), omega, G)
    np.testing.assert_allclose(reduced.displacement(omega, G), full, rtol=1e-5)
    own = plate.take([])
    A = own.K_0 + G[:, None, None] * own.K_1 - omega[:, None, None] ** 2 * own.M
    load = np.broadcast_to(own.load.astype(complex)[:, None], (3, len(own.load), 1))
    np.testing.assert_allclose(np.linalg.solve(A, load)[:, :, 0] @ own.observe, full, rtol=1e-5)
