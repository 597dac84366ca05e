import numpy as np
import pytest

from drivers.simulated.plant import air, grid
from drivers.simulated.plant.law import (
    ZN1,
    MaxwellLaw,
    even_loss,
    fractional_zener,
    maxwell_series,
    wlf_shift,
)
from drivers.simulated.plant.specimen import LENGTH_M, WIDTH_M

TABLE_4 = fractional_zener(0.27e6, 4.1e6, 1.21e-4, 0.83)
OMEGA = 2 * np.pi * np.geomspace(3, 3000, 400)


def test_shipped_series_follows_the_fractional_law():
    assert np.abs(ZN1.modulus(OMEGA) / TABLE_4(OMEGA) - 1).max() < 0.0031
    assert min(ZN1.g_pa) > 0


def test_shipped_series_is_what_the_fit_gives():
    fitted = maxwell_series(TABLE_4)
    np.testing.assert_allclose([fitted.g_inf_pa, *fitted.g_pa], [ZN1.g_inf_pa, *ZN1.g_pa], rtol=1e-3)
    np.testing.assert_allclose(fitted.tau_s, ZN1.tau_s, rtol=1e-5)


def test_warming_shifts_the_law_along_frequency():
    factor = wlf_shift(5.0, 9.0, 120.0)
    assert 0.3 < factor < 0.5
    np.testing.assert_allclose(ZN1.shifted(factor).modulus(OMEGA), ZN1.modulus(factor * OMEGA))
    assert wlf_shift(0.0, 9.0, 120.0) == 1.0


def test_clamp_friction_is_even_over_the_band_and_keeps_the_stiffness():
    law = even_loss(0.2)
    k = law.modulus(2 * np.pi * np.geomspace(5, 600, 60))
    np.testing.assert_allclose(k.imag, 0.2, rtol=0.05)
    assert law.modulus(2 * np.pi * 60.0).real == pytest.approx(1.0, abs=1e-12)


def test_a_series_that_would_gain_energy_is_refused():
    with pytest.raises(ValueError, match="gains energy"):
        MaxwellLaw(1e5, (-1.0,), (0.1,))
    with pytest.raises(ValueError, match="2 moduli and 1 relaxation times"):
        MaxwellLaw(1e5, (1.0, 2.0), (0.1,))


@pytest.mark.parametrize(("aspect", "coefficient"), [(1.0, 0.579), (1.5, 0.690), (2.0, 0.757)])
def test_added_mass_of_a_rigid_rectangle_is_the_published_one(aspect, coefficient):
    mass = air.mass_per_density(aspect, 1.0, (round(24 * aspect), 24)).sum()
    assert mass / (np.pi / 4 * aspect) == pytest.approx(coefficient, rel=0.003)


def test_grid_interpolates_a_smooth_shape_and_refuses_what_is_off_the_plate():
    x, y = grid.points(grid.POINTS_X, LENGTH_M), grid.points(grid.POINTS_Y, WIDTH_M)
    shape = np.outer(np.sin(20 * x), np.cos(25 * y)).ravel()
    for at in ((0.06, 0.06), (LENGTH_M, 0.0), (x[3], 0.11)):
        assert grid.on_plate(*at) @ shape == pytest.approx(np.sin(20 * at[0]) * np.cos(25 * at[1]), abs=1e-8)
    with pytest.raises(ValueError, match=r"\(310.0, 60.0\) mm is off the plate"):
        grid.on_plate(0.31, 0.06)
