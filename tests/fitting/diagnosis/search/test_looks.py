"""What a first look at an effect promises, where the law does almost the same."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.data.readings import Readings
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.search import looks
from fitting.diagnosis.search.looks import look
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect, EffectParameter


class Bent(Effect):
    """Its first order is what the law does too, but for a little; its second order nobody else does."""

    name, parameters = "bent", (EffectParameter("size", "1", -5.0, 5.0, 1.0),)


class FromTwoSizes(Bent):
    def starts(self, plate, points):
        return [np.array([1.0]), np.array([2.0])]


class BentResponse:
    """Readings (like the law, alone, by the bend)."""

    plate = None

    def __init__(self, effect, bend):
        self.effects, self.bend = (effect,), bend

    def velocity(self, law, u):
        size = u[0] if len(u) else 0.0
        return np.array([100 * size, size, self.bend * size**2], complex)


class BentAndLossy(Bent):
    """With a loss factor that begins at none: no reason to look at one side alone."""

    parameters = (*Bent.parameters, EffectParameter("loss_factor", "1", 0.0, 1.0, 0.2, shape=True))

    def starts(self, plate, points):
        return [np.array([1.0, 0.2])]


@pytest.fixture
def bent(monkeypatch):
    """A look at it, beside a law that takes up the first reading; the second asks for `asked` of it."""

    def looked(effect=None, bend=30.0, asked=10.0, **how):
        effect = effect or Bent()
        monkeypatch.setattr(looks, "response_of", lambda *_: BentResponse(effect, bend))
        evidence = Evidence(Readings(np.zeros(3, complex)), np.ones(3), np.ones(3), np.zeros((6, 1)), True)
        before = SimpleNamespace(
            effects=(),
            law=None,
            u=np.empty(0),
            residuals=np.array([0, -asked, 0, 0, 0, 0]),
            feels=np.eye(6)[:, :1],
        )
        problem = SimpleNamespace(coarse=None, points=None)
        return look(problem, evidence, before, effect, **how)

    return looked


def test_what_a_large_step_hides_in_its_bend_a_small_one_shows(bent):
    # Of a size of one the bend is thirty times what is looked for: all of it were 10^2.
    (shown, at), (hidden, _) = bent()
    assert hidden < 1
    assert shown > 20
    assert at[0] > 2


def test_what_a_small_step_promises_is_no_start_where_it_is_noise(bent):
    ((promise, _),) = bent(asked=1.0)
    assert promise < 0.01


def test_less_than_nothing_of_a_size_is_followed_whatever_else_begins_at_none(bent):
    promised = bent(BentAndLossy(), asked=-10.0)
    assert max(promise for promise, _ in promised) > 20
    assert any(u[0] < 0 for _, u in promised)


def test_starts_of_two_sizes_have_one_slope(bent):
    assert len(bent(FromTwoSizes())) == 3


def test_a_small_bend_a_second_step_takes_off(bent):
    (first, _), (again, _) = bent(bend=5.0)[0], bent(bend=5.0, again=True)[0]
    assert first < 4
    assert again > 20


class Humming(Effect):
    """A gain at one frequency; its starts are dense."""

    name = "humming"
    parameters = (
        EffectParameter("frequency", "Hz", 1.0, 100.0, 10.0, logarithmic=True, neutral=None),
        EffectParameter("size", "1", -9.0, 9.0, 1.0),
    )

    def starts(self, plate, points):
        return [np.array([f, 1.0]) for f in (10.0, 10.3, 10.6, 10.9, 30.0)]


class HummingResponse:
    """Every start is heard by itself, the lowest frequencies most plainly."""

    effects, plate = (Humming(),), None

    def velocity(self, law, u):
        heard = {10.0: 1.0, 10.3: 0.9, 10.6: 0.8, 10.9: 0.7, 30.0: 0.6}
        return np.array([u[1] * heard[u[0]] if len(u) else 0.0, u[1] if len(u) else 0.0, 0.0], complex)


def test_of_frequencies_next_to_each_other_not_all_are_followed_first(monkeypatch):
    monkeypatch.setattr(looks, "response_of", lambda *_: HummingResponse())
    evidence = Evidence(Readings(np.zeros(3, complex)), np.ones(3), np.ones(3), np.zeros((6, 1)), True)
    before = SimpleNamespace(
        effects=(), law=None, u=np.empty(0), residuals=np.array([-9.0, 0, 0, 0, 0, 0]), feels=np.zeros((6, 0))
    )
    found = look(SimpleNamespace(coarse=None, points=None), evidence, before, Humming())
    assert [u[0] for _, u in found] == [10.0, 10.3, 30.0, 10.6, 10.9]
    assert found[2][0] < found[4][0]


def test_what_has_a_frequency_and_a_place_begins_in_another_place_each_time():
    u = [np.array([1e-3, f, 0.05, x, 0.1]) for f in (10.0, 10.3) for x in (0.1, 0.2)]
    # The first place promises most at both of its frequencies.
    starts = list(zip((9.0, 5.0, 8.0, 4.0), u, strict=True))
    order = looks._apart(CATALOGUE["loose_part"], sorted(starts, key=lambda one: -one[0]))
    assert [promise for promise, _ in order] == [9.0, 5.0, 8.0, 4.0]
