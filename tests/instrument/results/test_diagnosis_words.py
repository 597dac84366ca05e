"""Probabilities and doubt in words."""

import numpy as np
import pytest
from diagnosis_cases import diagnosis

from instrument.cli.output import Output
from instrument.cli.print_diagnosis import print_diagnosis
from instrument.facts.diagnosis import ParameterFound
from instrument.facts.rows import HeldOut, StretchSetAside
from instrument.results.diagnosis_figures import law_figure
from instrument.results.diagnosis_words import (
    log_odds,
    parameter_words,
    probability_words,
    resampling_words,
    set_aside_words,
    with_verdict,
)
from instrument.results.foretelling import NOT_FORETOLD, why_not_foretold


@pytest.mark.parametrize(
    ("p", "said"),
    [
        (0.9876, "98.8 %"),
        (0.002, "0.2 %"),
        (1e-5, "< 0.1 %"),
        (0.9999, "> 99.9 %"),
        (None, "-"),
        (np.nan, "-"),
    ],
)
def test_a_probability_is_told_in_percent_and_never_as_nought_or_all(p, said):
    candidate = diagnosis().candidates[0].but(probability=p)
    assert probability_words(candidate, diagnosis()) == said


def test_nothing_was_weighed_by_hand_nor_before_there_were_probabilities():
    found = diagnosis()
    first = found.candidates[0]
    assert probability_words(first, found.but(by_hand=True)) == "-"
    assert probability_words(first.without("probability"), found) == "-"


def test_what_is_refused_has_no_probability_where_nothing_explains_the_data():
    unknown = diagnosis(verdict="unknown")
    fails = diagnosis().candidates[0].but(probability=0.01, checks={"size": 1e-9, "signs": 0.3})
    passes = fails.but(checks={"size": 0.02, "signs": 0.3})
    assert probability_words(fails, unknown) == "refused"
    assert probability_words(passes, unknown) == "1.0 %"
    # The likeliest passes every check and does not predict what it has not seen.
    assert probability_words(passes.but(probability=1.0), unknown) == "refused"
    assert probability_words(fails, diagnosis()) == "1.0 %"


@pytest.mark.parametrize(
    ("value", "said"), [(-1.0, "in each file its own"), (0.0, "in every file"), (2.0, "in file 2")]
)
def test_whose_file_an_effect_is_in_is_said_in_words(value, said):
    where = ParameterFound(value=value, standard_error=float("nan"), unit="1")
    assert parameter_words("file", where) == said


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("layer", 1.0, "of the constraining layer"),
        ("layer_density.layer", 0.0, "layer_density of the substrate"),
        ("level", 0.0, "at every level"),
        ("level", 9.81, "level 9.81"),
    ],
)
def test_a_number_that_stands_for_a_word_is_said_as_that_word(key, value, said):
    assert parameter_words(key, ParameterFound(value=value, standard_error=float("nan"), unit="1")) == said


def test_a_law_of_an_unknown_cause_says_so():
    assert with_verdict("the law", diagnosis(verdict="unknown")) == "the law (verdict unknown)"
    assert with_verdict("the law", diagnosis()) == "the law"


def test_odds_are_against_none():
    found = diagnosis()
    costs = found.candidates[0], found.candidates[-1].but(delta_bic=8.0)
    assert log_odds(found.but(candidates=costs)) == [4.0, 0.0]
    assert log_odds(found.but(candidates=costs[:1])) == [None]


def test_candidates_are_listed_by_their_probability_whatever_they_cost():
    found = diagnosis()
    some = tuple(found.candidates[0].but(probability=p, delta_bic=d) for p, d in ((0.2, 0.0), (0.7, 90.0)))
    assert [c.probability for c in found.but(candidates=some).likeliest_first] == [0.7, 0.2]


def test_resampling_is_said_where_it_was_done():
    assert resampling_words(diagnosis()) == ""
    said = resampling_words(diagnosis().but(p_value=0.05, nested_held_out_rms_percent=2.345))
    assert said == (
        "sweeps without any effect gain as much in up to 5 % of cases; "
        "data left out, the whole search repeated without them: 2.3 % rms"
    )


@pytest.mark.parametrize(("p", "times"), [(0.05, "none of 19 (below 5 %)"), (0.3, "5 of 19 (up to 30 %)")])
def test_how_often_data_without_any_effect_gain_as_much_is_counted(p, times):
    said = resampling_words(diagnosis().but(p_value=p, resamples=19))
    assert said == f"sweeps without any effect gain as much in {times}"


def test_every_law_of_an_unknown_cause_is_marked(capsys):
    found = diagnosis(verdict="unknown").but(equivalent={})
    print_diagnosis(Output(None), found)
    assert "the core's law, +- one standard error (verdict unknown)" in capsys.readouterr().out
    assert law_figure(found).axes[0].get_title(loc="left").endswith("(verdict unknown)")
    assert "verdict unknown" not in law_figure(diagnosis()).axes[0].get_title(loc="left")


def test_candidates_are_printed_with_their_probability(capsys):
    print_diagnosis(Output(None), diagnosis())
    said = capsys.readouterr().out
    assert "probability" in said
    assert "82.0 %" in said
    assert "BIC" not in said


def test_neighbours_that_were_set_aside_are_a_range():
    point = diagnosis().points[0]
    used = tuple(point.but(frequency_hz=f) for f in (10.0, 50.5, 70.0))
    found = diagnosis().but(points=used, set_aside_hz=(20.0, 30.0, 40.0, 60.0, 65.0, 100.0))
    assert set_aside_words(found) == "Set aside: 20 to 40, 60, 65, 100 Hz."


def test_stretches_of_files_are_said_by_their_file_and_not_point_by_point():
    point = diagnosis().points[0]
    used = tuple(point.but(frequency_hz=f) for f in (10.0, 20.1, 30.1, 70.0))
    stretches = [
        StretchSetAside(file=file, name=name, from_hz=low, to_hz=high, largest_percent=5.0, points=3)
        for file, name, low, high in ((2, "b.csv", 60.0, 65.0), (1, "a.csv", 20.0, 40.0))
    ]
    found = diagnosis().but(
        points=used, set_aside_hz=(20.0, 20.2, 30.0, 40.0, 60.0, 65.0, 100.0), set_aside=tuple(stretches)
    )
    assert set_aside_words(found) == "Set aside: 100 Hz; in a.csv 20 to 40 Hz; in b.csv 60 to 65 Hz."


def test_files_are_named_and_why_a_segment_is_not_foretold_is_said(capsys, monkeypatch):
    found = diagnosis()
    print_diagnosis(Output(None), found.but(files=("sweep",)))
    said = capsys.readouterr().out
    assert "file 1" not in said
    assert NOT_FORETOLD not in said
    monkeypatch.setattr("instrument.results.foretelling.is_foretold", lambda *_: False)
    held_out = (HeldOut(segment=1, rms_percent=2.0, noise_percent=1.0),)
    stages = {"before": found.before.but(held_out=held_out), "after": found.after.but(held_out=held_out)}
    print_diagnosis(Output(None), found.but(files=("sweep", "sweep, clamped anew"), **stages))
    said = capsys.readouterr().out
    assert "file 1: sweep; file 2: sweep, clamped anew" in said
    assert NOT_FORETOLD in said


@pytest.mark.parametrize(
    ("points", "why"),
    [
        (0, "modes are few, none is left out"),
        (5, "5 points are too few to leave one out"),
        (40, "one segment alone, no other foretells it"),
    ],
)
def test_why_there_is_no_error_on_data_held_out_is_said(points, why):
    found = diagnosis()
    assert why_not_foretold(found) == ()
    nothing = {"held_out": (), "held_out_rms_percent": None, "leave_one_out_rms_percent": None}
    stages = {name: getattr(found, name).but(**nothing) for name in ("before", "after")}
    without = found.but(points=(*found.points, *found.points)[:points], **stages)
    assert len(without.points) == points
    assert why_not_foretold(without) == (f"no error on data held out: {why}",)


def test_that_the_noise_of_held_out_data_is_not_known_is_said():
    found = diagnosis()
    held_out = (HeldOut(segment=1, rms_percent=2.0, noise_percent=float("nan")),)
    stages = {name: getattr(found, name).but(held_out=held_out) for name in ("before", "after")}
    assert why_not_foretold(found.but(**stages)) == (
        "- for noise alone: the noise of these readings is not known",
    )
