"""The campaign on many plates: what was said beside the truth, counted; and the command that runs it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

from campaign.__main__ import campaign
from campaign.plates import visible
from campaign.plates.answers import Answer, Band, line_of, outcome_from, outcome_of
from campaign.plates.asked import Asked
from campaign.plates.cases import KINDS, NONE, draw_case
from campaign.plates.hidden import ON_REQUEST
from campaign.plates.judged import left_out
from campaign.plates.run import ROTATION, run_plates
from campaign.plates.score import reliability, score, traces
from campaign.plates.tables import summary
from campaign.run import in_rotation
from fitting.data.noise import noise_of
from instrument.errors import BadInput

pytestmark = pytest.mark.usefixtures("coarse_plates")


def answered(case, verdict, effects=(), off=1.0, **more):
    f = np.array(case.truth.resonances_hz)
    G = case.truth.law.modulus(2 * np.pi * f)
    storage, loss = off * G.real, G.imag / G.real
    band = Band(*(tuple(v.tolist()) for v in (f, storage, loss, 0.02 * storage, 0.02 * loss)))
    said = Answer(
        verdict, tuple(effects), more.get("equivalent", {}), more.get("stated", {}), band, band, 1.0
    )
    return outcome_of(case, band, said)


def test_the_score_of_hand_made_answers():
    clean = draw_case(NONE, 4, plate="P2", law="fractional-zener")
    late = draw_case("channel_delay", 1, plate="P2", law="fractional-zener")
    right = answered(late, "effect", ["channel_delay"], stated={"channel_delay": 0.9, "gain_error": 0.1})
    grouped = answered(
        late,
        "ambiguous",
        ["sensor_lowpass"],
        equivalent={"sensor_lowpass": ("sensor_lowpass", "channel_delay")},
    )
    wrong = answered(late, "effect", ["tether", "gain_error"], off=1.1)
    nothing, alarm = answered(clean, "none"), answered(clean, "effect", ["tether"])
    found = score("late", [right, grouped, wrong])
    assert (found.first, found.in_group, found.whole, found.false_named, found.false_second) == (
        1,
        2,
        1,
        1,
        1,
    )
    assert found.after["storage"].points == 9
    assert found.after["storage"].inside_95 == pytest.approx(2 / 3)
    assert found.after["loss"].rms_pull == pytest.approx(0.0, abs=1e-9)
    assert score(NONE, [nothing, alarm]).first == score(NONE, [nothing, alarm]).false_named == 1
    bins = reliability([right])
    assert [(b.count, b.true) for b in bins] == [(1, 0.0), (1, 1.0)]
    text = summary([right, grouped, wrong, nothing, alarm])
    assert "| channel_delay | 3 | 1 | 2 |" in text
    assert outcome_from(line_of(grouped)) == grouped


def test_names_are_counted_by_how_plainly_the_hidden_effect_shows():
    late = draw_case("channel_delay", 1, plate="P2", law="fractional-zener")
    right, unknown = answered(late, "effect", ["channel_delay"]), answered(late, "unknown")
    plain, faint = (replace(right, visible_chi2=x) for x in (400.0, 12.0))
    cases = [plain, faint, replace(unknown, visible_chi2=15.0), right, replace(plain, truth=(), kind=NONE)]
    found = [(t.low, t.cases, t.named, t.first, t.in_group) for t in traces(cases)]
    assert found == [(10.0, 2, 2, 1, 1), (100.0, 1, 1, 1, 1)]
    assert outcome_from(line_of(faint)) == faint


def test_what_shows_is_what_no_fit_takes_up_of_the_sweep_without_noise(monkeypatch):
    case = draw_case("gain_error", 1, plate="P2")
    clean = case.silent.without_m_s

    def identify(files, hammer):
        sweep = files[0].sweep
        off = np.abs(sweep.velocity_m_s - clean) / sweep.std_m_s
        assert np.all(sweep.base_m_s2 == case.sweep.commanded_m_s2)
        return SimpleNamespace(
            joint=SimpleNamespace(begun=SimpleNamespace(none=SimpleNamespace(chi2=7 + off @ off)))
        )

    monkeypatch.setattr(visible, "identify", identify)
    (gain,) = case.truth.effects
    std = noise_of(case.sweep).std_m_s
    expected = np.sum((np.abs(clean) * (gain.factor - 1) / std) ** 2)
    assert visible.visible_chi2(case) == pytest.approx(expected, rel=1e-6)
    assert visible.visible_chi2(draw_case(NONE, 4, plate="P2")) is None


def test_a_fault_of_no_catalogue_should_be_refused():
    case = draw_case("gain_error", 1, plate="P2")
    strange = replace(
        answered(case, "unknown"),
        kind="tip_magnet",
        truth=("tip_magnet",),
        near={"tip_magnet": ()},
        strange=True,
    )
    assert score("strange", [strange]).first == score("strange", [strange]).refused == 1


def true_band(case):
    return answered(case, "none").identified


def thirty(case):
    return 30.0


def no_effect(case):
    return answered(case, "none", stated={"none": 1.0}).said


ASKED = Asked(identify=true_band, diagnose=no_effect)


def test_a_campaign_goes_on_where_it_was_stopped(tmp_path):
    jobs = in_rotation((NONE, "gain_error"), 3, 11)
    first = run_plates(jobs[:2], tmp_path, ASKED, workers=1)
    with open(tmp_path / "outcomes.jsonl", "a", encoding="utf-8") as file:
        file.write('{"kind": "none", "se')
    lines = run_plates(jobs, tmp_path, ASKED, workers=1)
    assert [line["seed"] for line in lines] == [11, 12, 13]
    assert lines[:2] == first
    with pytest.raises(BadInput, match="other sources or options"):
        run_plates(jobs, tmp_path, ASKED, exact=True, workers=1)


def test_what_contains_the_true_one_is_left_out_with_it():
    assert sorted(left_out(["added_mass"])) == ["added_mass", "added_masses"]
    assert sorted(left_out(["clamp_compliance", "gain_error"])) == [
        "clamp_compliance",
        "clamp_friction",
        "gain_error",
        "uneven_clamp",
    ]
    assert left_out(["stiffener"]) == []


def summary_of_one(folder, kind, how):
    options = ["--count", "1", "--seed", "11", "--kind", kind, "--workers", "1"]
    result = CliRunner().invoke(campaign, ["plates", str(folder), how, *options])
    assert result.exit_code == 0, result.output
    return result.output


def test_the_command_runs_it_and_keeps_the_summary(tmp_path, monkeypatch):
    monkeypatch.setattr("campaign.__main__.diagnosed_without_the_truth", no_effect)
    monkeypatch.setattr("campaign.__main__.visible_chi2", thirty)
    said = summary_of_one(tmp_path, "gain_error", "--without-truth")
    assert "gain_error" in said
    assert "| 20 to 40 | 1 | 0 | 0 | 0 |" in said
    assert (tmp_path / "summary.md").read_text(encoding="utf-8") == said[:-1]


def test_the_law_alone_can_be_asked_for_and_nothing_is_said_of_names(tmp_path, monkeypatch):
    monkeypatch.setattr("campaign.__main__.identified", true_band)
    said = summary_of_one(tmp_path, "none", "--law-alone")
    assert "| none | identify | 3 | 1.00 | 1.00 |" in said
    assert "Naming" not in said


def test_the_command_takes_kinds_of_one_campaign_only(tmp_path):
    result = CliRunner().invoke(campaign, ["plates", str(tmp_path), "--kind", "mains_hum"])
    assert result.exit_code == 2
    assert "'mains_hum' is not one of" in result.output


def test_every_kind_is_in_rotation():
    assert set(ROTATION) == set(KINDS) - set(ON_REQUEST)


@pytest.mark.parametrize(("least", "diagnosed"), [("20", True), ("40", False)])
def test_what_shows_too_little_is_drawn_and_not_diagnosed(tmp_path, monkeypatch, least, diagnosed):
    monkeypatch.setattr("campaign.__main__.diagnosed", no_effect)
    monkeypatch.setattr("campaign.__main__.visible_chi2", thirty)
    options = ["--count", "2", "--seed", "11", "--kind", "gain_error", "--workers", "1", "--shows", least]
    said = CliRunner().invoke(campaign, ["plates", str(tmp_path), *options]).output
    assert said.startswith(f"# {2 * diagnosed} sweeps")
    assert ("2 more were drawn in which what is hidden shows too little." in said) is not diagnosed


@pytest.mark.parametrize(
    "asked", [["plates", "--shows", "20"], ["plates", "--without-truth"], ["beams", "--shows", "20"]]
)
def test_what_is_of_diagnoses_is_refused_beside_the_law_alone(tmp_path, asked):
    of, *more = asked
    found = CliRunner().invoke(campaign, [of, str(tmp_path), "--law-alone", *more])
    assert isinstance(found.exception, BadInput)
    assert f"{more[0]} is of diagnoses" in str(found.exception)


@pytest.mark.parametrize("of", ["plant", "apart"])
def test_what_shows_is_asked_of_solids_that_are_diagnosed_once(tmp_path, of):
    assert CliRunner().invoke(campaign, [of, str(tmp_path), "--shows", "20"]).exit_code == 2
