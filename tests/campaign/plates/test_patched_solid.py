"""A patch on a solid plate: the layer-wise plate beside bricks."""

import numpy as np
import pytest
from scipy.sparse.linalg import LinearOperator, eigsh

from campaign.plates.geometry import plate_named
from campaign.plates.grid import Fineness
from campaign.plates.solid import Build, Solid, factorised
from fitting.dynamics.real_modes import real_modes
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from fitting.stated.patches import Patch

P8 = plate_named("P8")
PATCH = Patch(0.06, 0.15, 0.0, P8.width_m)
FINENESS = Fineness(8, 4, (0.5, 2.0), (0.5,))
MODES = 3


class PatchedSolid(Solid):
    """Treated between two x alone."""

    @property
    def treated(self):
        x, y = self.grid.middles
        return np.outer((x > PATCH.from_x_m) & (x < PATCH.to_x_m), np.ones(len(y)))


def solid_eigenvalues(G):
    solid = PatchedSolid(P8, Build(lines_x_m=(0.06, 0.062, 0.148, 0.15)), FINENESS)
    there = np.flatnonzero(np.diff(solid.M.indptr) > 0)
    free = solid.free[np.isin(solid.free, there)]
    K, M = ((A[free][:, free]).tocsc() for A in (solid.K_0 + G * solid.K_1, solid.M))
    inverse = LinearOperator(K.shape, matvec=factorised(K).solve)
    start = np.random.default_rng(0).normal(size=len(free))
    return np.sort(eigsh(K, MODES, M, sigma=0, OPinv=inverse, v0=start)[0])


def test_a_patch_is_as_stiff_and_its_core_shares_as_much_as_in_a_solid():
    s, c, v = P8.substrate, P8.constraining, P8.core
    plate = Plate(
        PlateSpecimen(
            P8.length_m,
            P8.width_m,
            "cantilever",
            *(Face(f.thickness_m, f.young_pa, f.poisson, f.density_kg_m3) for f in (s, c)),
            Core(v.thickness_m, v.poisson, v.density_kg_m3, ConstantModulus(5e5, 0.5)),
            patches=(PATCH,),
            force_m=(0.1, 0.03),
        )
    )
    moduli = (5e5, 5.2e5)
    solid = np.array([solid_eigenvalues(G) for G in moduli])
    layers = np.array([real_modes(plate, G, MODES).omega ** 2 for G in moduli])
    assert np.sqrt(layers[0] / solid[0]) == pytest.approx(1.0, abs=1.5e-3)
    shares = [np.log(x[1] / x[0]) / np.log(moduli[1] / moduli[0]) for x in (solid, layers)]
    assert shares[1] == pytest.approx(shares[0], rel=0.01)
