"""Trials weighed: what is named, what stands beside it, what is refused."""

from dataclasses import dataclass, field
from types import SimpleNamespace

import pytest

from fitting.diagnosis.verdict import (
    EXTENSION,
    FIRST,
    HINTED,
    SECOND,
    TOO_MUCH,
    WITHIN,
    judge,
    standing_for,
    without_idle_extensions,
)
from fitting.effects import CATALOGUE


@dataclass(frozen=True, eq=False)
class Weighed:
    """As much of a trial as is looked at."""

    names: tuple[str, ...]
    bic: float
    chi2: float = 0.0
    chi2_per_dof: float = 1.0
    leans: bool = False
    fitted: SimpleNamespace = field(init=False)

    def __post_init__(self):
        effects = tuple(CATALOGUE[name] for name in self.names)
        chi2 = self.chi2 or 500 * self.chi2_per_dof
        fitted = SimpleNamespace(effects=effects, chi2=chi2, chi2_per_dof=self.chi2_per_dof)
        object.__setattr__(self, "fitted", fitted)


def weighed(none, singles, pairs=(), off=None, **how):
    trials = sorted(singles, key=lambda t: t.bic)
    return judge(
        none,
        trials,
        sorted(pairs, key=lambda t: t.bic),
        noise_known=how.get("noise_known", True),
        structured=True,
        held_out=lambda trial: (off or {}).get(trial.names, 1.0),
        meant=lambda trial: standing_for(trial, [*trials, *pairs]),
    )


NONE = Weighed((), 1000.0, 1000.0, 3.0)


def test_what_gains_too_little_is_not_named():
    assert weighed(Weighed((), 100.0), [Weighed(("spot_offset",), 100.0 - 0.9 * FIRST)]).verdict == "none"
    assert weighed(Weighed((), 100.0), [Weighed(("spot_offset",), 100.0 - 1.1 * FIRST)]).verdict == "effect"


@pytest.mark.parametrize(("behind", "verdict"), [(0.9 * WITHIN, "ambiguous"), (1.1 * WITHIN, "effect")])
def test_what_is_near_belongs_to_the_group(behind, verdict):
    said = weighed(NONE, [Weighed(("gain_error",), 0.0), Weighed(("spot_offset",), behind)])
    assert said.verdict == verdict
    assert ("spot_offset" in said.equivalent["gain_error"]) == (verdict == "ambiguous")


@pytest.mark.parametrize(
    ("gain", "named", "group"),
    [
        (0.5 * HINTED, "base_rocking", ("base_rocking",)),
        (0.5 * (HINTED + EXTENSION), "base_rocking", ("base_rocking", "fixture_resonance")),
        (2 * EXTENSION, "fixture_resonance", ("fixture_resonance",)),
    ],
)
def test_a_wider_effect_is_named_where_it_gains_and_mentioned_where_it_hints(gain, named, group):
    every = [
        Weighed(("base_rocking",), 0.0, 300.0),
        Weighed(("fixture_resonance",), 10.0 - gain if gain > EXTENSION else 30.0, 300.0 - gain),
    ]
    every.sort(key=lambda t: t.bic)
    said = judge(
        NONE,
        without_idle_extensions(every),
        [],
        noise_known=True,
        structured=True,
        held_out=lambda trial: 1.0,
        meant=lambda trial: standing_for(trial, every),
    )
    assert said.accepted.names == (named,)
    if gain < EXTENSION:
        assert said.equivalent[named] == group


def test_a_second_effect_must_gain_and_predict():
    single, pair = Weighed(("channel_delay",), 100.0), ("channel_delay", "spot_offset")
    weak, strong = Weighed(pair, 100.0 - 0.9 * SECOND), Weighed(pair, 100.0 - 1.1 * SECOND)
    assert weighed(NONE, [single], [weak]).accepted.names == single.names
    assert weighed(NONE, [single], [strong]).accepted.names == pair
    assert (
        weighed(NONE, [single], [strong], off={pair: 2.6, single.names: 1.5}).accepted.names == single.names
    )


def test_a_pair_far_behind_the_best_one_is_not_taken_in_its_place():
    single, best = Weighed(("added_mass",), 100.0), ("added_mass", "gain_error")
    pairs = [Weighed(best, 0.0), Weighed(("added_mass", "partial_debond"), 2 * WITHIN)]
    off = {single.names: 1.0, best: 2.5}
    assert weighed(NONE, [single], pairs, off=off).accepted.names == single.names


def test_the_share_its_own_model_misses_is_not_a_second_effect():
    single, pair = Weighed(("clamp_friction",), 100.0), ("clamp_friction", "fixture_resonance")
    strong = Weighed(pair, 100.0 - 1.1 * SECOND)
    assert CATALOGUE["clamp_friction"].misses > 0
    assert weighed(Weighed((), 1e4), [single], [strong]).accepted.names == single.names


@pytest.mark.parametrize(("off", "none_off"), [(3.5, 4.0), (30.0, 40.0)])
def test_another_law_that_does_not_predict_is_refused(off, none_off):
    best = Weighed(("core_law",), 0.0)
    assert weighed(NONE, [best], off={best.names: off, (): none_off}).verdict == "unknown"
    assert weighed(NONE, [best], off={best.names: off, (): 10 * none_off}).verdict == "effect"


def test_what_two_segments_cannot_place_is_believed_all_the_same():
    assert weighed(NONE, [Weighed(("added_mass",), 0.0)], off={("added_mass",): 30.0}).verdict == "effect"


def test_what_bends_the_plate_too_much_is_refused_and_said():
    said = weighed(NONE, [Weighed(("gain_error",), 0.0, leans=True)])
    assert (said.verdict, said.refused) == ("unknown", ("gain_error",))
    assert "layer-wise plate" in said.why


def test_what_does_not_bend_it_is_named_before_what_does():
    singles = [Weighed(("gain_error",), 0.0, leans=True), Weighed(("spot_offset",), 0.9 * WITHIN)]
    said = weighed(NONE, singles)
    assert (said.verdict, said.equivalent) == ("effect", {"spot_offset": ("spot_offset",)})
    assert weighed(NONE, [singles[0], Weighed(("spot_offset",), 1.1 * WITHIN)]).verdict == "unknown"
    assert weighed(Weighed((), FIRST + 1.0), singles).verdict == "unknown"


def test_a_wider_effect_is_named_where_the_simpler_one_bends_the_plate():
    every = [Weighed(("base_rocking",), 0.0, 300.0, leans=True), Weighed(("fixture_resonance",), 5.0, 299.0)]
    assert without_idle_extensions(every) == every
    assert weighed(NONE, every).accepted.names == ("fixture_resonance",)


def test_a_pair_that_bends_the_plate_is_passed_over():
    single = Weighed(("gain_error",), 100.0, leans=True)
    pairs = [
        Weighed(("gain_error", "added_mass"), 0.0, leans=True),
        Weighed(("gain_error", "core_thickness"), 0.9 * WITHIN),
    ]
    assert weighed(NONE, [single], pairs).accepted is pairs[1]
    assert weighed(NONE, [single], pairs[:1]).verdict == "unknown"


def test_what_leaves_too_much_is_refused():
    assert weighed(NONE, [Weighed(("added_mass",), 0.0, chi2_per_dof=1.1 * TOO_MUCH)]).verdict == "unknown"


def test_what_its_own_model_misses_may_be_left():
    much = 1.1 * TOO_MUCH
    left = 500 * (much - TOO_MUCH)
    share = CATALOGUE["amplitude_softening"].misses
    for gain, verdict in ((0.5 * left / share, "unknown"), (2 * left / share, "effect")):
        one = Weighed(("amplitude_softening",), 0.0, chi2_per_dof=much)
        assert weighed(Weighed((), gain), [one]).verdict == verdict


def test_a_pair_need_not_predict_better_than_an_effect_that_explains_too_little():
    pair = ("absolute_velocity", "core_law")
    single = Weighed(pair[:1], 500.0, chi2_per_dof=1.1 * TOO_MUCH)
    off = {pair: 5.0, pair[:1]: 3.5}
    assert weighed(NONE, [single], [Weighed(pair, 0.0)], off={**off, (): 50.0}).accepted.names == pair
    assert weighed(NONE, [single], [Weighed(pair, 0.0)], off={**off, (): 6.0}).verdict == "unknown"
