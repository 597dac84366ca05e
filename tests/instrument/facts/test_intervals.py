from math import inf

from instrument.facts.intervals import IntervalsFound, QuantityInterval

ONE = {
    "quantity": "g0_pa",
    "value": 2.7e5,
    "interval_68_percent": (2.6e5, 2.9e5),
    "interval_95_percent": (2.5e5, inf),
    "linear_68_percent": (2.6e5, 2.8e5),
    "linear_95_percent": (2.5e5, 2.9e5),
}


def test_an_open_bound_is_null():
    assert QuantityInterval(**ONE).as_json()["interval_95_percent"] == [2.5e5, None]


def test_what_one_method_alone_has_is_not_written_by_another():
    found = IntervalsFound(method="profile", quantities=(QuantityInterval(**ONE),), advice="")
    assert list(found.as_json()) == ["method", "quantities", "advice"]
    sampled = found.but(method="posterior", samples=4000, r_hat={"g0_pa": 1.01})
    assert sampled.as_json()["r_hat"] == {"g0_pa": 1.01}
    assert IntervalsFound(**sampled.as_json()).as_json() == sampled.as_json()
