"""A solid beam on few motions against rigid bodies, beams of one metal, and the whole solid."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse.linalg import spsolve

from drivers.simulated.plant.basis import moduli
from drivers.simulated.plant.beam_basis import Place, on_basis
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.progress import Report
from drivers.simulated.plant.solid_beam import BeamStated, Sheet, SolidBeam

LAW = MaxwellLaw(0.5e6, (0.3e6, 0.6e6, 2e6), (5e-3, 5e-4, 5e-5))
FACE, CORE = Sheet(1e-3, 70e9, 0.3, 2700.0), Sheet(0.1e-3, 2 * 1.47, 0.47, 1000.0)
SANDWICH = (FACE, CORE, Sheet(0.5e-3, 70e9, 0.3, 2700.0))
FREE = BeamStated(0.2, 0.02, "free-free", SANDWICH, (1,), 0.15)
PLACES = (Place(0.03, below=True), Place(0.15), Place(0.2))


def stiffness(beam, omega):
    return beam.K_faces.sum(0) + beam.K_root + LAW.modulus(omega) * beam.K_core.sum(0) - omega**2 * beam.M


@pytest.fixture(scope="module")
def free():
    return on_basis(SolidBeam(FREE, 6), moduli(LAW), PLACES)


@pytest.fixture(scope="module")
def clamped():
    stated = BeamStated(0.2, 0.02, "clamped-free", SANDWICH, (1,), 0.15)
    return SolidBeam(stated, 6), on_basis(SolidBeam(stated, 6), moduli(LAW), PLACES, 3, with_air=True)


def test_a_free_beam_struck_slowly_moves_as_a_rigid_body(free):
    """w = F (1/m + (x - c)(x_F - c)/J)/(i w)^2, J = m L^2 / 12 and the little that height adds."""
    w = 2 * np.pi * 2.0
    found = -(w**2) * (free.w[2] @ np.linalg.solve(stiffness(free, w), free.w[0].astype(complex)))
    m = 0.2 * 0.02 * (1.5e-3 * 2700.0 + 0.1e-3 * 1000.0)
    assert found == pytest.approx(1 / m + 0.1 * -0.07 / (m * 0.2**2 / 12), rel=2e-3)


def test_force_and_spot_may_change_places(free):
    Z = stiffness(free, 2 * np.pi * 500.0)
    there, back = (free.w[a] @ np.linalg.solve(Z, free.w[b].astype(complex)) for a, b in ((0, 1), (1, 0)))
    assert there == pytest.approx(back, rel=1e-9)


def test_the_basis_loses_what_the_whole_solid_loses(clamped):
    """At the first resonance the slip of a thin core decides, which moves next to no mass."""
    solid, beam = clamped
    w = 2 * np.pi * 39.0
    row, heave = solid.row(0.15, 0.0), solid.M @ solid.rigid[:, 0]
    K = solid.stiffness(0) + solid.stiffness(2) + complex(LAW.modulus(w)) * solid.core - w**2 * solid.M
    whole = spsolve(K[solid.free][:, solid.free].tocsc(), -heave[solid.free]) @ row[solid.free]
    found = beam.w[1] @ np.linalg.solve(stiffness(beam, w), -beam.load[:, 0].astype(complex))
    assert found == pytest.approx(whole, rel=2e-4)


def test_a_force_bends_a_free_beam_as_it_bends_the_whole_solid(free):
    """Between modes the highest ones count: beside the whole beam's motion nothing was left of them."""
    solid = SolidBeam(FREE, 6)
    row, force = solid.row(0.15, 0.0), solid.row(0.03, 0.0, below=True)
    for hz in (900.0, 1500.0, 2200.0):
        w = 2 * np.pi * hz
        K = solid.stiffness(0) + solid.stiffness(2) + complex(LAW.modulus(w)) * solid.core - w**2 * solid.M
        whole = spsolve(K[solid.free][:, solid.free].tocsc(), force[solid.free].astype(complex))
        found = free.w[1] @ np.linalg.solve(stiffness(free, w), free.w[0].astype(complex))
        assert found == pytest.approx(whole @ row[solid.free], rel=1e-3)


def test_strips_add_up_and_air_weighs_what_slender_bodies_carry(clamped):
    """pi/4 rho b^2 a length: a strip that moves across itself, its ends too far away to matter."""
    _, beam = clamped
    assert len(beam.K_core) == 3
    heave_of_air = beam.load_air[:, 0] @ np.linalg.solve(beam.M, beam.load[:, 0])
    assert 0.6 < heave_of_air / (np.pi / 4 * 0.02**2 * 0.2) < 1.0
    np.testing.assert_allclose(beam.M_air, beam.M_air.T, atol=1e-9 * abs(beam.M_air).max())


def test_a_small_mass_at_the_tip_lowers_a_mode_by_its_own_kinetic_energy():
    """d ln f = -m w(L)^2 / (2 M): of a clamped beam's mode -2 m / (beam's mass), whatever the mode."""
    metal, unit = (Sheet(1e-3, young, 0.0, 2700.0) for young in (70e9, 2.0))
    stated = BeamStated(0.2, 0.01, "clamped-free", (metal, unit), (1,), 0.1)
    beam = on_basis(SolidBeam(stated, 6), np.array([35e9]), PLACES)
    row, light = beam.w[2], 1e-4 * 0.2 * 0.01 * 2e-3 * 2700.0
    K = beam.K_faces.sum(0) + 35e9 * beam.K_core.sum(0)
    f, moved = (
        np.sqrt(eigh(K, M, eigvals_only=True)[:2]) for M in (beam.M, beam.M + light * np.outer(row, row))
    )
    np.testing.assert_allclose(np.log(moved / f), -2e-4, rtol=0.02)


def test_building_tells_how_far_it_has_come():
    told = list[float]()
    report: Report = told.append
    on_basis(SolidBeam(FREE, 2), np.array([1e6, 3e6]), PLACES, report=report)
    assert told == [0.5, 1.0]
