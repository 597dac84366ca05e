"""Where a beam is read and struck: in the middle of its width, against solids of bricks."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from drivers.simulated.plant.solid_beam import BeamStated, Sheet, SolidBeam
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from fitting.structures.beam_reading import read_otherwise, row_at
from fitting.structures.small import displacement, system_of

G = 4e6 * (1 + 0.4j)
FORCE_M, SPOT_M = 0.018, 0.285
FREE = Beam(
    0.3,
    0.03,
    "free-free",
    Face(3e-3, 69.5e9, 0.33, 2705.0),
    constraining=Face(0.5e-3, 206e9, 0.285, 7850.0),
    core=Core(0.5e-3, 0.47, 1000.0, ConstantModulus(G.real, 0.4)),
    force_m=FORCE_M,
    pickup_m=SPOT_M,
    exact=True,
)


@pytest.fixture(scope="module")
def solid():
    sheets = [Sheet(f.thickness_m, f.young_pa, f.poisson, f.density_kg_m3) for f in (FREE.substrate,)]
    c, v = FREE.constraining, FREE.core
    sheets += [Sheet(v.thickness_m, 2 * (1 + v.poisson), v.poisson, v.density_kg_m3)]
    sheets += [Sheet(c.thickness_m, c.young_pa, c.poisson, c.density_kg_m3)]
    return SolidBeam(BeamStated(0.3, 0.03, "free-free", tuple(sheets), (1,), SPOT_M), 20)


def struck(solid: SolidBeam, hz: float) -> complex:
    w, free = 2 * np.pi * hz, solid.free
    row, force = solid.row(SPOT_M, 0.0), solid.row(FORCE_M, 0.0, below=True)
    K = solid.stiffness(0) + solid.stiffness(2) + G * solid.core - w**2 * solid.M
    return complex(spsolve(K[free][:, free].tocsc(), force[free].astype(complex)) @ row[free])


@pytest.mark.long
def test_a_free_beam_struck_near_an_end_moves_as_a_solid_does(solid):
    """The fourth mode has a node a few millimetres from both places: there the middle decides, by 7 %."""
    f = np.array([460.0, 860.0, 1200.0, 1360.0, 1500.0])
    found = displacement(system_of(FREE, FREE.parts()), 2 * np.pi * f, np.full(len(f), G))
    whole = np.array([struck(solid, hz) for hz in f])
    # Where it resonates a twentieth of a percent of the frequency turns the phase by 0.03.
    np.testing.assert_allclose(np.abs(found / whole), 1.0, atol=0.008)


def test_the_middle_of_an_evenly_bent_beam_is_higher_by_poissons_share():
    """w = x^2/2 bends by one everywhere: nu b^2/24 more, which a beam of no width has not."""
    section = FREE.section
    x = np.linspace(0, 1, 50)
    V, *_ = np.linalg.lstsq(section.shapes.rows("w", x).T, x**2 / 2, rcond=None)
    more = section.faces_poisson * (section.width_m / section.length_m) ** 2 / 24
    assert row_at(section, V[:, None], 0.5)[0] == pytest.approx(0.125 + more, rel=1e-6)
    slender = replace(FREE, slender=True).section
    assert row_at(slender, V[:, None], 0.5)[0] == pytest.approx(0.125, rel=1e-6)
    assert read_otherwise(section, 0.5)["middle"] @ V == pytest.approx(0.15 * more, rel=1e-5)
    assert read_otherwise(slender, 0.5) == {}
