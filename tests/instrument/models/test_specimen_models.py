"""Models of a specimen: what is taken from them without solving in full."""

import numpy as np
import pytest

from fitting.reduced.reduced_plate import ReducedPlate

FREQUENCY_HZ = np.array([19.3, 60.0, 101.0, 280.0])


def test_a_large_estimate_is_looked_into_before_a_model_is_doubted(zn1, zn1_models, monkeypatch):
    law = zn1.core.law
    assert not zn1_models.uncertified(law, FREQUENCY_HZ)
    monkeypatch.setattr(ReducedPlate, "estimated_error", lambda self, omega, G: np.full(len(omega), 0.1))
    assert not zn1_models.uncertified(law, FREQUENCY_HZ)
    right = ReducedPlate.displacement
    monkeypatch.setattr(ReducedPlate, "displacement", lambda self, omega, G: 1.001 * right(self, omega, G))
    assert zn1_models.uncertified(law, FREQUENCY_HZ)


def test_a_small_estimate_is_believed(zn1, zn1_models, monkeypatch):
    monkeypatch.setattr(
        "instrument.models.specimen_models.displacement_direct", lambda *_: pytest.fail("solved in full")
    )
    assert not zn1_models.uncertified(zn1.core.law, FREQUENCY_HZ)
