"""When one law serves, when a cause is looked for, and which causes may be one of all sweeps."""

from types import SimpleNamespace

import numpy as np
import pytest
from temperature_cases import LAW

from fitting.effects import CATALOGUE
from fitting.temperature.causes import REFUSED, common, explains
from fitting.temperature.shifted_law import ShiftedLaw
from fitting.temperature.simple import OddOne, in_doubt, judge, serving

T = np.array([5.0, 20.0])


def fit(p=0.4, own=1.0, *, noise_known=True, off=1.0):
    """Of two temperatures; at the second the loss factor is `off` times the joint law's."""

    def of_its_own(k):
        law = ShiftedLaw(LAW, a=(4.0, 1.0)[k])

        def storage_and_loss(omega):
            G, eta = law.storage_and_loss(omega)
            return G, eta * (1.0, off)[k]

        return SimpleNamespace(storage_and_loss=storage_and_loss)

    return SimpleNamespace(
        p_value=p,
        own_chi2_per_dof=own,
        noise_known=noise_known,
        chi2=110.0,
        chi2_own=100.0,
        degrees=4.0,
        law=LAW,
        own_law=of_its_own,
        sweeps_log_shift=np.log([4.0, 1.0]),
        log_vertical=np.zeros(2),
        bands_hz=[(14.0, 300.0)] * 2,
        shift=SimpleNamespace(kind="wlf", temperature_c=T),
    )


def cause(name, cost, *, serves=True, may_serve=False, p=0.5):
    effect = CATALOGUE[name]
    one = SimpleNamespace(of=lambda e: np.array([q.typical for q in e.parameters]))
    its = fit(p=p)
    its.one = one
    return SimpleNamespace(effect=effect, fit=its, cost=cost, serves=serves, may_serve=may_serve)


def test_one_law_that_leaves_noise_is_simple_and_its_wicket_is_one_curve():
    said = judge(fit())
    assert said.simple is True
    assert said.wicket_percent < 0.1
    assert not in_doubt(fit())


def test_one_law_that_is_refused_is_not_and_says_by_how_much_and_where():
    said = judge(fit(p=REFUSED / 2, off=1.2))
    assert said.simple is False
    assert said.wicket_percent == pytest.approx(20.0, abs=0.1)
    assert "differs by up to 20 % at 20 degC" in said.words
    assert "try --shift free" in said.words


def test_where_the_noise_is_unknown_what_each_law_leaves_is_the_measure():
    said = judge(fit(own=50.0, noise_known=False))
    assert said.simple is True
    assert "noise being what a law for each temperature leaves" in said.words
    refused = fit(p=0.0, own=50.0, noise_known=False)
    assert in_doubt(refused)
    assert judge(refused).simple is False


def test_without_any_law_nothing_is_told():
    unfit = judge(fit(p=0.0, own=50.0))
    assert unfit.simple is None
    assert "not even a law for each temperature" in unfit.words
    assert "this law is not to be used" in unfit.words
    assert not unfit.law_stands
    assert judge(fit()).law_stands


def test_a_cause_beside_which_one_law_serves_is_named_with_what_is_as_good():
    causes = [cause("gain_error", 10.0), cause("channel_delay", 14.0), cause("spot_offset", 40.0)]
    assert [c.effect.name for c in serving(causes)] == ["gain_error", "channel_delay"]
    said = judge(fit(p=0.0), causes)
    assert said.simple is None
    assert causes[0].effect.discriminating_test in said.words
    assert said.p_value == 0.5
    assert judge(fit(p=0.0, own=50.0), causes).simple is True


def test_a_cause_that_cannot_serve_is_no_excuse():
    poor = [cause("gain_error", 10.0, serves=False, p=1e-5)]
    assert judge(fit(p=0.0), poor).simple is False
    beside = judge(fit(p=0.0, own=50.0), poor)
    assert beside.simple is False
    assert beside.p_value == 1e-5


def test_a_cause_whose_fit_is_still_on_its_way_refuses_no_material():
    on_its_way = [cause("gain_error", 10.0, serves=False, p=1e-5), cause("spot_offset", 11.0, serves=False)]
    on_its_way[1].may_serve = True
    for own in (1.0, 50.0):
        said = judge(fit(p=0.0, own=own), on_its_way)
        assert (said.simple, said.law_stands) == (None, False)
        assert "that fit has not come to its end" in said.words


def test_causes_of_all_sweeps_are_the_plate_s_and_the_rig_s_not_the_core_s_nor_time_s():
    names = {e.name for e in common(list(CATALOGUE.values()))}
    assert {"gain_error", "spot_offset", "clamp_compliance"} <= names
    assert not {"core_law", "temperature_drift", "mains_hum", "absolute_velocity"} & names
    assert explains(fit(own=1.0))
    assert not explains(fit(own=50.0))


def test_a_temperature_without_which_one_law_serves_is_named_before_the_material_is_blamed():
    words = judge(fit(p=1e-5), names=["cold.csv", "warm.csv"], odd_ones=[OddOne(1, 0.4)]).words
    assert "without warm.csv (20 degC, p 0.4) one law explains all others" in words
    assert "something may be off there alone" in words
    assert "not one material" not in words
    assert "not one material" in judge(fit(p=1e-5)).words


def test_what_was_found_and_what_to_do_about_it_are_apart_whatever_a_file_is_called():
    odd = judge(fit(p=1e-5), names=["cold.csv", "warm; wet.csv"], odd_ones=[OddOne(1, 0.4)])
    assert "the loss factor differs by up to" in odd.said
    assert odd.advice[0].startswith("without warm; wet.csv (20 degC, p 0.4) one law explains all others")
    assert odd.advice[1:] == ("identify it by itself, and the others",)
    assert odd.words == "; ".join((odd.said, *odd.advice))
    refused = judge(fit(p=1e-5, off=1.2))
    assert "differs" in refused.said
    assert [words.split(":")[0] for words in refused.advice] == ["try --shift free"]
    assert judge(fit()).advice == ()


@pytest.mark.parametrize(("degrees", "said"), [(1.2, "1 parameter fewer"), (4.0, "4 parameters fewer")])
def test_one_parameter_is_singular(degrees, said):
    refused = fit(p=REFUSED / 2, off=1.2)
    refused.degrees = degrees
    assert f" for {said}, " in judge(refused).words
