"""The JSON of a diagnosis, and what is printed and drawn from it."""

import json

import numpy as np
import pytest
from diagnosis_cases import AFTER, BEFORE, diagnosis

from instrument.cli.output import Output
from instrument.cli.print_diagnosis import print_diagnosis
from instrument.errors import BadInput
from instrument.results.diagnosis_figures import (
    evidence_figure,
    law_figure,
    residual_figure,
    save_diagnosis_figures,
)
from instrument.results.diagnosis_words import verdict_line
from instrument.results.set_aside import NAME


@pytest.fixture(scope="module")
def result():
    return diagnosis()


@pytest.fixture(scope="module")
def found(result):
    """As JSON has it."""
    return result.as_json()


def test_every_key_that_others_rely_on_is_there(found):
    assert set(found) >= {
        *("verdict", "effects", "equivalent", "candidates", "before", "after", "next_measurement"),
        *("seconds", "setup_seconds"),
    }
    for candidate in found["candidates"]:
        assert set(candidate) == {
            *("name", "delta_bic", "probability", "chi2_per_dof", "parameters", "law", "checks")
        }
    for stage in (found["before"], found["after"]):
        assert set(stage) >= {
            *("rms_percent", "max_percent", "chi2_per_dof", "held_out", "held_out_rms_percent"),
            *("parameters", "standard_errors", "correlations", "law"),
        }
        assert set(stage["held_out"][0]) == {"segment", "rms_percent", "noise_percent"}
        assert set(stage["parameters"]) == set(stage["standard_errors"])
        assert set(stage["parameters"]) == set(stage["correlations"])
        frequencies = [row["frequency_hz"] for row in stage["law"]]
        assert {20.0, 100.0, 280.0} <= set(frequencies)


def test_effects_are_the_accepted_ones_and_what_channels_show(found):
    assert [e["name"] for e in found["effects"]] == ["added_mass", "mains_hum"]
    assert found["effects"][0]["parameters"]["mass"] == {"value": 0.008, "standard_error": 1e-4, "unit": "kg"}
    assert found["equivalent"] == {"added_mass": ["added_mass"]}


def test_what_the_data_do_not_fix_is_null_and_the_whole_is_json(found):
    assert found["effects"][0]["parameters"]["x"]["standard_error"] is None
    assert json.loads(json.dumps(found, allow_nan=False)) == found


def test_parameters_of_two_effects_together_cannot_be_mistaken(found):
    names = [c["name"] for c in found["candidates"]]
    assert names == ["added_mass", "spot_offset", "added_mass + spot_offset", "none"]
    assert set(found["candidates"][2]["parameters"]) == {"added_mass.mass", "added_mass.x", "spot_offset.dx"}
    assert found["candidates"][3]["parameters"] == {}


def test_the_held_out_error_is_that_of_single_points_where_there_are_few():
    before = diagnosis(one_by_one=7.5).as_json()["before"]
    assert before["held_out"] == []
    assert before["held_out_rms_percent"] == before["leave_one_out_rms_percent"] == 7.5


def test_points_carry_what_either_fit_leaves(found):
    points = found["points"]
    assert len(points) == 28
    np.testing.assert_allclose(
        [[p["before"]["re_percent"], p["before"]["im_percent"]] for p in points],
        np.tile([100 * BEFORE.real, 100 * BEFORE.imag], (28, 1)),
    )
    np.testing.assert_allclose([p["after"]["im_percent"] for p in points], 100 * AFTER.imag)
    # Real parts one after the other, then imaginary ones.
    assert points[3]["before"]["whitened"] == [3.0, 31.0]
    assert points[0]["noise_percent"] == pytest.approx(0.1)


def test_points_with_hum_are_named_and_not_among_the_others(found):
    assert len(found["set_aside_hz"]) == 2
    assert [p["frequency_hz"] for p in found["points_set_aside"]] == found["set_aside_hz"]
    assert {p["why"] for p in found["points_set_aside"]} == {"mains_hum"}
    assert not set(found["set_aside_hz"]) & {p["frequency_hz"] for p in found["points"]}


def test_amplitudes_leave_a_difference_in_amplitude_alone():
    point = diagnosis(phase=False).as_json()["points"][0]
    assert set(point["before"]) == {"amplitude_percent", "whitened"}
    assert len(point["before"]["whitened"]) == 1


@pytest.mark.parametrize("how", [{}, {"phase": False}, {"verdict": "ambiguous"}, {"one_by_one": 7.5}])
def test_a_person_reads_verdict_reasons_and_numbers(capsys, how):
    print_diagnosis(Output(None), diagnosis(**how))
    said = capsys.readouterr().out
    assert said.startswith(f"verdict: {how.get('verdict', 'effect')}")
    for words in (
        "added_mass (mass 8.00 +- 0.10 g",
        "a mass of 8 g",
        "Next measurement",
        "spot_offset",
        "chi-square per degree of freedom",
        "note: the points carry no time",
        "set-up 1.50 s, diagnosis 0.25 s",
    ):
        assert words in said
    assert ("cannot tell added_mass from spot_offset" in said) == (how.get("verdict") == "ambiguous")
    assert ("each point from the others" in said) == ("one_by_one" in how)


def test_what_channels_show_is_not_said_to_be_the_verdict(result):
    channel = [e for e in result.effects if e.name == "mains_hum"]
    line = verdict_line(result.but(verdict="none", effects=channel, equivalent={}))
    assert line.startswith("verdict: none: nothing beyond noise that these data can name (")
    assert "% for no effect); the channels by themselves show mains_hum (" in line


def test_what_someone_decided_is_not_said_to_be_the_data_s_word(result):
    declined = result.but(verdict="none", effects=(), equivalent={}, by_hand=True)
    assert verdict_line(declined) == "verdict: by your word: no effect accepted"
    accepted = verdict_line(result.but(by_hand=True))
    assert accepted.startswith("verdict: by your word: ")


@pytest.mark.parametrize("phase", [True, False])
def test_figures_are_saved(tmp_path, phase):
    paths = save_diagnosis_figures(diagnosis(phase=phase), tmp_path / "new")
    assert [p.name for p in paths] == [
        "diagnosis-residual.png",
        "diagnosis-evidence.png",
        "diagnosis-law.png",
    ]
    assert all(p.stat().st_size > 5000 for p in paths)


def test_figures_into_a_file_are_refused_in_a_line(tmp_path, result):
    (tmp_path / "taken").write_text("")
    with pytest.raises(BadInput, match="taken"):
        save_diagnosis_figures(result, tmp_path / "taken")


def test_the_residual_is_drawn_before_and_after_each_on_its_own_scale(result):
    axes = residual_figure(result).axes
    assert len(axes) == 6
    for left, right in zip(axes[::2], axes[1::2], strict=True):
        assert left.get_xlim() == right.get_xlim()
        assert left.get_ylim() != right.get_ylim()
        assert left.get_xlim() == right.get_xlim()
    assert "10" in axes[0].get_title()


def test_where_no_effect_is_accepted_nothing_is_drawn_after_it(result):
    alone = result.but(verdict="unknown", equivalent={}, effects=(), after=result.before)
    axes = residual_figure(alone).axes
    assert len(axes) == 3
    assert axes[0].get_title().startswith("without any effect")
    left, _ = law_figure(alone).axes
    assert [line.get_label() for line in left.lines] == ["no effect is accepted"]
    assert len(law_figure(result).axes[0].lines) == 2


def test_of_several_files_a_segment_is_named_by_file_and_pickup(result):
    points = [p.but(file=p.segment, pickup=p.segment - 1) for p in result.points]
    more = [p.but(segment=p.segment + 3) for p in points]
    axes = residual_figure(result.but(points=(*points, *more))).axes
    assert axes[2].get_ylabel().startswith("Segment 2\nfile 2, pickup 1\n")
    assert [text.get_text() for text in axes[8].texts] == ["the first 5 of 6 segments"]
    assert residual_figure(result).axes[2].get_ylabel().startswith("Segment 2\nresidual")


def test_a_sentinel_far_off_does_not_stretch_its_segment(result):
    away = result.points[-1].but(frequency_hz=20.0)
    axes = residual_figure(result.but(points=(*result.points, away))).axes
    assert axes[4].get_xlim()[0] > 200


def test_evidence_stands_above_no_effect(result):
    (ax,) = evidence_figure(result).axes
    assert [bar.get_width() for bar in ax.patches] == [200.0, 198.25, 197.0, 0.0]
    assert [text.get_text().split(",")[0] for text in ax.texts] == ["82.0 %", "14.0 %", "4.0 %", "< 0.1 %"]


def test_of_two_effects_together_one_alone_is_neither_accepted_nor_its_equal(result):
    """Green, orange and blue: a pair, the pair with one exchanged for its equal, anything else."""
    pair = {"added_mass": ["added_mass", "gain_error"], "spot_offset": ["spot_offset"]}
    names = ("added_mass + spot_offset", "gain_error + spot_offset", "added_mass", "spot_offset", "none")
    one = result.candidates[0]
    shares = (0.7, 0.27, 0.01, 0.01, 0.01)
    candidates = [
        one.but(name=n, delta_bic=float(k), chi2_per_dof=None, probability=p)
        for k, (n, p) in enumerate(zip(names, shares, strict=True))
    ]
    found = result.but(verdict="ambiguous", equivalent=pair, candidates=candidates)
    (ax,) = evidence_figure(found).axes
    first, second, third, fourth, _ = (bar.get_facecolor() for bar in ax.patches)
    assert len({first, second, third}) == 3
    assert third == fourth


def test_where_a_reading_was_set_aside_is_marked_in_its_segment_and_named(result):
    figure = residual_figure(result)
    marked = [[line for line in ax.lines if line.get_label() == NAME] for ax in figure.axes]
    at = [[x for line in lines for x in line.get_xdata()] for lines in marked]
    one, other = result.set_aside_hz
    assert at == [[], [], [one], [one], [other], [other]]
    assert NAME in [text.get_text() for text in figure.legends[0].get_texts()]
