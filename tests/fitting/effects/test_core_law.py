import numpy as np
import pytest

from fitting.effects import CATALOGUE
from fitting.effects.given import Points
from fitting.laws.fractional_zener import FractionalZener

OMEGA = 2 * np.pi * np.linspace(20.0, 300.0, 40)
POINTS = Points(OMEGA, np.ones(40), np.arange(40.0), True, True, "relative")


@pytest.mark.parametrize(
    "stated",
    [
        FractionalZener(0.4e6, 8e6, 2e-4, 0.7),
        # A fit that went astray: the loss factor reaches some fifty.
        FractionalZener(1e3, 1e7, 1e-5, 0.999),
        FractionalZener(1e8, 1e11, 1e-3, 0.5),
    ],
)
def test_other_laws_begin_as_materials_wherever_the_stated_one_has_got_to(stated):
    laws = CATALOGUE["core_law"].laws(stated, POINTS)
    assert len(laws) == 7
    for law in laws:
        G, eta = law.storage_and_loss(OMEGA)
        assert np.all(G > 0)
        assert np.all(eta > 0)
