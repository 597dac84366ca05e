"""True laws of a core: what each is at rest, and that it takes energy."""

import numpy as np
import pytest

from campaign.law import LAWS, TrueLaw

F = np.geomspace(1, 1e4, 9)
EACH = (
    TrueLaw("fractional-zener", (0.27e6, 4.1e6, 1.21e-4, 0.83)),
    TrueLaw("maxwell", (0.3e6, 0.5e6, 1e-2, 2e6, 1e-4)),
    TrueLaw("ghm", (0.2e6, 1.0, 3.0, 1e3, 6.0, 2.0, 2e4)),
    TrueLaw("havriliak-negami", (0.27e6, 4.1e6, 1.21e-4, 0.8, 0.5)),
    TrueLaw("table", (*F, *np.geomspace(0.3e6, 3e6, 9), *np.full(9, 0.4))),
)


@pytest.mark.parametrize("law", EACH, ids=lambda law: law.kind)
def test_a_core_takes_energy(law):
    assert (law.modulus(2 * np.pi * np.geomspace(1, 1e4, 50)).imag > 0).all()


def test_every_kind_is_known_and_no_other():
    assert tuple(law.kind for law in EACH) == LAWS
    with pytest.raises(ValueError, match="expected one of fractional-zener"):
        TrueLaw("burgers", (1.0,)).modulus(1.0)


def test_a_ghm_core_goes_from_rest_to_glass():
    low, high = EACH[2].modulus(np.array([1e-6, 1e9]))
    assert low == pytest.approx(0.2e6)
    assert high == pytest.approx(0.2e6 * 8, rel=1e-3)


def test_a_table_is_read_where_it_was_written():
    G = EACH[4].modulus(2 * np.pi * F)
    np.testing.assert_allclose(G.real, np.geomspace(0.3e6, 3e6, 9))
    np.testing.assert_allclose(G.imag / G.real, 0.4)
