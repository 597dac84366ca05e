"""Whether one specimen's reduced model may serve another: what is asked, and what a full solve decides."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fitting.sweep import Sweep
from instrument.models import sharing
from instrument.models.sharing import SHARED, may_be_like, serves

F = np.array([15.0, 40.0, 60.0])


@pytest.fixture(scope="module")
def plate(zn1):
    return replace(zn1, elements=(5, 4), exact=False)


def longer(plate, by):
    return replace(plate, length_m=plate.length_m * (1 + by))


@pytest.mark.parametrize("by", [0.0, 0.02, -0.1])
def test_a_plate_a_few_percent_off_is_worth_asking(plate, by):
    assert may_be_like(longer(plate, by), plate)


OTHERS = {
    "far off": lambda p: longer(p, 0.2),
    "exact": lambda p: replace(p, exact=True),
    "bare": lambda p: replace(p, core=None, constraining=None),
    "on another mesh": lambda p: replace(p, elements=(6, 4)),
    "read otherwise": lambda p: replace(p, reads="relative" if p.reads == "absolute" else "absolute"),
    "held otherwise": lambda p: replace(p, boundary="simply-supported"),
}


@pytest.mark.parametrize("what", OTHERS)
def test_another_kind_of_plate_is_not_even_tried(monkeypatch, plate, what):
    other = OTHERS[what](plate)
    assert not may_be_like(other, plate)
    assert not may_be_like(plate, other)
    monkeypatch.setattr(sharing, "cached", lambda *_: pytest.fail("a model was made"))
    assert not serves(plate, other, SimpleNamespace(frequency_hz=F))


@pytest.mark.parametrize(("error", "serving"), [(0.9 * SHARED, True), (1.1 * SHARED, False)])
def test_the_largest_error_at_three_frequencies_decides(monkeypatch, plate, error, serving):
    asked = []

    def certificate(kind, depends_on, made, build, modules):
        asked.append(depends_on[2])
        return made(np.array([0.0, error, 0.0]))

    monkeypatch.setattr(sharing, "cached", certificate)
    assert serves(plate, longer(plate, 0.01), SimpleNamespace(frequency_hz=F)) is serving
    np.testing.assert_allclose(asked[0], [15.0, 30.0, 60.0])


def test_a_moved_model_serves_a_plate_near_by_and_not_one_far_off(plate):
    one, v = np.ones(3, dtype=np.intp), np.ones(3, complex)
    sweep = Sweep(F, v, np.full(3, 9.81), one, one)
    assert serves(plate, longer(plate, 1e-3), sweep)
    assert not serves(plate, longer(plate, 0.12), sweep)
