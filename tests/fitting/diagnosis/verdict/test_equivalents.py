"""What stands for each effect of the best, in explanations of one group."""

from verdict_cases import scored

from fitting.diagnosis.verdict.equivalents import equivalents_of

BEST = scored("channel_delay", "spot_offset", cost=0.0)


def of_group(*others):
    group = [BEST, *(scored(*names, cost=1.0) for names in others)]
    return equivalents_of(BEST, [(one, 1 / len(group)) for one in group])


def test_what_is_beside_the_rest_of_the_best_stands_for_the_one_it_lacks():
    found = of_group(("channel_delay", "base_roll"))
    assert found == {"channel_delay": ("channel_delay",), "spot_offset": ("spot_offset", "base_roll")}


def test_where_both_are_exchanged_each_stands_for_what_it_stands_for_alone():
    found = of_group(("channel_delay", "base_roll"), ("sensor_lowpass", "base_roll"))
    assert found["channel_delay"] == ("channel_delay", "sensor_lowpass")
    assert found["spot_offset"] == ("spot_offset", "base_roll")


def test_none_stands_for_every_effect():
    assert of_group(()) == {n: (n, "none") for n in BEST.names}
