"""Words of a diagnosis that say no more than is known."""

from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_cases import pair, sweep

from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.diagnosis.verdict.judgement import Judgement
from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.diagnosis.verdict.result import FoundEffect, ParameterEstimate
from fitting.diagnosis.verdict.text import (
    beside_kin,
    explain,
    how_likely,
    moved_words,
    next_measurement,
    story,
    what_it_leaves,
    where_nothing_explains,
)
from fitting.effects import CATALOGUE
from fitting.effects.base import Effect
from fitting.identification.result import LawBand


@pytest.mark.parametrize(("none", "words"), [(0.52, "If anything,"), (0.3, "Most likely")])
def test_what_is_named_beside_a_likelier_none_is_not_called_most_likely(none, words):
    names = ("gain_error",)
    said = Judgement("ambiguous", None, {}, probability={(): none, names: 0.35})
    assert how_likely(said, names) == words


@pytest.mark.parametrize(
    ("share", "words"),
    [(0.08, "has 8 %: the readings show too little of it"), (0.3, "has 30 %: what is left of the readings")],
)
def test_why_something_in_no_catalogue_may_be_there_depends_on_what_the_readings_say_of_it(share, words):
    names = {"gain_error": ("gain_error", UNLISTED)}
    said = Judgement("ambiguous", None, names, probability={("gain_error",): 1 - share, (UNLISTED,): share})
    (line,) = beside_kin(said)
    assert words in line
    assert beside_kin(Judgement("effect", None, {"gain_error": ("gain_error",)})) == []


@pytest.mark.parametrize(
    ("kind", "levels", "asked"),
    [
        ("plate", 1, ("A second spot and a second level", "the place or the drive")),
        ("beam", 2, ("A second spot and its lowest level by itself", "the place or the drive")),
        ("shear-pair", 2, ("Another mass and its lowest level by itself", "the rig or to the strain")),
    ],
)
def test_where_nothing_explains_what_is_asked_for_is_what_the_specimen_has(kind, levels, asked):
    unknown = where_nothing_explains(kind, levels)
    said = next_measurement(Judgement("unknown", None, {}), {}, with_hammer=False, unknown=unknown)
    assert all(words in said for words in asked)
    assert next_measurement(Judgement("none", None, {}), {}, with_hammer=False, unknown=unknown) == ""


@pytest.mark.parametrize("group", [("odd",), ("odd", "other")])
def test_effects_that_name_no_test_of_their_own_ask_for_no_measurement(group):
    """Another package's effect need not say what would show it."""
    catalogue = {name: Effect() for name in group}
    judgement = Judgement("effect", SimpleNamespace(names=group), dict.fromkeys(group, group))
    assert next_measurement(judgement, catalogue, with_hammer=True) == ""
    catalogue["odd"].discriminating_test = "the odd thing taken off"
    assert "the odd thing taken off" in next_measurement(judgement, catalogue, with_hammer=True)


def moved(*places):
    """What is said where the last of members at these places moves by 6 %, the others hardly."""
    member = SmallProblem.of_small(sweep(pair(0.3), points=20), pair(0.3))
    problem = SeveralProblem.of_members([member] * len(places), [None] * len(places), places)
    plain = problem.sweep.response_m_s
    factor = np.full(len(plain), 1.0 + 2e-5)
    factor[problem.starts_at[-1]] = 1.06
    return moved_words(problem, plain, factor * plain)


def test_of_several_files_and_spots_the_most_moved_is_said_with_its_place():
    assert moved(Place(1), Place(2)).startswith(
        "With the same law, this effect alone changes the response by up to 6 % near "
    )
    assert moved(Place(1), Place(2)).endswith(" Hz in file 2.")
    assert moved(Place(1, 0), Place(1, 1)).endswith(" Hz at pickup 1.")
    assert moved(Place(1, 0), Place(2, 1)).endswith(" Hz in file 2 at pickup 1.")
    assert moved(Place(1)).endswith(" Hz.")


def test_the_frequency_that_is_said_is_where_the_response_changes_most():
    member = SmallProblem.of_small(sweep(pair(0.3), points=20), pair(0.3))
    plain = member.sweep.response_m_s
    factor = np.ones(len(plain), complex)
    factor[13] = 1.5
    said = moved_words(member, plain, factor * plain)
    assert f"50 % near {member.sweep.frequency_hz[13]:.0f} Hz" in said


def warmed(kelvin_error, time_error_s):
    sizes = {
        "warming": ParameterEstimate(9.5, kelvin_error, "K"),
        "time_constant": ParameterEstimate(1020.0, time_error_s, "s"),
    }
    return story(CATALOGUE["temperature_drift"], FoundEffect("temperature_drift", sizes))


def test_sizes_that_are_hardly_known_are_said_with_their_errors():
    plain = "the core warms by 9.5 K in the end, within 17 min"
    assert warmed(0.4, 90.0) == plain
    assert warmed(np.nan, np.nan) == plain
    assert warmed(28.0, 3060.0) == (
        f"{plain} (known roughly: warming 9.5 +- 28 K, time_constant 1000 +- 3100 s)"
    )


def stage(chi2, rms_percent, held_out=None):
    said = SimpleNamespace(leave_one_out_rms_percent=None, held_out_rms_percent=held_out)
    band = LawBand(np.array([100.0]), np.array([3e5]), np.array([0.3]), np.zeros(1), np.zeros(1))
    return SimpleNamespace(chi2_per_dof=chi2, rms_percent=rms_percent, validation=said, band=band)


def told(judgement, before, after, found=()):
    plate = SimpleNamespace(specimen=SimpleNamespace(kind="plate"))
    return explain(plate, judgement, before, after, found)


@pytest.mark.parametrize(
    ("chi2", "left", "words"),
    [
        (
            1.02,
            ", chi-square per degree of freedom 1.02 where noise and model error leave 1.",
            "That is what",
        ),
        # Nobody knows what noise leaves of points that do not show theirs.
        (np.nan, ".", "How much of that is noise these points do not show: they call for no effect."),
    ],
)
def test_that_noise_leaves_as_much_is_said_only_of_a_noise_that_is_known(chi2, left, words):
    before = stage(chi2, 5.2)
    first, second = told(Judgement("none", None, {}), before, before)
    assert first == f"The stated plate with its best law leaves 5.2 % rms in amplitude{left}"
    assert second.startswith(words)


def test_chi_square_is_called_what_it_is_wherever_it_is_said():
    """It is of squares, with the model's own error in it: not so many times the noise."""
    before, after = stage(41.0, 3.0, 3.1), stage(0.59, 0.35, 0.36)
    left, *_ = what_it_leaves(before, after, ())
    assert left == (
        "With it the fit leaves 0.35 % rms instead of 3 %, chi-square per degree of freedom 0.59 instead of "
        "41; on segments held out 0.36 % instead of 3.1 %."
    )
